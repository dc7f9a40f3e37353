// sine of x + shift pi/2 to f32's last bits for |x| up to some thousands: x less a whole multiple of pi/2 in three parts, of
// which the first products are exact (W. J. Cody, W. Waite, Software Manual for the Elementary Functions, 1980), then a
// polynomial on -pi/4..pi/4.
//
// Source: S. L. Moshier, Cephes Mathematical Library, 1989, single precision sin and cos, whose parts of pi/4 are doubled
// here: 8, 11 and 24 bits, so that the first two's products with multiples below 2^13 are exact.

#ifndef ROOTQ_CODY_WAITE
#define ROOTQ_CODY_WAITE

float cody_waite_sine(float x, int shift)
{
    float multiple = roundEven(x * 0.636619772367581);
    float r = x - multiple * 1.5703125;
    r = r - multiple * 4.837512969970703e-4;
    r = r - multiple * 7.549789954891882e-8;
    int quadrant = int(multiple) + shift;
    float z = r * r;
    float value;
    if ((quadrant & 1) == 0) {
        float p = -1.9515295891e-4 * z + 8.3321608736e-3;
        p = p * z - 1.6666654611e-1;
        value = p * z * r + r;
    } else {
        float p = 2.443315711809948e-5 * z - 1.388731625493765e-3;
        p = p * z + 4.166664568298827e-2;
        value = p * z * z - 0.5 * z + 1.0;
    }
    return (quadrant & 2) == 0 ? value : -value;
}

#endif
