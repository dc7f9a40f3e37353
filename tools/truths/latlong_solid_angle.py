"""Golden values of latlong_solid_angle."""

from truths.common import *  # the small language in which truths are written


def latlong_solid_angle():
    """The rows' integral of cos(latitude) as the difference of sines, in enough digits that nothing is left of its
    cancellation, and by quadrature of the cosine to check."""
    per_scenario = 24
    pole, half_turn = to_f32(math.pi / 2), to_f32(math.pi)

    def pixel(height, line, column):
        """All in Python floats, then rounded: the bits are what counts."""
        step = math.pi / height
        lats = [k * step - math.pi / 2 for k in (line, line + 1)]
        return [to_f32(x) for x in lats + [k * step - math.pi for k in (column, column + 1)]]

    def image(rng):
        rows = []
        for i in range(per_scenario):
            height = 32 << (i % 8)
            rows.append(pixel(height, int(rng.random() * height), int(rng.random() * 2 * height)))
        return rows

    def fine(rng):
        rows = []
        for i in range(per_scenario):
            height = 1 << (14 + i % 7)
            line = (int(rng.random() * height), int(rng.random() * 64), height - 1, 0)[i % 4]
            rows.append(pixel(height, line, int(rng.random() * 2 * height)))
        return rows

    def rectangle(rng):
        rows = []
        for _ in range(per_scenario):
            height, width = magnitude(rng, -20, 1), magnitude(rng, -20, 2)
            lat, lon = uniform(rng, -pole, pole - height), uniform(rng, -half_turn, half_turn - width)
            rows.append([to_f32(x) for x in (lat, lat + height, lon, lon + width)])
        return rows

    def near_pole(rng):
        rows = []
        for i in range(per_scenario):
            near = 0.0 if i % 4 == 0 else magnitude(rng, -23, -3)
            far, side = near + magnitude(rng, -23, 0), (1.0, -1.0)[i % 2]
            lon = [uniform(rng, -half_turn, half_turn) for _ in range(2)]
            rows.append([to_f32(x) for x in [side * (pole - far), side * (pole - near)] + lon])
        return rows

    def edge(rng):
        rows = [[-pole, pole, -half_turn, half_turn], [0.0, 0.0, 0.0, 1.0], [0.5, 0.5, -1.0, 1.0], [-0.5, 0.5, 1.0, 1.0]]
        rows += [[0.5, -0.25, 1.0, -1.0], [-0.5, 0.5, -1.0, 1.0], [f32_step(pole, -1), pole, 0.0, 1.0]]
        rows += [[F32_MIN_SUBNORMAL, -F32_MIN_SUBNORMAL, 0.0, F32_MIN_SUBNORMAL], [0.0, F32_MIN_NORMAL, 0.0, 1.0]]
        rows += [[-pole, f32_step(-pole, -1), 0.0, half_turn], [1.0, f32_step(1.0, 1), 1.0, f32_step(1.0, 1)]]
        while len(rows) < per_scenario:
            tiny = [magnitude(rng, -120, 0) for _ in range(4)]
            rows.append([to_f32(x) for x in tiny])
        return rows

    def truth(row):
        lat0, lat1, lon0, lon1 = (mpf(x) for x in row)
        mp.dps = 200
        height = abs(mp.sin(lat1) - mp.sin(lat0))
        value = height * abs(lon1 - lon0)
        mp.dps = 40
        if abs(lat1 - lat0) > 1e-3:
            check = abs(mp.quad(mp.cos, [lat0, lat1]))
            if not abs(check - height) <= mpf("1e-25"):
                raise ArithmeticError(f"{check} and {height} on {row}")
        return [value]

    return Golden(
        method="mpmath, 200 digits of the difference of sines; quadrature of the cosine agrees to 1e-25",
        inputs=["lat0", "lat1", "lon0", "lon1"],
        outputs=["solid_angle"],
        conditions=[],
        scenarios={"image": image, "fine": fine, "rectangle": rectangle, "pole": near_pole, "edge": edge},
        truth=truth,
    )
