// Irradiance of an ellipse from its axes and the secular equation of its cone. Ours.
//
// With squares h1 >= h2 of the semi-axes and p, q, z of the centre's coordinates along them and across, the dual quadric
// V1 V1^T + V2 V2^T - C C^T has the eigenvalues e1 >= e3 >= 0 > -l with
//
//     f(l) = p/(h1 + l) + q/(h2 + l) + z/l = 1
//
// for the one positive l, and (x/(h1 + l), y/(h2 + l), height/l) is the mean direction, whose square is -f'(l). With the shares
// t1 + t2 + s = 1 of f,
//
//     e1 + e3 = h1 (t2 + s) + h2 (t1 + s)        e1 e3 = h1 h2 s        (l + e1) (l + e3) = (h1 + l) (h2 + l) l |w|^2
//
// so that no term is of more than four lengths, and none cancels.

#ifndef ROOTQ_DISK_SECULAR
#define ROOTQ_DISK_SECULAR

#define DISK_PRINCIPAL
#include "common/confocal.glsl"
#include "common/disk_frame.glsl"
#include "common/disk_irradiance.glsl"

// One step from any l > 0: the two poles give way to one with their value and slope at l. A lower bound, since the
// reciprocal of their sum is concave, and exact for circles.
float secular_step(float p, float h1, float q, float h2, float z, float l)
{
    float r1 = 1.0 / (h1 + l);
    float r2 = 1.0 / (h2 + l);
    float t1 = p * r1;
    float t2 = q * r2;
    float value = t1 + t2;
    float ratio = l / max(t1 * (l * r1) + t2 * (l * r2), DISK_SMALLEST);
    return confocal_root(value * value * ratio, max(value * ratio - l, 0.0), z);
}

// Halley's step on f = 1, all in shares of f.
float secular_halley(float p, float h1, float q, float h2, float z, float l)
{
    float r1 = 1.0 / (h1 + l);
    float r2 = 1.0 / (h2 + l);
    float t1 = p * r1;
    float t2 = q * r2;
    float s = z / l;
    float u1 = l * r1;
    float u2 = l * r2;
    float value = t1 + t2 + s - 1.0;
    float g1 = t1 * u1;
    float g2 = t2 * u2;
    float slope = g1 + g2 + s;
    float bend = g1 * u1 + g2 * u2 + s;
    return l + l * (value * slope / max(slope * slope - value * bend, DISK_SMALLEST));
}

// l: start, step and Halley's leave 1e-6 of it in one of a thousand, and 1e-4 at worst, of lights with aspects to 1e5, 1e-6 to
// 100 lengths away (emulated in f64).
float secular_lambda(float p, float h1, float q, float h2, float z)
{
    float l = confocal_start(p, h1, q, h2, z);
    l = secular_step(p, h1, q, h2, z, l);
    l = secular_halley(p, h1, q, h2, z, l);
    return max(l, max(z, p + q + z - h1));
}

DiskCone secular_cone(DiskFrame f)
{
    vec3 squares = f.center * f.center;
    float h1 = f.along * f.along;
    float h2 = f.across * f.across;
    float l = secular_lambda(squares.x, h1, squares.y, h2, squares.z);
    vec3 poles = 1.0 / vec3(h1 + l, h2 + l, l);
    vec3 w = f.center * poles;
    vec3 shares = f.center * w;
    float up = dot(w, f.heights);
    vec3 level = cross(w, f.heights);
    float inverse = 1.0 / dot(w, w);
    float roots = sqrt(poles.x) * sqrt(poles.y);
    float area = f.along * f.across;

    DiskCone cone;
    cone.l = l;
    cone.sum = h1 * (shares.y + shares.z) + h2 * (shares.x + shares.z);
    cone.product = h1 * h2 * shares.z;
    cone.volume = area * abs(f.center.z);
    cone.height2 = up * up * inverse;
    cone.level2 = dot(level, level) * inverse;
    cone.whole = area * roots * (abs(w.z) * up * inverse);
    cone.slant = l * up / roots;
    return cone;
}

// Centre and any conjugate semi-axes before `minv`.
float disk_secular(mat3 minv, vec3 center, vec3 v1, vec3 v2)
{
    DiskFrame f = disk_frame(minv, center, v1, v2);
    float result = disk_irradiance(secular_cone(f), f.rise2, f.height);
    return f.dark ? 0.0 : result;
}

#endif
