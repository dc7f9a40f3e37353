"""Golden values of the family ltc_polygon."""

from truths.common import *  # the small language in which truths are written


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
        tolerances=[
            ("irradiance", "3e-11", "more precision is taken where the bound exceeds 2^-35"),
        ],
        scenarios={f.__name__: many(f) for f in drawn} | {"edge": edge},
        truth=truth,
        method=f"Worked in {FEWEST_DIGITS} digits by antiderivatives along the edges, spot checks by quadrature",
    )
