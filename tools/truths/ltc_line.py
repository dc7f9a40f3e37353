"""Golden values of the family ltc_line."""

from truths.common import *  # the small language in which truths are written


def rounded(values):
    return [to_f32(v) for v in values]


def direction(rng):
    """A uniform direction, by rejection from the ball."""
    while True:
        v = [uniform(rng, -1.0, 1.0) for _ in range(3)]
        n = math.sqrt(sum(c * c for c in v))
        if 0.1 < n <= 1.0:
            return [c / n for c in v]


def lobe(rng, alpha=None):
    """An inverse LTC matrix, column-major: a lobe of width alpha, sheared towards a direction as GGX's is."""
    alpha = alpha or uniform(rng, 0.05, 1.0)
    cosine = uniform(rng, 0.1, 1.0)
    sine = math.sqrt(1.0 - cosine * cosine)
    stretch = uniform(rng, 0.7, 1.0)
    return rounded([cosine / alpha, 0.0, sine, 0.0, stretch / alpha, 0.0, -sine / alpha, 0.0, cosine])


IDENTITY = [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0]


def exact_matrix(m):
    """Rows of a column-major matrix, in mpf."""
    return [[mpf(m[3 * column + row]) for column in range(3)] for row in range(3)]


def times(m, v):
    return [sum(a * b for a, b in zip(row, v)) for row in m]


def dot3(a, b):
    return sum(x * y for x, y in zip(a, b))


def cross3(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def length3(v):
    return mp.sqrt(dot3(v, v))


def determinant3(m):
    return dot3(m[0], cross3(m[1], m[2]))


def clip_segment(a, b):
    """The part of a segment above z = 0 and its share of the parameter; None if nothing."""
    if a[2] <= 0 and b[2] <= 0:
        return None
    share = mpf(1)
    if a[2] < 0:
        s = -a[2] / (b[2] - a[2])
        a, share = [x + s * (y - x) for x, y in zip(a, b)], 1 - s
    elif b[2] < 0:
        s = -b[2] / (a[2] - b[2])
        b, share = [y + s * (x - y) for x, y in zip(a, b)], 1 - s
    return a, b, share


def line_by_antiderivatives(a, b):
    """Integral of 2 q.z/|q|^4 ds, s in 0..1 of a..b, z >= 0 throughout: the published Fpo and Fwt, times 1/(d |b - a|)
    for the parameter. They cancel, and digits pay for that."""
    step = [y - x for x, y in zip(a, b)]
    length = length3(step)
    t = [c / length for c in step]
    l1, l2 = dot3(a, t), dot3(b, t)
    foot = [c - l1 * u for c, u in zip(a, t)]
    d = length3(foot)

    def fpo(x):
        return x / (d * (d * d + x * x)) + mp.atan(x / d) / (d * d)

    def fwt(x):
        return x * x / (d * (d * d + x * x))

    return (foot[2] * (fpo(l2) - fpo(l1)) + t[2] * (fwt(l2) - fwt(l1))) / (d * length)


def line_by_angle(a, b):
    """The same by quadrature over the polar angle seen from the origin."""
    area = length3(cross3(a, b))
    angle = mp.atan2(area, dot3(a, b))
    ra, rb = length3(a), length3(b)
    e1 = [c / ra for c in a]
    normal = [c / area for c in cross3(a, b)]
    e2 = cross3(normal, e1)

    def integrand(phi):
        inverse = (mp.sin(angle - phi) / ra + mp.sin(phi) / rb) / mp.sin(angle)
        return inverse * (e1[2] * mp.cos(phi) + e2[2] * mp.sin(phi))

    return 2 * mpmath.quad(integrand, [0, angle], method="gauss-legendre") / area


def ltc_line():
    """Irradiance per unit radius of a line: (1/pi) |det Minv| |p1 x p2| times the integral of 2 q.z/|q|^4 over the part
    above the horizon.

    The integral comes from the published antiderivatives in 120 digits, where their cancellation does no harm, and for
    every third row again from quadrature over the angle; the oracle uses neither."""
    per_scenario = 50

    def tube(rng, minv, center, half_length):
        half = [half_length * c for c in direction(rng)]
        return rounded(minv + [c - h for c, h in zip(center, half)] + [c + h for c, h in zip(center, half)])

    def material(rng, i):
        return IDENTITY if i % 2 else lobe(rng)

    def ggx(rng):
        def center():
            return [uniform(rng, -5.0, 5.0), uniform(rng, -5.0, 5.0), uniform(rng, 0.1, 4.0)]

        return [tube(rng, lobe(rng), center(), magnitude(rng, -3, 1)) for _ in range(per_scenario)]

    def far(rng):
        rows = []
        for i in range(per_scenario):
            distance = magnitude(rng, 2 + i // 4, 3 + i // 4)
            away = direction(rng)
            rows.append(tube(rng, material(rng, i), [distance * away[0], distance * away[1], distance * abs(away[2])], 0.25))
        return rows

    def grazing(rng):
        rows = []
        for i in range(per_scenario):
            ends = []
            for _ in range(2):
                x, y = circle_point(rng)
                r = magnitude(rng, -2, 3)
                ends += [r * x, r * y, r * magnitude(rng, -20, -4)]
            rows.append(rounded(IDENTITY + ends))
        return rows

    def near(rng):
        rows = []
        for i in range(per_scenario):
            u, v, _ = rotation(rng)
            half, gap = magnitude(rng, -3, 3), magnitude(rng, -20, -3)
            if u[2] < 0:
                u = [-c for c in u]
            shift = uniform(rng, -0.8, 0.8)
            ends = [half * (gap * p + (shift + side) * q) for side in (-1, 1) for p, q in zip(u, v)]
            rows.append(rounded(material(rng, i) + ends))
        return rows

    def horizon(rng):
        rows = []
        for i in range(per_scenario):
            p, q = direction(rng), direction(rng)
            p[2], q[2] = abs(p[2]), -abs(q[2])
            ends = [c * magnitude(rng, -2, 2) for c in (p + q if i % 4 < 2 else q + p)]
            rows.append(rounded(material(rng, i) + ends))
        return rows

    def long(rng):
        rows = []
        for i in range(per_scenario):
            u, v, _ = rotation(rng)
            gap = magnitude(rng, -2, 2)
            before, after = magnitude(rng, 3, 20), magnitude(rng, 3, 20)
            if u[2] < 0:
                u = [-c for c in u]
            ends = [gap * p + side * q for side in (-before, after) for p, q in zip(u, v)]
            rows.append(rounded(material(rng, i) + ends))
        return rows

    def edge(rng):
        rows = []
        minv = lobe(rng)
        # Exactly dark: equal ends, end-on from outside and from the light itself, on the horizon and below, singular.
        for factor in (1.0, 2.0, -0.5, 0.0, 3.0):
            rows.append(minv + [1.0, 2.0, 3.0] + [factor * c for c in (1.0, 2.0, 3.0)])
        rows.append(IDENTITY + [1.0, 2.0, 0.0, -2.0, 1.0, 0.0])
        rows.append(IDENTITY + [1.0, 2.0, -1.0, -2.0, 1.0, 0.0])
        rows.append(IDENTITY + [1.0, 2.0, -1.0, -2.0, 1.0, -3.0])
        rows.append([1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 1.0, 2.0, 3.0, -1.0, 1.0, 2.0])
        # Axis-aligned over the point, and touching the horizon at an end.
        rows.append(IDENTITY + [-1.0, 0.0, 1.0, 1.0, 0.0, 1.0])
        rows.append(IDENTITY + [1.0, 0.0, 0.0, 0.0, 1.0, 1.0])
        rows.append(IDENTITY + [1.0, 0.0, 0.0, 1.0, 0.0, 1.0])
        # Nearly end-on: a factor that rounds, a component moved by one step.
        while len(rows) < per_scenario // 2:
            p = [to_f32(uniform(rng, 0.5, 2.0)) for _ in range(3)]
            q = rounded([3.0 * c for c in p])
            q[len(rows) % 3] = f32_step(q[len(rows) % 3], 1)
            rows.append(material(rng, len(rows)) + p + q)
        # Scales.
        while len(rows) < per_scenario:
            scale = math.ldexp(1.0, 8 * (len(rows) - per_scenario // 2) - 96)
            rows.append(material(rng, len(rows)) + [scale * uniform(rng, 0.1, 2.0) for _ in range(6)])
        return [rounded(row) for row in rows]

    checked = itertools.count()

    def truth(row):
        mp.dps = FEWEST_DIGITS
        m = exact_matrix(row[:9])
        p1, p2 = ([mpf(c) for c in row[k : k + 3]] for k in (9, 12))
        weight = abs(determinant3(m)) * length3(cross3(p1, p2))
        visible = clip_segment(times(m, p1), times(m, p2))
        if weight == 0 or visible is None:
            return [mpf(0)]
        a, b, share = visible
        integral = line_by_antiderivatives(a, b)
        if next(checked) % 3 == 0:
            mp.dps = 60
            error = abs(line_by_angle(a, b) / integral - 1)
            assert error < mpf(10) ** -30, (row, error)
            mp.dps = FEWEST_DIGITS
        return [weight * share * integral / mp.pi]

    return Golden(
        inputs=[f"minv_{c}{r}" for c in range(3) for r in range(3)] + [f"{p}_{c}" for p in ("p1", "p2") for c in "xyz"],
        outputs=["irradiance"],
        conditions=[],
        scenarios={f.__name__: f for f in (ggx, far, grazing, near, horizon, long, edge)},
        truth=truth,
    )
