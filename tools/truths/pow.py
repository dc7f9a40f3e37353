"""Golden values of the family pow."""

from truths.common import *  # the small language in which truths are written


def pow():
    """Undefined for x of 0 and below; values that a double holds."""

    def strata(rng):
        rows = [(magnitude(rng, -20, 10), uniform(rng, -10.0, 10.0)) for _ in range(30)]
        rows += [(uniform(rng, 0.8, 1.0), magnitude(rng, 0, 10)) for _ in range(30)]
        return [[to_f32(x), to_f32(y)] for x, y in rows]

    def edge(rng):
        bases = neighbours(1.0)[:5] + [0.5, 2.0, 10.0, F32_MIN_NORMAL, F32_MAX, F32_MIN_SUBNORMAL, 0.0, -2.0]
        rows = itertools.product(bases, [1.0, -1.0, 0.5, 2.2, 7.0, 0.0, F32_MIN_SUBNORMAL])
        return [[to_f32(x), to_f32(y)] for x, y in rows]

    def value(x, y):
        return [x**y] if x > 0 else None

    return builtin(["x", "y"], ["r"], value, {f.__name__: f for f in (strata, edge)})
