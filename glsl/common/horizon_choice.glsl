// The horizon by a sphere that stands for the light: c is the height of its mean direction, s its form factor, which is
// the sphere's squared sine. HORIZON chooses the function of common/horizon_sphere.glsl; the table is the default, and
// needs `tables = { sphere_lut = .. }`.

#ifndef ROOTQ_HORIZON_CHOICE
#define ROOTQ_HORIZON_CHOICE

#include "common/horizon_sphere.glsl"

#define HORIZON_ANALYTIC 1
#define HORIZON_RATIONAL 2
#define HORIZON_STABLE 3

float horizon_of_sphere(float c, float s)
{
#if !defined(HORIZON)
    return horizon_lut(c, s);
#elif HORIZON == HORIZON_ANALYTIC
    return horizon_sphere_analytic(c, s);
#elif HORIZON == HORIZON_RATIONAL
    return horizon_rational(c, s);
#else
    return horizon_stable(c, s);
#endif
}

#endif
