"""Golden values of the family horizon_sphere."""

from truths.common import *  # the small language in which truths are written


def horizon_sphere():
    """Irradiance, over that of the full hemisphere, of a sphere whose direction has the cosine c with the normal and
    whose half angle has the squared sine s.

    Truth is the integral itself, by tanh-sinh quadrature over the polar angle about the sphere's direction, in two
    precisions that agree; of the azimuths only the visible arc's end is known beforehand. No closed form of the
    clipped sphere is involved. Whether the horizon cuts, hides or spares the sphere is decided in exact rational
    arithmetic; a sphere that is spared has c s.
    """
    per_scenario = 50

    def log_uniform(rng, low_exponent, high_exponent):
        return magnitude(rng, low_exponent, high_exponent)

    def sign(rng):
        return 1.0 if rng.random() < 0.5 else -1.0

    def rounded(pairs):
        return [[to_f32(max(-1.0, min(1.0, c))), to_f32(max(0.0, min(1.0, s)))] for c, s in pairs]

    def scene(rng):
        """Spheres 1 to 128 radii away in any direction."""
        sines = [log_uniform(rng, -7, 0) for _ in range(per_scenario)]
        return rounded([(uniform(rng, -1.0, 1.0), sine * sine) for sine in sines])

    def grazing(rng):
        """The centre within 2^-27..2^-7 of the horizon."""
        return rounded([(sign(rng) * log_uniform(rng, -27, -7), log_uniform(rng, -13, 0)) for _ in range(per_scenario)])

    def horizon(rng):
        """The rim within 2^-24..2^-3 of touching the horizon, and the f32 neighbours of touching it exactly."""
        pairs = []
        for _ in range(per_scenario - 12):
            s = to_f32(log_uniform(rng, -20, 0))
            pairs.append((sign(rng) * math.sqrt(s) * (1.0 + sign(rng) * log_uniform(rng, -24, -3)), s))
        for i in range(12):
            c = math.ldexp(1.0 + math.floor(uniform(rng, 0.0, 2048.0)) / 2048.0, -1 - i)
            pairs.append(((1.0, -1.0)[i % 2] * c, f32_step(to_f32(c * c), (1, -1, 2, 0)[i % 4])))
        return rounded(pairs)

    def small(rng):
        """Squared sines 2^-40..2^-13, the centre within two half angles of the horizon or anywhere."""
        pairs = []
        for i in range(per_scenario):
            s = log_uniform(rng, -40, -13)
            pairs.append((uniform(rng, -1.0, 1.0) * (2.0 * math.sqrt(s) if i % 2 else 1.0), s))
        return rounded(pairs)

    def near_full(rng):
        """1 - s of 2^-24..2^-3; cosines anywhere, and as close to +-1."""
        pairs = []
        for i in range(per_scenario):
            c = uniform(rng, -1.0, 1.0) if i % 2 else sign(rng) * (1.0 - log_uniform(rng, -24, -1))
            pairs.append((c, 1.0 - log_uniform(rng, -24, -3)))
        return rounded(pairs)

    def edge(rng):
        """Both ends and their neighbours, the horizon through the centre, subnormals; and a full sphere at any angle."""
        below_one, tiny = f32_step(1.0, -1), F32_MIN_SUBNORMAL
        pairs = list(itertools.product((-1.0, -0.0, 0.0, 0.5, 1.0), (0.0, tiny, 0.25, below_one, 1.0)))
        pairs += itertools.product((below_one, -below_one, tiny, -tiny), (below_one, 1.0))
        pairs += [(tiny, tiny), (-tiny, tiny), (F32_MIN_NORMAL, F32_MIN_NORMAL), (1e-20, 1e-30), (-1e-20, 1e-30)]
        pairs += [(-0.5, f32_step(0.25, 1)), (0.5, f32_step(0.25, 1)), (-0.5, f32_step(0.25, -1))]
        while len(pairs) < per_scenario:
            pairs.append((uniform(rng, -1.0, 1.0), 1.0))
        return rounded(pairs)

    def integral(c, s):
        """(1/pi) times the integral of the cosine over the sphere's visible directions, at the precision set."""
        c, s = mpf(c), mpf(s)
        q = mp.sqrt((1 - c) * (1 + c))
        sigma = mp.atan2(mp.sqrt(s), mp.sqrt(1 - s))
        kink = mp.atan2(abs(c), q)

        def whole(alpha):
            return 2 * mp.pi * c * mp.cos(alpha) * mp.sin(alpha)

        def cut(alpha):
            across, along = q * mp.sin(alpha), c * mp.cos(alpha)
            # (across - along)(across + along), by the angles' sum and difference: both factors vanish at the kink.
            other = mp.sqrt(max(0, mp.sin(alpha - kink) * mp.sin(alpha + kink)))
            azimuth = mp.atan2(other, -along)
            return 2 * (along * azimuth + other) * mp.sin(alpha)

        # Beyond the kink the azimuth settles over some multiples of it.
        points = [kink]
        while 0 < 8 * points[-1] < sigma:
            points.append((4 if len(points) < 3 else 10**6) * points[-1])
        points = [x for x in points if x < sigma]
        # mpmath's quadrature stops at an absolute error: make the integral about 1.
        size = cut((kink + sigma) / 2) * (sigma - kink)
        total = size * mp.quad(lambda alpha: cut(alpha) / size, points + [(points[-1] + sigma) / 2, sigma])
        if c > 0:
            total += mp.quad(whole, [0, kink])
        return total / mp.pi

    def truth(row):
        c, s = (Fraction(x) for x in row)
        if s <= c * c:
            value = c * s if c > 0 else Fraction(0)
            mp.dps = 50
            return [mpf(value.numerator) / value.denominator]
        mp.dps = 40
        first = integral(*row)
        mp.dps = 60
        second = integral(*row)
        if not abs(first - second) <= mpf("1e-27") * abs(second):
            raise ArithmeticError(f"quadrature: {first} and {second} on {row}")
        return [second]

    return Golden(
        inputs=["cos_theta", "sin2_half_angle"],
        outputs=["irradiance"],
        conditions=[],
        scenarios={f.__name__: f for f in (scene, grazing, horizon, small, near_full, edge)},
        truth=truth,
    )
