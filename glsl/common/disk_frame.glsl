// An ellipse after Minv in coordinates that leave little to compute, without a 2D eigensystem. Ours.
//
// Of all conjugate semi-axes the pair (A, B) is taken whose B is horizontal, and the horizontal axes are turned so that B
// lies along x: with the centre C,
//
//     A = (a1, a2, a3), a3 >= 0     B = (b, 0, 0)     C = (c1, c2, c3)     N = A x B = b h n, h = hypot(a2, a3)
//
// so the rim rises to c3 +- a3, and in the light's plane, whose axes are x and n x x, A = (a1, h), B = (b, 0), C = (c1, d)
// with the origin at the height cz over it.

#ifndef ROOTQ_DISK_FRAME
#define ROOTQ_DISK_FRAME

#include "common/elliptic_cone.glsl"
#include "common/power_of_two.glsl"

// A light that is longer than 2^12 times what else there is seems endless, to 2^-24 of the hemisphere: it is cut there.
const float DISK_ENDLESS = 4096.0;

// The light's size is 2^10: products of up to eight lengths occur, so that the largest leave a factor of 10 to the end of f32's
// range, and the smallest have the rest of it. A height below this is taken for this, 1e-18 of the light's size: the point is
// on the light, on the side it was.
const float DISK_TOUCHING = 1.0e-15;

// A light is level if the products that make its area are this many times its rise times its longer vector.
const float DISK_FLAT = 16.0;

struct DiskFrame {
    float a1;
    float a3;
    float b;
    float h;
    float c1;
    float c3;
    float d;
    float cz;     // signed, never 0
    float area;   // b h; 0: a light without area, and the rest undefined
    vec2 slope;   // (a2, a3)/h: the way from the plane's axes to y and z
};

float disk_longest(vec3 v)
{
    return max(abs(v.x), max(abs(v.y), abs(v.z)));
}

// For the centre and any conjugate semi-axes before m. Matrix, light and image are scaled by powers of two; the first two to 2^19,
// for the volume is a product of six.
//
// What belongs to a plane is mapped by the cofactors of m, since m v1 x m v2 = cof(m) (v1 x v2): a matrix that makes needles of
// all lights, as at grazing angles, costs no digits then, where a cross product of the images loses as many as the needle
// is long.
DiskFrame disk_frame(mat3 m, vec3 c, vec3 v1, vec3 v2)
{
    float scale = scale_to_power(disk_longest(max(abs(m[0]), max(abs(m[1]), abs(m[2])))), 19);
    m[0] *= scale;
    m[1] *= scale;
    m[2] *= scale;
    float size1 = disk_longest(v1);
    float size2 = disk_longest(v2);
    scale = scale_to_power(max(disk_longest(c), max(size1, size2)), 19);
    c *= scale;
    v1 *= scale;
    v2 *= scale;
    size1 *= scale;
    size2 *= scale;

    vec3 C = m * c;
    vec3 V1 = m * v1;
    vec3 V2 = m * v2;
    vec3 k0 = cross(m[1], m[2]);
    vec3 k1 = cross(m[2], m[0]);
    vec3 k2 = cross(m[0], m[1]);
    vec3 kz = vec3(k0.z, k1.z, k2.z);
    vec3 area = cross(v1, v2);
    vec3 N = area.x * k0 + area.y * k1 + area.z * k2;
    float volume = dot(kz, vec3(m[0].z, m[1].z, m[2].z)) * dot(area, c);

    float far = disk_longest(C);
    float long1 = disk_longest(V1);
    float long2 = disk_longest(V2);
    // At most one of them is endless.
    float longer = max(long1, long2);
    float cut = min(DISK_ENDLESS * max(min(long1, long2), far) / max(longer, DISK_SMALLEST), 1.0);
    scale = scale_to_power(max(far, max(min(long1, long2), longer * cut)), 10);
    float cut1 = long1 < longer ? 1.0 : cut;
    float cut2 = long1 < longer ? cut : 1.0;
    cut1 *= scale;
    cut2 *= scale;
    C *= scale;
    V1 *= cut1;
    V2 *= cut2;
    N *= cut1;
    N *= cut2;
    volume = volume * scale * cut1 * cut2;

    DiskFrame f;
    vec2 up = vec2(V1.z, V2.z);
    float up_square = dot(up, up);
    bool level = up_square < 1.0e-36;
    float inverse_a3 = level ? 1.0 : inversesqrt(max(up_square, DISK_SMALLEST));
    up = level ? vec2(1.0, 0.0) : up * inverse_a3;
    f.a3 = level ? 0.0 : up_square * inverse_a3;
    // B a3 = V1.z V2 - V2.z V1 is N turned by a right angle. N's roundings are shares of its products, and over a3 they are more
    // than B where the light is level but for roundings: there the difference itself, whose roundings are shares of the longer
    // vector.
    vec2 k = max(abs(k0.xy), max(abs(k1.xy), abs(k2.xy)));
    float products = (size1 * cut1) * (size2 * cut2) * max(k.x, k.y);
    bool flat_light = products > DISK_FLAT * f.a3 * max(long1 * cut1, long2 * cut2);
    vec2 B = flat_light ? up.x * V2.xy - up.y * V1.xy : vec2(N.y, -N.x) * inverse_a3;
    float b2 = dot(B, B);
    float inverse_b = inversesqrt(max(b2, DISK_SMALLEST));
    B *= inverse_b;
    f.b = b2 * inverse_b;
    float n2 = dot(N, N);
    float inverse_n = inversesqrt(max(n2, DISK_SMALLEST));
    f.a1 = up.x * dot(B, V1.xy) + up.y * dot(B, V2.xy);
    f.area = min(n2, b2) > 1.0e-36 ? n2 * inverse_n : 0.0;
    f.h = f.area * inverse_b;
    f.slope = vec2(-N.z, f.b * f.a3) * inverse_n;
    f.c1 = dot(B, C.xy);
    f.c3 = C.z;
    // The height of C x B, by the light before m.
    float crossed = dot(kz, cross(c, (cut1 * up.y) * v1 - (cut2 * up.x) * v2)) * scale;
    f.d = crossed * inverse_b * f.slope.x + f.c3 * f.slope.y;
    float height = max(abs(volume) * inverse_n, DISK_TOUCHING);
    f.cz = volume < 0.0 ? -height : height;
    return f;
}

#endif
