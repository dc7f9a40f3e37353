"""Golden values of pixel_cube."""

from truths.common import *  # the small language in which truths are written


def pixel_cube():
    """The integral of (1 + x^2 + y^2)^(-3/2) over the rectangle, by its primitive at the corners in enough digits that
    nothing is left of its cancellation, and for rectangles of moderate size by quadrature to check: the rows'
    integrals in closed form, the columns' by Gauss-Legendre's rule."""
    per_scenario = 24

    def pixel(size, rng):
        at = lambda k: 2.0 * k / size - 1.0
        x, y = int(rng.random() * size), int(rng.random() * size)
        return [to_f32(v) for v in (at(x), at(y), at(x + 1), at(y + 1))]

    def faces(sizes):
        return lambda rng: [pixel(sizes[i % len(sizes)], rng) for i in range(per_scenario)]

    def rectangles(reach, low, high):
        def draw(rng):
            rows = []
            for _ in range(per_scenario):
                w, h = (min(magnitude(rng, low, high), 2 * reach) for _ in range(2))
                x, y = uniform(rng, -reach, reach - w), uniform(rng, -reach, reach - h)
                rows.append([to_f32(v) for v in (x, y, x + w, y + h)])
            return rows

        return draw

    def edge(rng):
        rows = [[-s, -s, s, s] for s in (1.0, 1e3, 1e6, 1e10, F32_MIN_SUBNORMAL)]
        rows += [[0.25, 0.0, 0.25, 1.0], [0.5, 0.25, 0.5, 0.25], [1.0, 1.0, -1.0, 0.0], [0.75, -0.5, 0.25, 0.5]]
        rows += [[0.0, 0.0, F32_MIN_SUBNORMAL, 1.0], [-1e10, -1e-10, 1e10, 1e-10], [-1e6, 3.0, 1e6, f32_step(3.0, 1)]]
        rows += [[x, y, f32_step(x, 1), f32_step(y, 2)] for x, y in ((1.0, 0.5), (-0.75, 0.125), (300.0, -2.0))]
        while len(rows) < per_scenario:
            rows.append([(1.0, -1.0)[int(2 * rng.random())] * magnitude(rng, -60, 30) for _ in range(4)])
        return [[to_f32(v) for v in row] for row in rows]

    def primitive(x, y):
        return mp.atan(x * y / mp.sqrt(1 + x * x + y * y))

    def truth(row):
        x0, y0, x1, y1 = (mpf(v) for v in row)
        mp.dps = 300
        value = abs(primitive(x1, y1) - primitive(x0, y1) - primitive(x1, y0) + primitive(x0, y0))
        mp.dps = 40
        if 1e-4 < abs(x1 - x0) < 1 and 1e-4 < abs(y1 - y0) < 1:
            line = lambda x, y: x / ((1 + y * y) * mp.sqrt(1 + x * x + y * y))
            check = abs(mp.quad(lambda y: line(x1, y) - line(x0, y), [y0, y1], method="gauss-legendre"))
            if not abs(check - value) <= mpf("1e-25") * value:
                raise ArithmeticError(f"{check} and {value} on {row}")
        return [value]

    return Golden(
        method="mpmath, 300 digits of the primitive; quadrature agrees to 1e-25 where the sides are 1e-4 to 1",
        inputs=["x0", "y0", "x1", "y1"],
        outputs=["solid_angle"],
        conditions=[],
        scenarios={
            "cube_map": faces([8 << k for k in range(10)]),
            "decimal": faces([1000, 5000, 10000]),
            "fine": faces([1 << k for k in range(13, 21)]),
            "window": rectangles(1.0, -20, 1),
            "wide": rectangles(1e3, -10, 11),
            "edge": edge,
        },
        truth=truth,
    )
