"""Golden values of the family atan2."""

from truths.common import *  # the small language in which truths are written


def atan2():
    """Undefined at the origin."""

    def strata(rng):
        def component():
            return (1.0 if rng.random() < 0.5 else -1.0) * magnitude(rng, -30, 30)

        return [[to_f32(component()) for _ in range(2)] for _ in range(60)]

    def edge(rng):
        values = neighbours(1.0)[1:8:3] + [-3.0, 1e10, F32_MAX, F32_MIN_NORMAL, -F32_MIN_SUBNORMAL, 0.0]
        rows = list(itertools.product(values, repeat=2))
        return [[to_f32(x) for x in row] for row in rows]

    def value(y, x):
        return [mp.atan2(y, x)] if (x, y) != (0, 0) else None

    return builtin(["y", "x"], ["r"], value, {f.__name__: f for f in (strata, edge)})
