/*---
summary = "Rows in closed form, asin(x1/rho) - asin(x0/rho) with rho^2 = 1 - y^2, across them Gauss's rule of 4 points"
source  = "ours: the row's integral is elementary, and clipping a row is a clamp"

[[variant]]
name = "rows4"

[[variant]]
name = "rows8"
summary = "rows4 with 8 points"
defines = { POINTS = 8 }

[[variant]]
name = "rows4_stable"
summary = "rows4 with the two angles' difference as one arctangent whose argument does not cancel"
defines = { STABLE = 1 }

[[variant]]
name = "rows8_stable"
summary = "rows4_stable with 8 points"
defines = { POINTS = 8, STABLE = 1 }
---*/

// Domain: any rectangle, in any order.
// Source: ours; Gauss-Legendre quadrature.
// Bound: inside the circle the rule has converged to f32 for pixels of 1/16 (4 points) and 1/4 (8 points) that are as far from
// the circle. At the circle a row's end moves as a root: the error of a cut pixel is of the order of its own area.
// Without STABLE the difference of angles cancels: u over the width.
// Measured: failed, and worst error where all are finite; lavapipe (Mesa 22.3), 1 M a scenario, seed 1.
//                         image       boundary        decimal           fine         window        grazing           edge
//   rows4         24.2 % 1.9e+0  91.5 % 2.1e+0  50.7 % 3.3e+0  20.6 % 2.4e+1    29 % 8.4e+0  93.2 % 1.0e+1  19.5 % 4.5e+2
//   rows8         24.3 % 1.0e+0  90.1 % 1.2e+0  49.2 % 1.7e+0  15.1 % 2.4e+1  26.9 % 6.0e+0  92.7 % 4.9e+0     18.2 % inf
//   rows4_stable  6.58 % 1.9e+0  69.5 % 2.1e+0  34.8 % 3.3e+0  19.4 % 8.2e+0  18.7 % 8.4e+0  83.4 % 1.0e+1  16.2 % 4.5e+2
//   rows8_stable   6.7 % 1.0e+0  67.8 % 1.2e+0  32.2 % 1.7e+0  13.7 % 7.5e+0  15.9 % 6.0e+0  82.6 % 4.9e+0     14.6 % inf

#ifdef STABLE
#include "common/arctangent.glsl"
#endif

#ifndef POINTS
#define POINTS 4
#endif

float row_angle(float x0, float x1, float y)
{
    float square = (1.0 - y) * (1.0 + y);
    float rho = sqrt(max(square, 0.0));
    if (!(rho > 0.0)) {
        return 0.0;
    }
#ifdef STABLE
    x0 = clamp(x0, -rho, rho);
    x1 = clamp(x1, -rho, rho);
    float c0 = sqrt(max((rho - x0) * (rho + x0), 0.0));
    float c1 = sqrt(max((rho - x1) * (rho + x1), 0.0));
    float dx = x1 - x0;
    float cosine = x0 * x1 + c0 * c1;
    float sine = x0 * x1 > 0.0 ? square * dx * (x0 + x1) / (x1 * c0 + x0 * c1) : x1 * c0 - x0 * c1;
    return dx == 0.0 ? 0.0 : arctangent(abs(sine), cosine);
#else
    return asin(clamp(x1 / rho, -1.0, 1.0)) - asin(clamp(x0 / rho, -1.0, 1.0));
#endif
}

float pixel_ortho(float x0, float y0, float x1, float y1)
{
#if POINTS == 4
    const vec2 rule[2] = vec2[](vec2(0.339981043584856265, 0.652145154862546143), vec2(0.861136311594052575, 0.347854845137453857));
#else
    const vec2 rule[4] = vec2[](
        vec2(0.183434642495649805, 0.362683783378361983), vec2(0.525532409916328986, 0.313706645877887287),
        vec2(0.796666477413626740, 0.222381034453374471), vec2(0.960289856497536232, 0.101228536290376259));
#endif
    vec2 x = vec2(min(x0, x1), max(x0, x1));
    vec2 y = clamp(vec2(min(y0, y1), max(y0, y1)), -1.0, 1.0);
    float middle = 0.5 * (y.x + y.y);
    float reach = 0.5 * (y.y - y.x);
    float sum = 0.0;
    for (int k = 0; k < POINTS / 2; ++k) {
        float offset = rule[k].x * reach;
        sum += rule[k].y * (row_angle(x.x, x.y, middle - offset) + row_angle(x.x, x.y, middle + offset));
    }
    return reach * sum;
}
