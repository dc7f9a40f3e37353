"""Golden values of the family ltc_strip."""

from truths.common import *  # the small language in which truths are written
from truths.ltc_line import (
    IDENTITY,
    clip_segment,
    cross3,
    determinant3,
    direction,
    dot3,
    exact_matrix,
    length3,
    line_by_antiderivatives,
    lobe,
    rounded,
    times,
)


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
        tolerances=[
            ("irradiance", "3e-11", "more precision is taken where the bound exceeds 2^-35"),
        ],
        scenarios={f.__name__: f for f in (ggx_alpha_02, ggx_alpha_01, ggx_alpha_05, edge)},
        truth=truth,
        method=f"Lambert's formula of the clipped polygon in {FEWEST_DIGITS} digits, every sixth row agreeing with lines across to 1e-12",
    )
