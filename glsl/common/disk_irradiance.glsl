// The irradiance of an ellipse from its cone: EXACT_HORIZON for the closed form, else a sphere as HORIZON chooses
// (common/horizon_choice.glsl). Ours.

#ifndef ROOTQ_DISK_IRRADIANCE
#define ROOTQ_DISK_IRRADIANCE

#ifdef EXACT_HORIZON
#include "common/clipped_ellipse.glsl"
#else
#include "common/horizon_choice.glsl"
#endif
#include "common/disk_cone.glsl"

float disk_irradiance(DiskFrame f, DiskCone cone)
{
    float result;
#ifdef EXACT_HORIZON
    float szz = (f.a3 - f.c3) * (f.a3 + f.c3);
    if (szz > 0.0) {
        result = clipped_ellipse(cone, szz);
    } else {
        result = f.c3 > 0.0 ? min(cone.volume * abs(cone.rise), 1.0) : 0.0;
    }
#else
    float height = sqrt(cone.height2);
    float form = height > 0.0 ? cone.volume * abs(cone.rise) / height : 0.0;
    result = f.c3 > -f.a3 ? horizon_of_sphere(cone.rise < 0.0 ? -height : height, min(form, 1.0)) : 0.0;
#endif
    return f.area > 0.0 ? result : 0.0;
}

#endif
