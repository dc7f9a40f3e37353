// The cosine along a straight line, written so that no term cancels.

#ifndef ROOTQ_LINE_COSINE
#define ROOTQ_LINE_COSINE

// f1 = (sin t - t cos t)/sin^3 t and f2 = (t - sin t cos t)/sin^3 t for an angle t in 0..pi, from its sine and cosine.
// Both are positive; 1/3 and 2/3 at t = 0.
// Below sin^2 t = 0.2 their series in sin^2 t, all terms positive: f1 = F(1, 1; 5/2; s)/3, f2 = 2 F(1/2, 3/2; 5/2; s)/3.
// Relative error of the cut-off 4e-7; of the closed forms 16 roundings where what cancels is 1/15 of its terms.
// Source: ours.
vec2 line_factors(float sine, float cosine)
{
    float s = sine * sine;
    if (cosine > 0.0 && s < 0.2) {
        float f1 = 1.0 + s * 0.8;
        f1 = 1.0 + s * (14.0 / 17.0) * (1.0 + s * (16.0 / 19.0) * f1);
        f1 = 1.0 + s * (10.0 / 13.0) * (1.0 + s * (12.0 / 15.0) * f1);
        f1 = 1.0 + s * (6.0 / 9.0) * (1.0 + s * (8.0 / 11.0) * f1);
        f1 = 1.0 + s * (2.0 / 5.0) * (1.0 + s * (4.0 / 7.0) * f1);
        float f2 = 1.0 + s * 0.75;
        f2 = 1.0 + s * (48.75 / 59.5) * (1.0 + s * (63.75 / 76.0) * f2);
        f2 = 1.0 + s * (24.75 / 32.5) * (1.0 + s * (35.75 / 45.0) * f2);
        f2 = 1.0 + s * (8.75 / 13.5) * (1.0 + s * (15.75 / 22.0) * f2);
        f2 = 1.0 + s * (0.75 / 2.5) * (1.0 + s * (3.75 / 7.0) * f2);
        return vec2(f1 * 0.333333333333, f2 * 0.666666666667);
    }
    float angle = atan(sine, cosine);
    return vec2(sine - angle * cosine, angle - sine * cosine) / (s * sine);
}

#endif
