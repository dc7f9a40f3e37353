// The length of a 2D vector without leaving the range in its squares.

#ifndef ROOTQ_HYPOT
#define ROOTQ_HYPOT

// sqrt(x^2 + y^2) by the ratio of the two, finite and accurate wherever the result is; hypot(0, 0) = 0.
float hypot(float x, float y)
{
    float longer = max(abs(x), abs(y));
    if (!(longer > 0.0)) {
        return 0.0;
    }
    float ratio = min(abs(x), abs(y)) / longer;
    return longer * sqrt(1.0 + ratio * ratio);
}

#endif
