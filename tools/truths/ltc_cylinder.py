"""Golden values of the family ltc_cylinder."""

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
        tolerances=[
            ("irradiance", "5.9e-11", "more precision is taken where the bound exceeds 2^-34"),
        ],
        scenarios={f.__name__: f for f in (ggx_alpha_02, ggx_alpha_01, ggx_alpha_05, edge)},
        truth=truth,
        method="Integrated over the surface seen, in 40 digits",
    )
