// Directions orthogonal to a given one, where the data determines none. Ours.

#ifndef ROOTQ_ORTHOGONAL
#define ROOTQ_ORTHOGONAL

// A unit vector orthogonal to the unit vector n: n turned by 90 degrees in the coordinate plane that holds at least
// half of its square.
vec3 any_orthogonal(vec3 n)
{
    vec3 turned = abs(n.x) > abs(n.z) ? vec3(-n.y, n.x, 0.0) : vec3(0.0, -n.z, n.y);
    return turned * inversesqrt(dot(turned, turned));
}

// The part of v orthogonal to the unit vector n. Where hardly anything remains of v, that remainder is rounding
// error, and its direction is not orthogonal to n either: the answer is then zero.
vec3 orthogonal_part(vec3 v, vec3 n)
{
    vec3 part = v - dot(v, n) * n;
    return dot(part, part) > 9.5367431640625e-7 * dot(v, v) ? part : vec3(0.0);
}

#endif
