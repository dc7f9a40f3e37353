/*---
summary = "No clipping: the vector irradiance of the whole quad, and the horizon as of a sphere"
source  = "Hill & Heitz, Real-Time Area Lighting: a Journey from Research to Production, SIGGRAPH 2016; horizons as in glsl/common/horizon_sphere.glsl"

[[variant]]
name = "clipless_sphere"
summary = "No clipping: edges by the rational fit with its guard of 1e-7, the horizon by the published closed form of the clipped sphere"
defines = { HORIZON = "horizon_sphere_analytic", EDGE = "edge_fit", FIT = "fit_rational", GUARD = "guard_1e7", FIT_SCALED = 1 }

[[variant]]
name = "clipless_rational"
summary = "No clipping: edges by the rational fit with its guard of 1e-7, the horizon by (z + l^2)/(l + 1)"
defines = { HORIZON = "horizon_rational", EDGE = "edge_fit", FIT = "fit_rational", GUARD = "guard_1e7", FIT_SCALED = 1 }

[[variant]]
name = "clipless_lut"
summary = "No clipping: edges by the rational fit with its guard of 1e-7, the horizon by the 64 x 64 table, bilinear in the shader"
tables = { sphere_lut = "buffer" }
defines = { HORIZON = "horizon_lut", EDGE = "edge_fit", FIT = "fit_rational", GUARD = "guard_1e7", FIT_SCALED = 1 }

[[variant]]
name = "clipless_lut_sampler"
summary = "No clipping: edges by the rational fit with its guard of 1e-7, the horizon by the 64 x 64 table through a sampler"
tables = { sphere_lut = "image" }
defines = { HORIZON = "horizon_lut", EDGE = "edge_fit", FIT = "fit_rational", GUARD = "guard_1e7", FIT_SCALED = 1 }

[[variant]]
name = "clipless_sphere_stable"
summary = "No clipping: edges by the rational fit with its guard of 1e-7, the horizon by the clipped sphere without cancellation"
defines = { HORIZON = "horizon_stable", EDGE = "edge_fit", FIT = "fit_rational", GUARD = "guard_1e7", FIT_SCALED = 1 }

[[variant]]
name = "clipless_rational_stable"
summary = "No clipping: edges by the cross product that does not cancel, the horizon by (z + l^2)/(l + 1)"
defines = { HORIZON = "horizon_rational", EDGE = "edge_stable" }

[[variant]]
name = "clipless_sphere_stable_stable"
summary = "No clipping: edges by the cross product that does not cancel, the horizon by the clipped sphere without cancellation"
defines = { HORIZON = "horizon_stable", EDGE = "edge_stable" }
---*/

// F, the sum of all edges as vectors, is the irradiance of a surface that faces F, |F| the form factor, and a sphere of
// that form factor in that direction stands for the quad where the horizon cuts it. F points to the light: a quad seen
// from behind turns its sign.
//
// Domain: as of `cases`.
// Source: Hill & Heitz 2016.
// Bound: an approximation wherever the horizon cuts the light: off by up to 0.08 of the hemisphere with the sphere,
// and by up to 0.16 with (z + l^2)/(l + 1), which is off by as much where nothing is cut. Beyond that the edges' and
// the horizon's own errors: the published closed form of the sphere answers 0 where |F| rounds to 1.
// Measured: llvmpipe (Mesa 22.3.6 (LLVM 15.0.6)), 1,000,000 a scenario, seed 1.
// Failed and the worst error, whoever is to blame; n: failed, and so many of them not finite.
//                                        ggx   grazing    facing       far  near_plane     needle   horizon  inside_out     edge
//   clipless_sphere                  31% 1e0   40% 1e0  12% 8e-3   3x 1e-3     45% 1e0   6.6% 1e0   33% 1e0     83% 1e0  13% 1e0
//   clipless_rational               55% 2e-1  54% 4e-1  62% 9e-2  97x 3e-2     39% 1e0  8.8% 4e-1  40% 2e-1    95% 3e-1  23% 1e0
//   clipless_lut                    32% 1e-1  41% 3e-1  19% 8e-3   3x 1e-3     38% 1e0  6.6% 4e-1  34% 9e-2    95% 1e-1  14% 1e0
//   clipless_lut_sampler            32% 1e-1  41% 3e-1  19% 8e-3   3x 1e-3     38% 1e0  6.6% 4e-1  34% 9e-2    95% 1e-1  14% 1e0
//   clipless_sphere_stable          31% 1e-1  40% 3e-1  12% 8e-3   3x 1e-3     39% 1e0  6.6% 4e-1  33% 9e-2    83% 1e-1  14% 1e0
//   clipless_rational_stable        55% 2e-1  54% 2e-1  62% 9e-2  97x 3e-2     38% 1e0  8.8% 2e-1  40% 2e-1    95% 2e-1  23% 1e0
//   clipless_sphere_stable_stable   31% 8e-2  40% 6e-2  12% 7e-3   3x 1e-3     32% 1e0  6.5% 8e-2  33% 7e-2    82% 7e-2  13% 1e0

#include "common/edge_any.glsl"
#include "common/horizon_sphere.glsl"

float ltc_polygon(mat3 minv, vec3 p0, vec3 p1, vec3 p2, vec3 p3)
{
    vec3 q0 = minv * p0;
    vec3 q1 = minv * p1;
    vec3 q2 = minv * p2;
    vec3 q3 = minv * p3;
    float side = dot(q0, cross(q1 - q0, q3 - q0));

    q0 = normalize(q0);
    q1 = normalize(q1);
    q2 = normalize(q2);
    q3 = normalize(q3);
    vec3 f = edge_any(q0, q1) + edge_any(q1, q2) + edge_any(q2, q3) + edge_any(q3, q0);
    f = side < 0.0 ? -f : f;
    float form_factor = length(f);
    if (!(form_factor > 0.0)) {
        return 0.0;
    }
    return HORIZON(f.z / form_factor, form_factor);
}
