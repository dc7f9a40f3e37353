// atan for x >= 0, to f32's last bits: beyond tan(pi/8) turned by pi/4, beyond tan(3 pi/8) by pi/2.
//
// Source: S. L. Moshier, Cephes Mathematical Library, 1989, single precision atan.

#ifndef ROOTQ_CEPHES_ATAN
#define ROOTQ_CEPHES_ATAN

float cephes_atan(float x)
{
    float turn = 0.0;
    if (x > 2.414213562373095) {
        turn = 1.57079632679490;
        x = -1.0 / x;
    } else if (x > 0.4142135623730950) {
        turn = 0.785398163397448;
        x = (x - 1.0) / (x + 1.0);
    }
    float z = x * x;
    float p = 8.05374449538e-2 * z - 1.38776856032e-1;
    p = p * z + 1.99777106478e-1;
    p = p * z - 3.33329491539e-1;
    return turn + (p * z * x + x);
}

#endif
