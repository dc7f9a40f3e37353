// An ellipse after Minv in its own plane, with the point at the origin: one axis, what the conjugate one has across and along it,
// the centre's coordinates, and the heights of the unit vectors. Ours.
//
//     DISK_PRINCIPAL   the axes are the ellipse's own; else the longer of the given pair, and there is no 2D eigensystem
//
// Every number is within a few roundings of itself however long the ellipse is and however the matrix is graded, because what
// belongs to the plane never passes through differences of images: cofactors map the normal, m v1 x m v2 = cof(m) (v1 x v2), and
// the moment of the centre about the axis. What is across the axis is the area over it, and the centre's distances from the
// axis and from the plane are moment and volume over what they belong to.
//
// The order of factors is that in which they are known: a root or a quotient comes last, and nothing waits for it.

#ifndef ROOTQ_DISK_FRAME
#define ROOTQ_DISK_FRAME

#include "common/elliptic_cone.glsl"
#include "common/power_of_two.glsl"

// A light that is this many times as long as it is far and wide is cut there: what is beyond is seen within 2^-14 of its axis,
// and the rest of the rim bends by no more.
const float DISK_ENDLESS = 16384.0;

// The light and its distance are scaled to 2^12, so that products of eight lengths stay in f32's range. A width or a height below
// this is taken for this, 2^-43 of the distance or less: the point is on the light, on the side it was.
const float DISK_TOUCHING = 1.0e-13;

// 2^80, for the area: volumes of lights that the point is on are tiny.
const float DISK_LARGE = 1.2089258196146292e24;

// 2^40, for the centre of lights that the point is on, and back.
const float DISK_NEAR = 1.099511627776e12;

// Of squares of lengths: what is below is 0, and its reciprocal's products with lengths stay in range.
const float DISK_TINY = 1.0e-25;

struct DiskFrame {
    float along;    // length of the axis
    float shear;    // of the conjugate one along it; 0 for the ellipse's own axes
    float across;   // and across
    vec3 center;    // along, across and normal; never 0 along the normal
    vec3 heights;   // of the unit vectors of these three
    float rise2;    // the rim rises to height -+ its root
    float height;   // of the centre
    bool dark;      // no area, or seen edge-on: the rest is undefined
#ifndef DISK_PRINCIPAL
    // Of the squares h1 >= h2 of the ellipse's own semi-axes, to a few roundings of h1: 1/h1 and 1/(h1 - h2), long before the rest.
    float inverse_h1;
    float inverse_split;
#endif
};

// The products of a light's component and its column are of some powers of two: of top, middle and low. Lengths are told in units
// of 2^middle, so that a light may be 2^250 times as long as wide, or as wide as far.
struct DiskScale {
    vec3 image;      // 2^(own - middle): of a component, for images
    vec3 cofactor;   // 2^(low - own): of a cofactor, for the images of areas
    float needle;    // 2^(top - middle)
    float thin;      // 2^(low - middle)
#ifndef DISK_PRINCIPAL
    vec3 center;     // the light's, 2^40 times: near 0 beside its axes it would leave f32's range
#endif
};

// The largest power of two that a needle is taken to be longer than wide, before it is cut.
const int DISK_NEEDLE = 28;

// The smallest power of two that f32 has all digits of.
const int DISK_THIN = -126;

float disk_power(int exponent)
{
    return intBitsToFloat((exponent + 127) << 23);
}

vec3 disk_powers(ivec3 exponents)
{
    return intBitsToFloat((exponents + 127) << 23);
}

// Brings the light's components and the columns of m to 1..2, by powers of two each, but for what is 0 or denormal.
DiskScale disk_scale(inout mat3 m, inout vec3 c, inout vec3 v1, inout vec3 v2)
{
    vec3 light = max(abs(c), max(abs(v1), abs(v2)));
    vec3 column = vec3(largest_component(m[0]), largest_component(m[1]), largest_component(m[2]));
    ivec3 of_light = clamp(floatBitsToInt(light) >> 23, 1, 253);
    ivec3 of_column = clamp(floatBitsToInt(column) >> 23, 1, 253);
    vec3 scale = disk_powers(127 - of_column);
    m[0] *= scale.x;
    m[1] *= scale.y;
    m[2] *= scale.z;
    DiskScale s;
#ifndef DISK_PRINCIPAL
    // In two steps, for the power may leave f32's range where the product does not.
    ivec3 power = 127 + 127 + 127 + 40 - of_light;
    ivec3 first = power >> 1;
    precise vec3 center = c * intBitsToFloat(first << 23);
    center *= intBitsToFloat((power - first) << 23);
    s.center = center;
#endif
    scale = disk_powers(127 - of_light);
    c *= scale;
    v1 *= scale;
    v2 *= scale;

    ivec3 both = of_column + of_light;
    int top = max(max(both.x, both.y), both.z);
    int low = min(min(both.x, both.y), both.z);
    int middle = both.x + both.y + both.z - top - low;
    s.image = disk_powers(clamp(both - middle, DISK_THIN, DISK_NEEDLE));
    s.cofactor = disk_powers(max(low - both, DISK_THIN));
    s.needle = disk_power(min(top - middle, DISK_NEEDLE));
    s.thin = disk_power(max(low - middle, DISK_THIN));
    return s;
}

// For the centre and any conjugate semi-axes before m.
DiskFrame disk_frame(mat3 m, vec3 c, vec3 v1, vec3 v2)
{
    DiskScale by = disk_scale(m, c, v1, v2);
    vec3 C = m * (by.image * c);
    vec3 V1 = m * (by.image * v1);
    vec3 V2 = m * (by.image * v2);
    vec3 k0 = cross(m[1], m[2]);
    vec3 k1 = cross(m[2], m[0]);
    vec3 k2 = cross(m[0], m[1]);
    float det = k0.z * m[0].z + k1.z * m[1].z + k2.z * m[2].z;
    k0 *= by.cofactor.x;
    k1 *= by.cofactor.y;
    k2 *= by.cofactor.z;
    vec3 area = cross(DISK_LARGE * v1, v2);
    vec3 normal = area.x * k0 + area.y * k1 + area.z * k2;

    DiskFrame f;
    float d11 = dot(V1, V1);
    float d22 = dot(V2, V2);
#ifdef DISK_PRINCIPAL
    // Half the angle of (difference of squares, product) turns the pair to the axes. If it is off by a rounding, the pair is
    // still conjugate, and what the axis has of the other is a rounding of its length.
    float unit = 1.0 / max(d11 + d22, DISK_SMALLEST);
    float both = dot(V1, V2) * unit;
    float difference = 0.5 * (d11 - d22) * unit;
    float split = sqrt(difference * difference + both * both);
    vec2 turn = difference > 0.0 ? vec2(difference + split, both) : vec2(both, split - difference);
    float turn2 = dot(turn, turn);
    turn = turn2 > 1.0e-18 ? turn * inversesqrt(turn2) : vec2(1.0, 0.0);
    vec3 before = turn.x * v1 + turn.y * v2;
    vec3 axis = turn.x * V1 + turn.y * V2;
    float axis2 = dot(axis, axis);
#else
    bool first = d11 > d22;
    vec3 before = first ? v1 : v2;
    vec3 axis = first ? V1 : V2;
    float axis2 = max(d11, d22);
    float d12 = dot(V1, V2);
    float difference = d11 - d22;
    float split = sqrt(difference * difference + 4.0 * (d12 * d12));
    float inverse_split = 1.0 / max(split, DISK_TINY);
    float inverse_h1 = 2.0 / max(d11 + d22 + split, DISK_TINY);
#endif
    axis2 = max(axis2, DISK_SMALLEST);
    float inverse_along = inversesqrt(axis2);
    float lead = dot(C, axis) / axis2;
    axis *= inverse_along;
    float along = axis2 * inverse_along;
    float x = lead * along;
    // Most of the centre of a needle that passes the point is along it, and would round what is across; but a share that
    // is nothing would round the rest of the centre.
#ifdef DISK_PRINCIPAL
    vec3 off = c - (abs(lead) < 1.0 / DISK_ENDLESS ? 0.0 : lead) * before;
    float volume = dot(area, off);
    float side = volume;
    bool edge_on = dot(area, c) == 0.0;
#else
    // By what the terms of the volume add up to, which is the same either way; 2^40 times, for its sign is more than f32 has of it.
    vec3 off = c - lead * before;
    vec3 whole = area * by.center;
    vec3 rest = area * off;
    float of_whole = whole.x + whole.y + whole.z;
    float of_rest = rest.x + rest.y + rest.z;
    bool less = abs(whole.x) + abs(whole.y) + abs(whole.z) <= DISK_NEAR * (abs(rest.x) + abs(rest.y) + abs(rest.z));
    float side = less ? of_whole : DISK_NEAR * of_rest;
    off = less ? c : off;
    float volume = side * (1.0 / DISK_NEAR);
    bool edge_on = of_whole == 0.0;
#endif
    vec3 moment = cross(off, before);
    float normal_scale = scale_to_one(largest_component(normal));
    normal *= normal_scale;
    float normal2 = dot(normal, normal);
    float inverse_normal = inversesqrt(max(normal2, DISK_SMALLEST));
    float inverse_both = inverse_normal * (inverse_along * by.needle);
    float across = normal2 * (reciprocal_power_of_two(normal_scale) * (1.0 / DISK_LARGE)) * inverse_both;
    float y = -dot(normal, moment.x * k0 + moment.y * k1 + moment.z * k2) * inverse_both;
    float z = (det * by.thin) * (volume * normal_scale) * inverse_normal;
    f.heights = vec3(axis.z, (normal.x * axis.y - normal.y * axis.x) * inverse_normal, normal.z * inverse_normal);

    float near = max(max(abs(y), abs(z)), max(across, abs(x) - along));
    // Edge-on exactly: a product that rounds to 0 alone may be a needle's.
    f.dark = normal2 < 0.5 || det == 0.0 || (edge_on && abs(z) <= 1.0e-6 * near);
    float end = DISK_ENDLESS * near;
    float inverse_end = 1.0 / max(end, DISK_SMALLEST);
    bool endless = along > end;
    // The length that such a light's own axis has.
    float own = along;
    float inverse_own = inverse_along;
#ifndef DISK_PRINCIPAL
    f.shear = (first ? d12 : -d12) * inverse_along;
    float own2 = max(along * along + f.shear * f.shear, DISK_SMALLEST);
    inverse_own = inversesqrt(own2);
    own = own2 * inverse_own;
    float tilt = endless ? f.shear * inverse_own * (across * inverse_own) : 0.0;
    y -= tilt * x;
    f.heights.xy += tilt * vec2(f.heights.y, -f.heights.x);
    f.shear = endless ? 0.0 : f.shear;
#else
    f.shear = 0.0;
#endif
    // It becomes one of the same width at the point's foot, or with the same tip.
    float beyond = abs(x) - own;
    bool between = -beyond > end;
    float share = -beyond * inverse_own;
    float over = (between ? share : end * inverse_own) * (2.0 - share);
    float under = between ? 1.0 : 2.0 + beyond * inverse_end;
    float left = between ? 0.0 : end + beyond;
    x = endless ? (x < 0.0 ? -left : left) : x;
    across *= endless ? along * inverse_own * (over * inversesqrt(max(over * under, DISK_SMALLEST))) : 1.0;
    along = min(along, end);

    float scale = scale_to_power(max(along, near), 12);
    f.along = along * scale;
    f.shear *= scale;
    f.across = max(across * scale, DISK_TOUCHING);
#ifndef DISK_PRINCIPAL
    float back = reciprocal_power_of_two(scale);
    float by_end = inverse_end * back;
    f.inverse_h1 = endless ? by_end * by_end : inverse_h1 * back * back;
    f.inverse_split = endless ? by_end * by_end : inverse_split * back * back;
#endif
    bool below = (side < 0.0) != (det < 0.0);
    float apart = max(abs(z) * scale, DISK_TOUCHING);
    apart = below ? -apart : apart;
    f.center = vec3(x * scale, y * scale, apart);
    // Of these very coordinates: a light turned by a rounding looks the same, but where its parts disagree about the horizon, one
    // that lies almost in it flips.
    f.height = dot(f.center, f.heights);
    vec2 reach = vec2(f.along * f.heights.x, f.shear * f.heights.x + f.across * f.heights.y);
    f.rise2 = dot(reach, reach);
    return f;
}

#endif
