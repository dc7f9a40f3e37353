// Irradiance of an ellipse from its direct cone: EXACT_HORIZON for the closed form, else a sphere as HORIZON chooses
// (common/horizon_choice.glsl). Ours.

#ifndef ROOTQ_DISK_DIRECT
#define ROOTQ_DISK_DIRECT

#ifdef EXACT_HORIZON
#include "common/clipped_ellipse.glsl"
#else
#include "common/horizon_choice.glsl"
#endif
#include "common/disk_cone.glsl"

// Centre and any conjugate semi-axes before `minv`.
float disk_direct(mat3 minv, vec3 C, vec3 V1, vec3 V2)
{
    disk_image(minv, C, V1, V2);
    float swing = length(vec2(V1.z, V2.z));
    if (C.z <= -swing) {
        return 0.0;
    }
    DiskCone cone = disk_cone(C, V1, V2);
    if (!(cone.l > 0.0)) {
        return 0.0;
    }
#ifdef EXACT_HORIZON
    if (C.z >= swing) {
        return cone.form * max(cone.axis.z, 0.0);
    }
    vec3 heights;
    vec2 e;
    disk_principal(cone, C, V1, V2, heights, e);
    return clipped_ellipse(heights, e, cone.l, (swing - C.z) * (swing + C.z));
#else
    return horizon_of_sphere(cone.axis.z, cone.form);
#endif
}

#endif
