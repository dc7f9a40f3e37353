// The cone over an ellipse from the height and place of the point over its plane. Ours.
//
// The dual quadric V1 V1^T + V2 V2^T - C C^T has eigenvalues e1 >= e3 >= 0 > -l. For squared semi-axes h1 >= h2 of the ellipse and
// squares p, q of the centre's components along them, z of its height,
//
//     p/(h1 + l) + q/(h2 + l) + z/l = 1
//
// has l for its one positive root. Every coefficient below is a sum of positive terms, and no single semi-axis is needed.

#ifndef ROOTQ_DISK_CONE
#define ROOTQ_DISK_CONE

#include "common/confocal.glsl"
#include "common/disk_frame.glsl"

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

// From l and the mean direction's part in the light's plane, over 1/((h1 + l) (h2 + l)) if its part across is the height over
// the plane, over l: its product with the centre is then 1, and it is as long as the light is near.
DiskCone disk_cone(DiskFrame f, Confocal k, float l, vec2 plane)
{
    float square = (l + k.sum) * l + k.product;
    float inverse_root = inversesqrt(square);
    float inverse = inverse_root * inverse_root;
    float inverse_l = 1.0 / l;
    plane *= inverse;
    float across = f.cz * inverse_l;
    float side = plane.y * f.slope.x + across * f.slope.y;
    float up = plane.y * f.slope.y - across * f.slope.x;
    float level2 = plane.x * plane.x + side * side;
    float inverse_w = 1.0 / (level2 + up * up);

    DiskCone cone;
    cone.l = l;
    float share = k.z * inverse_l;
    cone.sum = (l * k.beta + k.kappa) * inverse + k.sum * share;
    cone.product = k.product * share;
    cone.volume = f.area * abs(f.cz);
    cone.height2 = up * up * inverse_w;
    cone.level2 = level2 * inverse_w;
    cone.whole = cone.volume * (inverse_root * (up * inverse_w) * inverse_l);
    cone.slant = square * inverse_root * (up * l);
    return cone;
}

// (p, q) and (h1, h2) without the axes' directions, for a start: exact but for their cancellation in circles, where p and
// q are of no account.
float confocal_start(Confocal k)
{
    float split = sqrt(max(k.sum * k.sum - 4.0 * k.product, 0.0));
    float h1 = 0.5 * (k.sum + split);
    float h2 = k.product / max(h1, DISK_SMALLEST);
    float q = clamp((k.beta - h2 * k.alpha) / max(split, DISK_SMALLEST), 0.0, k.alpha);
    return confocal_start(k.alpha - q, h1, q, h2, k.z);
}

// l from a start: a step that is safe from anywhere, then one of Halley's and one of Newton's on
//
//     l^3 + (h1 + h2 - |C|^2) l^2 + (h1 h2 - beta - z (h1 + h2)) l - z h1 h2 = 0
//
// They leave 2e-3, 1e-7 and 1e-14 of l for one light in a thousand, and at worst 0.06, 3e-4 and 1e-7.
float confocal_lambda(Confocal k, float l)
{
    l = confocal_step(k, l);
    float c2 = k.sum - k.alpha - k.z;
    float c1 = k.product - k.beta - k.z * k.sum;
    float c0 = k.product * k.z;
    float value = ((l + c2) * l + c1) * l - c0;
    float slope = (3.0 * l + 2.0 * c2) * l + c1;
    float bend = 3.0 * l + c2;
    l = max(l - value * slope / max(slope * slope - value * bend, DISK_SMALLEST), k.z);
    value = ((l + c2) * l + c1) * l - c0;
    slope = (3.0 * l + 2.0 * c2) * l + c1;
    return max(l - value / max(slope, DISK_SMALLEST), k.z);
}

#endif
