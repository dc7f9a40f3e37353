#!/usr/bin/env python3
"""Writes tests/golden/<family>.csv: exact inputs, and results computed with mpmath in many digits.

File format
-----------
Comma-separated, one header line, no quoting. Lines that begin with '#' are comments.

scenario      which part of the input space the row stands for
<inputs>      exact f32 values as C hex floats (0x1.8p+3); truth belongs to exactly these bits
<outputs>     25 significant digits. A cell is empty where the result is undefined (the axes of a circle).
              Components of unit vectors below 1e-50 are written as 0, so a row states them to 25 digits or to 1e-50.
<conditions>  numbers from which a test derives the accuracy that it may ask for; empty means infinite or 0/0

Unit vectors are free in sign; here the first of their largest components is positive.

Draws use random.Random.random() and the exactly rounded operations + - * / sqrt only, so every platform draws the
same bits. Each scenario has its own seed: adding one changes no other row.

A new family is one function that returns a Golden, and its line in FAMILIES.
"""

import argparse
import itertools
import math
import pathlib
import random
import struct
import sys
from fractions import Fraction
from typing import Callable, NamedTuple

try:
    import mpmath
    from mpmath import mp, mpf
except ImportError:
    sys.exit("golden.py needs the Python package mpmath (Debian: python3-mpmath)")

PRINTED_DIGITS = 25
FEWEST_DIGITS = 120
MOST_DIGITS = 1920
# Two independent solvers agree this well before a row is written: 25 digits of the smallest printed component.
AGREEMENT = "1e-75"
SMALLEST_COMPONENT = "1e-50"


class Golden(NamedTuple):
    """The content of one file. `scenarios` maps a name to a function from a random source to input rows; `truth`
    maps one input row to its outputs followed by its conditions, None for an empty cell."""

    inputs: list[str]
    outputs: list[str]
    conditions: list[str]
    scenarios: dict[str, Callable[[random.Random], list[list[float]]]]
    truth: Callable[[list[float]], list]


# --- f32 -------------------------------------------------------------------------------------------------------------

F32_MAX = math.ldexp(2.0 - 2.0**-23, 127)
F32_MIN_NORMAL = math.ldexp(1.0, -126)
F32_MIN_SUBNORMAL = math.ldexp(1.0, -149)


def to_f32(x):
    """The nearest f32 to a Python float."""
    return struct.unpack("<f", struct.pack("<f", x))[0]


def f32_step(x, steps):
    """The f32 that lies `steps` representable values away from zero, seen from x (towards it if negative)."""
    bits = struct.unpack("<i", struct.pack("<f", x))[0]
    return struct.unpack("<f", struct.pack("<i", bits + steps))[0]


def hex_float(x):
    """The shortest C hex float: 0x1.8p+3, -0x0p+0."""
    mantissa, exponent = x.hex().split("p")
    if "." in mantissa:
        mantissa = mantissa.rstrip("0").rstrip(".")
    return f"{mantissa}p{exponent}"


# --- draws -----------------------------------------------------------------------------------------------------------


def uniform(rng, low, high):
    return low + (high - low) * rng.random()


def magnitude(rng, low_exponent, high_exponent):
    """A positive number whose binary exponent is uniform in low..high-1, with a uniform mantissa."""
    exponent = low_exponent + int(rng.random() * (high_exponent - low_exponent))
    return math.ldexp(uniform(rng, 1.0, 2.0), exponent)


def circle_point(rng):
    """(cos, sin) of a uniform angle, by rejection: no library sine whose last bit depends on the platform."""
    while True:
        x, y = uniform(rng, -1.0, 1.0), uniform(rng, -1.0, 1.0)
        r2 = x * x + y * y
        if 1e-3 < r2 <= 1.0:
            r = math.sqrt(r2)
            return x / r, y / r


def rotation(rng):
    """The columns of a uniform rotation matrix, from a quaternion drawn by rejection from the 4-ball."""
    while True:
        x, y, z, w = (uniform(rng, -1.0, 1.0) for _ in range(4))
        n = x * x + y * y + z * z + w * w
        if 1e-3 < n <= 1.0:
            break
    s = 2.0 / n
    return (
        (1.0 - s * (y * y + z * z), s * (x * y + z * w), s * (x * z - y * w)),
        (s * (x * y - z * w), 1.0 - s * (x * x + z * z), s * (y * z + x * w)),
        (s * (x * z + y * w), s * (y * z - x * w), 1.0 - s * (x * x + y * y)),
    )


# --- printing --------------------------------------------------------------------------------------------------------


def digits(x):
    """25 significant digits, always scientific, trailing zeros dropped; an empty cell for None."""
    if x is None:
        return ""
    if x == 0:
        return "0"
    text = mpmath.nstr(x, PRINTED_DIGITS, strip_zeros=False, min_fixed=1, max_fixed=0, show_zero_exponent=True)
    mantissa, exponent = text.split("e")
    mantissa = mantissa.rstrip("0").rstrip(".")
    return f"{mantissa}e{int(exponent)}"


def axis_cells(axis):
    """A unit vector with its sign chosen (first largest component positive) and negligible components as 0."""
    largest = max(abs(c) for c in axis)
    # Components that are equal in truth differ by the last digit here; the first of them decides.
    leading = next(c for c in axis if largest - abs(c) < mpf(SMALLEST_COMPONENT))
    sign = 1 if leading > 0 else -1
    return [sign * c if abs(c) >= mpf(SMALLEST_COMPONENT) else mpf(0) for c in axis]


# --- ellipse_axes ----------------------------------------------------------------------------------------------------


def ellipse_axes():
    """Semi-axes of the ellipse with conjugate semi-diameters V1, V2: singular values and left singular vectors of the
    3x2 matrix A = [V1 V2].

    Truth comes from mpmath's SVD of A and, independently, from its eigensolver applied to the 3x3 matrix A A^T. No
    closed form is involved. Degeneracy is decided in exact rational arithmetic: V1 x V2 = 0 (minor_len is 0 and the
    minor axis undefined), |V1| = |V2| with V1.V2 = 0 (a circle: both axes undefined).

    Conditions: gap = (major_len - minor_len)/major_len, which divides the error of the axes; aspect =
    major_len/minor_len, which multiplies the relative error of minor_len under perturbed inputs; skew =
    |V1||V2|/|V1 x V2|, which multiplies the relative error of the area when its products are rounded.
    """
    per_scenario = 60

    def pair(frame, major, minor, cos_phi, sin_phi):
        """Conjugate semi-diameters at eccentric angle phi of the ellipse with these semi-axes, rounded to f32."""
        u, v, _ = frame
        v1 = [major * cos_phi * a + minor * sin_phi * b for a, b in zip(u, v)]
        v2 = [minor * cos_phi * b - major * sin_phi * a for a, b in zip(u, v)]
        return [to_f32(c) for c in v1 + v2]

    def scene(rng):
        """Lights as artists place them: radii 1/8 to 8, half of them with orthogonal semi-diameters."""
        rows = []
        for i in range(per_scenario):
            a, b = magnitude(rng, -3, 3), magnitude(rng, -3, 3)
            phi = (1.0, 0.0) if i % 2 else circle_point(rng)
            rows.append(pair(rotation(rng), a, b, *phi))
        return rows

    def aspect(rng):
        """Aspect 1 to 1e7, evenly in binary exponent; long axis in V1, in V2, shared equally, shared at random."""
        half = math.sqrt(0.5)
        rows = []
        for i in range(per_scenario):
            ratio = min(magnitude(rng, i * 24 // per_scenario, i * 24 // per_scenario + 1), 1e7)
            major = magnitude(rng, -2, 2)
            phi = ((1.0, 0.0), (0.0, 1.0), (half, half), circle_point(rng))[i % 4]
            rows.append(pair(rotation(rng), major, major / ratio, *phi))
        return rows

    def near_circle(rng):
        """Gaps 2^-1 to 2^-24 and below: drawn, f32 neighbours of a circle, and the tiniest third component."""
        rows = []
        for k in range(1, 25):
            r = magnitude(rng, -2, 2)
            rows.append(pair(rotation(rng), r, r * (1.0 - math.ldexp(1.0, -k)), *circle_point(rng)))
        for _ in range(12):
            r = magnitude(rng, -2, 2)
            rows.append(pair(rotation(rng), r, r, *circle_point(rng)))
        for i in range(12):
            r = to_f32(magnitude(rng, -2, 2))
            neighbour = f32_step(r, (1, -1, 2, -3)[i % 4])
            v = [[r, 0.0, 0.0], [0.0, neighbour, 0.0]]
            rows.append([v[j][(c + i // 4) % 3] for j in range(2) for c in range(3)])
        for k in range(1, 13):
            # Exactly orthogonal, and lengths that differ by z^2/2 in relative terms: gaps 2^-3 to 2^-25.
            x, y = (to_f32(magnitude(rng, -2, 2)) for _ in range(2))
            z = to_f32(math.ldexp(math.sqrt(x * x + y * y), -k))
            rows.append([x, y, 0.0, -y, x, z])
        return rows

    def scale(rng):
        """A scene at scales 2^-40 to 2^40, then V1 and V2 at different scales, subnormal, and near the f32 limit."""
        rows = []

        def at(exponent1, exponent2):
            # Orthogonal semi-diameters at equal scales say nothing about d12: draw an eccentric angle always.
            row = pair(rotation(rng), magnitude(rng, -1, 1), magnitude(rng, -3, 1), *circle_point(rng))
            exponents = [exponent1] * 3 + [exponent2] * 3
            rows.append([to_f32(math.ldexp(c, e)) for c, e in zip(row, exponents)])

        for exponent in range(-40, 41, 2):
            at(exponent, exponent)
        for exponent1, exponent2 in ((-40, 40), (40, -40), (-20, 20), (20, -20), (0, -40), (40, 0), (-100, 100)):
            at(exponent1, exponent2)
        for exponent in (-120, -126, -130, -135, -140, -145):
            at(exponent, exponent)
        for exponent in (100, 110, 120, 122, 123, 124):
            at(exponent, exponent)
        return rows

    def edge(rng):
        """Parallel, zero, circular, axis-aligned and neighbouring vectors, with the signs and limits of f32."""
        zero, x, y, z = [0.0] * 3, [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]

        def times(v, factor):
            return [c * factor for c in v]

        rows = [zero + zero, times(x, 0.0) + times(y, -0.0), x + zero, zero + z, [0.0, 3.0, 4.0] + zero]
        rows += [zero + [1.0, -2.0, 2.0], [F32_MIN_SUBNORMAL, 0.0, 0.0] + zero, [F32_MAX, 0.0, 0.0] + zero]
        # Parallel, exactly: minor_len is 0.
        for v, factor in itertools.product(([1.0, 2.0, 3.0], [-5.0, 0.0, 7.0]), (1.0, -1.0, 3.0, math.ldexp(1.0, -40))):
            rows.append(v + times(v, factor))
        # Circles, exactly: both axes undefined.
        rows += [x + y, y + x, z + times(x, -1.0), times(y, 1e10) + times(z, -1e10), [3.0, 4.0, 0.0, -4.0, 3.0, 0.0]]
        rows += [[1.0, 2.0, 2.0, 2.0, 1.0, -2.0], [2.0, 3.0, 6.0, 6.0, 2.0, -3.0]]
        rows += [times(x, F32_MIN_SUBNORMAL) + times(y, F32_MIN_SUBNORMAL), times(y, F32_MAX) + times(z, F32_MAX)]
        # Axis-aligned, either order, aspect 2 to 2^149.
        for u, v in itertools.permutations((x, y, z), 2):
            rows.append(times(u, 2.0) + v)
        rows += [x + times(z, F32_MIN_NORMAL), times(y, F32_MIN_SUBNORMAL) + z, x + times(y, math.ldexp(1.0, -24))]
        # Equal lengths, not orthogonal (tau is 0), either sign of V1.V2; then equal up to one f32 step.
        rows += [[1.0, 1.0, 0.0, 1.0, 0.0, 1.0], [1.0, 1.0, 0.0, -1.0, 0.0, 1.0], [2.0, 1.0, 2.0, 2.0, -1.0, 2.0]]
        rows += [[1.0, 1e-4, 0.0, 1.0, -1e-4, 0.0], [1.0, 1e-4, 0.0, -1.0, 1e-4, 0.0]]
        rows += [[1.0, 1.0, 0.0, 1.0, 0.0, f32_step(1.0, 1)], [1.0, 1.0, 0.0, 1.0, 0.0, f32_step(1.0, -1)]]
        # V1.V2 is tiny: orthogonal up to one small component, at aspects 2 and 1.
        rows += [[2.0, 0.0, 0.0, 1e-7, 1.0, 0.0], [1.0, 1e-7, 0.0, 0.0, 1.0, 0.0], [1.0, 1e-20, 0.0, 0.0, 2.0, 0.0]]
        # Nearly parallel: V2 is V1 with one component moved by an f32 step, the area a few steps of its products.
        while len(rows) < per_scenario:
            v = [to_f32(uniform(rng, -2.0, 2.0)) for _ in range(3)]
            moved = list(v)
            moved[len(rows) % 3] = f32_step(v[len(rows) % 3], 1 + len(rows) % 2)
            rows.append(v + moved)
        return [[to_f32(c) for c in row] for row in rows]

    def by_svd(a):
        u, s, _ = mpmath.svd_r(a)
        return s[0], s[1], [u[i, 0] for i in range(3)], [u[i, 1] for i in range(3)]

    def by_eigenvalues(a):
        e, q = mpmath.eigsy(a * a.T)
        lengths = [mp.sqrt(max(e[k], 0)) for k in (2, 1)]
        return *lengths, [q[i, 2] for i in range(3)], [q[i, 1] for i in range(3)]

    def solve(row, parallel, circle):
        """Lengths and axes, at the least precision where both solvers agree. Axes are None where undefined."""
        exponent = max(math.frexp(c)[1] for c in row if c != 0.0)
        mp.dps = FEWEST_DIGITS
        while mp.dps <= MOST_DIGITS:
            # A power of two is exact and spares the solvers' absolute thresholds.
            a = mpmath.matrix(3, 2)
            for i in range(3):
                a[i, 0], a[i, 1] = (mp.ldexp(mpf(row[i + 3 * j]), -exponent) for j in range(2))
            major_len, minor_len, major, minor = by_svd(a)
            other_major_len, other_minor_len, other_major, other_minor = by_eigenvalues(a)
            tolerance = mpf(AGREEMENT)
            agree = abs(major_len - other_major_len) <= tolerance * major_len
            if parallel:
                agree = agree and max(minor_len, other_minor_len) <= tolerance * major_len
                minor_len, minor = mpf(0), None
            else:
                agree = agree and abs(minor_len - other_minor_len) <= tolerance * minor_len
            if circle:
                agree = agree and abs(major_len - minor_len) <= tolerance * major_len
                minor_len, major, minor = major_len, None, None
            for axis, other in ((major, other_major), (minor, other_minor)):
                if axis is not None:
                    pairs = list(zip(axis_cells(axis), axis_cells(other)))
                    agree = agree and all(abs(p - q) <= tolerance for p, q in pairs)
            if agree:
                return mp.ldexp(major_len, exponent), mp.ldexp(minor_len, exponent), major, minor
            mp.dps *= 2
        raise ArithmeticError(f"SVD and eigensolver disagree at {MOST_DIGITS} digits on {row}")

    def truth(row):
        v1, v2 = [[Fraction(c) for c in row[3 * j : 3 * j + 3]] for j in range(2)]
        d11, d22, d12 = (sum(a * b for a, b in zip(p, q)) for p, q in ((v1, v1), (v2, v2), (v1, v2)))
        area2 = d11 * d22 - d12 * d12
        if d11 + d22 == 0:
            return [None] * 6 + [mpf(0), mpf(0)] + [None] * 3
        circle = d11 == d22 and d12 == 0
        major_len, minor_len, major, minor = solve(row, area2 == 0, circle)
        gap = (major_len - minor_len) / major_len
        aspect_ratio = skew = None
        if area2 != 0:
            aspect_ratio = major_len / minor_len
            sin2 = area2 / (d11 * d22)
            skew = 1 / mp.sqrt(mpf(sin2.numerator) / sin2.denominator)
        axes = [c for axis in (major, minor) for c in (axis_cells(axis) if axis else [None] * 3)]
        return axes + [major_len, minor_len, gap, aspect_ratio, skew]

    def xyz(*names):
        return [f"{name}_{c}" for name in names for c in "xyz"]

    return Golden(
        inputs=xyz("v1", "v2"),
        outputs=xyz("major", "minor") + ["major_len", "minor_len"],
        conditions=["gap", "aspect", "skew"],
        scenarios={f.__name__: f for f in (scene, aspect, near_circle, scale, edge)},
        truth=truth,
    )


# --- cone_axes -------------------------------------------------------------------------------------------------------


def cone_axes():
    """Mean direction and tangents of the half angles of the cone over an ellipse with semi-axes hx, hy and centre c.

    Truth comes from mpmath's eigensolver applied to the dual matrix S = diag(hx^2, hy^2, 0) - c c^T and, independently
    where no tangent is 0, to the cone's own quadric adj(S), both formed in exact rational arithmetic: tan^2 are the
    ratios of eigenvalues to the one of the other sign. No cubic is solved. Where S has no negative eigenvalue, which
    is decided exactly, the origin lies in the light and everything is undefined.
    """
    per_scenario = 60

    def light(rng, aspect=5.0):
        """Semi-axes of about 1/16 to 8 in either order, and a direction."""
        longer = magnitude(rng, -3, 3)
        shorter = longer / math.sqrt(uniform(rng, 1.0, aspect * aspect))
        hx, hy = (longer, shorter) if rng.random() < 0.5 else (shorter, longer)
        return hx, hy, rotation(rng)[2]

    def row(hx, hy, c):
        return [to_f32(v) for v in (hx, hy, *c)]

    def scene(rng):
        """Lights as artists place them, 1/4 to 16 away."""
        rows = []
        for _ in range(per_scenario):
            hx, hy, (x, y, z) = light(rng)
            d = magnitude(rng, -2, 4)
            rows.append(row(hx, hy, (d * x, d * y, d * abs(z))))
        return rows

    def facing(rng):
        """Discs on the axis, then off by 2^-24 to 2^-6 in shape and place."""
        rows = []
        for i in range(per_scenario):
            r, d = to_f32(magnitude(rng, -4, 3)), magnitude(rng, -3, 4)
            off = [math.ldexp(uniform(rng, -1.0, 1.0), -24 + 18 * i // per_scenario) if i % 2 else 0.0 for _ in range(3)]
            rows.append(row(r, r * (1.0 + off[0]), (d * off[1], d * off[2], d)))
        return rows

    def far(rng):
        """Distances of 8 to 2^17 radii."""
        rows = []
        for i in range(per_scenario):
            hx, hy, (x, y, z) = light(rng)
            d = max(hx, hy) * magnitude(rng, 3 + 14 * i // per_scenario, 4 + 14 * i // per_scenario)
            rows.append(row(hx, hy, (d * x, d * y, d * abs(z))))
        return rows

    def near_plane(rng):
        """Heights of 2^-17 to 2^-3 radii, up to two semi-axes from the centre; every third one beside the rim."""
        rows = []
        for i in range(per_scenario):
            hx, hy, _ = light(rng)
            cos, sin = circle_point(rng)
            offset = 1.0 + math.ldexp(uniform(rng, -1.0, 1.0), -i // 3) if i % 3 == 0 else uniform(rng, 0.0, 2.0)
            height = max(hx, hy) * magnitude(rng, -17 + 14 * i // per_scenario, -16 + 14 * i // per_scenario)
            rows.append(row(hx, hy, (hx * offset * cos, hy * offset * sin, height)))
        return rows

    def needle(rng):
        """Aspects of 1 to 2^14, seen from 1/8 to 8 major semi-axes away."""
        rows = []
        for i in range(per_scenario):
            longer = magnitude(rng, -3, 3)
            shorter = longer / magnitude(rng, 14 * i // per_scenario, 1 + 14 * i // per_scenario)
            x, y, z = rotation(rng)[2]
            d = longer * magnitude(rng, -3, 3)
            hx, hy = (longer, shorter) if i % 2 else (shorter, longer)
            rows.append(row(hx, hy, (d * x, d * y, d * abs(z))))
        return rows

    def edge(rng):
        """Centres on the axis, in the plane, on the rim and within; zero and equal semi-axes; both sides; any scale."""
        rows = [[1.0, 1.0, 0.0, 0.0, 1.0], [1.0, 1.0, 0.0, 0.0, -2.0], [2.0, 1.0, 0.0, 0.0, 3.0], [1.0, 2.0, 0.0, 0.0, -3.0]]
        # In the plane: outside, on the rim, inside, at the centre.
        rows += [[1.0, 1.0, 2.0, 0.0, 0.0], [3.0, 2.0, 0.0, 5.0, 0.0], [3.0, 2.0, 3.0, 2.0, 0.0], [1.0, 2.0, 1.0, -0.0, -0.0]]
        rows += [[1.0, 1.0, 0.0, 1.0, 0.0], [5.0, 5.0, 3.0, 4.0, 0.0], [1.0, 2.0, 0.5, 0.5, 0.0], [1.0, 2.0, 0.0, 0.0, 0.0]]
        rows += [[5.0, 5.0, 3.0, f32_step(4.0, 1), 0.0], [1.0, 1.0, f32_step(1.0, 1), 0.0, 0.0], [1.0, 1.0, f32_step(1.0, -1), 0.0, 0.0]]
        # Above the rim, down to the least height.
        for exponent in (0, -10, -24, -60, -126, -149):
            rows += [[1.0, 1.0, 1.0, 0.0, math.ldexp(1.0, exponent)], [2.0, 1.0, 0.0, -1.0, -math.ldexp(1.0, exponent)]]
            rows.append([1.0, 1.0, 0.5, 0.0, math.ldexp(1.0, exponent)])
        # No area, no width, a point; the origin on a segment, beside it, at a point.
        rows += [[1.0, 0.0, 0.0, 0.0, 2.0], [0.0, 1.0, 1.0, 1.0, 2.0], [0.0, 0.0, 1.0, 2.0, 2.0], [0.0, 0.0, 0.0, 0.0, 0.0]]
        rows += [[1.0, 0.0, 0.5, 0.0, 0.0], [1.0, 0.0, 2.0, 0.0, 0.0], [0.0, 1.0, 0.0, 1.0, 0.0], [1.0, 0.0, 0.0, 3.0, 0.0]]
        rows += [[F32_MIN_SUBNORMAL, 1.0, 0.0, 0.0, 1.0], [1.0, 1.0, F32_MIN_SUBNORMAL, 0.0, 1.0]]
        while len(rows) < per_scenario:
            hx, hy, (x, y, z) = light(rng)
            exponent = (-100, -40, 40, 100)[len(rows) % 4]
            rows.append([math.ldexp(v, exponent) for v in (hx, hy, x, y, z)])
        return [[to_f32(c) for c in r] for r in rows]

    def by_dual(s):
        e, q = mpmath.eigsy(s)
        k = min(range(3), key=lambda i: e[i])
        rest = sorted((max(e[i], 0) for i in range(3) if i != k), reverse=True)
        return [q[i, k] for i in range(3)], [mp.sqrt(v / -e[k]) for v in rest]

    def by_quadric(adjugate):
        e, q = mpmath.eigsy(adjugate)
        k = max(range(3), key=lambda i: e[i])
        rest = sorted((-e[i] for i in range(3) if i != k))
        return [q[i, k] for i in range(3)], [mp.sqrt(max(e[k], 0) / v) for v in rest]

    def matrix(entries, scale):
        return mpmath.matrix([[mpf((v * scale).numerator) / (v * scale).denominator for v in line] for line in entries])

    def adjugate(s):
        def minor(i, j):
            a, b = [k for k in range(3) if k != i], [k for k in range(3) if k != j]
            return (-1) ** (i + j) * (s[a[0]][b[0]] * s[a[1]][b[1]] - s[a[0]][b[1]] * s[a[1]][b[0]])

        return [[minor(i, j) for i in range(3)] for j in range(3)]

    def power_of_two(entries):
        """The scale that brings the largest entry to about 1."""
        largest = max(abs(v) for line in entries for v in line)
        exponent = largest.numerator.bit_length() - largest.denominator.bit_length()
        return Fraction(1, 2**exponent) if exponent >= 0 else Fraction(2**-exponent)

    def truth(row):
        hx, hy, x, y, z = [Fraction(v) for v in row]
        c = (x, y, z)
        s = [[(hx * hx, hy * hy, 0)[i] * (i == j) - c[i] * c[j] for j in range(3)] for i in range(3)]
        trace = s[0][0] + s[1][1] + s[2][2]
        adj = adjugate(s)
        # S has at most one negative eigenvalue; it has none if all its invariants are >= 0.
        if hx * hy * z == 0 and trace >= 0 and adj[0][0] + adj[1][1] + adj[2][2] >= 0:
            return [None] * 5
        mp.dps = FEWEST_DIGITS
        while mp.dps <= MOST_DIGITS:
            dual = by_dual(matrix(s, power_of_two(s)))
            if hx * hy * z != 0:
                other = by_quadric(matrix(adj, power_of_two(adj)))
            else:
                dual[1][1] = mpf(0)
                if adj[0][0] + adj[1][1] + adj[2][2] == 0:
                    dual[1][0] = mpf(0)
                other = dual
            tolerance = mpf(AGREEMENT)
            agree = all(abs(a - b) <= tolerance * abs(a) for a, b in zip(dual[1], other[1]))
            pairs = list(zip(axis_cells(dual[0]), axis_cells(other[0])))
            if agree and all(abs(p - q) <= tolerance for p, q in pairs):
                axis = axis_cells(dual[0])
                sign = 1 if sum(a * mpf(v) for a, v in zip(axis, row[2:])) > 0 else -1
                return [sign * a for a in axis] + dual[1]
            mp.dps *= 2
        raise ArithmeticError(f"both eigensystems disagree at {MOST_DIGITS} digits on {row}")

    return Golden(
        inputs=["half_x", "half_y", "center_x", "center_y", "center_z"],
        outputs=["axis_x", "axis_y", "axis_z", "tan_major", "tan_minor"],
        conditions=[],
        scenarios={f.__name__: f for f in (scene, facing, far, near_plane, needle, edge)},
        truth=truth,
    )


# --- sym3_eigen ------------------------------------------------------------------------------------------------------


def sym3_eigen():
    """Eigenvalues, ascending, and eigenvectors of a symmetric 3x3 matrix.

    Truth comes from mpmath's symmetric eigensolver (tridiagonal QL), at the least precision where a second run with
    twice the digits agrees and the exact rational invariants (trace, sum of minors, determinant) are met. Zeros are
    decided by those invariants and equal eigenvalues by the exact discriminant; vectors of equal ones are undefined.
    """
    per_scenario = 60

    def spectrum(rng, values):
        frame = rotation(rng)

        def entry(i, j):
            return sum(v * q[i] * q[j] for v, q in zip(values, frame))

        return [to_f32(entry(i, j)) for i, j in ((0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2))]

    def outer(v):
        return [v[0] * v[0], v[1] * v[1], v[2] * v[2], v[0] * v[1], v[0] * v[2], v[1] * v[2]]

    def sign(rng):
        return 1.0 if rng.random() < 0.5 else -1.0

    def scene(rng):
        """Covariances of splats: axes of 2^-10 to 1, up to 32:1."""
        rows = []
        for _ in range(per_scenario):
            longest = magnitude(rng, -10, 0)
            rows.append(spectrum(rng, [(longest * magnitude(rng, -5, 0)) ** 2 for _ in range(3)]))
        return rows

    def near_equal(rng):
        """Two or three eigenvalues apart by 2^-26 to 2^-2 of themselves."""
        rows = []
        for i in range(per_scenario):
            value = sign(rng) * magnitude(rng, -6, 6)
            near = [value * (1.0 + magnitude(rng, -26 + 24 * i // per_scenario, -25 + 24 * i // per_scenario)) for _ in range(2)]
            third = near[1] if i % 2 else uniform(rng, -100.0, 100.0)
            rows.append(spectrum(rng, [value, near[0], third]))
        return rows

    def graded(rng):
        """Eigenvalues over up to 40 binary orders, or entries graded by d_i d_j over as many."""
        rows = []
        for i in range(per_scenario):
            if i % 2:
                rows.append(spectrum(rng, [sign(rng) * magnitude(rng, -40, 0) for _ in range(3)]))
            else:
                d = [magnitude(rng, -20, 0) for _ in range(3)]
                pairs = ((0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2))
                rows.append([to_f32(d[i] * d[j] * uniform(rng, -1.0, 1.0)) for i, j in pairs])
        return rows

    def indefinite(rng):
        """All entries uniform, at scales of 2^-10 to 2^10."""
        rows = []
        for _ in range(per_scenario):
            scale = magnitude(rng, -10, 10)
            rows.append([to_f32(scale * uniform(rng, -1.0, 1.0)) for _ in range(6)])
        return rows

    def light_cone(rng):
        """V1 V1^T + V2 V2^T - C C^T of ellipses of radius 1, 1/4 to 256 away."""
        rows = []
        for _ in range(per_scenario):
            u, v, _ = rotation(rng)
            minor, d = uniform(rng, 0.2, 1.0), magnitude(rng, -2, 8)
            c = [d * x for x in rotation(rng)[2]]
            parts = zip(outer(u), outer([minor * x for x in v]), outer(c))
            rows.append([to_f32(a + b - e) for a, b, e in parts])
        return rows

    def edge(rng):
        """Zero, diagonal, singular, exactly equal, subnormal, huge."""
        rows = [[0.0] * 6, [1.0, 2.0, 3.0, 0.0, 0.0, 0.0], [3.0, -1.0, 2.0, 0.0, 0.0, -0.0], [2.0, 2.0, 2.0, 0.0, 0.0, 0.0]]
        rows += [[1.0, 1.0, 2.0, 0.0, 0.0, 0.0], [1.0, F32_MIN_NORMAL, F32_MIN_SUBNORMAL, 0.0, 0.0, 0.0], [F32_MAX, -F32_MAX, 1.0, 0.0, 0.0, 0.0]]
        rows += [[-2.0, -2.0, -2.0, 1.0, 1.0, 1.0], [2.0, 2.0, 2.0, -1.0, 0.0, -1.0], [0.0, 0.0, 0.0, 1.0, 1.0, 1.0], [0.0, 0.0, 0.0, 1.0, 0.0, 0.0]]

        def integers():
            return [float(int(uniform(rng, -8.0, 9.0))) for _ in range(3)]

        for _ in range(8):
            rows.append(outer(integers()))
            rows.append([a - b for a, b in zip(outer(integers()), outer(integers()))])
            multiple = float(int(uniform(rng, -8.0, 9.0)))
            rows.append([a + (multiple if k < 3 else 0.0) for k, a in enumerate(outer(integers()))])
        while len(rows) < per_scenario:
            exponent = (-140, 100, 0)[len(rows) % 3]
            row = [math.ldexp(uniform(rng, -1.0, 1.0), exponent) for _ in range(6)]
            if exponent == 0:
                row[int(6 * rng.random())] = (F32_MIN_SUBNORMAL, 1e-20, 1e10, math.ldexp(1.0, 63))[len(rows) // 3 % 4]
            rows.append(row)
        return [[to_f32(c) for c in row] for row in rows]

    def invariants(row):
        xx, yy, zz, xy, xz, yz = [Fraction(v) for v in row]
        minors = xx * yy - xy * xy + xx * zz - xz * xz + yy * zz - yz * yz
        return xx + yy + zz, minors, xx * (yy * zz - yz * yz) - xy * (xy * zz - yz * xz) + xz * (xy * yz - yy * xz)

    def rational(x):
        return mpf(x.numerator) / x.denominator

    def solve(row, digits_now):
        mp.dps = digits_now
        xx, yy, zz, xy, xz, yz = [mpf(v) for v in row]
        largest = max(abs(v) for v in row)
        exponent = math.frexp(largest)[1]
        a = mpmath.matrix([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]]) * mp.ldexp(1, -exponent)
        e, q = mpmath.eigsy(a)
        order = sorted(range(3), key=lambda k: e[k])
        return [mp.ldexp(e[k], exponent) for k in order], [[q[i, k] for i in range(3)] for k in order]

    def truth(row):
        trace, minors, det = invariants(row)
        if not any(row):
            return [mpf(0)] * 3 + [None] * 9
        # The discriminant of e^3 - trace e^2 + minors e - det.
        discriminant = (
            18 * trace * minors * det - 4 * trace**3 * det + trace**2 * minors**2 - 4 * minors**3 - 27 * det**2
        )
        digits_now = FEWEST_DIGITS
        while digits_now <= MOST_DIGITS:
            finer, finer_vectors = solve(row, 2 * digits_now)
            values, vectors = solve(row, digits_now)
            tolerance = mpf(AGREEMENT)
            by_size = sorted(range(3), key=lambda k: abs(values[k]))
            zeros = [] if det != 0 else by_size[: 1 if minors != 0 else 2]
            gaps = [values[1] - values[0], values[2] - values[1]]
            equal = []
            if discriminant == 0:
                equal = [0, 1] if abs(gaps[0]) < tolerance * abs(values[by_size[2]]) else []
                equal += [1, 2] if abs(gaps[1]) < tolerance * abs(values[by_size[2]]) else []
            agree = discriminant != 0 or bool(equal)
            for k in range(3):
                if k in zeros:
                    values[k] = mpf(0)
                elif abs(values[k] - finer[k]) > tolerance * abs(values[k]):
                    agree = False
            product, pairs = values[0] * values[1] * values[2], values[0] * values[1] + values[0] * values[2] + values[1] * values[2]
            norm = max(abs(v) for v in values)
            agree = agree and abs(product - rational(det)) <= tolerance * abs(product)
            agree = agree and abs(pairs - rational(minors)) <= tolerance * norm**2
            agree = agree and abs(sum(values) - rational(trace)) <= tolerance * norm
            cells = []
            for k in range(3):
                if k in equal:
                    cells += [None] * 3
                    continue
                one, other = axis_cells(vectors[k]), axis_cells(finer_vectors[k])
                agree = agree and all(abs(p - q) <= tolerance for p, q in zip(one, other))
                cells += one
            if agree:
                return values + cells
            digits_now *= 2
        raise ArithmeticError(f"no agreement at {MOST_DIGITS} digits on {row}")

    return Golden(
        inputs=["xx", "yy", "zz", "xy", "xz", "yz"],
        outputs=["e0", "e1", "e2"] + [f"q{k}_{c}" for k in range(3) for c in "xyz"],
        conditions=[],
        scenarios={f.__name__: f for f in (scene, near_equal, graded, indefinite, light_cone, edge)},
        truth=truth,
    )


FAMILIES = {
    "cone_axes": cone_axes,
    "ellipse_axes": ellipse_axes,
    "sym3_eigen": sym3_eigen,
}

# --- files -----------------------------------------------------------------------------------------------------------


def render(family):
    """The text of tests/golden/<family>.csv."""
    golden = FAMILIES[family]()
    lines = [
        f"# Written by tools/golden.py {family} (make golden) with mpmath; do not edit.",
        f"# Worked in {FEWEST_DIGITS} digits or more, two solvers agreeing to {AGREEMENT}; printed to "
        f"{PRINTED_DIGITS} significant digits.",
        ",".join(["scenario"] + golden.inputs + golden.outputs + golden.conditions),
    ]
    for scenario, draw in golden.scenarios.items():
        for row in draw(random.Random(f"{family}/{scenario}")):
            assert len(row) == len(golden.inputs) and all(to_f32(c) == c for c in row), row
            truth = golden.truth(row)
            assert len(truth) == len(golden.outputs) + len(golden.conditions), row
            lines.append(",".join([scenario] + [hex_float(c) for c in row] + [digits(x) for x in truth]))
    return "\n".join(lines) + "\n"


def first_difference(old, new):
    """Number and texts of the first line in which two files differ."""
    lines = itertools.zip_longest(old.splitlines(), new.splitlines(), fillvalue="(end of file)")
    return next((n, a, b) for n, (a, b) in enumerate(lines, 1) if a != b)


def main():
    parser = argparse.ArgumentParser(
        description=__doc__.split("\n")[0],
        epilog="families: " + ", ".join(FAMILIES),
    )
    parser.add_argument("family", nargs="*", help="which files to write (default: all)")
    parser.add_argument("--check", action="store_true", help="write nothing; fail if a file is not what this script writes")
    parser.add_argument(
        "--dir",
        type=pathlib.Path,
        default=pathlib.Path(__file__).resolve().parent.parent / "tests" / "golden",
        help="folder of the files (default: tests/golden of this checkout)",
    )
    args = parser.parse_args()
    unknown = [f for f in args.family if f not in FAMILIES]
    if unknown:
        parser.error(f"no family {unknown[0]!r}; there are: {', '.join(FAMILIES)}")

    differing = 0
    for family in args.family or FAMILIES:
        path = args.dir / f"{family}.csv"
        text = render(family)
        if not args.check:
            args.dir.mkdir(parents=True, exist_ok=True)
            path.write_text(text, encoding="ascii", newline="\n")
            print(f"{path}: {text.count(chr(10))} lines", file=sys.stderr)
            continue
        old = path.read_bytes().decode("ascii", "replace") if path.exists() else ""
        if old != text:
            differing += 1
            line, was, now = first_difference(old, text) if old else (1, "(no file)", text.split("\n")[0])
            print(f"{path}:{line}: differs\n  file   {was}\n  script {now}", file=sys.stderr)
    return 1 if differing else 0


if __name__ == "__main__":
    sys.exit(main())
