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

// The upper 12 bits of a, truncated: one operation, any finite a, and the rest has at most 12 bits as well.
vec3 mask_high(vec3 a)
{
    return uintBitsToFloat(floatBitsToUint(a) & 0xfffff000u);
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

// a x b from the halves of a and b, each component a difference of products with both rounding errors kept: a
// component that cancels down to 2^-24 of its products is still good to two roundings.
// Source: Dekker 1971; the compensated difference as in Ogita, Rump & Oishi, "Accurate sum and dot product", 2005.
vec3 cross_compensated(vec3 a, vec3 a_high, vec3 b, vec3 b_high)
{
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

// a x b with Dekker's own splitting.
vec3 cross_dekker(vec3 a, vec3 b)
{
    return cross_compensated(a, split_high(a), b, split_high(b));
}

// a x b with the splitting by mask: the same accuracy.
vec3 cross_mask(vec3 a, vec3 b)
{
    return cross_compensated(a, mask_high(a), b, mask_high(b));
}

// a x b = ah x bh + ah x bl + al x b. The products of the first two terms are exact in f32, so contraction changes
// nothing in them, and where the products of ah x bh cancel their difference is exact too. What remains are the
// roundings of terms 2^-11 as large: an error below 2^-34 |a| |b|. Contraction is harmless, reassociation is not: a
// compiler that factors a_high b_low + a_low b_low into a b has undone the splitting, and lavapipe does.
// Source: ours.
vec3 cross_split(vec3 a, vec3 b)
{
    vec3 a_high = mask_high(a);
    vec3 b_high = mask_high(b);
    vec3 a_low = a - a_high;
    vec3 b_low = b - b_high;

    vec3 high = a_high.yzx * b_high.zxy - a_high.zxy * b_high.yzx;
    vec3 middle = a_high.yzx * b_low.zxy - a_high.zxy * b_low.yzx;
    vec3 low = a_low.yzx * b.zxy - a_low.zxy * b.yzx;
    return high + (middle + low);
}

// a x b by Kahan's difference of products.
vec3 cross_fma(vec3 a, vec3 b)
{
    return difference_of_products_fma(a.yzx, b.zxy, a.zxy, b.yzx);
}

// a + b as the rounded sum and, in `low`, its rounding error: exactly. Source: Knuth, The Art of Computer Programming 2.
vec3 sum_pair(vec3 a, vec3 b, out vec3 low)
{
    precise vec3 sum = a + b;
    precise vec3 of_b = sum - a;
    precise vec3 of_a = sum - of_b;
    precise vec3 error = (a - of_a) + (b - of_b);
    low = error;
    return sum;
}

// a x b as a vector and, in `low`, the rest: off by 2^-46 of each component's products. Source: Dekker 1971.
vec3 cross_pair(vec3 a, vec3 b, out vec3 low)
{
    vec3 a_high = mask_high(a);
    vec3 b_high = mask_high(b);
    precise vec3 a_low = a - a_high;
    precise vec3 b_low = b - b_high;

    precise vec3 p = a.yzx * b.zxy;
    precise vec3 q = a.zxy * b.yzx;
    vec3 p_error = product_error(p, a_high.yzx, a_low.yzx, b_high.zxy, b_low.zxy);
    vec3 q_error = product_error(q, a_high.zxy, a_low.zxy, b_high.yzx, b_low.yzx);

    vec3 error;
    vec3 difference = sum_pair(p, -q, error);
    precise vec3 rest = error + (p_error - q_error);
    precise vec3 sum = difference + rest;
    precise vec3 remainder = rest - (sum - difference);
    low = remainder;
    return sum;
}

// (a + a_low).(b + b_low), the second parts at most 2^-24 of the first: off by one rounding of the result and 2^-45 of
// the products. Source: Ogita, Rump & Oishi 2005, with the second parts' products added.
float dot_pair(vec3 a, vec3 a_low, vec3 b, vec3 b_low)
{
    vec3 a_high = mask_high(a);
    vec3 b_high = mask_high(b);
    precise vec3 p = a * b;
    precise vec3 a_rest = a - a_high;
    precise vec3 b_rest = b - b_high;
    vec3 p_error = product_error(p, a_high, a_rest, b_high, b_rest);
    precise vec3 small = p_error + (a * b_low + a_low * b);

    vec3 error;
    float first = sum_pair(p.xxx, p.yyy, error).x;
    precise float rest = error.x;
    float sum = sum_pair(vec3(first), p.zzz, error).x;
    rest = rest + error.x;
    rest = rest + small.x;
    rest = rest + small.y;
    rest = rest + small.z;
    precise float result = sum + rest;
    return result;
}

#endif
