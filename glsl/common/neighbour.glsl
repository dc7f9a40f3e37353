// The next representable numbers, from bits: no arithmetic that a rounding mode or a rearrangement could change.

#ifndef ROOTQ_NEIGHBOUR
#define ROOTQ_NEIGHBOUR

// Zero and subnormals, which a device may flush, stay what they are.
bvec3 has_neighbours(ivec3 bits)
{
    return greaterThanEqual(bits & 0x7fffffff, ivec3(0x00800000));
}

// The next number above each component; infinite above the largest.
vec3 next_above(vec3 x)
{
    ivec3 bits = floatBitsToInt(x);
    ivec3 outwards = (bits >> 31) | 1;
    return intBitsToFloat(mix(bits, bits + outwards, has_neighbours(bits)));
}

// The next number below each component.
vec3 next_below(vec3 x)
{
    ivec3 bits = floatBitsToInt(x);
    ivec3 outwards = (bits >> 31) | 1;
    return intBitsToFloat(mix(bits, bits - outwards, has_neighbours(bits)));
}

#endif
