"""Golden values of ellipse_solid_angle."""

from truths.common import *  # the small language in which truths are written


def cone_solid_angle(matrix):
    """Of the cone with this dual quadric, eigenvalues e1 >= e3 > 0 > -l: 2 pi less a complete elliptic integral of the third
    kind, in so many digits that nothing is left of its cancellation, and where the tangents are moderate by quadrature of
    the cone's radius over the azimuth to check. No Carlson form is involved."""
    mp.dps = 400
    e = sorted(mpmath.eigsy(matrix, eigvals_only=True))
    a2, b2 = e[2] / -e[0], e[1] / -e[0]
    big = 1 + a2
    characteristic, parameter = (a2 - b2) / a2, (a2 - b2) / big
    value = 2 * mp.pi - 4 * mp.sqrt(b2 / (a2 * big)) * mpmath.ellippi(characteristic, parameter)
    mp.dps = 40
    if b2 > a2 / 1000 and mpf("1e-6") < a2 < 1e6:

        def cap(phi):
            rho2 = 1 / (mp.cos(phi) ** 2 / a2 + mp.sin(phi) ** 2 / b2)
            h = mp.sqrt(1 + rho2)
            return rho2 / (h * (h + 1))

        check = 4 * mp.quad(cap, mp.linspace(0, mp.pi / 2, 9))
        if not abs(check - value) <= mpf("1e-18") * value:
            raise ArithmeticError(f"{check} and {value}")
    return value


def ellipse_solid_angle():
    """See cone_solid_angle; S = V1 V1^T + V2 V2^T - C C^T. What lies in its own plane is decided in rational arithmetic."""
    per_scenario = 24

    def row(center, u, v, rng):
        cos, sin = circle_point(rng)
        v1 = [cos * p + sin * q for p, q in zip(u, v)]
        v2 = [cos * q - sin * p for p, q in zip(u, v)]
        return [to_f32(x) for x in [*center, *v1, *v2]]

    def times(v, factor):
        return [factor * c for c in v]

    def lights(distance, aspect):
        def draw(rng):
            rows = []
            for _ in range(per_scenario):
                x, y, _ = rotation(rng)
                major = magnitude(rng, -4, 2)
                center = times(rotation(rng)[0], major * distance(rng))
                rows.append(row(center, times(x, major), times(y, major / aspect(rng)), rng))
            return rows

        return draw

    def facing(rng):
        rows = []
        for i in range(per_scenario):
            x, y, z = rotation(rng)
            squeeze, a, b = (0.0, 0.0, 0.0) if i % 2 else (magnitude(rng, -26, -6) for _ in range(3))
            distance = magnitude(rng, -3, 4)
            center = [distance * (r + a * p + b * q) for p, q, r in zip(x, y, z)]
            rows.append([to_f32(v) for v in center + list(x) + times(y, 1.0 + squeeze)])
        return rows

    def near_plane(rng):
        rows = []
        for _ in range(per_scenario):
            x, y, z = rotation(rng)
            u, v = x, times(y, 1.0 / magnitude(rng, 0, 2))
            (cos, sin), offset, height = circle_point(rng), uniform(rng, 0.0, 2.0), magnitude(rng, -17, -3)
            center = [offset * (cos * p + sin * q) + height * r for p, q, r in zip(u, v, z)]
            rows.append(row(center, u, v, rng))
        return rows

    def edge(rng):
        x, y = [3.0, 0.0, 0.0], [0.0, 1.0, 0.0]
        rows = [[d, 0.0, 0.0] + x + y for d in (0.0, 2.0, 3.0, 3.5, -4.0)]
        rows += [[0.0] * 9, [1.0, 2.0, 3.0] + x + times(x, 2.0), [1.0, 2.0, 3.0] + x + [0.0] * 3, [0.0, 0.0, 2.0] + x + y]
        rows += [[1.0, 1.0, 2.0, 1.0, 0.0, 1.0, 0.0, 1.0, 1.0], [4.0, 4.0, 8.0, 1.0, 0.0, 1.0, 0.0, 1.0, 1.0]]
        rows += [[3.0, 0.0, h] + x + y for h in (1e-6, 1.0)] + [[0.0, 4.0, 0.0, 0.0, 0.0, 3.0, -3.0, 0.0, 0.0]]
        tiny, huge = F32_MIN_SUBNORMAL, 1e10
        rows += [[0.0, 0.0, tiny, tiny, 0.0, 0.0, 0.0, tiny, 0.0], [0.0, huge, huge, tiny, 0.0, 0.0, 0.0, 1.0, 0.0]]
        while len(rows) < per_scenario:
            scale = math.ldexp(1.0, int(uniform(rng, -40.0, 40.0)))
            rows.append([scale * uniform(rng, -1.0, 1.0) for _ in range(9)])
        return [[to_f32(v) for v in cells] for cells in rows]

    def truth(cells):
        c, v1, v2 = ([Fraction(x) for x in cells[i : i + 3]] for i in (0, 3, 6))

        def cross(a, b):
            return [a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3] for i in range(3)]

        def square(a):
            return sum(x * x for x in a)

        normal = cross(v1, v2)
        if square(normal) == 0:
            return [mpf(0)]
        if sum(a * b for a, b in zip(normal, c)) == 0:
            inside = square(cross(c, v1)) + square(cross(c, v2)) <= square(normal)
            return [2 * mp.pi if inside else mpf(0)]
        mp.dps = 400
        scale = max(abs(x) for x in c + v1 + v2)
        matrix = mpmath.matrix(3, 3)
        for i in range(3):
            for j in range(3):
                entry = (v1[i] * v1[j] + v2[i] * v2[j] - c[i] * c[j]) / scale**2
                matrix[i, j] = mpf(entry.numerator) / entry.denominator
        return [cone_solid_angle(matrix)]

    def below(high):
        return lambda rng: magnitude(rng, 0, high)

    return Golden(
        method="mpmath, 400 digits of the eigenvalues and of the integral of the third kind; quadrature agrees to 1e-18",
        inputs=[f"{name}_{c}" for name in ("center", "v1", "v2") for c in "xyz"],
        outputs=["solid_angle"],
        conditions=[],
        scenarios={
            "scene": lights(lambda rng: magnitude(rng, -1, 5), below(2)),
            "facing": facing,
            "far": lights(lambda rng: magnitude(rng, 3, 17), below(2)),
            "near_plane": near_plane,
            "needle": lights(lambda rng: magnitude(rng, -3, 3), below(13)),
            "edge": edge,
        },
        truth=truth,
    )
