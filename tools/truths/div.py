"""Golden values of the family div."""

from truths.common import *  # the small language in which truths are written


def div():
    """Undefined for a divisor of 0."""

    def strata(rng):
        def component():
            return (1.0 if rng.random() < 0.5 else -1.0) * magnitude(rng, -40, 40)

        return [[to_f32(component()) for _ in range(2)] for _ in range(60)]

    def edge(rng):
        values = neighbours(1.0)[1:8:3] + [3.0, 1e10, F32_MAX, F32_MIN_NORMAL, -F32_MIN_SUBNORMAL, 0.0]
        rows = list(itertools.product(values, repeat=2))
        return [[to_f32(x) for x in row] for row in rows]

    def value(x, y):
        return [x / y] if y != 0 else None

    return builtin(["x", "y"], ["r"], value, {f.__name__: f for f in (strata, edge)})
