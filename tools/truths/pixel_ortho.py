"""Golden values of pixel_ortho."""

from truths.common import *  # the small language in which truths are written


def pixel_ortho():
    """The area of the unit hemisphere over the part of a rectangle inside the unit circle, by quadrature in two
    precisions that agree: the rows' integrals are asin(x/sqrt(1 - y^2)) between the ends that the circle leaves, the
    columns' are tanh-sinh sums between the heights at which an end meets the circle. No closed form of the area is
    involved."""
    per_scenario = 24

    def pixel(size, column, line):
        at = lambda k: 2.0 * k / size - 1.0
        return [to_f32(v) for v in (at(column), at(line), at(column + 1), at(line + 1))]

    def boundary_pixel(size, rng):
        x, y = circle_point(rng)
        return pixel(size, *(min(int(0.5 * (v + 1.0) * size), size - 1) for v in (x, y)))

    def inner_pixel(size, rng):
        x, y = circle_point(rng)
        r = rng.random()
        return pixel(size, *(min(int(0.5 * (r * v + 1.0) * size), size - 1) for v in (x, y)))

    def images(sizes, draws):
        return lambda rng: [draws[i % len(draws)](sizes[i % len(sizes)], rng) for i in range(per_scenario)]

    def window(rng):
        rows = []
        for _ in range(per_scenario):
            w, h = magnitude(rng, -10, 1), magnitude(rng, -10, 1)
            x, y = uniform(rng, -1.1, 1.1 - w), uniform(rng, -1.1, 1.1 - h)
            rows.append([to_f32(v) for v in (x, y, x + w, y + h)])
        return rows

    def grazing(rng):
        rows = []
        for _ in range(per_scenario):
            r = 1.0 - magnitude(rng, -20, -3)
            x, y = (r * v for v in circle_point(rng))
            w, h = (math.copysign(magnitude(rng, -10, 0), v) for v in (x, y))
            rows.append([to_f32(v) for v in (x, y, x + w, y + h)])
        return rows

    def edge(rng):
        rows = [[-s, -s, s, s] for s in (1.0, 1.5, 1e10, F32_MIN_SUBNORMAL)]
        rows += [[0.25, 0.0, 0.25, 1.0], [0.75, 0.75, 1.0, 1.0], [1.0, -0.5, 2.0, 0.5], [0.75, -0.5, 0.25, 0.5]]
        rows += [[1.0, 0.0, 0.75, 0.25], [0.0, -1.0, -0.5, -0.75], [-1.0, -1.0, -0.25, 1.0], [0.0, 0.0, 3.0, -2.0]]
        rows += [[0.6, 0.8, 0.7, 0.9], [0.6, 0.8, 0.5, 0.7], [f32_step(0.5, 0), 0.75, f32_step(0.5, 3), f32_step(0.75, 2)]]
        for i in range(4):
            x, y = (to_f32(v) for v in circle_point(rng))
            rows.append([x, f32_step(y, i - 2), x + math.copysign(0.1, x), y + math.copysign(0.2, y)])
        while len(rows) < per_scenario:
            rows.append([uniform(rng, -1.2, 1.2) for _ in range(4)])
        return [[to_f32(v) for v in row] for row in rows]

    def area(x, y):
        """Of a rectangle whose sides ascend, at the precision set."""
        def root(s):
            """The height at which the side x = s meets the circle."""
            return mp.sqrt((1 - s) * (1 + s)) if abs(s) < 1 else mpf(0)

        def angle(s, rho2):
            """asin(s/rho), or the circle's end."""
            rest = rho2 - s * s
            return mp.atan2(s, mp.sqrt(rest)) if rest > 0 else mp.sign(s) * mp.pi / 2

        def line(v):
            rho2 = (1 - v) * (1 + v)
            if rho2 <= 0:
                return mpf(0)
            return angle(x[1], rho2) - angle(x[0], rho2)

        low, high = max(y[0], mpf(-1)), min(y[1], mpf(1))
        nearest = max(x[0], -x[1], mpf(0))
        if nearest >= 1:
            return mpf(0)
        low, high = max(low, -root(nearest)), min(high, root(nearest))
        if not low < high:
            return mpf(0)
        cuts = sorted({c for s in x for c in (root(s), -root(s)) if low < c < high} | ({mpf(0)} if low < 0 < high else set()))
        size = line((low + high) / 2) * (high - low)
        if size == 0:
            size = mpf(1)
        return size * mp.quad(lambda v: line(v) / size, [low] + cuts + [high])

    def truth(row):
        cells = [Fraction(v) for v in row]
        near = [max(min(a, b), -max(a, b), 0) for a, b in ((cells[0], cells[2]), (cells[1], cells[3]))]
        if cells[0] == cells[2] or cells[1] == cells[3] or near[0] ** 2 + near[1] ** 2 >= 1:
            return [mpf(0)]
        values = []
        for digits_used in (50, 70):
            mp.dps = digits_used
            x0, y0, x1, y1 = (mpf(v) for v in row)
            values.append(area(sorted((x0, x1)), sorted((y0, y1))))
        if not abs(values[0] - values[1]) <= mpf("1e-27") * values[1]:
            raise ArithmeticError(f"{values} on {row}")
        return values[1:]

    return Golden(
        method="mpmath, tanh-sinh quadrature of 50 and of 70 digits agreeing to 1e-27",
        inputs=["x0", "y0", "x1", "y1"],
        outputs=["solid_angle"],
        conditions=[],
        scenarios={
            "image": images([8 << k for k in range(10)], [inner_pixel]),
            "boundary": images([8 << k for k in range(10)], [boundary_pixel]),
            "decimal": images([1000, 5000, 10000], [inner_pixel, boundary_pixel]),
            "fine": images([1 << k for k in range(13, 21)], [inner_pixel, boundary_pixel]),
            "window": window,
            "grazing": grazing,
            "edge": edge,
        },
        truth=truth,
    )
