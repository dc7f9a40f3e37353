/*---
summary = "The silhouette's contour: two generators exactly, the caps' arcs as chords"
source  = "ours; edges as in Heitz et al. 2016"
tried   = "The silhouette's rectangle alone costs four edges and loses all of the caps; chords through the rim lose area as the square of their angle, which the chords' own radius gives back"

[[variant]]
name = "silhouette_rectangle"
summary = "The rectangle between the silhouette's two generators, as a polygon: caps are cut straight"
defines = { CHORDS = 1 }

[[variant]]
name = "silhouette_4"
summary = "The silhouette with four chords to an arc"
defines = { CHORDS = 4 }

[[variant]]
name = "silhouette_8"
summary = "The silhouette with eight chords to an arc"
defines = { CHORDS = 8 }

[[variant]]
name = "silhouette_16"
summary = "The silhouette with sixteen chords to an arc"
defines = { CHORDS = 16 }

[[variant]]
name = "silhouette_16_scaled"
summary = "silhouette_16, everything first scaled exactly by a power of two: any size of the scene"
defines = { CHORDS = 16, SCALED = 1 }
---*/

// Seen from outside, a capped cylinder ends at two generators, where the radius is R/gap of the way to the point, and at
// an arc of each rim: the near one where the cap faces away, the far one where it is seen. Within the side's prolongation
// only one cap is seen, a whole circle. The contour is mapped by Minv and summed as a polygon's, clipped edge by edge.
//
// An arc of angle t in n chords is short of its sector's area by (t/n)^2/6 of it; the points between the ends are moved
// out until the chords hold that area, while the ends stay on the generators.
//
// Domain: any cylinder, the point within it too: 1.
// Source: ours.
// Bound: exact but for the chords: with 8 of them 1e-3 of a cap's share.
// Measured: llvmpipe (Mesa 22.3.6 (LLVM 15.0.6)), 1,000,000 a scenario, seed 1.
// Failed and the worst error, whoever is to blame; n: failed, and so many of them not finite.
//                          ggx_alpha_02  ggx_alpha_01  ggx_alpha_05       edge
//   silhouette_rectangle        9% 4e-1     5.3% 7e-1      16% 4e-1   33% 9e-1
//   silhouette_4             0.09% 2e-2    0.16% 4e-2   0.051% 5e-2   15% 9e-1
//   silhouette_8            0.013% 3e-3   0.029% 1e-2      70x 8e-3    5% 9e-1
//   silhouette_16              16x 2e-4      30x 1e-3       9x 9e-4  2.4% 9e-1
//   silhouette_16_scaled       16x 2e-4      30x 1e-3       9x 9e-4    1% 5e-1

#include "common/cosine_contour.glsl"
#ifdef SCALED
#include "common/power_of_two.glsl"
#endif

const float PI = 3.14159265358979324;

// The arc about `center` from angle `from` to `to`, its first and last point on the rim itself.
void arc(inout CosineContour contour, vec3 center, vec3 towards, vec3 across, float from, float to)
{
    float step = (to - from) / float(CHORDS);
    vec3 last = center + cos(from) * towards + sin(from) * across;
#if CHORDS > 1
    // n chords of a circle of radius s, but for the two outer points: area (n - 2) s^2 + 2 s = n step/sin(step).
    float half_inner = 0.5 * float(CHORDS - 2);
    float area = 0.5 * float(CHORDS) * step / sin(step);
    float stretch = 2.0 * area / (1.0 + sqrt(1.0 + 4.0 * half_inner * area));
    for (int k = 1; k < CHORDS; ++k) {
        float angle = from + float(k) * step;
        vec3 next = center + stretch * (cos(angle) * towards + sin(angle) * across);
        contour_segment(contour, last, next);
        last = next;
    }
#endif
    contour_segment(contour, last, center + cos(to) * towards + sin(to) * across);
}

float ltc_cylinder(mat3 minv, vec3 p1, vec3 p2, float radius)
{
#ifdef SCALED
    float scale = scale_to_one(max(max(largest_component(p1), largest_component(p2)), radius));
    p1 *= scale;
    p2 *= scale;
    radius *= scale;
#endif
    vec3 along = p2 - p1;
    float size = length(along);
    if (!(size > 0.0) || !(radius > 0.0)) {
        return 0.0;
    }
    vec3 axis = along / size;
    float place = -dot(p1, axis);
    vec3 foot = abs(place) < abs(place - size) ? p1 : p2;
    foot -= dot(foot, axis) * axis;
    float gap = length(foot);
    bool beside = place >= 0.0 && place <= size;
    if (gap <= radius && beside) {
        return 1.0;
    }
    // Any direction across will do for a point on the axis.
    vec3 other = abs(axis.z) < 0.7 ? vec3(-axis.y, axis.x, 0.0) : vec3(0.0, -axis.z, axis.y);
    vec3 towards = gap > 1.0e-6 * radius ? -foot / gap : normalize(other);
    vec3 across = cross(axis, towards);

    vec3 e1 = minv * (radius * towards);
    vec3 e2 = minv * (radius * across);
    vec3 q1 = minv * p1;
    vec3 q2 = minv * p2;
    CosineContour contour = cosine_contour();
    if (gap <= radius) {
        // Four chords at the least make a circle; their points all move out alike, which the arc's ends cannot.
        const int POINTS = max(CHORDS, 4) * 2;
        float step = 2.0 * PI / float(POINTS);
        float stretch = sqrt(step / sin(step));
        vec3 center = place > 0.0 ? q2 : q1;
        vec3 last = center + stretch * e1;
        for (int k = 1; k <= POINTS; ++k) {
            float angle = float(k) * step;
            vec3 next = center + stretch * (cos(angle) * e1 + sin(angle) * e2);
            contour_segment(contour, last, next);
            last = next;
        }
        return contour_irradiance(contour);
    }

    float rim = atan(sqrt((gap - radius) * (gap + radius)), radius);
    vec3 out1 = cos(rim) * e1 + sin(rim) * e2;
    vec3 out2 = cos(rim) * e1 - sin(rim) * e2;
    contour_segment(contour, q1 + out1, q2 + out1);
    arc(contour, q2, e1, e2, rim, place > size ? 2.0 * PI - rim : -rim);
    contour_segment(contour, q2 + out2, q1 + out2);
    arc(contour, q1, e1, e2, -rim, place < 0.0 ? rim - 2.0 * PI : rim);
    return contour_irradiance(contour);
}
