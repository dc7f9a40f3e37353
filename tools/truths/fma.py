"""Golden values of the family fma."""

from truths.common import *  # the small language in which truths are written


def fma():
    """Exact products and sums; half of them cancel but for the rounding of the product."""

    def strata(rng):
        rows = []
        for k in range(60):
            x, y, z = (to_f32(magnitude(rng, -20, 20)) for _ in range(3))
            rows.append([x, -y, to_f32(x * y) if k % 2 else z])
        return rows

    def edge(rng):
        values = neighbours(1.0)[1:8:3] + [-3.0, 1e10, F32_MIN_NORMAL, -F32_MIN_SUBNORMAL, 0.0]
        rows = list(itertools.product(values, repeat=3))
        return [[to_f32(x) for x in row] for row in rows]

    def value(x, y, z):
        return [x * y + z]

    return builtin(["x", "y", "z"], ["r"], value, {f.__name__: f for f in (strata, edge)})
