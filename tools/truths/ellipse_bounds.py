"""Golden values of the family ellipse_bounds."""

from truths.common import *  # the small language in which truths are written


def ellipse_bounds():
    """The box of c + u cos t + v sin t.

    The extreme of a coordinate is where its derivative vanishes, at tan t = v/u: the value there, by cosine and sine of
    that angle, not by the root of the squares. A spot check is the largest of the coordinate at 64 angles, which must not
    exceed it and must come within (pi / 32)^2 / 2 of it, relatively.
    """
    per_scenario = 40

    def row_of(*vectors):
        return [to_f32(c) for v in vectors for c in v]

    def direction(rng, length):
        return [length * c for c in rotation(rng)[0]]

    def scaled(factor, v):
        return [factor * c for c in v]

    def scene(rng):
        rows = []
        for _ in range(per_scenario):
            x, y, _ = rotation(rng)
            radius = magnitude(rng, -4, 3)
            rows.append(row_of(direction(rng, uniform(rng, 0.0, 10.0)), scaled(radius, x), scaled(radius * uniform(rng, 0.2, 1.0), y)))
        return rows

    def disk(rng):
        """Radius 2^-10 to 1, centres within 2^7."""
        rows = []
        for _ in range(per_scenario):
            x, y, _ = rotation(rng)
            radius = magnitude(rng, -10, 0)
            rows.append(row_of(direction(rng, magnitude(rng, -3, 7)), scaled(radius, x), scaled(radius, y)))
        return rows

    def flat(rng):
        """Tilts 2^-26 to 1 out of a coordinate plane."""
        rows = []
        for i in range(per_scenario):
            sine = min(magnitude(rng, -26 + i * 26 // per_scenario, -25 + i * 26 // per_scenario), 1.0)
            c, s = circle_point(rng)
            p, q = circle_point(rng)
            radius = magnitude(rng, -4, 3)
            cos = math.sqrt(1.0 - sine * sine)
            hinge, rise = [c, s, 0.0], [-s * cos, c * cos, sine]
            x = [radius * (p * a + q * b) for a, b in zip(hinge, rise)]
            y = [radius * (p * b - q * a) for a, b in zip(hinge, rise)]
            k = i % 3
            rows.append(row_of(direction(rng, magnitude(rng, -20, 4)), x[k:] + x[:k], y[k:] + y[:k]))
        return rows

    def conjugate(rng):
        """Aspects 1 to 2^20, any conjugate semi-axes."""
        rows = []
        for i in range(per_scenario):
            x, y, _ = rotation(rng)
            radius, aspect = magnitude(rng, -4, 3), magnitude(rng, i // 2, i // 2 + 1)
            c, s = circle_point(rng)
            u = [radius * (c * a + s * b / aspect) for a, b in zip(x, y)]
            v = [radius * (c * b / aspect - s * a) for a, b in zip(x, y)]
            rows.append(row_of(direction(rng, uniform(rng, 0.0, 10.0)), u, v))
        return rows

    def offset(rng):
        """Centres 2^-13 to 2^27 radii away."""
        rows = []
        for i in range(per_scenario):
            x, y, _ = rotation(rng)
            radius = magnitude(rng, -4, 3)
            rows.append(row_of(direction(rng, radius * magnitude(rng, i - 13, i - 12)), scaled(radius, x), scaled(radius, y)))
        return rows

    def scale(rng):
        """Lengths 2^-80 to 2^80."""
        rows = []
        for i in range(per_scenario):
            x, y, _ = rotation(rng)
            radius = magnitude(rng, 4 * i - 80, 4 * i - 76)
            rows.append(row_of(direction(rng, radius * magnitude(rng, -3, 3)), scaled(radius, x), scaled(0.5 * radius, y)))
        return rows

    def edge(rng):
        """Points, segments, along the axes, a corner that cancels, mixed scales, subnormals."""
        zero, x, y, z = [0.0] * 3, [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]
        tiny = [F32_MIN_SUBNORMAL, F32_MIN_NORMAL, -3 * F32_MIN_SUBNORMAL]
        rows = [
            row_of(zero, zero, zero),
            row_of([1.0, -2.0, 3.0], zero, zero),
            row_of(zero, x, y),
            row_of(z, [2.0, 0.0, 0.0], [0.0, 0.0, -1.0]),
            row_of([3.0, 5.0, 13.0], [3.0, 3.0, 5.0], [0.0, 4.0, 12.0]),
            row_of([5.0, -5.0, 0.0], [3.0, 4.0, 0.0], [4.0, 3.0, -0.0]),
            row_of(zero, tiny, tiny),
            row_of(tiny, [F32_MIN_SUBNORMAL] * 3, zero),
            row_of(x, tiny, [F32_MIN_NORMAL] * 3),
            row_of([1e30] * 3, [1e-30] * 3, [1e30, 0.0, 1e-30]),
        ]
        for i in range(5):
            u = direction(rng, magnitude(rng, -10, 10))
            rows.append(row_of(direction(rng, 1.0), u, scaled((0.0, 1.0, -0.5, 0.3, 2.0)[i], u)))
        while len(rows) < per_scenario:
            row = [to_f32(magnitude(rng, -60, 60) * (1 if rng.random() < 0.5 else -1)) for _ in range(9)]
            if len(rows) % 2:
                # The centre is the half extent, rounded: one corner is what rounding leaves.
                u, v = direction(rng, magnitude(rng, -10, 10)), direction(rng, magnitude(rng, -10, 10))
                u, v = [to_f32(c) for c in u], [to_f32(c) for c in v]
                row = row_of([math.sqrt(a * a + b * b) for a, b in zip(u, v)], u, v)
            rows.append(row)
        return rows

    def truth(row):
        mp.dps = 2 * FEWEST_DIGITS
        low, high = [], []
        truth.calls += 1
        for k in range(3):
            c, u, v = (mpf(row[j + k]) for j in (0, 3, 6))
            if v == 0:
                extent = abs(u)
            elif u == 0:
                extent = abs(v)
            else:
                t = mp.atan2(v, u)
                extent = u * mp.cos(t) + v * mp.sin(t)
                # Two numbers whose squares add up to a square have a root with few digits: print it as such.
                extent = mp.nint(extent) if abs(extent - mp.nint(extent)) < mpf(10) ** -200 else extent
            if truth.calls % 5 == 0 and (u != 0 or v != 0):
                seen = max(u * mp.cos(mp.pi * j / 32) + v * mp.sin(mp.pi * j / 32) for j in range(64))
                assert seen <= extent * (1 + mpf(10) ** -100) and seen >= extent * (1 - (mp.pi / 32) ** 2 / 2), row
            low.append(c - extent)
            high.append(c + extent)
        return low + high

    truth.calls = 0

    return Golden(
        inputs=[f"{v}_{c}" for v in ("center", "u", "v") for c in "xyz"],
        outputs=[f"{v}_{c}" for v in ("min", "max") for c in "xyz"],
        conditions=[],
        scenarios={f.__name__: f for f in (scene, disk, flat, conjugate, offset, scale, edge)},
        truth=truth,
        method=f"Worked in {2 * FEWEST_DIGITS} digits by the angle at which a coordinate is extreme",
    )
