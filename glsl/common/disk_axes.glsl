// An ellipse after Minv by its own axes, with the point at the origin: lengths, the centre's coordinates along them and across,
// and the heights of their unit vectors. Ours.
//
// Every number is within a few roundings of itself however long the ellipse is and however the matrix is graded, because what
// belongs to the plane never passes through differences of images: cofactors map the normal, m v1 x m v2 = cof(m) (v1 x v2), and
// the moment of the centre about the long axis, so that the short axis is the area over the long one, and the distances from the
// long axis and from the plane are theirs.

#ifndef ROOTQ_DISK_AXES
#define ROOTQ_DISK_AXES

#include "common/elliptic_cone.glsl"
#include "common/power_of_two.glsl"

// A light that is this many times as long as it is far and wide is cut there: what is beyond is in a direction within 2^-14 of
// its axis, and the rest of the rim bends by no more.
const float DISK_ENDLESS = 16384.0;

// The rest is scaled to 2^13, which leaves products of eight lengths in f32's range. A width or height below this, 1e-13 of the distance
// or less, is taken for this: the point is on the light, on the side it was.
const float DISK_TOUCHING = 1.0e-13;

// 2^60: of areas, whose products with a third length would leave the range of f32 first.
const float DISK_LARGE = 1.152921504606847e18;

struct DiskAxes {
    float major;
    float minor;
    vec3 center;    // along the major axis, the minor one and the normal; never 0 across
    vec3 heights;   // of the unit vectors of these three
    float rise;     // the rim rises to height -+ rise
    float height;   // of the centre
    bool dark;      // no area, or seen edge-on: the rest is undefined
};

// What the light's components are multiplied by, and the columns of m. Both products with one component get alike, so that
// m v stays itself up to a power of two; the largest are 1 and 2^12.
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
    scale = intBitsToFloat(clamp(254 + 12 - top + apart, 1, 253) << 23);
    c *= scale;
    v1 *= scale;
    v2 *= scale;
}

// For the centre and any conjugate semi-axes before m.
DiskAxes disk_axes(mat3 m, vec3 c, vec3 v1, vec3 v2)
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
    float volume = dot(area, c);

    // Half the angle of (difference of squares, product) turns the conjugate pair to the axes. An angle that is off by a
    // rounding leaves a conjugate pair.
    float d11 = dot(V1, V1);
    float d22 = dot(V2, V2);
    float unit = 1.0 / max(d11 + d22, DISK_SMALLEST);
    float both = dot(V1, V2) * unit;
    float difference = 0.5 * (d11 - d22) * unit;
    float split = sqrt(difference * difference + both * both);
    vec2 turn = difference > 0.0 ? vec2(difference + split, both) : vec2(both, split - difference);
    float square = dot(turn, turn);
    turn = square > 1.0e-18 ? turn * inversesqrt(square) : vec2(1.0, 0.0);
    vec3 before = turn.x * v1 + turn.y * v2;
    vec3 along = turn.x * V1 + turn.y * V2;

    DiskAxes f;
    float long2 = dot(along, along);
    float inverse_long = inversesqrt(max(long2, DISK_SMALLEST));
    along *= inverse_long;
    float major = long2 * inverse_long;
    float normal_scale = scale_to_one(largest_component(normal));
    normal *= normal_scale;
    float normal2 = dot(normal, normal);
    float inverse_normal = inversesqrt(max(normal2, DISK_SMALLEST));
    normal *= inverse_normal;
    f.dark = normal2 < 0.5 || volume == 0.0 || det == 0.0;
    float minor = normal2 * inverse_normal * (reciprocal_power_of_two(normal_scale) / DISK_LARGE) * inverse_long;
    vec3 moment = cross(c, before);
    float x = dot(C, along);
    float y = -dot(normal, moment.x * k0 + moment.y * k1 + moment.z * k2) * inverse_long;
    float z = det * (volume * normal_scale * inverse_normal);
    f.heights = vec3(along.z, normal.x * along.y - normal.y * along.x, normal.z);

    // A light that is longer than the point can tell becomes one of the same width at the point's foot, or with the same
    // tip.
    float beyond = abs(x) - major;
    float near = max(max(abs(y), abs(z)), max(minor, beyond));
    float end = DISK_ENDLESS * near;
    bool endless = major > end;
    bool between = -beyond > end;
    float share = -beyond * inverse_long;
    float over = (between ? share : end * inverse_long) * (2.0 - share);
    float under = between ? 1.0 : 2.0 + beyond / max(end, DISK_SMALLEST);
    float left = between ? 0.0 : end + beyond;
    x = endless ? (x < 0.0 ? -left : left) : x;
    minor *= endless ? over * inversesqrt(max(over * under, DISK_SMALLEST)) : 1.0;
    major = min(major, end);
    float height = endless ? x * f.heights.x + y * f.heights.y + z * f.heights.z : C.z;

    float scale = scale_to_power(max(major, near), 13);
    f.major = major * scale;
    f.minor = max(minor * scale, DISK_TOUCHING);
    z *= scale;
    bool below = (volume < 0.0) != (det < 0.0);
    float across = max(abs(z), DISK_TOUCHING);
    across = below ? -across : across;
    f.center = vec3(x * scale, y * scale, across);
    f.height = height * scale + (across - z) * f.heights.z;
    vec2 reach = vec2(f.major, f.minor) * f.heights.xy;
    f.rise = sqrt(reach.x * reach.x + reach.y * reach.y);
    return f;
}

#endif
