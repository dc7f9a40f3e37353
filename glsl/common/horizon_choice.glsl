// The irradiance above the horizon of a sphere that stands for the light: its mean direction's height, and its form
// factor, which is the sphere's squared sine. HORIZON chooses how.

#ifndef ROOTQ_HORIZON_CHOICE
#define ROOTQ_HORIZON_CHOICE

#define HORIZON_ANALYTIC 1
#define HORIZON_RATIONAL 2

#ifndef HORIZON
#define HORIZON HORIZON_ANALYTIC
#endif

// The clipped sphere in closed form: with s the squared sine of its half angle, z its height, c = sqrt(1 - s),
// g = sqrt(s - z^2): (z s atan(g, -z c) - c g + atan(g, c))/pi. Source: Snyder, "Area light sources for real-time
// graphics", 1996, in the form that Stokes' theorem gives.
float horizon_sphere_analytic(float z, float s)
{
    float cut = s - z * z;
    if (!(cut > 0.0)) {
        return max(z, 0.0) * s;
    }
    float g = sqrt(cut);
    float c = sqrt(max(1.0 - s, 0.0));
    return max((z * s * atan(g, -z * c) - c * g + atan(g, c)) / 3.14159265358979, 0.0);
}

// A rational fit: exact for the full hemisphere and its complement. Source: seen in many engines.
float horizon_sphere_rational(float z, float s)
{
    return max((s * s + s * z) / (s + 1.0), 0.0);
}

float horizon_sphere(float z, float s)
{
#if HORIZON == HORIZON_RATIONAL
    return horizon_sphere_rational(z, s);
#else
    return horizon_sphere_analytic(z, s);
#endif
}

#endif
