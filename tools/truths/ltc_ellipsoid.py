"""Golden values of ltc_ellipsoid."""

import math
from fractions import Fraction

from mpmath import mpf

from truths.common import Golden, magnitude, rotation, to_f32, uniform
from truths.ltc_disk import IDENTITY, MINV_COLUMNS, Clipped, apply, lobe_matrix, tangent_disk, xyz_columns


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
        method="mpmath, 60 digits: quadrature over the visible area of the mapped tangent disk",
        inputs=MINV_COLUMNS + xyz_columns("center") + [f"rotation_{c}" for c in "xyzw"] + xyz_columns("radius"),
        outputs=["irradiance"],
        conditions=[],
        tolerances=[
            ("irradiance", "1.5e-11", "more precision is taken where the bound exceeds 2^-36"),
        ],
        scenarios={"ggx": ggx, "flat": flat, "far": far, "near_surface": near_surface, "edge": edge},
        truth=truth,
    )
