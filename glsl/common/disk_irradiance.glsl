// The irradiance of an ellipse from its cone: EXACT_HORIZON for the closed form, else a sphere as HORIZON chooses
// (common/horizon_choice.glsl). Ours.

#ifndef ROOTQ_DISK_IRRADIANCE
#define ROOTQ_DISK_IRRADIANCE

#ifdef EXACT_HORIZON
#include "common/clipped_ellipse.glsl"
#else
#include "common/horizon_choice.glsl"
#endif
#include "common/elliptic_cone.glsl"

// The rim rises to height -+ the root of rise2.
float disk_irradiance(DiskCone cone, float rise2, float height)
{
#ifdef EXACT_HORIZON
    float szz = rise2 - height * height;
    return szz > 0.0 ? clipped_ellipse(cone, szz) : clamp(cone.whole, 0.0, 1.0);
#else
    float mean = sqrt(cone.height2);
    float form = mean > 0.0 ? abs(cone.whole) / mean : 0.0;
    bool above = height > 0.0 || height * height < rise2;
    return above ? horizon_of_sphere(cone.whole < 0.0 ? -mean : mean, min(form, 1.0)) : 0.0;
#endif
}

#endif
