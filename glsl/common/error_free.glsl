// Error-free transformations in f32: products, and differences of two products, with their rounding errors kept.
//
// Everything that must not be contracted or reassociated is `precise`. Underflow is the one exception to
// exactness: partial products below 2^-126 may be flushed, so |a b| should exceed 2^-78.

#ifndef ROOTQ_ERROR_FREE
#define ROOTQ_ERROR_FREE

// The upper 12 bits of a, rounded to nearest; a - high has at most 12 bits more, and is exact. |a| < 2^115.
// Source: Dekker, "A floating-point technique for extending the available precision", 1971 (Veltkamp's splitting).
vec3 split_high(vec3 a)
{
    precise vec3 c = 4097.0 * a;
    precise vec3 d = c - a;
    precise vec3 high = c - d;
    return high;
}

// The rounding error of the product p = fl(a b), from both factors split as a = a_high + a_low: a b = p + error,
// exactly. Source: Dekker 1971.
vec3 product_error(vec3 p, vec3 a_high, vec3 a_low, vec3 b_high, vec3 b_low)
{
    precise vec3 e = a_high * b_high - p;
    e = e + a_high * b_low;
    e = e + a_low * b_high;
    e = e + a_low * b_low;
    return e;
}

// a b - c d with one fused operation carrying the rounding error of c d: within 1.5 ulp if fma() is fused, and no
// better than the plain expression if it is not (Vulkan allows both).
// Source: Kahan; bound by Jeannerod, Louvet & Muller, "Further analysis of Kahan's algorithm for the accurate
// computation of 2x2 determinants", 2013.
vec3 difference_of_products_fma(vec3 a, vec3 b, vec3 c, vec3 d)
{
    precise vec3 p = c * d;
    precise vec3 error = fma(-c, d, p);
    precise vec3 difference = fma(a, b, -p);
    precise vec3 result = difference + error;
    return result;
}

// a x b, each component a difference of products with both rounding errors kept: a component that cancels down to
// 2^-24 of its products is still good to two roundings.
// Source: Dekker 1971; the compensated difference as in Ogita, Rump & Oishi, "Accurate sum and dot product", 2005.
vec3 cross_dekker(vec3 a, vec3 b)
{
    vec3 a_high = split_high(a);
    vec3 b_high = split_high(b);
    precise vec3 a_low = a - a_high;
    precise vec3 b_low = b - b_high;

    precise vec3 p = a.yzx * b.zxy;
    precise vec3 q = a.zxy * b.yzx;
    vec3 p_error = product_error(p, a_high.yzx, a_low.yzx, b_high.zxy, b_low.zxy);
    vec3 q_error = product_error(q, a_high.zxy, a_low.zxy, b_high.yzx, b_low.yzx);

    precise vec3 difference = p - q;
    precise vec3 error = p_error - q_error;
    precise vec3 result = difference + error;
    return result;
}

// a x b by Kahan's difference of products.
vec3 cross_fma(vec3 a, vec3 b)
{
    return difference_of_products_fma(a.yzx, b.zxy, a.zxy, b.yzx);
}

#endif
