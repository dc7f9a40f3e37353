"""Golden values of the family normalize."""

from truths.common import *  # the small language in which truths are written


def normalize():
    """Undefined for the zero vector."""

    def strata(rng):
        def component():
            return (1.0 if rng.random() < 0.5 else -1.0) * magnitude(rng, -20, 20)

        return [[to_f32(component()) for _ in range(3)] for _ in range(60)]

    def edge(rng):
        values = neighbours(1.0)[1:8:3] + [-3.0, 1e10, 1e30, F32_MIN_NORMAL, -F32_MIN_SUBNORMAL, 0.0]
        rows = list(itertools.product(values, repeat=3))
        return [[to_f32(x) for x in row] for row in rows]

    def value(x, y, z):
        length = mp.sqrt(x * x + y * y + z * z)
        return [x / length, y / length, z / length] if length > 0 else None

    return builtin(["v_x", "v_y", "v_z"], ["n_x", "n_y", "n_z"], value, {f.__name__: f for f in (strata, edge)})
