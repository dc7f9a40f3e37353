// sine for -pi..pi as a parabola each half turn, and that corrected by its own square.
//
// Source: N. Capens, "Fast and accurate sine/cosine", devmaster.net, 2006; errors 5.6e-2 and 1.1e-3.

#ifndef ROOTQ_PARABOLA_SINE
#define ROOTQ_PARABOLA_SINE

float parabola_sine(float x)
{
    return 1.27323954473516 * x - 0.405284734569351 * x * abs(x);
}

float parabola_sine_refined(float x)
{
    float y = parabola_sine(x);
    return 0.225 * (y * abs(y) - y) + y;
}

#endif
