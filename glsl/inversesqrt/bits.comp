/*---
summary = "Half the exponent by an integer shift, then Newton's steps"
source  = "C. Lomont, Fast Inverse Square Root, 2003, on the code of Quake III; J. Kadlec, Improving the fast inverse square root, 2010"

[[variant]]
name = "quake_0"
summary = "The shift alone"
defines = { STEPS = 0 }

[[variant]]
name = "quake_1"
summary = "The shift and one Newton step, as in Quake III"
defines = { STEPS = 1 }

[[variant]]
name = "quake_2"
summary = "The shift and two Newton steps"
defines = { STEPS = 2 }

[[variant]]
name = "kadlec"
summary = "One step whose constants are fitted together with the shift's"
defines = { KADLEC = 1 }
---*/

// y = y (3 - x y^2)/2 squares the relative error, times 3/2.
// Bound: relative 3.4e-2, 1.75e-3 and 4.7e-6 after 0, 1 and 2 steps; 6.5e-4 for kadlec; subnormals are not numbers to the shift.
// Measured: broken, worst ULP, largest share of the permitted error; lavapipe (Mesa 22.3), 1 M a scenario, seed 1.
//                           domain                   edge
//   quake_0    100 %, 5.7e5, 2.8e5   83.7 %, 5.7e5, 2.8e5
//   quake_1   99.6 %, 2.8e4, 1.4e4   83.7 %, 2.8e4, 1.4e4
//   quake_2   78.7 %, 73.27, 36.64   68.9 %, 73.09, 36.54
//   kadlec      100 %, 1.0e4, 5189    83.7 %, 1.0e4, 5189

float builtin_inversesqrt(float x)
{
#ifdef KADLEC
    float y = uintBitsToFloat(0x5f1ffff9u - (floatBitsToUint(x) >> 1));
    return y * (0.703952253 * (2.38924456 - x * y * y));
#else
    float y = uintBitsToFloat(0x5f3759dfu - (floatBitsToUint(x) >> 1));
    for (int i = 0; i < STEPS; ++i) {
        y = y * (1.5 - 0.5 * x * y * y);
    }
    return y;
#endif
}
