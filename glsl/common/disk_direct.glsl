// Irradiance of an ellipse without its 2D eigensystem. Ours.

#ifndef ROOTQ_DISK_DIRECT
#define ROOTQ_DISK_DIRECT

#include "common/disk_cone.glsl"
#include "common/disk_irradiance.glsl"

// Centre and any conjugate semi-axes before `minv`.
float disk_direct(mat3 minv, vec3 center, vec3 v1, vec3 v2)
{
    DiskFrame f = disk_frame(minv, center, v1, v2);
    float b2 = f.b * f.b;
    // In the light's plane: [C, A], A (A x C) + B (B x C), and the projections on A and B.
    float moment = f.h * f.c1 - f.a1 * f.d;
    vec2 turned = vec2(f.h * moment, b2 * f.d - f.a1 * moment);
    float on_a = f.a1 * f.c1 + f.h * f.d;
    float on_b = f.b * f.c1;

    Confocal k;
    k.z = f.cz * f.cz;
    k.sum = f.a1 * f.a1 + f.h * f.h + b2;
    k.product = f.area * f.area;
    k.alpha = f.c1 * f.c1 + f.d * f.d;
    k.beta = moment * moment + b2 * f.d * f.d;
    k.gamma = on_a * on_a + on_b * on_b;
    k.kappa = dot(turned, turned);
    float l = confocal_lambda(k, confocal_start(k));
    float result = disk_irradiance(disk_cone(f, k, l, l * vec2(f.c1, f.d) + turned), f.a3, f.c3);
    return f.area > 0.0 ? result : 0.0;
}

#endif
