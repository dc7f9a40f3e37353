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


# --- ltc_line ---------------------------------------------------------------------------------------------------------


def rounded(values):
    return [to_f32(v) for v in values]


def direction(rng):
    """A uniform direction, by rejection from the ball."""
    while True:
        v = [uniform(rng, -1.0, 1.0) for _ in range(3)]
        n = math.sqrt(sum(c * c for c in v))
        if 0.1 < n <= 1.0:
            return [c / n for c in v]


def lobe(rng, alpha=None):
    """An inverse LTC matrix, column-major: a lobe of width alpha, sheared towards a direction as GGX's is."""
    alpha = alpha or uniform(rng, 0.05, 1.0)
    cosine = uniform(rng, 0.1, 1.0)
    sine = math.sqrt(1.0 - cosine * cosine)
    stretch = uniform(rng, 0.7, 1.0)
    return rounded([cosine / alpha, 0.0, sine, 0.0, stretch / alpha, 0.0, -sine / alpha, 0.0, cosine])


IDENTITY = [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0]


def exact_matrix(m):
    """Rows of a column-major matrix, in mpf."""
    return [[mpf(m[3 * column + row]) for column in range(3)] for row in range(3)]


def times(m, v):
    return [sum(a * b for a, b in zip(row, v)) for row in m]


def dot3(a, b):
    return sum(x * y for x, y in zip(a, b))


def cross3(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def length3(v):
    return mp.sqrt(dot3(v, v))


def determinant3(m):
    return dot3(m[0], cross3(m[1], m[2]))


def clip_segment(a, b):
    """The part of a segment above z = 0 and its share of the parameter; None if nothing."""
    if a[2] <= 0 and b[2] <= 0:
        return None
    share = mpf(1)
    if a[2] < 0:
        s = -a[2] / (b[2] - a[2])
        a, share = [x + s * (y - x) for x, y in zip(a, b)], 1 - s
    elif b[2] < 0:
        s = -b[2] / (a[2] - b[2])
        b, share = [y + s * (x - y) for x, y in zip(a, b)], 1 - s
    return a, b, share


def line_by_antiderivatives(a, b):
    """Integral of 2 q.z/|q|^4 ds, s in 0..1 of a..b, z >= 0 throughout: the published Fpo and Fwt, times 1/(d |b - a|)
    for the parameter. They cancel, and digits pay for that."""
    step = [y - x for x, y in zip(a, b)]
    length = length3(step)
    t = [c / length for c in step]
    l1, l2 = dot3(a, t), dot3(b, t)
    foot = [c - l1 * u for c, u in zip(a, t)]
    d = length3(foot)

    def fpo(x):
        return x / (d * (d * d + x * x)) + mp.atan(x / d) / (d * d)

    def fwt(x):
        return x * x / (d * (d * d + x * x))

    return (foot[2] * (fpo(l2) - fpo(l1)) + t[2] * (fwt(l2) - fwt(l1))) / (d * length)


def line_by_angle(a, b):
    """The same by quadrature over the polar angle seen from the origin."""
    area = length3(cross3(a, b))
    angle = mp.atan2(area, dot3(a, b))
    ra, rb = length3(a), length3(b)
    e1 = [c / ra for c in a]
    normal = [c / area for c in cross3(a, b)]
    e2 = cross3(normal, e1)

    def integrand(phi):
        inverse = (mp.sin(angle - phi) / ra + mp.sin(phi) / rb) / mp.sin(angle)
        return inverse * (e1[2] * mp.cos(phi) + e2[2] * mp.sin(phi))

    return 2 * mpmath.quad(integrand, [0, angle], method="gauss-legendre") / area


def ltc_line():
    """Irradiance per unit radius of a line: (1/pi) |det Minv| |p1 x p2| times the integral of 2 q.z/|q|^4 over the part
    above the horizon.

    The integral comes from the published antiderivatives in 120 digits, where their cancellation does no harm, and for
    every third row again from quadrature over the angle; the oracle uses neither."""
    per_scenario = 50

    def tube(rng, minv, center, half_length):
        half = [half_length * c for c in direction(rng)]
        return rounded(minv + [c - h for c, h in zip(center, half)] + [c + h for c, h in zip(center, half)])

    def material(rng, i):
        return IDENTITY if i % 2 else lobe(rng)

    def ggx(rng):
        def center():
            return [uniform(rng, -5.0, 5.0), uniform(rng, -5.0, 5.0), uniform(rng, 0.1, 4.0)]

        return [tube(rng, lobe(rng), center(), magnitude(rng, -3, 1)) for _ in range(per_scenario)]

    def far(rng):
        rows = []
        for i in range(per_scenario):
            distance = magnitude(rng, 2 + i // 4, 3 + i // 4)
            away = direction(rng)
            rows.append(tube(rng, material(rng, i), [distance * away[0], distance * away[1], distance * abs(away[2])], 0.25))
        return rows

    def grazing(rng):
        rows = []
        for i in range(per_scenario):
            ends = []
            for _ in range(2):
                x, y = circle_point(rng)
                r = magnitude(rng, -2, 3)
                ends += [r * x, r * y, r * magnitude(rng, -20, -4)]
            rows.append(rounded(IDENTITY + ends))
        return rows

    def near(rng):
        rows = []
        for i in range(per_scenario):
            u, v, _ = rotation(rng)
            half, gap = magnitude(rng, -3, 3), magnitude(rng, -20, -3)
            if u[2] < 0:
                u = [-c for c in u]
            shift = uniform(rng, -0.8, 0.8)
            ends = [half * (gap * p + (shift + side) * q) for side in (-1, 1) for p, q in zip(u, v)]
            rows.append(rounded(material(rng, i) + ends))
        return rows

    def horizon(rng):
        rows = []
        for i in range(per_scenario):
            p, q = direction(rng), direction(rng)
            p[2], q[2] = abs(p[2]), -abs(q[2])
            ends = [c * magnitude(rng, -2, 2) for c in (p + q if i % 4 < 2 else q + p)]
            rows.append(rounded(material(rng, i) + ends))
        return rows

    def long(rng):
        rows = []
        for i in range(per_scenario):
            u, v, _ = rotation(rng)
            gap = magnitude(rng, -2, 2)
            before, after = magnitude(rng, 3, 20), magnitude(rng, 3, 20)
            if u[2] < 0:
                u = [-c for c in u]
            ends = [gap * p + side * q for side in (-before, after) for p, q in zip(u, v)]
            rows.append(rounded(material(rng, i) + ends))
        return rows

    def edge(rng):
        rows = []
        minv = lobe(rng)
        # Exactly dark: equal ends, end-on from outside and from the light itself, on the horizon and below, singular.
        for factor in (1.0, 2.0, -0.5, 0.0, 3.0):
            rows.append(minv + [1.0, 2.0, 3.0] + [factor * c for c in (1.0, 2.0, 3.0)])
        rows.append(IDENTITY + [1.0, 2.0, 0.0, -2.0, 1.0, 0.0])
        rows.append(IDENTITY + [1.0, 2.0, -1.0, -2.0, 1.0, 0.0])
        rows.append(IDENTITY + [1.0, 2.0, -1.0, -2.0, 1.0, -3.0])
        rows.append([1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 1.0, 2.0, 3.0, -1.0, 1.0, 2.0])
        # Axis-aligned over the point, and touching the horizon at an end.
        rows.append(IDENTITY + [-1.0, 0.0, 1.0, 1.0, 0.0, 1.0])
        rows.append(IDENTITY + [1.0, 0.0, 0.0, 0.0, 1.0, 1.0])
        rows.append(IDENTITY + [1.0, 0.0, 0.0, 1.0, 0.0, 1.0])
        # Nearly end-on: a factor that rounds, a component moved by one step.
        while len(rows) < per_scenario // 2:
            p = [to_f32(uniform(rng, 0.5, 2.0)) for _ in range(3)]
            q = rounded([3.0 * c for c in p])
            q[len(rows) % 3] = f32_step(q[len(rows) % 3], 1)
            rows.append(material(rng, len(rows)) + p + q)
        # Scales.
        while len(rows) < per_scenario:
            scale = math.ldexp(1.0, 8 * (len(rows) - per_scenario // 2) - 96)
            rows.append(material(rng, len(rows)) + [scale * uniform(rng, 0.1, 2.0) for _ in range(6)])
        return [rounded(row) for row in rows]

    checked = itertools.count()

    def truth(row):
        mp.dps = FEWEST_DIGITS
        m = exact_matrix(row[:9])
        p1, p2 = ([mpf(c) for c in row[k : k + 3]] for k in (9, 12))
        weight = abs(determinant3(m)) * length3(cross3(p1, p2))
        visible = clip_segment(times(m, p1), times(m, p2))
        if weight == 0 or visible is None:
            return [mpf(0)]
        a, b, share = visible
        integral = line_by_antiderivatives(a, b)
        if next(checked) % 3 == 0:
            mp.dps = 60
            error = abs(line_by_angle(a, b) / integral - 1)
            assert error < mpf(10) ** -30, (row, error)
            mp.dps = FEWEST_DIGITS
        return [weight * share * integral / mp.pi]

    return Golden(
        inputs=[f"minv_{c}{r}" for c in range(3) for r in range(3)] + [f"{p}_{c}" for p in ("p1", "p2") for c in "xyz"],
        outputs=["irradiance"],
        conditions=[],
        scenarios={f.__name__: f for f in (ggx, far, grazing, near, horizon, long, edge)},
        truth=truth,
    )


# --- ltc_strip --------------------------------------------------------------------------------------------------------


def clipped_polygon(points):
    """Above z = 0, by Sutherland and Hodgman."""
    kept = []
    for a, b in zip(points, points[1:] + points[:1]):
        if a[2] >= 0:
            kept.append(a)
        if (a[2] < 0 < b[2]) or (b[2] < 0 < a[2]):
            s = a[2] / (a[2] - b[2])
            kept.append([x + s * (y - x) for x, y in zip(a, b)][:2] + [mpf(0)])
    return kept


def polygon_irradiance(points):
    """Lambert's formula for a polygon above the horizon."""
    total = mpf(0)
    for a, b in zip(points, points[1:] + points[:1]):
        normal = cross3(a, b)
        size = length3(normal)
        if size > 0:
            total += mp.acos(dot3(a, b) / (length3(a) * length3(b))) * normal[2] / size
    return abs(total) / (2 * mp.pi)


def ltc_strip():
    """Irradiance of the rectangle p1 +- side, p2 +- side.

    Clipped as a polygon and summed by Lambert's formula with acos, in 120 digits; for every sixth row again as an
    integral over lines along it, each by the published antiderivatives."""
    per_scenario = 50

    def strips(rng, alpha):
        rows = []
        for i in range(per_scenario):
            u, v, _ = rotation(rng)
            center = [uniform(rng, -5.0, 5.0), uniform(rng, -5.0, 5.0), uniform(rng, 0.1, 4.0)]
            half, width = magnitude(rng, -3, 1), magnitude(rng, -10, -1 if i % 4 else 2)
            ends = [c + side * half * a for side in (-1, 1) for c, a in zip(center, u)]
            rows.append(rounded(lobe(rng, alpha) + ends + [width * a for a in v]))
        return rows

    def ggx_alpha_02(rng):
        return strips(rng, 0.2)

    def ggx_alpha_01(rng):
        return strips(rng, 0.1)

    def ggx_alpha_05(rng):
        return strips(rng, 0.5)

    def edge(rng):
        x, p, q = [1.0, 0.0, 0.0], [1.0, 2.0, 3.0], [2.0, -1.0, 3.0]
        rows = [IDENTITY + p + p + x, IDENTITY + p + q + [0.0] * 3, IDENTITY + p + q + p, lobe(rng) + p + q + q]
        rows.append(IDENTITY + [1.0, 2.0, 0.0, -2.0, 1.0, 0.0] + x)
        rows.append(IDENTITY + [1.0, 2.0, -1.0, -2.0, 1.0, -1.0] + x)
        rows.append([1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0] + p + q + x)
        # A square overhead, one around the point's height, one whose edge lies on the horizon, one upright.
        rows.append(IDENTITY + [-1.0, 0.0, 1.0, 1.0, 0.0, 1.0, 0.0, 1.0, 0.0])
        rows.append(IDENTITY + [-1.0, 0.0, 0.0009765625, 1.0, 0.0, 0.0009765625, 0.0, 1.0, 0.0])
        rows.append(IDENTITY + [-1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 0.0, 0.0, 1.0])
        rows.append(IDENTITY + [-1.0, 1.0, 0.0, 1.0, 1.0, 0.0, 0.0, 0.0, 1.0])
        # Around the point at every height; then at every scale.
        while len(rows) < 30:
            height = math.ldexp(1.0, -len(rows))
            a, b = uniform(rng, 0.5, 2.0), uniform(rng, -1.0, 1.0)
            minv = IDENTITY if len(rows) % 2 else lobe(rng)
            rows.append(minv + [-a, -b, height, a, b, height, -b, a, 0.0])
        while len(rows) < per_scenario:
            scale = math.ldexp(1.0, 8 * (len(rows) - 30) - 80)
            rows.append(lobe(rng) + [scale * c for c in (*p, *q, uniform(rng, -1.0, 1.0), 0.25, uniform(rng, -1.0, 1.0))])
        return [rounded(row) for row in rows]

    checked = itertools.count()

    def by_lines(m, p1, p2, side):
        def line(v):
            visible = clip_segment(*(times(m, [a + v * s for a, s in zip(p, side)]) for p in (p1, p2)))
            if visible is None:
                return mpf(0)
            a, b, share = visible
            return share * line_by_antiderivatives(a, b) / 2

        # Kinks: where an end crosses the horizon.
        kinks = [-times(m, p)[2] / times(m, side)[2] for p in (p1, p2)]
        places = sorted([mpf(-1), mpf(1)] + [v for v in kinks if -1 < v < 1])
        volume = abs(dot3(p2, cross3(side, p1)))
        return mpmath.quad(line, places) * abs(determinant3(m)) * volume / mp.pi

    def truth(row):
        mp.dps = FEWEST_DIGITS
        m = exact_matrix(row[:9])
        p1, p2, side = ([mpf(c) for c in row[k : k + 3]] for k in (9, 12, 15))
        if determinant3(m) == 0 or dot3(p2, cross3(side, p1)) == 0:
            return [mpf(0)]
        corners = [[a + sign * s for a, s in zip(p, side)] for p, sign in ((p1, -1), (p2, -1), (p2, 1), (p1, 1))]
        points = clipped_polygon([times(m, c) for c in corners])
        if len(points) < 3:
            return [mpf(0)]
        irradiance = polygon_irradiance(points)
        thin = length3(side) < length3([a + b for a, b in zip(p1, p2)]) / 4
        if thin and next(checked) % 6 == 0:
            mp.dps = 60
            error = abs(by_lines(m, p1, p2, side) / irradiance - 1)
            assert error < mpf(10) ** -12, (row, error)
            mp.dps = FEWEST_DIGITS
        return [irradiance]

    return Golden(
        inputs=[f"minv_{c}{r}" for c in range(3) for r in range(3)]
        + [f"{p}_{c}" for p in ("p1", "p2", "side") for c in "xyz"],
        outputs=["irradiance"],
        conditions=[],
        scenarios={f.__name__: f for f in (ggx_alpha_02, ggx_alpha_01, ggx_alpha_05, edge)},
        truth=truth,
    )


# --- ltc_cylinder -----------------------------------------------------------------------------------------------------


def ltc_cylinder():
    """Irradiance of a capped cylinder.

    Summed over the surface that the point sees, not around the silhouette: the side as lines along it, a cap as chords,
    each line by the published antiderivatives, and tanh-sinh quadrature over the angle, split where an end of a line
    crosses the horizon."""
    per_scenario = 50
    digits_used = 40

    def tubes(rng, alpha):
        rows = []
        for _ in range(per_scenario):
            u, _, _ = rotation(rng)
            center = [uniform(rng, -5.0, 5.0), uniform(rng, -5.0, 5.0), uniform(rng, 0.1, 4.0)]
            half, radius = magnitude(rng, -3, 1), magnitude(rng, -10, -1)
            rows.append(rounded(lobe(rng, alpha) + [c + s * half * a for s in (-1, 1) for c, a in zip(center, u)] + [radius]))
        return rows

    def ggx_alpha_02(rng):
        return tubes(rng, 0.2)

    def ggx_alpha_01(rng):
        return tubes(rng, 0.1)

    def ggx_alpha_05(rng):
        return tubes(rng, 0.5)

    def edge(rng):
        up = [0.0, 0.0, 1.0, 0.0, 0.0, 3.0]
        rows = [IDENTITY + up + [r] for r in (0.0, 0.125, 1.0, 8.0)]
        rows += [IDENTITY + [1.0, 2.0, 3.0] * 2 + [1.0], IDENTITY + [1.0, 2.0, -4.0, 2.0, 1.0, -3.0, 1.0]]
        rows += [[1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 1.0, 2.0, 3.0, -1.0, 1.0, 2.0, 0.5]]
        # From within; upright about the horizon; lengthwise in it.
        rows += [lobe(rng) + [-1.0, 0.25, 0.5, 2.0, 0.0, 0.25, 1.0]]
        rows += [IDENTITY + [3.0, 0.0, -2.0, 3.0, 0.0, 2.0, 1.0], IDENTITY + [-2.0, 3.0, 0.0, 1.0, 3.0, 0.0, 1.0]]
        rows += [lobe(rng) + [3.0, 0.5, -2.0, 3.5, 0.0, 2.0, 1.0], lobe(rng) + [-2.0, 3.0, 0.25, 1.0, 3.0, -0.125, 1.0]]
        while len(rows) < per_scenario:
            # Next to the side, facing a cap, flat.
            u, v, _ = rotation(rng)
            gap, radius, half = magnitude(rng, -6, 0), magnitude(rng, -3, 1), magnitude(rng, -3, 1)
            shift = uniform(rng, -0.8, 0.8)
            kind = len(rows) % 3
            if kind == 0:
                center = [(radius + gap) * a + shift * half * b for a, b in zip(u, v)]
            elif kind == 1:
                center = [(half + gap) * b + shift * radius * a for a, b in zip(u, v)]
            else:
                center, half = [(radius + gap) * c for c in direction(rng)], half / 256
            minv = IDENTITY if len(rows) % 2 else lobe(rng)
            rows.append(minv + [c + s * half * b for s in (-1, 1) for c, b in zip(center, v)] + [radius])
        return [rounded(row) for row in rows]

    def truth(row):
        mp.dps = digits_used
        m = exact_matrix(row[:9])
        p1, p2 = ([mpf(c) for c in row[k : k + 3]] for k in (9, 12))
        radius = mpf(row[15])
        length = length3([b - a for a, b in zip(p1, p2)])
        if determinant3(m) == 0 or length == 0 or radius == 0:
            return [mpf(0)]
        axis = [(b - a) / length for a, b in zip(p1, p2)]
        place = -dot3(p1, axis)
        radial = [-a - place * t for a, t in zip(p1, axis)]
        gap = length3(radial)
        if gap <= radius and 0 <= place <= length:
            return [mpf(1)]
        towards = [c / gap for c in radial] if gap > 0 else [axis[1], axis[2], axis[0]]
        if gap == 0:
            along = dot3(towards, axis)
            towards = [a - along * t for a, t in zip(towards, axis)]
            towards = [c / length3(towards) for c in towards]
        across = cross3(axis, towards)

        def rim(p, cosine, sine):
            return [c + radius * (cosine * a + sine * b) for c, a, b in zip(p, towards, across)]

        def line(a, b):
            visible = clip_segment(times(m, a), times(m, b))
            if visible is None:
                return mpf(0)
            a, b, share = visible
            return share * line_by_antiderivatives(a, b) / 2

        def crossings(p):
            """Angles at which the rim about p crosses the horizon."""
            z, a, b = (times(m, v)[2] for v in (p, towards, across))
            slope = radius * mp.hypot(a, b)
            if slope <= abs(z):
                return []
            top, half = mp.atan2(b, a), mp.acos(-z / slope)
            return [mp.atan2(mp.sin(t), mp.cos(t)) for t in (top - half, top + half)]

        total = mpf(0)
        if gap > radius:
            edge_angle = mp.acos(radius / gap)

            def side(angle):
                cosine, sine = mp.cos(angle), mp.sin(angle)
                return (gap * cosine - radius) * line(rim(p1, cosine, sine), rim(p2, cosine, sine))

            kinks = [t for p in (p1, p2) for t in crossings(p) if abs(t) < edge_angle]
            total += radius * length * mpmath.quad(side, sorted([-edge_angle, edge_angle] + kinks))
        if place < 0 or place > length:
            cap = p1 if place < 0 else p2

            def chord(angle):
                cosine, sine = mp.cos(angle), mp.sin(angle)
                return cosine * cosine * line(rim(cap, -cosine, sine), rim(cap, cosine, sine))

            kinks = [mp.asin(mp.sin(t)) for t in crossings(cap)]
            height = abs(dot3(cap, axis))
            total += 2 * radius * radius * height * mpmath.quad(chord, sorted([-mp.pi / 2, mp.pi / 2] + kinks))
        return [total * abs(determinant3(m)) / mp.pi]

    return Golden(
        inputs=[f"minv_{c}{r}" for c in range(3) for r in range(3)]
        + [f"{p}_{c}" for p in ("p1", "p2") for c in "xyz"]
        + ["radius"],
        outputs=["irradiance"],
        conditions=[],
        scenarios={f.__name__: f for f in (ggx_alpha_02, ggx_alpha_01, ggx_alpha_05, edge)},
        truth=truth,
    )


FAMILIES = {
    "ellipse_axes": ellipse_axes,
    "ltc_cylinder": ltc_cylinder,
    "ltc_line": ltc_line,
    "ltc_strip": ltc_strip,
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
