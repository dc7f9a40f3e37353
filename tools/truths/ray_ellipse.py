"""Golden values of the family ray_ellipse."""

from truths.common import *  # the small language in which truths are written


def ray_ellipse():
    """o + t d = c + lambda u + gamma v by elimination in rational numbers: no rounding anywhere before printing.

    A miss (lambda^2 + gamma^2 > 1, t < 0, t of the largest f32 or more, or no one solution) has t = the largest f32 and
    lambda = gamma = 0.
    """
    per_scenario = 60

    def row_of(*vectors):
        return [to_f32(c) for v in vectors for c in v]

    def unit(rng):
        return rotation(rng)[0]

    def light(rng):
        """Centre and perpendicular semi-axes, the first the longer."""
        x, y, _ = rotation(rng)
        radius = magnitude(rng, -4, 3)
        ratio = uniform(rng, 0.2, 1.0)
        centre = [uniform(rng, 0.0, 10.0) * c for c in unit(rng)]
        return centre, [radius * c for c in x], [radius * ratio * c for c in y]

    def aimed(ellipse, place, distance, direction):
        c, u, v = ellipse
        origin = [
            ck + place[0] * uk + place[1] * vk - distance * dk for ck, uk, vk, dk in zip(c, u, v, direction)
        ]
        return row_of(origin, direction, c, u, v)

    def around(rng, radius):
        c, s = circle_point(rng)
        return radius * c, radius * s

    def scene(rng):
        """Up to 1.5 radii, a tenth from behind."""
        rows = []
        for i in range(per_scenario):
            ellipse, distance = light(rng), magnitude(rng, -2, 5)
            rows.append(aimed(ellipse, around(rng, uniform(rng, 0.0, 1.5)), distance * (-1 if i % 10 == 9 else 1), unit(rng)))
        return rows

    def border(rng):
        """Radius 1 +- 2^-26 to 2^-4."""
        rows = []
        for i in range(per_scenario):
            radius = 1.0 + (1 if i % 2 else -1) * magnitude(rng, -26 + i * 22 // per_scenario, -25 + i * 22 // per_scenario)
            rows.append(aimed(light(rng), around(rng, radius), magnitude(rng, -2, 5), unit(rng)))
        return rows

    def grazing(rng):
        """Sines 2^-23 to 1 between ray and plane."""
        rows = []
        for i in range(per_scenario):
            c, u, v = light(rng)
            sine = min(magnitude(rng, -23 + i * 23 // per_scenario, -22 + i * 23 // per_scenario), 1.0)
            cos = math.sqrt(1.0 - sine * sine)
            lu = math.sqrt(sum(a * a for a in u))
            lv = math.sqrt(sum(a * a for a in v))
            x, y = [a / lu for a in u], [a / lv for a in v]
            n = [x[1] * y[2] - x[2] * y[1], x[2] * y[0] - x[0] * y[2], x[0] * y[1] - x[1] * y[0]]
            p, q = circle_point(rng)
            direction = [cos * (p * a + q * b) + sine * m for a, b, m in zip(x, y, n)]
            rows.append(aimed((c, u, v), around(rng, uniform(rng, 0.0, 1.2)), magnitude(rng, -2, 5), direction))
        return rows

    def far(rng):
        """1 to 2^20 radii away."""
        rows = []
        for i in range(per_scenario):
            c, u, v = light(rng)
            radius = math.sqrt(sum(a * a for a in u))
            c = [radius * a for a in unit(rng)]
            distance = radius * magnitude(rng, i // 3, i // 3 + 1)
            rows.append(aimed((c, u, v), around(rng, uniform(rng, 0.0, 1.2)), distance, unit(rng)))
        return rows

    def needle(rng):
        """Conjugate semi-axes, aspects 1 to 2^17."""
        rows = []
        for i in range(per_scenario):
            c, u, v = light(rng)
            aspect = magnitude(rng, i * 17 // per_scenario, i * 17 // per_scenario + 1)
            v = [a / aspect for a in v]
            p, q = circle_point(rng)
            needle = c, [p * a + q * b for a, b in zip(u, v)], [p * b - q * a for a, b in zip(u, v)]
            rows.append(aimed(needle, around(rng, uniform(rng, 0.0, 1.2)), magnitude(rng, -2, 5), unit(rng)))
        return rows

    def at_plane(rng):
        """Origins 2^-30 to 1 radii from the plane, either side."""
        rows = []
        for i in range(per_scenario):
            ellipse = light(rng)
            distance = magnitude(rng, -30 + i // 2, -29 + i // 2) * (1 if i % 3 else -1)
            rows.append(aimed(ellipse, around(rng, uniform(rng, 0.0, 1.2)), distance, unit(rng)))
        return rows

    def scale(rng):
        """Lengths times 2^-40 to 2^40, directions times 2^-20 to 2^20."""
        rows = []
        for _ in range(per_scenario):
            row = aimed(light(rng), around(rng, uniform(rng, 0.0, 1.2)), magnitude(rng, -2, 5), unit(rng))
            length, pace = magnitude(rng, -40, 40), magnitude(rng, -20, 20)
            rows.append([to_f32(x * (pace if 3 <= k < 6 else length)) for k, x in enumerate(row)])
        return rows

    def edge(rng):
        """Parallel, in-plane, zero and parallel axes, borders, t = 0, t beyond f32, extremes."""
        zero, x, y, z = [0.0] * 3, [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]
        up, down = [0.0, 0.0, 2.0], [0.0, 0.0, -0.5]
        rows = [
            row_of(up, zero, zero, x, y),
            row_of(up, down, zero, zero, y),
            row_of(up, down, zero, x, zero),
            row_of(up, down, zero, zero, zero),
            row_of(up, down, zero, x, [-4.0, 0.0, 0.0]),
            row_of(up, [1.0, 2.0, 0.0], zero, x, y),
            row_of([-3.0, 0.5, 0.0], x, zero, x, y),
            row_of(zero, x, zero, x, y),
            row_of(zero, down, zero, x, y),
            row_of(up, z, zero, x, y),
            row_of(up, [0.0, 0.0, -F32_MIN_SUBNORMAL], zero, x, y),
            row_of(up, [0.0, 0.0, -F32_MIN_NORMAL], zero, x, y),
            row_of(up, [0.0, 0.0, -F32_MIN_NORMAL / 2], zero, x, y),
            row_of([0.0, 0.0, F32_MAX], [0.0, 0.0, -1.0], zero, x, y),
            row_of([0.0, 0.0, F32_MAX], [0.0, 0.0, -1.0 - 2.0**-23], [0.0, 0.0, -F32_MAX], x, y),
            row_of([0.0, 0.0, F32_MIN_SUBNORMAL], down, zero, x, y),
            row_of([0.0, 0.0, -F32_MIN_SUBNORMAL], down, zero, x, y),
        ]
        for steps in range(-3, 4):
            for sign in (1.0, -1.0):
                rows.append(row_of([sign * f32_step(1.0, steps), 0.0, 2.0], down, zero, x, y))
                rows.append(row_of([0.6, sign * f32_step(0.8, steps), 2.0], down, zero, x, y))
        while len(rows) < 2 * per_scenario:
            row = [magnitude(rng, -40, 40) * (1 if rng.random() < 0.5 else -1) for _ in range(15)]
            if len(rows) % 2:
                # Extents of one order: every other of these has a chance to be hit.
                row = aimed(light(rng), around(rng, uniform(rng, 0.0, 1.0)), magnitude(rng, -20, 20), unit(rng))
            rows.append([to_f32(c) for c in row])
        return rows

    def eliminated(matrix, right):
        """The solution of three equations, None if there is not exactly one."""
        rows = [list(r) + [b] for r, b in zip(matrix, right)]
        for k in range(3):
            pivot = next((r for r in range(k, 3) if rows[r][k] != 0), None)
            if pivot is None:
                return None
            rows[k], rows[pivot] = rows[pivot], rows[k]
            rows[k] = [x / rows[k][k] for x in rows[k]]
            for r in range(3):
                if r != k:
                    rows[r] = [a - rows[r][k] * b for a, b in zip(rows[r], rows[k])]
        return [r[3] for r in rows]

    def truth(row):
        mp.dps = FEWEST_DIGITS
        o, d, c, u, v = [[Fraction(x) for x in row[k : k + 3]] for k in range(0, 15, 3)]
        # t d - lambda u - gamma v = c - o, one equation a component.
        matrix = [[d[k], -u[k], -v[k]] for k in range(3)]
        solution = eliminated(matrix, [p - q for p, q in zip(c, o)])
        if solution is not None:
            t, lam, gam = solution
            if lam * lam + gam * gam <= 1 and 0 <= t < Fraction(F32_MAX):
                return [mpf(x.numerator) / x.denominator for x in solution]
        return [mpf(F32_MAX), mpf(0), mpf(0)]

    return Golden(
        inputs=[f"{v}_{c}" for v in ("origin", "direction", "center", "u", "v") for c in "xyz"],
        outputs=["t", "lambda", "gamma"],
        conditions=[],
        scenarios={f.__name__: f for f in (scene, border, grazing, far, needle, at_plane, scale, edge)},
        truth=truth,
        method="Worked in rational numbers by Gaussian elimination",
    )
