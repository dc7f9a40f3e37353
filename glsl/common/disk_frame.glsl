// An ellipse after Minv in its own plane, with the point at the origin: one axis, what the conjugate one has across and along it,
// the centre's coordinates, and the heights of the unit vectors. Ours.
//
//     DISK_PRINCIPAL   the axes are the ellipse's own; else the longer of the given pair, and there is no 2D eigensystem
//
// Every number is within a few roundings of itself however long the ellipse is and however the matrix is graded, because what
// belongs to the plane never passes through differences of images: cofactors map the normal, m v1 x m v2 = cof(m) (v1 x v2), and
// the moment of the centre about the axis. What is across the axis is the area over it, and the centre's distances from the
// axis and from the plane are moment and volume over what they belong to.

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

// 2^60, for areas: products with a third length leave the range of f32 later.
const float DISK_LARGE = 1.152921504606847e18;

struct DiskFrame {
    float along;    // length of the axis
    float shear;    // of the conjugate one along it; 0 for the ellipse's own axes
    float across;   // and across
    vec3 center;    // along, across and normal; never 0 along the normal
    vec3 heights;   // of the unit vectors of these three
    float rise;     // the rim rises to height -+ rise
    float height;   // of the centre
    bool dark;      // no area, or seen edge-on: the rest is undefined
};

// Multiplies the light's components and the columns of m by powers of two. Both factors of a product of one component and its
// column get alike, so that m v stays itself up to a power of two; the largest are in 1..2 and 2^12..2^13.
void disk_scale(inout mat3 m, inout vec3 c, inout vec3 v1, inout vec3 v2)
{
    vec3 light = max(abs(c), max(abs(v1), abs(v2)));
    vec3 column = vec3(largest_component(m[0]), largest_component(m[1]), largest_component(m[2]));
    ivec3 of_light = floatBitsToInt(light) >> 23;
    ivec3 of_column = floatBitsToInt(column) >> 23;
    ivec3 apart = (of_column - of_light) >> 1;
    ivec3 together = of_column + of_light;
    int top = max(together.x, max(together.y, together.z)) >> 1;
    vec3 scale = intBitsToFloat(clamp(254 - top - apart, 1, 253) << 23);
    m[0] *= scale.x;
    m[1] *= scale.y;
    m[2] *= scale.z;
    scale = intBitsToFloat(clamp(266 - top + apart, 1, 253) << 23);
    c *= scale;
    v1 *= scale;
    v2 *= scale;
}

// For the centre and any conjugate semi-axes before m.
DiskFrame disk_frame(mat3 m, vec3 c, vec3 v1, vec3 v2)
{
    disk_scale(m, c, v1, v2);
    vec3 C = m * c;
    vec3 V1 = m * v1;
    vec3 V2 = m * v2;
    vec3 k0 = cross(m[1], m[2]);
    vec3 k1 = cross(m[2], m[0]);
    vec3 k2 = cross(m[0], m[1]);
    vec3 area = cross(DISK_LARGE * v1, v2);
    vec3 normal = area.x * k0 + area.y * k1 + area.z * k2;
    float det = k0.z * m[0].z + k1.z * m[1].z + k2.z * m[2].z;

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
#else
    bool first = d11 > d22;
    vec3 before = first ? v1 : v2;
    vec3 axis = first ? V1 : V2;
    vec3 other = first ? V2 : -V1;
#endif
    float axis2 = dot(axis, axis);
    float inverse_along = inversesqrt(max(axis2, DISK_SMALLEST));
    axis *= inverse_along;
    float along = axis2 * inverse_along;
    float x = dot(C, axis);
    float normal_scale = scale_to_one(largest_component(normal));
    normal *= normal_scale;
    float normal2 = dot(normal, normal);
    float inverse_normal = inversesqrt(max(normal2, DISK_SMALLEST));
    normal *= inverse_normal;
    float across =
        normal2 * inverse_normal * (reciprocal_power_of_two(normal_scale) * (1.0 / DISK_LARGE)) * inverse_along;
    // Most of the centre of a needle that passes the point is along it, and would round what is across.
    vec3 off = c - (x * inverse_along) * before;
    float volume = dot(area, off);
    vec3 moment = cross(off, before);
    float y = -dot(normal, moment.x * k0 + moment.y * k1 + moment.z * k2) * inverse_along;
    float z = det * (volume * normal_scale * inverse_normal);
    f.heights = vec3(axis.z, normal.x * axis.y - normal.y * axis.x, normal.z);

    float near = max(max(abs(y), abs(z)), max(across, abs(x) - along));
    // Edge-on exactly: a product that rounds to 0 alone may be a needle's.
    f.dark = normal2 < 0.5 || det == 0.0 || (dot(area, c) == 0.0 && abs(z) <= 1.0e-6 * near);
    float end = DISK_ENDLESS * near;
    bool endless = along > end;
#ifdef DISK_PRINCIPAL
    f.shear = 0.0;
#else
    // Such a light's own axes are a stretch and a tilt away.
    f.shear = dot(other, axis);
    float ratio = f.shear * inverse_along;
    float stretch2 = 1.0 + ratio * ratio;
    float stretch = endless ? inversesqrt(stretch2) : 1.0;
    float tilt = endless ? across * inverse_along * ratio * (stretch * stretch) : 0.0;
    y -= tilt * x;
    f.heights.xy += tilt * vec2(f.heights.y, -f.heights.x);
    along *= endless ? stretch2 * stretch : 1.0;
    across *= stretch;
    inverse_along *= stretch;
    f.shear = endless ? 0.0 : f.shear;
#endif
    // It becomes one of the same width at the point's foot, or with the same tip.
    float beyond = abs(x) - along;
    bool between = -beyond > end;
    float share = -beyond * inverse_along;
    float over = (between ? share : end * inverse_along) * (2.0 - share);
    float under = between ? 1.0 : 2.0 + beyond / max(end, DISK_SMALLEST);
    float left = between ? 0.0 : end + beyond;
    x = endless ? (x < 0.0 ? -left : left) : x;
    across *= endless ? over * inversesqrt(max(over * under, DISK_SMALLEST)) : 1.0;
    along = min(along, end);
    float height = endless ? x * f.heights.x + y * f.heights.y + z * f.heights.z : C.z;

    float scale = scale_to_power(max(along, near), 12);
    f.along = along * scale;
    f.shear *= scale;
    f.across = max(across * scale, DISK_TOUCHING);
    z *= scale;
    bool below = (volume < 0.0) != (det < 0.0);
    float apart = max(abs(z), DISK_TOUCHING);
    apart = below ? -apart : apart;
    f.center = vec3(x * scale, y * scale, apart);
    f.height = height * scale + (apart - z) * f.heights.z;
    vec2 reach = vec2(f.along * f.heights.x, f.shear * f.heights.x + f.across * f.heights.y);
    f.rise = sqrt(reach.x * reach.x + reach.y * reach.y);
    return f;
}

#endif
