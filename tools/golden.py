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


# --- ltc_disk --------------------------------------------------------------------------------------------------------


class Clipped:
    """The irradiance of clipped elliptic cones, by quadrature over the area.

    The ellipse C + V1 x + V2 y, (x, y) in the unit disk and p.z > 0, gives |[C, V1, V2]|/pi times the integral of
    p.z/|p|^4: a positive integrand. The disk is turned so that p.z is constant along y, the integral over y is then
    elementary, and that over x = cos(angle) is done numerically on pieces that halve until they agree. No eigensystem and no contour is involved.
    """

    DIGITS = 50
    # The whole and the halves of a piece agree this well, relative to the result.
    AGREEMENT = mpf("1e-22")

    @classmethod
    def integral(cls, c, v1, v2):
        """From exact rational vectors, or from mpf vectors of DIGITS + 10 digits."""

        def cross(a, b):
            return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]

        volume = sum(p * q for p, q in zip(c, cross(v1, v2)))
        swing2 = v1[2] ** 2 + v2[2] ** 2
        if volume == 0 or (c[2] <= 0 and c[2] ** 2 >= swing2):
            return mpf(0)
        mp.dps = cls.DIGITS + 10

        def number(f):
            return mpf(f.numerator) / f.denominator if isinstance(f, Fraction) else f

        volume = number(volume)
        swing = mp.sqrt(number(swing2))
        c, v1, v2 = ([number(f) for f in v] for v in (c, v1, v2))
        cz = c[2]
        cos, sin = (v1[2] / swing, v2[2] / swing) if swing else (mpf(1), mpf(0))
        u1 = [cos * p + sin * q for p, q in zip(v1, v2)]
        u2 = [cos * q - sin * p for p, q in zip(v1, v2)]
        dot = lambda a, b: sum(p * q for p, q in zip(a, b))
        end = mp.acos(-cz / swing) if abs(cz) < swing else mp.pi
        cc, c1, c2, d11, d12, d22 = dot(c, c), dot(c, u1), dot(c, u2), dot(u1, u1), dot(u1, u2), dot(u2, u2)

        def line(angle):
            x, half = mp.cos(angle), mp.sin(angle)
            alpha, beta, gamma = cc + 2 * x * c1 + x * x * d11, c2 + x * d12, d22
            delta = alpha * gamma - beta * beta
            root = mp.sqrt(delta)
            low, high = beta - gamma * half, beta + gamma * half

            def part(s):
                return gamma * s / (2 * delta * (s * s + delta)) + gamma / (2 * delta * root) * mp.atan(s / root)

            return (cz + swing * x) * half * (part(high) - part(low))

        # delta is a quadratic in x; its minimum is where the integrand may peak.
        curvature = d11 * d22 - d12 * d12
        lowest = -(c1 * d22 - c2 * d12) / curvature
        ends = sorted({mpf(0), end} | ({mp.acos(lowest)} if abs(lowest) < 1 and mp.acos(lowest) < end else set()))

        def rule(low, high):
            half, mid = (high - low) / 2, (high + low) / 2
            return half * sum(w * line(mid + half * x) for x, w in cls.rule(32))

        # Bisection until whole and halves agree; their difference overstates the halves' error by far.
        pieces = [(low, high, rule(low, high)) for low, high in zip(ends, ends[1:])]
        total = mpf(0)
        for _ in range(4000):
            if not pieces:
                return abs(volume) / mp.pi * total
            low, high, whole = pieces.pop()
            mid = (low + high) / 2
            halves = rule(low, mid), rule(mid, high)
            if abs(whole - sum(halves)) <= cls.AGREEMENT * abs(total + whole):
                total += sum(halves)
            else:
                pieces += [(low, mid, halves[0]), (mid, high, halves[1])]
        raise ArithmeticError("quadrature does not settle")

    RULES = {}

    @classmethod
    def rule(cls, n):
        """Gauss-Legendre nodes and weights in -1..1."""
        if n not in cls.RULES:
            mp.dps = cls.DIGITS + 10
            nodes = []
            for i in range(n):
                # Newton by the recurrence from the asymptotic root.
                x = mp.cos(mp.pi * (i + mpf(3) / 4) / (n + mpf(1) / 2))
                for _ in range(8):
                    before, value = mpf(1), x
                    for k in range(2, n + 1):
                        before, value = value, ((2 * k - 1) * x * value - (k - 1) * before) / k
                    slope = n * (x * value - before) / (x * x - 1)
                    x -= value / slope
                nodes.append((x, 2 / ((1 - x * x) * slope * slope)))
            cls.RULES[n] = nodes
        return cls.RULES[n]


def lobe_matrix(rng, sharpest):
    """An inverse LTC matrix as fits produce them, column-major: stretched along x and y, sheared in the xz plane."""
    stretch = 1.0 / uniform(rng, sharpest, 1.0)
    flat = uniform(rng, 0.5, 1.0)
    return [stretch, 0.0, uniform(rng, -0.7, 0.7), 0.0, stretch * flat, 0.0, uniform(rng, -0.7, 0.7) * stretch, 0.0, 1.0]


def apply(m, v):
    return [sum(m[3 * k + i] * v[k] for k in range(3)) for i in range(3)]


IDENTITY = [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0]


MINV_COLUMNS = [f"minv_{column}{row}" for column in range(3) for row in range(3)]


def xyz_columns(*names):
    return [f"{name}_{c}" for name in names for c in "xyz"]


def ltc_disk():
    """Irradiance of the part of an ellipse above the horizon, after Minv: see Clipped."""
    per_scenario = 22

    def row(minv, c, v1, v2):
        return [to_f32(x) for part in (minv, c, v1, v2) for x in part]

    def scaled(v, factor):
        return [factor * x for x in v]

    def placed(rng, foot, height, aspect, sharpest):
        """An ellipse of major length 1 in a random frame, its centre at (foot, height) in that frame."""
        u, v, n = rotation(rng)
        cos, sin = circle_point(rng)
        c = [foot * (cos * p + sin * q) + height * r for p, q, r in zip(u, v, n)]
        a, b = u, scaled(v, 1.0 / aspect)
        cos, sin = circle_point(rng)
        minv = lobe_matrix(rng, sharpest) if rng.random() < 0.5 else IDENTITY
        return row(minv, c, [cos * p + sin * q for p, q in zip(a, b)], [cos * q - sin * p for p, q in zip(a, b)])

    def ggx(rng):
        rows = []
        for _ in range(2 * per_scenario):
            u, v, _ = rotation(rng)
            r = magnitude(rng, -3, 1)
            c = [uniform(rng, -4.0, 4.0), uniform(rng, -4.0, 4.0), uniform(rng, 0.2, 4.0)]
            rows.append(row(lobe_matrix(rng, 0.05), c, scaled(u, r), scaled(v, r)))
        return rows

    def grazing(rng):
        rows = []
        for _ in range(per_scenario):
            u, v, _ = rotation(rng)
            r = magnitude(rng, -3, 1)
            c = [uniform(rng, -8.0, 8.0), uniform(rng, -2.0, 2.0), uniform(rng, 0.0, 2.0)]
            rows.append(row(lobe_matrix(rng, 0.003), c, scaled(u, r), scaled(v, r)))
        return rows

    def facing(rng):
        """Exactly facing, by small integers; then up to rounding."""
        rows = []
        x, y, z = [2.0, -3.0, 6.0], [6.0, -2.0, -3.0], [3.0, 6.0, 2.0]
        for i in range(per_scenario):
            r, d = to_f32(magnitude(rng, -3, 2)), to_f32(magnitude(rng, -1, 4))
            if i % 3 == 0:
                rows.append(row(IDENTITY, [0.0, 0.0, d], [r, 0.0, 0.0], [0.0, r, 0.0]))
            elif i % 3 == 1:
                k, l = 1.0 + int(8.0 * rng.random()), 1.0 + int(8.0 * rng.random())
                rows.append(row(IDENTITY, scaled(z, k), scaled(x, l), scaled(y, l)))
            else:
                u, v, n = rotation(rng)
                rows.append(row(IDENTITY, scaled(n, d), scaled(u, r), scaled(v, r)))
        return rows

    def far(rng):
        return [placed(rng, magnitude(rng, 4, 17), magnitude(rng, 2, 16), 1.0, 0.1) for _ in range(per_scenario)]

    def near_plane(rng):
        return [placed(rng, uniform(rng, 0.0, 2.0), magnitude(rng, -20, -3), 1.0, 0.5) for _ in range(per_scenario)]

    def needle(rng):
        return [
            placed(rng, magnitude(rng, 0, 4), magnitude(rng, -1, 4), magnitude(rng, 3, 13), 0.5)
            for _ in range(per_scenario)
        ]

    def horizon(rng):
        rows = []
        for _ in range(2 * per_scenario):
            u, v, _ = rotation(rng)
            v = scaled(v, uniform(rng, 0.1, 1.0))
            swing = math.sqrt(u[2] * u[2] + v[2] * v[2])
            cos, sin = circle_point(rng)
            d = magnitude(rng, -2, 5)
            rows.append(row(IDENTITY, [d * cos, d * sin, uniform(rng, -1.0, 1.0) * swing], u, v))
        return rows

    def inside_out(rng):
        return [placed(rng, rng.random(), magnitude(rng, -7, 0), 1.0, 0.3) for _ in range(per_scenario)]

    def edge(rng):
        """Zero, parallel, edge-on, singular, below, touching; then scales far from 1."""
        x, y, z, o = [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [0.0, 0.0, 0.0]
        up = [0.5, 0.25, 2.0]
        rows = [row(IDENTITY, up, o, o), row(IDENTITY, up, x, o), row(IDENTITY, up, o, y), row(IDENTITY, o, x, y)]
        rows += [row(IDENTITY, up, x, scaled(x, k)) for k in (1.0, -2.0, 3.0)]
        rows += [row(IDENTITY, scaled(x, k), x, y) for k in (0.5, 1.0, 4.0)]
        rows += [row(IDENTITY, scaled(x, k), x, z) for k in (0.5, 1.0, 4.0)]
        rows += [row(IDENTITY, [0.0, 0.0, -1.0], x, y), row(IDENTITY, [4.0, 0.0, -1.0], y, z)]
        rows += [row([1.0, 2.0, 3.0, 2.0, 4.0, 6.0, 0.0, 0.0, 1.0], up, x, y), row([0.0] * 9, up, x, y)]
        rows += [row(IDENTITY, [4.0, 0.0, 1.0], y, z), row(IDENTITY, [4.0, 0.0, 0.0], y, z)]
        rows += [row(IDENTITY, [0.0, 0.0, 1.0], x, y), row(IDENTITY, [0.0, 0.0, -1.0], x, scaled(z, 2.0))]
        rows += [row(IDENTITY, [4.0, 0.0, f32_step(1.0, -1)], y, z), row(IDENTITY, [4.0, 0.0, f32_step(-1.0, -1)], y, z)]
        for exponent in (-40, -20, 20, 40):
            s = math.ldexp(1.0, exponent)
            rows.append(row(IDENTITY, scaled([2.0, 1.0, 0.5], s), scaled([0.5, 0.5, 0.25], s), scaled([0.0, 1.0, 2.0], s)))
            rows.append(row([s, 0.0, 0.0, 0.0, s, 0.0, 0.0, 0.0, s], [2.0, 1.0, 0.5], [0.5, 0.5, 0.25], [0.0, 1.0, 2.0]))
        return rows

    def truth(cells):
        cells = [Fraction(c) for c in cells]
        image = [apply(cells[:9], cells[9 + 3 * k : 12 + 3 * k]) for k in range(3)]
        return [Clipped.integral(*image)]

    return Golden(
        inputs=MINV_COLUMNS + xyz_columns("center", "v1", "v2"),
        outputs=["irradiance"],
        conditions=[],
        scenarios={f.__name__: f for f in (ggx, grazing, facing, far, near_plane, needle, horizon, inside_out, edge)},
        truth=truth,
    )


# --- horizon_sphere --------------------------------------------------------------------------------------------------


def horizon_sphere():
    """Irradiance, over that of the full hemisphere, of a sphere whose direction has the cosine c with the normal and
    whose half angle has the squared sine s.

    Truth is the integral itself, by tanh-sinh quadrature over the polar angle about the sphere's direction, in two
    precisions that agree; of the azimuths only the visible arc's end is known beforehand. No closed form of the
    clipped sphere is involved. Whether the horizon cuts, hides or spares the sphere is decided in exact rational
    arithmetic; a sphere that is spared has c s.
    """
    per_scenario = 50

    def log_uniform(rng, low_exponent, high_exponent):
        return magnitude(rng, low_exponent, high_exponent)

    def sign(rng):
        return 1.0 if rng.random() < 0.5 else -1.0

    def rounded(pairs):
        return [[to_f32(max(-1.0, min(1.0, c))), to_f32(max(0.0, min(1.0, s)))] for c, s in pairs]

    def scene(rng):
        """Spheres 1 to 128 radii away in any direction."""
        sines = [log_uniform(rng, -7, 0) for _ in range(per_scenario)]
        return rounded([(uniform(rng, -1.0, 1.0), sine * sine) for sine in sines])

    def grazing(rng):
        """The centre within 2^-27..2^-7 of the horizon."""
        return rounded([(sign(rng) * log_uniform(rng, -27, -7), log_uniform(rng, -13, 0)) for _ in range(per_scenario)])

    def horizon(rng):
        """The rim within 2^-24..2^-3 of touching the horizon, and the f32 neighbours of touching it exactly."""
        pairs = []
        for _ in range(per_scenario - 12):
            s = to_f32(log_uniform(rng, -20, 0))
            pairs.append((sign(rng) * math.sqrt(s) * (1.0 + sign(rng) * log_uniform(rng, -24, -3)), s))
        for i in range(12):
            c = math.ldexp(1.0 + math.floor(uniform(rng, 0.0, 2048.0)) / 2048.0, -1 - i)
            pairs.append(((1.0, -1.0)[i % 2] * c, f32_step(to_f32(c * c), (1, -1, 2, 0)[i % 4])))
        return rounded(pairs)

    def small(rng):
        """Squared sines 2^-40..2^-13, the centre within two half angles of the horizon or anywhere."""
        pairs = []
        for i in range(per_scenario):
            s = log_uniform(rng, -40, -13)
            pairs.append((uniform(rng, -1.0, 1.0) * (2.0 * math.sqrt(s) if i % 2 else 1.0), s))
        return rounded(pairs)

    def near_full(rng):
        """1 - s of 2^-24..2^-3; cosines anywhere, and as close to +-1."""
        pairs = []
        for i in range(per_scenario):
            c = uniform(rng, -1.0, 1.0) if i % 2 else sign(rng) * (1.0 - log_uniform(rng, -24, -1))
            pairs.append((c, 1.0 - log_uniform(rng, -24, -3)))
        return rounded(pairs)

    def edge(rng):
        """Both ends and their neighbours, the horizon through the centre, subnormals; and a full sphere at any angle."""
        below_one, tiny = f32_step(1.0, -1), F32_MIN_SUBNORMAL
        pairs = list(itertools.product((-1.0, -0.0, 0.0, 0.5, 1.0), (0.0, tiny, 0.25, below_one, 1.0)))
        pairs += itertools.product((below_one, -below_one, tiny, -tiny), (below_one, 1.0))
        pairs += [(tiny, tiny), (-tiny, tiny), (F32_MIN_NORMAL, F32_MIN_NORMAL), (1e-20, 1e-30), (-1e-20, 1e-30)]
        pairs += [(-0.5, f32_step(0.25, 1)), (0.5, f32_step(0.25, 1)), (-0.5, f32_step(0.25, -1))]
        while len(pairs) < per_scenario:
            pairs.append((uniform(rng, -1.0, 1.0), 1.0))
        return rounded(pairs)

    def integral(c, s):
        """(1/pi) times the integral of the cosine over the sphere's visible directions, at the precision set."""
        c, s = mpf(c), mpf(s)
        q = mp.sqrt((1 - c) * (1 + c))
        sigma = mp.atan2(mp.sqrt(s), mp.sqrt(1 - s))
        kink = mp.atan2(abs(c), q)

        def whole(alpha):
            return 2 * mp.pi * c * mp.cos(alpha) * mp.sin(alpha)

        def cut(alpha):
            across, along = q * mp.sin(alpha), c * mp.cos(alpha)
            # (across - along)(across + along), by the angles' sum and difference: both factors vanish at the kink.
            other = mp.sqrt(max(0, mp.sin(alpha - kink) * mp.sin(alpha + kink)))
            azimuth = mp.atan2(other, -along)
            return 2 * (along * azimuth + other) * mp.sin(alpha)

        # Beyond the kink the azimuth settles over some multiples of it.
        points = [kink]
        while 0 < 8 * points[-1] < sigma:
            points.append((4 if len(points) < 3 else 10**6) * points[-1])
        points = [x for x in points if x < sigma]
        # mpmath's quadrature stops at an absolute error: make the integral about 1.
        size = cut((kink + sigma) / 2) * (sigma - kink)
        total = size * mp.quad(lambda alpha: cut(alpha) / size, points + [(points[-1] + sigma) / 2, sigma])
        if c > 0:
            total += mp.quad(whole, [0, kink])
        return total / mp.pi

    def truth(row):
        c, s = (Fraction(x) for x in row)
        if s <= c * c:
            value = c * s if c > 0 else Fraction(0)
            mp.dps = 50
            return [mpf(value.numerator) / value.denominator]
        mp.dps = 40
        first = integral(*row)
        mp.dps = 60
        second = integral(*row)
        if not abs(first - second) <= mpf("1e-27") * abs(second):
            raise ArithmeticError(f"quadrature: {first} and {second} on {row}")
        return [second]

    return Golden(
        inputs=["cos_theta", "sin2_half_angle"],
        outputs=["irradiance"],
        conditions=[],
        scenarios={f.__name__: f for f in (scene, grazing, horizon, small, near_full, edge)},
        truth=truth,
    )


def tangent_disk(c, r2):
    """The disk that covers the sphere of centre c and squared radius r2 < |c|^2, as mpf vectors."""
    mp.dps = Clipped.DIGITS + 10
    c = [mpf(x.numerator) / x.denominator if isinstance(x, Fraction) else x for x in c]
    r2 = mpf(r2.numerator) / r2.denominator if isinstance(r2, Fraction) else r2
    d2 = sum(x * x for x in c)
    n = [x / mp.sqrt(d2) for x in c]
    k = min(range(3), key=lambda i: abs(n[i]))
    u = [(1 if i == k else 0) - n[k] * n[i] for i in range(3)]
    length = mp.sqrt(sum(x * x for x in u))
    u = [x / length for x in u]
    v = [n[1] * u[2] - n[2] * u[1], n[2] * u[0] - n[0] * u[2], n[0] * u[1] - n[1] * u[0]]
    r = mp.sqrt(r2 * (1 - r2 / d2))
    return [x * (1 - r2 / d2) for x in c], [x * r for x in u], [x * r for x in v]


def ltc_sphere():
    """Irradiance of the part of a sphere above the horizon, after Minv: the tangent circle's disk, see Clipped."""
    per_scenario = 24

    def row(minv, c, r):
        return [to_f32(x) for part in (minv, c, [r]) for x in part]

    def upper(direction, length):
        return [length * direction[0], length * direction[1], length * abs(direction[2])]

    def scene(matrix, off):
        def draw(rng):
            rows = []
            for _ in range(per_scenario):
                r = magnitude(rng, -4, 1)
                rows.append(row(matrix(rng), upper(rotation(rng)[0], r * (1.0 + off(rng))), r))
            return rows

        return draw

    ggx = scene(lambda rng: lobe_matrix(rng, 0.05), lambda rng: magnitude(rng, -4, 5))
    diffuse = scene(lambda rng: IDENTITY, lambda rng: magnitude(rng, -4, 5))
    grazing = scene(lambda rng: lobe_matrix(rng, 0.003), lambda rng: magnitude(rng, -2, 4))
    far = scene(lambda rng: lobe_matrix(rng, 0.1), lambda rng: magnitude(rng, 4, 17))
    near_surface = scene(lambda rng: lobe_matrix(rng, 0.1), lambda rng: magnitude(rng, -17, -3))

    def horizon(rng):
        rows = []
        for _ in range(per_scenario):
            d, height = 1.01 + magnitude(rng, -3, 5), uniform(rng, -1.0, 1.0)
            along = math.sqrt(d * d - height * height)
            cos, sin = circle_point(rng)
            minv = lobe_matrix(rng, 0.2) if rng.random() < 0.5 else IDENTITY
            rows.append(row(minv, [along * cos, along * sin, height], 1.0))
        return rows

    def edge(rng):
        rows = [row(IDENTITY, [0.5, 0.25, 0.125], 1.0), row(IDENTITY, [0.0] * 3, 1.0), row(IDENTITY, [0.0] * 3, 0.0)]
        rows += [row(IDENTITY, [2.0, 3.0, 6.0], 7.0), row(IDENTITY, [2.0, 3.0, 6.0], 0.0)]
        rows += [row(IDENTITY, [4.0, 0.0, z], 1.0) for z in (1.0, -1.0, 0.0, -2.0)]
        rows += [row([1.0, 2.0, 3.0, 2.0, 4.0, 6.0, 0.0, 0.0, 1.0], [2.0, 3.0, 6.0], 1.0), row([0.0] * 9, [2.0, 3.0, 6.0], 1.0)]
        for exponent in (-40, -20, 20, 40):
            s = math.ldexp(1.0, exponent)
            rows.append(row(IDENTITY, [2.0 * s, s, 0.5 * s], s))
            rows.append(row([s, 0.0, 0.0, 0.0, s, 0.0, 0.0, 0.0, s], [2.0, 1.0, 0.5], 1.0))
        while len(rows) < per_scenario:
            rows.append(row(lobe_matrix(rng, 0.01), upper(rotation(rng)[0], 8.0), 1.0))
        return rows

    def truth(cells):
        cells = [Fraction(c) for c in cells]
        minv, c, r = cells[:9], cells[9:12], cells[12]
        if r == 0:
            return [mpf(0)]
        if sum(x * x for x in c) <= r * r:
            return [mpf(1)]
        # Exactly dark: the image's lowest point is above none of the horizon.
        up = [minv[2], minv[5], minv[8]]
        height = sum(p * q for p, q in zip(up, c))
        if height <= 0 and height**2 >= r * r * sum(p * p for p in up):
            return [mpf(0)]
        m = [[Fraction(minv[3 * k + i]) for k in range(3)] for i in range(3)]
        det = sum(
            m[0][k] * (m[1][(k + 1) % 3] * m[2][(k + 2) % 3] - m[1][(k + 2) % 3] * m[2][(k + 1) % 3]) for k in range(3)
        )
        if det == 0:
            return [mpf(0)]
        disk = tangent_disk(c, r * r)
        minv = [mpf(x.numerator) / x.denominator for x in minv]
        return [Clipped.integral(*(apply(minv, v) for v in disk))]

    return Golden(
        inputs=MINV_COLUMNS + xyz_columns("center") + ["radius"],
        outputs=["irradiance"],
        conditions=[],
        scenarios={
            "ggx": ggx,
            "diffuse": diffuse,
            "grazing": grazing,
            "far": far,
            "near_surface": near_surface,
            "horizon": horizon,
            "edge": edge,
        },
        truth=truth,
    )


def ltc_ellipsoid():
    """Irradiance of the part of an ellipsoid above the horizon, after Minv: the unit sphere's tangent disk mapped by R D,
    see Clipped."""
    per_scenario = 24

    def row(minv, c, q, r):
        return [to_f32(x) for part in (minv, c, q, r) for x in part]

    def quaternion(rng):
        while True:
            q = [uniform(rng, -1.0, 1.0) for _ in range(4)]
            if 1e-2 < sum(x * x for x in q) <= 1.0:
                return q

    def matrix(q):
        n = sum(x * x for x in q)
        x, y, z, w = q
        columns = (
            (n - 2 * (y * y + z * z), 2 * (x * y + z * w), 2 * (x * z - y * w)),
            (2 * (x * y - z * w), n - 2 * (x * x + z * z), 2 * (y * z + x * w)),
            (2 * (x * z + y * w), 2 * (y * z - x * w), n - 2 * (x * x + y * y)),
        )
        return [c / n for column in columns for c in column]

    def scene(minv, radii, off):
        def draw(rng):
            rows = []
            for _ in range(per_scenario):
                q, r, d = quaternion(rng), radii(rng), rotation(rng)[0]
                c = apply(matrix(q), [(1.0 + off(rng)) * p * s for p, s in zip(d, r)])
                c = [-x for x in c] if c[2] < 0.0 else c
                rows.append(row(minv(rng), c, q, r))
            return rows

        return draw

    def round_radii(rng):
        return [uniform(rng, 0.25, 1.0) for _ in range(3)]

    ggx = scene(lambda rng: lobe_matrix(rng, 0.05), round_radii, lambda rng: magnitude(rng, -4, 4))
    flat = scene(
        lambda rng: lobe_matrix(rng, 0.3), lambda rng: [magnitude(rng, -10, 0) for _ in range(3)], lambda rng: magnitude(rng, -3, 4)
    )
    far = scene(lambda rng: lobe_matrix(rng, 0.3), round_radii, lambda rng: magnitude(rng, 4, 17))
    near_surface = scene(lambda rng: IDENTITY, round_radii, lambda rng: magnitude(rng, -17, -3))

    def edge(rng):
        q = quaternion(rng)
        rows = [row(IDENTITY, [0.1, 0.05, 0.0], q, [1.0, 0.5, 0.25]), row(IDENTITY, [0.0] * 3, q, [1.0, 1.0, 1.0])]
        rows += [row(IDENTITY, [1.0, 1.0, 1.0], q, [1.0, 0.0, 0.0]), row(IDENTITY, [0.0, 0.0, -4.0], q, [1.0, 0.5, 0.25])]
        rows += [row([1.0, 2.0, 3.0, 2.0, 4.0, 6.0, 0.0, 0.0, 1.0], [2.0, 3.0, 6.0], q, [1.0, 2.0, 0.5])]
        rows += [row(IDENTITY, [2.0, 3.0, 6.0], [0.0] * 4, [1.0, 2.0, 4.0])]
        rows += [row(IDENTITY, [2.0, 3.0, 6.0], [s, 0.0, 0.0, s], [1.0, 2.0, 4.0]) for s in (1.0, -3.0, 1e6, 1e-6)]
        for exponent in (-30, -20, 20, 30):
            s = math.ldexp(1.0, exponent)
            rows.append(row(IDENTITY, [2.0 * s, s, 0.5 * s], q, [s, 0.5 * s, 0.25 * s]))
        while len(rows) < per_scenario:
            rows.append(row(lobe_matrix(rng, 0.01), [4.0, 2.0, 8.0], quaternion(rng), round_radii(rng)))
        return rows

    def truth(cells):
        cells = [Fraction(c) for c in cells]
        minv, c, q, r = cells[:9], cells[9:12], cells[12:16], cells[16:]
        columns = matrix(q) if any(q) else [Fraction(int(i % 4 == 0)) for i in range(9)]
        if sum(x == 0 for x in r) > 1:
            return [mpf(0)]
        b = [sum(columns[3 * k + i] * c[i] for i in range(3)) / r[k] for k in range(3)]
        if sum(x * x for x in b) <= 1:
            return [mpf(1)]
        m = [[minv[3 * k + i] for k in range(3)] for i in range(3)]
        det = sum(
            m[0][k] * (m[1][(k + 1) % 3] * m[2][(k + 2) % 3] - m[1][(k + 2) % 3] * m[2][(k + 1) % 3]) for k in range(3)
        )
        up = [sum(m[2][i] * columns[3 * k + i] for i in range(3)) * r[k] for k in range(3)]
        height = sum(p * s for p, s in zip(up, b))
        if det == 0 or (height <= 0 and height**2 >= sum(p * p for p in up)):
            return [mpf(0)]
        disk = tangent_disk(b, Fraction(1))
        real = lambda f: mpf(f.numerator) / f.denominator
        through = [real(x) for x in columns]
        outer = [real(x) for x in minv]
        return [Clipped.integral(*(apply(outer, apply(through, [real(s) * p for s, p in zip(r, v)])) for v in disk))]

    return Golden(
        inputs=MINV_COLUMNS + xyz_columns("center") + [f"rotation_{c}" for c in "xyzw"] + xyz_columns("radius"),
        outputs=["irradiance"],
        conditions=[],
        scenarios={"ggx": ggx, "flat": flat, "far": far, "near_surface": near_surface, "edge": edge},
        truth=truth,
    )


FAMILIES = {
    "ellipse_axes": ellipse_axes,
    "horizon_sphere": horizon_sphere,
    "ltc_disk": ltc_disk,
    "ltc_ellipsoid": ltc_ellipsoid,
    "ltc_sphere": ltc_sphere,
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
