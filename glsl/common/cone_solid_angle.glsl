// The solid angle of an elliptic cone. Pure functions.

#ifndef ROOTQ_CONE_SOLID_ANGLE
#define ROOTQ_CONE_SOLID_ANGLE

const float CONE_TAU = 6.28318530717958648;

// (4/3) root R_J(0, p, q, l) from p + q and p q, p, q >= l > 0, which is the solid angle for the dual quadric's eigenvalues e1,
// e3, -l, with p = l + e1, q = l + e3 and root = sqrt(e1 e3 l): nothing cancels, however small the cone.
//
// Bulirsch's transformation from its second step on, where only the sum and the product of p and q are left. Its two means
// converge quadratically: CEL_STEPS 3 suffices for p/q up to 1e4, 5 for any. Within 12 u, u = 2^-24.
// Source: ours, by DLMF 19.7.9 and 19.25.2; Bulirsch, "Numerical calculation of elliptic integrals and elliptic functions III",
// 1969.
#ifndef CEL_STEPS
#define CEL_STEPS 5
#endif

float cone_complete(float root, float l, float sum, float product)
{
    float root_l = sqrt(l);
    float w = sqrt(product);
    float a = 1.0 / l;
    float b = 2.0 / root_l;
    float p = root_l + w / root_l;
    float m = sqrt(sum + 2.0 * w);
    float k = 2.0 * sqrt(w);
    float e = k * m;
    for (int i = 0; i < CEL_STEPS; ++i) {
        float f = a;
        a += b / p;
        float g = e / p;
        b = 2.0 * (b + f * g);
        p += g;
        float last = m;
        m += k;
        if (abs(last - k) <= 1.0e-4 * last) {
            break;
        }
        k = 2.0 * sqrt(e);
        e = k * m;
    }
    return min(CONE_TAU * root * (b / m + a) / (m + p), CONE_TAU);
}

// By the tangents of the half angles, major first: POINTS equal steps of azimuth over a quarter, both ends halved, which
// converges geometrically in POINTS minor/major, about; what is summed does not cancel.
// Source: the integral itself.
#ifndef POINTS
#define POINTS 16
#endif

float cone_trapezoid(float tan_major, float tan_minor)
{
    if (!(tan_minor > 0.0)) {
        return 0.0;
    }
    vec2 inverse = 1.0 / vec2(tan_major, tan_minor);
    float sum = 0.0;
    for (int i = 0; i <= POINTS; ++i) {
        float phi = 1.57079632679489662 * float(i) / float(POINTS);
        vec2 d = inverse * vec2(cos(phi), sin(phi));
        float rho2 = 1.0 / dot(d, d);
        float h = sqrt(1.0 + rho2);
        sum += (i == 0 || i == POINTS ? 0.5 : 1.0) * rho2 / (h * (h + 1.0));
    }
    return CONE_TAU / float(POINTS) * sum;
}

// (4/3) a b R_J(0, 1 + a^2, 1 + b^2, 1) by Carlson's duplication: about as many steps as bits over two, fewer for round cones.
// Source: Carlson, "Numerical computation of real or complex elliptic integrals", Numer. Algorithms 10, 1995.
float cone_carlson(float tan_major, float tan_minor)
{
    float x = 0.0;
    float y = 1.0 + tan_major * tan_major;
    float z = 1.0 + tan_minor * tan_minor;
    float p = 1.0;
    float a = 0.2 * (x + y + z + 2.0 * p);
    float delta = (p - x) * (p - y) * (p - z);
    float power = 1.0;
    float sum = 0.0;
    vec3 last = vec3(0.0);
    float p_last = 0.0;
    for (int i = 0; i < 12; ++i) {
        vec3 roots = sqrt(vec3(x, y, z));
        float root = sqrt(p);
        float lambda = roots.x * roots.y + roots.x * roots.z + roots.y * roots.z;
        float d = (root + roots.x) * (root + roots.y) * (root + roots.z);
        float e = delta / (d * d);
        // R_C(1, 1 + e).
        float s = sqrt(abs(e));
        float rc = s < 1.0e-2 ? 1.0 - e / 3.0 : e > 0.0 ? atan(s) / s : atanh(min(s, 0.9999999)) / s;
        sum += power / d * rc;
        power *= 0.25;
        delta *= 0.015625;
        x = 0.25 * (x + lambda);
        y = 0.25 * (y + lambda);
        z = 0.25 * (z + lambda);
        p = 0.25 * (p + lambda);
        a = 0.25 * (a + lambda);
        if (max(max(abs(x - a), abs(y - a)), max(abs(z - a), abs(p - a))) < 0.02 * a) {
            break;
        }
    }
    vec3 u = 1.0 - vec3(x, y, z) / a;
    float v = -0.5 * (u.x + u.y + u.z);
    float e2 = u.x * u.y + u.x * u.z + u.y * u.z - 3.0 * v * v;
    float e3 = u.x * u.y * u.z + 2.0 * e2 * v + 4.0 * v * v * v;
    float series = 1.0 - 3.0 * e2 / 14.0 + e3 / 6.0 + 9.0 * e2 * e2 / 88.0;
    float rj = power * series / (a * sqrt(a)) + 6.0 * sum;
    return min(4.0 / 3.0 * tan_major * tan_minor * rj, CONE_TAU);
}

// 2 pi less a complete integral of the third kind, as formulas for disks and ellipses have it: a difference of numbers of about
// 2 pi, off by 2^-22 absolutely.
// Source: the form of Paxton, "Solid angle calculation for a circular disk", 1959, and of Conway, "Analytical solution for the
// solid angle subtended at any point by an ellipse via a point source radiation vector potential", 2010, for the cone's own
// axes; the integral by Bulirsch's cel.
float cone_third_kind(float tan_major, float tan_minor)
{
    float a2 = tan_major * tan_major;
    float b2 = tan_minor * tan_minor;
    float kc = sqrt((1.0 + b2) / (1.0 + a2));
    float p = b2 / a2;
    float e = kc;
    float em = 1.0;
    float a = 1.0;
    p = sqrt(p);
    float b = 1.0 / p;
    for (int i = 0; i < 6; ++i) {
        float f = a;
        a += b / p;
        float g = e / p;
        b = 2.0 * (b + f * g);
        p += g;
        g = em;
        em += kc;
        if (abs(g - kc) <= 1.0e-4 * g) {
            break;
        }
        kc = 2.0 * sqrt(e);
        e = kc * em;
    }
    float third = 1.57079632679489662 * (b + a * em) / (em * (em + p));
    return CONE_TAU - 4.0 * tan_minor / (tan_major * sqrt(1.0 + a2)) * third;
}

// The sphere of the same irradiance through a plane across the axis: exact for circles.
// Source: the equal-area sphere of Heitz & Hill, "Real-Time Line- and Disk-Light Shading with Linearly Transformed Cosines", 2017.
float cone_equal_sphere(float tan_major, float tan_minor)
{
    float a2 = tan_major * tan_major;
    float b2 = tan_minor * tan_minor;
    float sine2 = tan_major * inversesqrt(1.0 + a2) * (tan_minor * inversesqrt(1.0 + b2));
    return CONE_TAU * sine2 / (1.0 + sqrt(max(1.0 - sine2, 0.0)));
}

// METHOD: 0 trapezoid, 1 Carlson, 2 third kind, 3 equal sphere.
#ifndef METHOD
#define METHOD 0
#endif

float cone_by_tangents(float tan_major, float tan_minor)
{
#if METHOD == 0
    return cone_trapezoid(tan_major, tan_minor);
#elif METHOD == 1
    return cone_carlson(tan_major, tan_minor);
#elif METHOD == 2
    return cone_third_kind(tan_major, tan_minor);
#else
    return cone_equal_sphere(tan_major, tan_minor);
#endif
}

#endif
