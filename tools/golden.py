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
    method: str = f"Worked in {FEWEST_DIGITS} digits or more, two solvers agreeing to {AGREEMENT}"


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


# --- edge_integral ---------------------------------------------------------------------------------------------------


def edge_integral():
    """theta/(2 pi) times the unit normal, for two vectors of any length.

    Truth is the line integral of p x dp / (2 pi |p|^2) along the segment between the normalised vectors. Along it
    1/|p|^2 is the reciprocal of a quadratic, integrated by the half angle theta = 2 asin(|a - b|/2): no atan, no dot
    product. Every fifth row is integrated by Gauss-Legendre quadrature as well. Parallel vectors have the edge 0; for
    exactly opposite ones the cells are empty.

    Condition: sin = |a x b| / (|a||b|), which divides the error of the direction.
    """
    per_scenario = 60

    def unit(rng):
        return rotation(rng)[0]

    def pair(a, b):
        return [to_f32(c) for c in list(a) + list(b)]

    def arc(rng, cos_theta, sin_theta):
        u, v, _ = rotation(rng)
        return pair(u, [cos_theta * p + sin_theta * q for p, q in zip(u, v)])

    def scene(rng):
        """Corners of rectangles of 1/4 to 4, 1/4 to 8 away."""
        rows = []
        for _ in range(per_scenario):
            u, v, _ = rotation(rng)
            centre = [magnitude(rng, -2, 3) * c for c in unit(rng)]
            x, y = magnitude(rng, -3, 1), magnitude(rng, -3, 1)
            corners = [[c + s * x * p + y * q for c, p, q in zip(centre, u, v)] for s in (-1.0, 1.0)]
            rows.append(pair(*([c / math.sqrt(sum(d * d for d in corner)) for c in corner] for corner in corners)))
        return rows

    def small_angles(rng, sign):
        rows = []
        for i in range(per_scenario):
            s = min(magnitude(rng, -24 + i * 24 // per_scenario, -23 + i * 24 // per_scenario), 1.0)
            rows.append(arc(rng, sign * math.sqrt(1.0 - s * s), s))
        return rows

    def near(rng):
        """Sines 2^-24 to 1, nearly parallel."""
        return small_angles(rng, 1.0)

    def antipodal(rng):
        """Sines 2^-24 to 1, nearly opposite."""
        return small_angles(rng, -1.0)

    def right_angle(rng):
        """Cosines +-2^-26 to +-1/8, and 0."""
        rows = []
        for i in range(per_scenario):
            c = magnitude(rng, -26 + i * 24 // per_scenario, -25 + i * 24 // per_scenario) * (1 if i % 2 else -1)
            rows.append(arc(rng, c if i else 0.0, math.sqrt(1.0 - c * c)))
        return rows

    def edge(rng):
        """Equal, opposite, zero, along the axes, and off by f32 steps."""
        zero, x, y, z = [0.0] * 3, [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]
        rows = [pair(u, v) for u in (zero, x, y, z) for v in (zero, x, y, z)]
        rows += [pair(u, [-c for c in v]) for u in (x, y, z) for v in (x, y, z)]
        rows += [pair(x, [-1.0, F32_MIN_SUBNORMAL, 0.0]), pair(x, [1.0, 0.0, F32_MIN_SUBNORMAL])]
        rows += [pair(x, [-1.0, F32_MIN_NORMAL, 0.0]), pair(y, [F32_MIN_NORMAL, 1.0, -F32_MIN_NORMAL])]
        while len(rows) < per_scenario:
            a = [to_f32(c) for c in unit(rng)]
            b = list(a)
            k = len(rows) % 3
            b[k] = f32_step(b[k], (1, -1, 3, -2)[len(rows) % 4])
            sign = 1 if len(rows) % 2 else -1
            length = (1.0, 1.0 + 2.0**-20, 1.0 - 2.0**-21, 2.0)[len(rows) // 8 % 4]
            rows.append(pair(a, [sign * length * c for c in b]))
        return rows

    def truth(row):
        mp.dps = FEWEST_DIGITS
        a, b = [[mpf(c) for c in row[3 * j : 3 * j + 3]] for j in range(2)]

        def cross(p, q):
            return [p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]]

        def dot(p, q):
            return sum(s * t for s, t in zip(p, q))

        if dot(a, a) == 0 or dot(b, b) == 0:
            return [mpf(0)] * 3 + [None]
        n = cross(a, b)
        if dot(n, n) == 0:
            return [mpf(0) if dot(a, b) > 0 else None] * 3 + [mpf(0)]
        # Subnormal steps from a parallel or an opposite vector need digits for 2^-149 squared.
        mp.dps = 3 * FEWEST_DIGITS
        a, b = [[c / mp.sqrt(dot(v, v)) for c in v] for v in (a, b)]
        chord = [q - p for p, q in zip(a, b)]
        theta = 2 * mp.asin(mp.sqrt(dot(chord, chord)) / 2)
        n = cross(a, chord)
        sine = mp.sqrt(dot(n, n))
        truth.calls += 1
        if truth.calls % 5 == 0 and sine > mpf("1e-4"):
            mp.dps = 30

            def density(t):
                p = [s + t * c for s, c in zip(a, chord)]
                return sine / dot(p, p)

            # Panels that shrink towards the chord's middle, where the integrand peaks for opposite vectors.
            stops = [mpf(0)] + [mpf(1) / 2 - mpf(2) ** -k for k in range(2, 16)] + [mpf(1) / 2]
            area = 2 * mp.quad(density, stops)
            assert abs(area - theta) < mpf("1e-20") * theta, (row, area, theta)
            mp.dps = 3 * FEWEST_DIGITS
        return [theta / (2 * mp.pi) * c / sine for c in n] + [sine]

    truth.calls = 0

    return Golden(
        inputs=[f"{v}_{c}" for v in "ab" for c in "xyz"],
        outputs=[f"edge_{c}" for c in "xyz"],
        conditions=["sin"],
        scenarios={f.__name__: f for f in (scene, near, antipodal, right_angle, edge)},
        truth=truth,
        method=f"Worked in {3 * FEWEST_DIGITS} digits by the half angle, spot checks by quadrature",
    )


# --- ltc_polygon -----------------------------------------------------------------------------------------------------


def ltc_polygon():
    """Irradiance of a quad under Minv, clipped to z > 0: the absolute value of the integral of (x dy - y dx)/(2 pi) along
    the contour of directions.

    Corners and clipping are worked in exact rational arithmetic. Along an edge q0 + t e the integrand is N.z/|q|^2,
    N = q0 x e; truth is the difference of its antiderivative N.z/|N| atan((|e|^2 t + q0.e)/|N|), and every sixth row is
    integrated by Gauss-Legendre quadrature as well. The horizon adds differences of azimuths. Cells are empty where the
    contour or the chord that closes it passes through the origin, exactly; edges in one plane with it give 0.
    """
    per_scenario = 50

    def any_minv(rng, low=0.1):
        """A plausible inverse LTC matrix: stretch, and shear in the xz plane."""
        m11 = 1.0 / max(magnitude(rng, -4, 1), low)
        m22 = m11 * uniform(rng, 0.5, 1.0)
        return [m11, 0.0, uniform(rng, -1.0, 1.0), 0.0, m22, 0.0, m11 * uniform(rng, -1.0, 1.0), 0.0, 1.0]

    def rectangle(centre, x, y):
        return [[c + s * p + t * q for c, p, q in zip(centre, x, y)] for s, t in ((-1, -1), (1, -1), (1, 1), (-1, 1))]

    def times(factor, v):
        return [factor * c for c in v]

    def row_of(minv, corners):
        return [to_f32(c) for c in minv + [c for corner in corners for c in corner]]

    def upper(rng, distance):
        v = rotation(rng)[0]
        return [distance * v[0], distance * v[1], distance * abs(v[2])]

    def any_rectangle(rng, centre, low, high):
        u, v, _ = rotation(rng)
        return rectangle(centre, times(magnitude(rng, low, high), u), times(magnitude(rng, low, high), v))

    def many(draw):
        """A scenario of `per_scenario` rows that `draw` makes one by one."""

        def scenario(rng):
            return [draw(rng, i) for i in range(per_scenario)]

        return scenario

    def ggx(rng, _):
        return row_of(any_minv(rng), any_rectangle(rng, upper(rng, magnitude(rng, -1, 3)), -3, 1))

    def grazing(rng, _):
        centre = [-magnitude(rng, -1, 4), uniform(rng, -0.5, 0.5), magnitude(rng, -9, -2)]
        return row_of(any_minv(rng), any_rectangle(rng, centre, -3, 1))

    def facing(rng, _):
        c, s = circle_point(rng)
        x, y = times(magnitude(rng, -3, 1), [c, s, 0.0]), times(magnitude(rng, -3, 1), [-s, c, 0.0])
        return row_of(any_minv(rng), rectangle([0.0, 0.0, magnitude(rng, -4, 4)], x, y))

    def far(rng, i):
        size = -4 - i * 14 // per_scenario
        return row_of(any_minv(rng), any_rectangle(rng, upper(rng, magnitude(rng, -1, 5)), size - 1, size + 1))

    def near_plane(rng, i):
        u, v, n = rotation(rng)
        x, y = times(magnitude(rng, -3, 1), u), times(magnitude(rng, -3, 1), v)
        height = magnitude(rng, -24 + i * 20 // per_scenario, -23 + i * 20 // per_scenario)
        a, b = uniform(rng, -1.5, 1.5), uniform(rng, -1.5, 1.5)
        if i % 4 == 0:
            a = 1.0
        centre = [height * r + a * p + b * q for p, q, r in zip(x, y, n)]
        return row_of(any_minv(rng), rectangle(centre, x, y))

    def needle(rng, i):
        u, v, _ = rotation(rng)
        long = magnitude(rng, -3, 2)
        short = long * magnitude(rng, -4 - i * 14 // per_scenario, -3 - i * 14 // per_scenario)
        return row_of(any_minv(rng), rectangle(upper(rng, magnitude(rng, -1, 3)), times(long, u), times(short, v)))

    def horizon(rng, _):
        c, s = circle_point(rng)
        u, v, _ = rotation(rng)
        x, y = times(magnitude(rng, -3, 1), u), times(magnitude(rng, -3, 1), v)
        distance = magnitude(rng, -1, 3)
        centre = [distance * c, distance * s, (abs(x[2]) + abs(y[2])) * uniform(rng, -1.0, 1.0)]
        return row_of(any_minv(rng), rectangle(centre, x, y))

    def inside_out(rng, _):
        u, v, n = rotation(rng)
        x, y = times(magnitude(rng, -1, 3), u), times(magnitude(rng, -1, 3), v)
        height, a, b = magnitude(rng, -6, -1), uniform(rng, -0.9, 0.9), uniform(rng, -0.9, 0.9)
        centre = [height * r + a * p + b * q for p, q, r in zip(x, y, n)]
        return row_of(any_minv(rng), rectangle(centre, x, y))

    def edge(rng):
        """No area, corners together, at the point and on the horizon, edge-on, singular matrices, scales."""
        identity = [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0]
        zero, x, y, z = [0.0] * 3, [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]
        unit_square = rectangle([0.0, 0.0, 1.0], x, y)
        rows = [row_of(m, unit_square) for m in (identity, [0.0] * 9, any_minv(rng), times(-1.0, identity))]
        rows += [row_of(identity, unit_square[::-1]), row_of(identity, [[1.0, 2.0, 3.0]] * 4)]
        rows += [row_of(identity, [unit_square[k] for k in (0, 1, 1, 0)]), row_of(identity, [x, y, z, z])]
        rows += [row_of(identity, [x, y, z, x]), row_of(identity, [zero, x, [1.0, 1.0, 1.0], [0.0, 1.0, 1.0]])]
        # The horizon itself, within and beside; upright planes through the point, within and beside; on an edge.
        rows += [row_of(identity, rectangle(c, x, y)) for c in (zero, [5.0, 0.0, 0.0], [0.5, 0.25, 0.0])]
        rows += [row_of(identity, rectangle(c, y, z)) for c in (zero, [0.0, 5.0, 0.0], [0.0, 2.0, 0.5], [0.0, 0.0, 1.0])]
        rows += [row_of(any_minv(rng), rectangle(c, [1.0, 1.0, 0.0], z)) for c in (zero, [4.0, 4.0, 2.0], [1.0, 1.0, 1.0])]
        # Corners on the horizon; below it; straight through it.
        rows += [row_of(identity, [[1.0, -1.0, 0.0], [1.0, 1.0, 0.0], [1.0, 1.0, h], [1.0, -1.0, h]]) for h in (1.0, -1.0, 1e-6)]
        rows += [row_of(identity, rectangle([0.0, 0.0, h], x, y)) for h in (-1.0, 1e-6, 1e6, -1e-6)]
        rows += [row_of(identity, rectangle([2.0, 0.0, 0.0], y, z)), row_of(identity, rectangle([2.0, 1.0, -1.0], y, z))]
        rows += [row_of(any_minv(rng), rectangle([2.0, 1.0, 0.5], y, z)) for _ in range(3)]
        singular = [1.0, 2.0, 3.0, 1.0, 2.0, 3.0, 0.0, 0.0, 1.0]
        rows += [row_of(singular, rectangle([3.0, 1.0, 1.0], x, z)), row_of(singular, unit_square)]
        for k in range(-20, 21, 5):
            corners = [times(math.ldexp(1.0, k), c) for c in any_rectangle(rng, upper(rng, 2.0), -1, 1)]
            rows.append(row_of(times(math.ldexp(1.0, -k // 2), any_minv(rng)), corners))
        while len(rows) < per_scenario:
            rows.append(row_of(identity, any_rectangle(rng, upper(rng, 1.0), -1, 1)))
        return rows

    def truth(row):
        mp.dps = FEWEST_DIGITS
        values = [Fraction(c) for c in row]
        minv = [values[0:3], values[3:6], values[6:9]]
        corners = [
            [sum(minv[c][r] * values[9 + 3 * k + c] for c in range(3)) for r in range(3)] for k in range(4)
        ]

        def cross(p, q):
            return [p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]]

        def dot(p, q):
            return sum(s * t for s, t in zip(p, q))

        def real(f):
            return mpf(f.numerator) / f.denominator

        truth.calls += 1
        flat = all(dot(cross(a, b), c) == 0 for a, b, c in itertools.combinations(corners, 3))
        total, crossings = mpf(0), []
        for k in range(4):
            a, b = corners[k], corners[(k + 1) % 4]
            e = [q - p for p, q in zip(a, b)]
            low, high = Fraction(0), Fraction(1)
            if a[2] <= 0 and b[2] <= 0:
                continue
            if a[2] <= 0 or b[2] <= 0:
                t = a[2] / (a[2] - b[2])
                crossings.append((b[2] <= 0, [p + t * q for p, q in zip(a, e)]))
                low, high = (low, t) if b[2] <= 0 else (t, high)
            n = cross(a, e)
            ee, ae, nn = dot(e, e), dot(a, e), dot(n, n)
            if nn == 0:
                # Along a ray from the origin, or through the origin.
                if min(ee * low + ae, ee * high + ae) <= 0 <= max(ee * low + ae, ee * high + ae):
                    if ee != 0 or dot(a, a) == 0:
                        return [None]
                continue
            norm = mp.sqrt(real(nn))
            angle = mp.atan(real(ee * high + ae) / norm) - mp.atan(real(ee * low + ae) / norm)
            if truth.calls % 6 == 0 and angle < 3:
                with mp.workdps(30):
                    start, stop = real(ee * low + ae) / norm, real(ee * high + ae) / norm
                    stops = [start] + [s for s in (-64, -16, -4, -1, 0, 1, 4, 16, 64) if start < s < stop] + [stop]
                    area = mp.quad(lambda s: 1 / (1 + s * s), stops)
                    assert abs(area - angle) < mpf("1e-18") * max(angle, mpf("1e-6")), (row, area, angle)
            total += angle * real(n[2]) / norm
        for k, (leaves, c) in enumerate(crossings):
            if not leaves:
                continue
            d = crossings[(k + 1) % len(crossings)][1]
            sine, cosine = c[0] * d[1] - c[1] * d[0], c[0] * d[0] + c[1] * d[1]
            if sine == 0 and cosine <= 0:
                return [None]
            turn = mp.atan2(real(d[1]), real(d[0])) - mp.atan2(real(c[1]), real(c[0]))
            total += turn - 2 * mp.pi * mp.nint(turn / (2 * mp.pi))
        if flat:
            assert abs(total) < mpf("1e-100"), (row, total)
            return [mpf(0)]
        return [abs(total) / (2 * mp.pi)]

    truth.calls = 0
    drawn = (ggx, grazing, facing, far, near_plane, needle, horizon, inside_out)

    return Golden(
        inputs=[f"minv_{c}{r}" for c in range(3) for r in range(3)] + [f"p{k}_{c}" for k in range(4) for c in "xyz"],
        outputs=["irradiance"],
        conditions=[],
        scenarios={f.__name__: many(f) for f in drawn} | {"edge": edge},
        truth=truth,
        method=f"Worked in {FEWEST_DIGITS} digits by antiderivatives along the edges, spot checks by quadrature",
    )


FAMILIES = {
    "edge_integral": edge_integral,
    "ellipse_axes": ellipse_axes,
    "ltc_polygon": ltc_polygon,
}

# --- files -----------------------------------------------------------------------------------------------------------


def render(family):
    """The text of tests/golden/<family>.csv."""
    golden = FAMILIES[family]()
    lines = [
        f"# Written by tools/golden.py {family} (make golden) with mpmath; do not edit.",
        f"# {golden.method}; printed to {PRINTED_DIGITS} significant digits.",
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
