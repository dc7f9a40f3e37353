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
// Measured: failed, and worst error; lavapipe (Mesa 22.3), 1 M a scenario, seed 1.
//                                           ggx        far  near_plane      needle  inside_out        edge
//   clipless_sphere                  30.8% 1.00  3x 1.4e-3  45.4% 1.00  6.59% 1.00  83.0% 1.00  13.3% 1.00
//   clipless_rational                54.9% 0.22   97x 0.03  39.4% 1.00  8.82% 0.41  95.0% 0.29  23.4% 1.10
//   clipless_lut                     32.1% 0.11  3x 1.4e-3  38.2% 1.00  6.60% 0.40  94.9% 0.15  14.0% 1.10
//   clipless_lut_sampler             32.1% 0.11  3x 1.4e-3  38.2% 1.00  6.60% 0.40  94.9% 0.15  14.0% 1.10
//   clipless_sphere_stable           30.8% 0.11  3x 1.4e-3  38.8% 1.00  6.59% 0.40  82.6% 0.14  13.7% 1.00
//   clipless_rational_stable         54.9% 0.16   97x 0.03  38.2% 1.00  8.77% 0.16  95.0% 0.16  22.9% 1.00
//   clipless_sphere_stable_stable    30.7% 0.08  3x 1.4e-3  31.8% 1.00  6.51% 0.08  82.3% 0.07  13.2% 1.00

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
