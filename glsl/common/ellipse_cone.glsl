// The cone over an ellipse from any two conjugate semi-axes V1, V2 and the centre C: no 2D eigensystem. Ours.
//
// With n = V1 x V2 / |V1 x V2|, C = P + n cz, k_i = [C, V_i, n], the dual quadric V1 V1^T + V2 V2^T - C C^T has the one
// negative eigenvalue -l, where
//
//     cz^2/l + phi(l) = 1,   phi(l) = (alpha l + beta)/Q,   Q = l^2 + t l + area^2
//     alpha = |P|^2,   beta = k1^2 + k2^2,   t = |V1|^2 + |V2|^2
//
// and the mean direction is W ~ n cz + (l/Q)(l P + (k1 V1 + k2 V2) x n). Every coefficient is a sum of positive terms.

#ifndef ROOTQ_ELLIPSE_CONE
#define ROOTQ_ELLIPSE_CONE

#include "common/cone_secular.glsl"
#include "common/power_of_two.glsl"

// Steps at most. The start is exact for circles and far lights, each step squares the error.
#ifndef ELLIPSE_STEPS
#define ELLIPSE_STEPS 6
#endif

struct EllipseCone {
    vec3 axis;      // unit mean direction
    float l;        // minus the negative eigenvalue; 0: no cone
    float product;  // e1 e3
    float form;     // irradiance through a plane across the axis
};

// Squared areas below this, for vectors of length 1, are beyond what f32 resolves: such a light is dark.
const float ELLIPSE_FLAT = 1.0e-30;

EllipseCone ellipse_cone(vec3 C, vec3 V1, vec3 V2)
{
    EllipseCone cone = EllipseCone(vec3(0.0, 0.0, 1.0), 0.0, 0.0, 0.0);
    vec3 N = cross(V1, V2);
    float area2 = dot(N, N);
    if (!(area2 > ELLIPSE_FLAT)) {
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
    for (int i = 0; i < ELLIPSE_STEPS; ++i) {
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

#endif
