// What a ray that hits nothing returns for its parameter: the largest finite number. Finite, since a shader may assume that
// there are no infinities; no legal parameter; and above every hit where the nearest is looked for.

#ifndef ROOTQ_RAY_MISS
#define ROOTQ_RAY_MISS

const float RAY_MISS = 3.402823466e+38;

#endif
