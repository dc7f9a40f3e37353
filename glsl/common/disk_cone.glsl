// The cone over an ellipse from any two conjugate semi-axes V1, V2 and the centre C: no 2D eigensystem. Ours.
//
// With n = V1 x V2 / |V1 x V2|, C = P + n cz, k_i = [C, V_i, n], the dual quadric V1 V1^T + V2 V2^T - C C^T has the one
// negative eigenvalue -l, where
//
//     cz^2/l + phi(l) = 1,   phi(l) = (alpha l + beta)/Q,   Q = l^2 + t l + area^2
//     alpha = |P|^2,   beta = k1^2 + k2^2,   t = |V1|^2 + |V2|^2
//
// and the mean direction is W ~ n cz + (l/Q)(l P + (k1 V1 + k2 V2) x n). Every coefficient is a sum of positive terms.

#ifndef ROOTQ_DISK_CONE
#define ROOTQ_DISK_CONE

#include "common/cone_secular.glsl"
#include "common/power_of_two.glsl"

// Steps at most. The start is exact for circles and far lights, each step squares the error.
#ifndef DISK_STEPS
#define DISK_STEPS 6
#endif

struct DiskCone {
    vec3 axis;      // unit mean direction
    float l;        // minus the negative eigenvalue; 0: no cone
    float product;  // e1 e3
    float form;     // irradiance through a plane across the axis
};

// The images under m, all three by one power of two so that their largest component is 1..2. The light is scaled before it
// is multiplied, so nothing overflows, whatever its unit, for matrices up to 2^125.
void disk_image(mat3 m, inout vec3 C, inout vec3 V1, inout vec3 V2)
{
    float scale = scale_to_one(largest_component(max(abs(C), max(abs(V1), abs(V2)))));
    C = m * (C * scale);
    V1 = m * (V1 * scale);
    V2 = m * (V2 * scale);
    scale = scale_to_one(largest_component(max(abs(C), max(abs(V1), abs(V2)))));
    C *= scale;
    V1 *= scale;
    V2 *= scale;
}

// Squared areas below this, for vectors of length 1, are beyond what f32 resolves: such a light is dark.
const float DISK_FLAT = 1.0e-30;

DiskCone disk_cone(vec3 C, vec3 V1, vec3 V2)
{
    DiskCone cone = DiskCone(vec3(0.0, 0.0, 1.0), 0.0, 0.0, 0.0);
    vec3 N = cross(V1, V2);
    float area2 = dot(N, N);
    if (!(area2 > DISK_FLAT)) {
        return cone;
    }
    vec3 n = N * inversesqrt(area2);
    float cz = dot(n, C);
    float cz2 = cz * cz;
    vec3 P = C - cz * n;
    vec3 R = cross(n, C);
    float k1 = dot(R, V1);
    float k2 = dot(R, V2);
    float j1 = dot(P, V1);
    float j2 = dot(P, V2);
    vec3 K = k1 * V1 + k2 * V2;
    float t = dot(V1, V1) + dot(V2, V2);
    float alpha = dot(P, P);
    float beta = k1 * k1 + k2 * k2;
    float kappa = dot(K, K);

    // phi as seen from infinity: one pole at its weighted mean.
    float l = cone_two_poles(alpha, alpha > 0.0 ? (j1 * j1 + j2 * j2) / alpha : 0.0, cz2);
    for (int i = 0; i < DISK_STEPS; ++i) {
        // One pole with phi's value and slope at l. A lower bound of the root, since 1/phi is concave.
        float last = l;
        float Q = (l + t) * l + area2;
        float above = alpha * l + beta;
        float below = (alpha * l + 2.0 * beta) * l + kappa;
        float reach = below > 0.0 ? above / below * Q : l;
        float weight = above / Q * reach;
        l = max(cone_two_poles(weight, max(reach - l, 0.0), cz2), cz2);
        if (abs(l - last) <= 1.0e-3 * l) {
            break;
        }
    }
    if (!(l > 0.0)) {
        return cone;
    }

    float Q = (l + t) * l + area2;
    vec3 W = cz * n + l / Q * (l * P + cross(K, n));
    float inverse = inversesqrt(dot(W, W));
    cone.axis = W * inverse;
    cone.l = l;
    cone.product = area2 * (cz2 / l);
    cone.form = min(sqrt(area2) * inversesqrt(Q) * (abs(cz) * inverse), 1.0);
    return cone;
}

// (heights of W1, W2, W3; e1, e3) of the cone's principal axes, from a basis of which one vector is horizontal.
//
// C across the axis follows from S W = -l W without cancellation where the light is far.
void disk_principal(DiskCone cone, vec3 C, vec3 V1, vec3 V2, out vec3 heights, out vec2 e)
{
    vec3 W = cone.axis;
    float rise = length(W.xy);
    vec3 B1 = rise > 0.0 ? vec3(-W.y, W.x, 0.0) / rise : vec3(1.0, 0.0, 0.0);
    vec3 B2 = cross(W, B1);
    vec2 a = vec2(dot(B1, V1), dot(B1, V2));
    vec2 b = vec2(dot(B2, V1), dot(B2, V2));
    vec2 w = vec2(dot(W, V1), dot(W, V2));
    float along = dot(W, C);
    bool far = along * along > dot(V1, V1) + dot(V2, V2);
    float ac = far ? dot(a, w) / along : dot(B1, C);
    float bc = far ? dot(b, w) / along : dot(B2, C);

    float s11 = dot(a, a) - ac * ac;
    float s22 = dot(b, b) - bc * bc;
    float s12 = dot(a, b) - ac * bc;
    float tau = 0.5 * (s11 - s22);
    float h = sqrt(tau * tau + s12 * s12);
    float e1 = max(0.5 * (s11 + s22) + h, sqrt(cone.product));
    e = vec2(e1, e1 > 0.0 ? cone.product / e1 : 0.0);

    // W1 = cosine B1 + sine B2 from half the angle of (tau, s12).
    vec2 half_angle = tau >= 0.0 ? vec2(tau + h, s12) : vec2(s12, h - tau);
    // A circle up to rounding: any axes do, and squares of what is left would leave the range.
    half_angle = h > max(1.0e-9 * (s11 + s22), 1.0e-18) ? normalize(half_angle) : vec2(1.0, 0.0);
    heights = vec3(half_angle.y * rise, half_angle.x * rise, W.z);
}

#endif
