/*---
summary = "pi R^2/d^2, the disk as its flat image: how point lights with a radius are weighed"
source  = "The limit of a far disk, as renderers use it"

[[variant]]
name = "flat"

[[variant]]
name = "slant"
summary = "pi R^2/(R^2 + d^2): stays finite on the disk, half of the truth there"
defines = { SLANT = 1 }
---*/

// Domain: far disks. flat is too large by (3/4)(R/d)^2, slant too small by (1/4)(R/d)^2: 0.1 % at 27 and 16 radii.
// Source: the first term of the series.
// Bound: as stated, and 4 roundings.
// Measured: failed, and worst error where all are finite; lavapipe (Mesa 22.3), 1 M a scenario, seed 1.
//                  scene            far           near          scale        edge
//   flat   85.3 % 1.3e+3  23.9 % 7.1e-1  100 % 5.0e+15  86.1 % 5.0e+3  74.5 % inf
//   slant  78.6 % 4.9e-1    20 % 1.5e-1   100 % 5.0e-1  80.1 % 1.0e+0    74 % inf

float disk_solid_angle(float radius, float distance)
{
    float square = distance * distance;
#ifdef SLANT
    square += radius * radius;
#endif
    return 3.14159265358979324 * radius * radius / square;
}
