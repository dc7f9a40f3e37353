"""Golden values of disk_solid_angle."""

from truths.common import *  # the small language in which truths are written


def disk_solid_angle():
    """2 pi (1 - cos theta) in enough digits that nothing is left of its cancellation, which is at most 2^-550, and the
    integral of the inverse square law over the disk, by quadrature, to check the rows that are not degenerate."""
    per_scenario = 24

    def rounded(pairs):
        return [[to_f32(r), to_f32(d)] for r, d in pairs]

    def scene(rng):
        return rounded((magnitude(rng, -4, 2), magnitude(rng, -3, 4)) for _ in range(per_scenario))

    def at(low, high):
        def draw(rng):
            radii = [magnitude(rng, -4, 2) for _ in range(per_scenario)]
            return rounded((r, r * magnitude(rng, low, high)) for r in radii)

        return draw

    def scale(rng):
        radii = [magnitude(rng, -60, 60) for _ in range(per_scenario)]
        return rounded((r, r * magnitude(rng, -6, 6)) for r in radii)

    def edge(rng):
        rows = [(0.0, 0.0), (0.0, 1.0), (1.0, 0.0), (-1.0, -0.0), (3.0, 4.0), (-3.0, 4.0), (3.0, -4.0), (1.0, 1.0)]
        rows += [(F32_MIN_SUBNORMAL, F32_MIN_SUBNORMAL), (F32_MIN_SUBNORMAL, 1.0), (1.0, F32_MIN_SUBNORMAL)]
        rows += [(F32_MAX, F32_MAX), (F32_MAX, F32_MIN_SUBNORMAL), (F32_MIN_SUBNORMAL, F32_MAX), (0.0, F32_MAX)]
        while len(rows) < per_scenario:
            rows.append((magnitude(rng, -100, 100), magnitude(rng, -100, 100)))
        return rounded(rows)

    def truth(row):
        r, d = (abs(mpf(x)) for x in row)
        if r == 0:
            return [mpf(0)]
        mp.dps = 400
        value = 2 * mp.pi * (1 - mp.cos(mp.atan2(r, d)))
        mp.dps = 40
        if d > 0 and d / 50 < r < d * 50:
            # The ring of radius s covers 2 pi s d ds/(s^2 + d^2)^(3/2).
            check = mp.quad(lambda s: 2 * mp.pi * s * d / (s * s + d * d) ** mpf(1.5), mp.linspace(0, r, 8))
            if not abs(check - value) <= mpf("1e-25") * value:
                raise ArithmeticError(f"{check} and {value} on {row}")
        return [value]

    return Golden(
        method="mpmath, 400 digits of the closed form; rings by quadrature agree to 1e-25 where R and d are comparable",
        inputs=["radius", "distance"],
        outputs=["solid_angle"],
        conditions=[],
        scenarios={"scene": scene, "far": at(0, 20), "near": at(-27, 0), "scale": scale, "edge": edge},
        truth=truth,
    )
