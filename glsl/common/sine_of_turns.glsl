// sine of 2 pi t from t, the angle in turns: the whole turns fall off exactly, so that what is left is t's own rounding.
//
// Ours; the polynomial is the odd minimax of degree 9 on a quarter turn by Remez' algorithm, relative error 6.1e-9.

#ifndef ROOTQ_SINE_OF_TURNS
#define ROOTQ_SINE_OF_TURNS

float sine_of_turns(float t)
{
    t = t - roundEven(t);
    // sin(pi - x) = sin x: within a quarter turn either way.
    t = abs(t) > 0.25 ? (t < 0.0 ? -0.5 : 0.5) - t : t;
    float x = 6.28318530717959 * t;
    float z = x * x;
    float p = 2.60578063697e-6 * z - 1.98096029014e-4;
    p = p * z + 8.33306624607e-3;
    p = p * z - 1.66666595504e-1;
    return p * z * x + x;
}

#endif
