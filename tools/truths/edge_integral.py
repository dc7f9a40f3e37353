"""Golden values of the family edge_integral."""

from truths.common import *  # the small language in which truths are written


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
