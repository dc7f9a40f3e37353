/*---
summary = "Eigenvalues of Q as (v +- u)^2 from tr Q +- 2 sqrt(det Q); axes always from the first row"
source  = "Heitz & Hill, Real-Time Line- and Disk-Light Shading with Linearly Transformed Cosines, SIGGRAPH 2017 course, and the thresholds its ports add"

[[variant]]
name = "sqrtq_uv"

[[variant]]
name = "sqrtq_uv_precise"
precise = true

[[variant]]
name = "sqrtq_ordered"
summary = "The u, v form with the axes from the row of the larger diagonal: the course's final answer"
defines = { ORDERED = 1 }

[[variant]]
name = "sqrtq_ordered_precise"
summary = "The u, v form with the axes from the row of the larger diagonal: the course's final answer"
defines = { ORDERED = 1 }
precise = true

[[variant]]
name = "sqrtq_shortcut_1e4"
summary = "sqrtq_ordered; vectors with |cos| <= 1e-4 count as the axes (the authors' sample code)"
defines = { ORDERED = 1, SHORTCUT = "1e-4" }

[[variant]]
name = "sqrtq_shortcut_1e4_precise"
summary = "sqrtq_ordered; vectors with |cos| <= 1e-4 count as the axes (the authors' sample code)"
defines = { ORDERED = 1, SHORTCUT = "1e-4" }
precise = true

[[variant]]
name = "sqrtq_shortcut_7e4"
summary = "sqrtq_ordered; vectors with |cos| <= 7e-4 count as the axes (seen in production renderers)"
defines = { ORDERED = 1, SHORTCUT = "7e-4" }

[[variant]]
name = "sqrtq_shortcut_7e4_precise"
summary = "sqrtq_ordered; vectors with |cos| <= 7e-4 count as the axes (seen in production renderers)"
defines = { ORDERED = 1, SHORTCUT = "7e-4" }
precise = true

[[variant]]
name = "sqrtq_shortcut_1e3"
summary = "sqrtq_ordered; vectors with |cos| <= 1e-3 count as the axes (seen in production renderers)"
defines = { ORDERED = 1, SHORTCUT = "1e-3" }

[[variant]]
name = "sqrtq_shortcut_1e3_precise"
summary = "sqrtq_ordered; vectors with |cos| <= 1e-3 count as the axes (seen in production renderers)"
defines = { ORDERED = 1, SHORTCUT = "1e-3" }
precise = true

[[variant]]
name = "sqrtq_clamped"
summary = "sqrtq_ordered with det Q clamped to >= 0"
defines = { ORDERED = 1, CLAMP_DET = 1 }

[[variant]]
name = "sqrtq_clamped_precise"
summary = "sqrtq_ordered with det Q clamped to >= 0"
defines = { ORDERED = 1, CLAMP_DET = 1 }
precise = true

[[variant]]
name = "sqrtq_floors"
summary = "sqrtq_ordered with q11, q22, e_max and e_min kept above an absolute 1e-7 (seen in an HLSL port)"
defines = { ORDERED = 1, FLOOR = "1e-7" }

[[variant]]
name = "sqrtq_floors_precise"
summary = "sqrtq_ordered with q11, q22, e_max and e_min kept above an absolute 1e-7 (seen in an HLSL port)"
defines = { ORDERED = 1, FLOOR = "1e-7" }
precise = true
---*/

// The eigenvalues of sqrt(Q) once more, written with the entries of Q alone (two roots instead of three in a row):
//
//     u = sqrt(tr Q - 2 sqrt(det Q)) / 2,  v = sqrt(tr Q + 2 sqrt(det Q)) / 2
//     e_max = (u + v)^2, e_min = (u - v)^2               the slide prints sqrt(e) here; it is e
//     axis = q12 V1 + (e - q11) V2                       ORDERED: if q11 > q22, else q12 V2 + (e - q22) V1
//
// ORDERED is the course's final answer. Its ports differ by what they add:
//     SHORTCUT   |q12| / sqrt(q11 q22) <= SHORTCUT: V1, V2 are taken for the axes themselves (and, because this
//                family's result is ordered, exchanged when V2 is the longer)
//     CLAMP_DET  det Q >= 0
//     FLOOR      q11, q22, e_max, e_min >= FLOOR, an absolute number, whatever the size of the light
//
// Domain: aspect ratios up to about 100; without SHORTCUT not for orthogonal vectors (0/0), in no form for exact
// circles off the shortcut. No guard is added beyond those named.
// Source: Heitz & Hill, "Real-Time Line- and Disk-Light Shading with Linearly Transformed Cosines", SIGGRAPH 2017,
// and public ports of its sample code.
// Bound: det Q cancels as in `sqrtq` (2^-24 aspect^2 for skewed vectors); tr Q - 2 sqrt(det Q) cancels towards
// circles and can turn negative there: NaN. With r = |V1| / |V2|, SHORTCUT turns the axes by up to
// SHORTCUT r / |r^2 - 1| and, for nearly equal lengths, by up to 45 degrees.
// Measured: failed, and worst minor_len ULP where all are finite; lavapipe (Mesa 22.3), 1 M a scenario, seed 1.
//                                 scene           aspect      near_circle            scale             edge
//   sqrtq_uv             0.0383 % 1e+03       51.9 % inf       78.3 % inf       45.4 % inf       98.5 % inf
//   sqrtq_ordered        0.0369 % 1e+03       51.9 % inf       78.3 % inf       44.9 % inf       98.1 % inf
//   sqrtq_shortcut_1e4   0.0265 % 1e+03       51.9 % inf       53.8 % inf       44.9 % inf       72.5 % inf
//   sqrtq_shortcut_7e4   0.0454 % 3e+03       51.9 % inf     53.9 % 6e+03       44.9 % inf         72 % inf
//   sqrtq_shortcut_1e3   0.0854 % 3e+03       51.9 % inf       54 % 8e+03       44.9 % inf       71.8 % inf
//   sqrtq_clamped        0.0369 % 1e+03       51.9 % inf       78.3 % inf       44.9 % inf       98.1 % inf
//   sqrtq_floors         0.0369 % 1e+03     53.8 % 4e+10     78.3 % 2e+07     62.3 % 4e+17       98.6 % inf

EllipseAxes ellipse_axes(vec3 v1, vec3 v2)
{
    float q11 = dot(v1, v1);
    float q22 = dot(v2, v2);
    float q12 = dot(v1, v2);
#ifdef FLOOR
    q11 = max(q11, FLOOR);
    q22 = max(q22, FLOOR);
#endif

#ifdef SHORTCUT
    if (!(abs(q12) / sqrt(q11 * q22) > SHORTCUT)) {
        float l1 = sqrt(q11);
        float l2 = sqrt(q22);
        vec3 axis1 = v1 / l1;
        vec3 axis2 = v2 / l2;
        if (l1 < l2) {
            return EllipseAxes(axis2, axis1, l2, l1);
        }
        return EllipseAxes(axis1, axis2, l1, l2);
    }
#endif

    float trace = q11 + q22;
    float det = q11 * q22 - q12 * q12;
#ifdef CLAMP_DET
    det = max(det, 0.0);
#endif
    float root = sqrt(det);
    float u = 0.5 * sqrt(trace - 2.0 * root);
    float v = 0.5 * sqrt(trace + 2.0 * root);
    float e_max = (u + v) * (u + v);
    float e_min = (u - v) * (u - v);
#ifdef FLOOR
    e_max = max(e_max, FLOOR);
    e_min = max(e_min, FLOOR);
#endif

    vec3 major = q12 * v1 + (e_max - q11) * v2;
    vec3 minor = q12 * v1 + (e_min - q11) * v2;
#ifdef ORDERED
    if (!(q11 > q22)) {
        major = q12 * v2 + (e_max - q22) * v1;
        minor = q12 * v2 + (e_min - q22) * v1;
    }
#endif

    return EllipseAxes(normalize(major), normalize(minor), sqrt(e_max), sqrt(e_min));
}
