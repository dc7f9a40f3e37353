"""Golden values of ltc_sphere."""

import math
from fractions import Fraction

from mpmath import mpf

from truths.common import Golden, circle_point, magnitude, rotation, to_f32, uniform
from truths.ltc_disk import IDENTITY, MINV_COLUMNS, Clipped, apply, lobe_matrix, tangent_disk, xyz_columns


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
        method="mpmath, 60 digits: quadrature over the visible area of the tangent disk",
        inputs=MINV_COLUMNS + xyz_columns("center") + ["radius"],
        outputs=["irradiance"],
        conditions=[],
        tolerances=[
            ("irradiance", "1.5e-11", "more precision is taken where the bound exceeds 2^-36"),
        ],
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
