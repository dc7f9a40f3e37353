"""Golden values of ltc_disk, and what the families of elliptic cones share: the quadrature and lobe matrices."""

import math
from fractions import Fraction

from mpmath import mp, mpf

from truths.common import Golden, circle_point, f32_step, magnitude, rotation, to_f32, uniform


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
        method="mpmath, 60 digits: quadrature over the visible area",
        inputs=MINV_COLUMNS + xyz_columns("center", "v1", "v2"),
        outputs=["irradiance"],
        conditions=[],
        tolerances=[
            ("irradiance", "1.5e-11", "more precision is taken where the bound exceeds 2^-36"),
        ],
        scenarios={f.__name__: f for f in (ggx, grazing, facing, far, near_plane, needle, horizon, inside_out, edge)},
        truth=truth,
    )
