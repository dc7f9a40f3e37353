// Irradiance of an ellipse without its 2D eigensystem. Ours.
//
// The dual quadric V1 V1^T + V2 V2^T - C C^T has eigenvalues e1 >= e3 >= 0 > -l. For squared semi-axes h1 >= h2 of the ellipse and
// squares p, q of the centre's components along them, z of its height,
//
//     p/(h1 + l) + q/(h2 + l) + z/l = 1
//
// has l for its one positive root. Every coefficient below is a sum of positive terms, and no single semi-axis is needed.

#ifndef ROOTQ_DISK_DIRECT
#define ROOTQ_DISK_DIRECT

#include "common/confocal.glsl"
#include "common/disk_frame.glsl"
#include "common/disk_irradiance.glsl"

struct Confocal {
    float z;
    float sum;       // h1 + h2
    float product;   // h1 h2
    float alpha;     // p + q
    float beta;      // p h2 + q h1
    float gamma;     // p h1 + q h2
    float kappa;     // p h2^2 + q h1^2
};

// One step from any l > 0: the two poles give way to one with their value and slope at l. A lower bound again, since the
// reciprocal of their sum is concave, and exact for circles.
float confocal_step(Confocal k, float l)
{
    float above = k.alpha * l + k.beta;
    float inverse = 1.0 / max((k.alpha * l + 2.0 * k.beta) * l + k.kappa, DISK_SMALLEST);
    float pole = (k.gamma * l + 2.0 * k.product * k.alpha) * l + k.beta * k.product;
    return confocal_root(above * above * inverse, pole * inverse, k.z);
}

// (p, q) and (h1, h2) without the axes' directions, for a start: exact but for their cancellation in circles, where p and
// q are of no account.
float direct_start(Confocal k, float inverse_h1, float inverse_split)
{
    float h2 = k.product * inverse_h1;
    float q = clamp((k.beta - h2 * k.alpha) * inverse_split, 0.0, k.alpha);
    return confocal_start(k.alpha - q, k.sum - h2, q, h2, k.z);
}

// l from a start: a step that is safe from anywhere, then Householder's of third order on
//
//     l^3 + (h1 + h2 - |C|^2) l^2 + (h1 h2 - beta - z (h1 + h2)) l - z h1 h2 = 0
//
// They leave 2e-6 of l for one light in a thousand, and 1e-3 at worst, of lights with aspects to 1e5, 1e-6 to 100 lengths away
// (emulated in f64).
float confocal_lambda(Confocal k, float l)
{
    l = confocal_step(k, l);
    float c2 = k.sum - k.alpha - k.z;
    float c1 = k.product - k.beta - k.z * k.sum;
    float c0 = k.product * k.z;
    float value = ((l + c2) * l + c1) * l - c0;
    float bend = 3.0 * l + c2;
    float slope = (bend + c2) * l + c1;
    float inverse = 1.0 / max(slope, DISK_SMALLEST);
    float newton = value * inverse;
    float curve = newton * (bend * inverse);
    return max(l - newton * (1.0 - curve) / (1.0 - 2.0 * curve + newton * (newton * inverse)), k.z);
}

// From l and the mean direction's part in the light's plane, over 1/((h1 + l) (h2 + l)) if its part across is the height over
// the plane, over l: its product with the centre is then 1, and it is as long as the light is near.
DiskCone direct_cone(DiskFrame f, Confocal k, float l, vec2 plane)
{
    float square = (l + k.sum) * l + k.product;
    float inverse = 1.0 / square;
    float inverse_root = sqrt(inverse);
    float inverse_l = 1.0 / l;
    vec3 w = vec3(plane * inverse, f.center.z * inverse_l);
    float up = dot(w, f.heights);
    vec3 level = cross(w, f.heights);
    float inverse_w = 1.0 / dot(w, w);
    float share = k.z * inverse_l;

    DiskCone cone;
    cone.l = l;
    cone.sum = (l * k.beta + k.kappa) * inverse + k.sum * share;
    cone.product = k.product * share;
    cone.volume = f.along * f.across * abs(f.center.z);
    cone.height2 = up * up * inverse_w;
    cone.level2 = dot(level, level) * inverse_w;
    cone.whole = cone.volume * (inverse_root * (up * inverse_w) * inverse_l);
    cone.slant = square * inverse_root * (up * l);
    return cone;
}

// Centre and any conjugate semi-axes before `minv`.
float disk_direct(mat3 minv, vec3 center, vec3 v1, vec3 v2)
{
    DiskFrame f = disk_frame(minv, center, v1, v2);
    // In the light's plane A = (along, 0), B = (shear, across): [A, C], [B, C], A . C, B . C, and A (A x C) + B (B x C).
    vec2 c = f.center.xy;
    float of_a = f.along * c.y;
    float of_b = f.shear * c.y - f.across * c.x;
    float on_a = f.along * c.x;
    float on_b = f.shear * c.x + f.across * c.y;
    vec2 turned = vec2(-f.across * of_b, f.along * of_a + f.shear * of_b);

    Confocal k;
    k.z = f.center.z * f.center.z;
    k.sum = f.along * f.along + f.shear * f.shear + f.across * f.across;
    k.product = (f.along * f.across) * (f.along * f.across);
    k.alpha = dot(c, c);
    k.beta = of_a * of_a + of_b * of_b;
    k.gamma = on_a * on_a + on_b * on_b;
    k.kappa = dot(turned, turned);
    float l = confocal_lambda(k, direct_start(k, f.inverse_h1, f.inverse_split));
    float result = disk_irradiance(direct_cone(f, k, l, l * c + turned), f.rise2, f.height);
    return f.dark ? 0.0 : result;
}

#endif
