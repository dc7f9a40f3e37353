"""Golden values of the family sym3_eigen."""

from truths.common import *  # the small language in which truths are written


def sym3_eigen():
    """Eigenvalues, ascending, and eigenvectors of a symmetric 3x3 matrix.

    Truth comes from mpmath's symmetric eigensolver (tridiagonal QL), at the least precision where a second run with
    twice the digits agrees and the exact rational invariants (trace, sum of minors, determinant) are met. Zeros are
    decided by those invariants and equal eigenvalues by the exact discriminant; vectors of equal ones are undefined.
    """
    per_scenario = 60

    def spectrum(rng, values):
        frame = rotation(rng)

        def entry(i, j):
            return sum(v * q[i] * q[j] for v, q in zip(values, frame))

        return [to_f32(entry(i, j)) for i, j in ((0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2))]

    def outer(v):
        return [v[0] * v[0], v[1] * v[1], v[2] * v[2], v[0] * v[1], v[0] * v[2], v[1] * v[2]]

    def sign(rng):
        return 1.0 if rng.random() < 0.5 else -1.0

    def scene(rng):
        """Covariances of splats: axes of 2^-10 to 1, up to 32:1."""
        rows = []
        for _ in range(per_scenario):
            longest = magnitude(rng, -10, 0)
            rows.append(spectrum(rng, [(longest * magnitude(rng, -5, 0)) ** 2 for _ in range(3)]))
        return rows

    def near_equal(rng):
        """Two or three eigenvalues apart by 2^-26 to 2^-2 of themselves."""
        rows = []
        for i in range(per_scenario):
            value = sign(rng) * magnitude(rng, -6, 6)
            near = [value * (1.0 + magnitude(rng, -26 + 24 * i // per_scenario, -25 + 24 * i // per_scenario)) for _ in range(2)]
            third = near[1] if i % 2 else uniform(rng, -100.0, 100.0)
            rows.append(spectrum(rng, [value, near[0], third]))
        return rows

    def graded(rng):
        """Eigenvalues over up to 40 binary orders, or entries graded by d_i d_j over as many."""
        rows = []
        for i in range(per_scenario):
            if i % 2:
                rows.append(spectrum(rng, [sign(rng) * magnitude(rng, -40, 0) for _ in range(3)]))
            else:
                d = [magnitude(rng, -20, 0) for _ in range(3)]
                pairs = ((0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2))
                rows.append([to_f32(d[i] * d[j] * uniform(rng, -1.0, 1.0)) for i, j in pairs])
        return rows

    def indefinite(rng):
        """All entries uniform, at scales of 2^-10 to 2^10."""
        rows = []
        for _ in range(per_scenario):
            scale = magnitude(rng, -10, 10)
            rows.append([to_f32(scale * uniform(rng, -1.0, 1.0)) for _ in range(6)])
        return rows

    def light_cone(rng):
        """V1 V1^T + V2 V2^T - C C^T of ellipses of radius 1, 1/4 to 256 away."""
        rows = []
        for _ in range(per_scenario):
            u, v, _ = rotation(rng)
            minor, d = uniform(rng, 0.2, 1.0), magnitude(rng, -2, 8)
            c = [d * x for x in rotation(rng)[2]]
            parts = zip(outer(u), outer([minor * x for x in v]), outer(c))
            rows.append([to_f32(a + b - e) for a, b, e in parts])
        return rows

    def edge(rng):
        """Zero, diagonal, singular, exactly equal, subnormal, huge."""
        rows = [[0.0] * 6, [1.0, 2.0, 3.0, 0.0, 0.0, 0.0], [3.0, -1.0, 2.0, 0.0, 0.0, -0.0], [2.0, 2.0, 2.0, 0.0, 0.0, 0.0]]
        rows += [[1.0, 1.0, 2.0, 0.0, 0.0, 0.0], [1.0, F32_MIN_NORMAL, F32_MIN_SUBNORMAL, 0.0, 0.0, 0.0], [F32_MAX, -F32_MAX, 1.0, 0.0, 0.0, 0.0]]
        rows += [[-2.0, -2.0, -2.0, 1.0, 1.0, 1.0], [2.0, 2.0, 2.0, -1.0, 0.0, -1.0], [0.0, 0.0, 0.0, 1.0, 1.0, 1.0], [0.0, 0.0, 0.0, 1.0, 0.0, 0.0]]

        def integers():
            return [float(int(uniform(rng, -8.0, 9.0))) for _ in range(3)]

        for _ in range(8):
            rows.append(outer(integers()))
            rows.append([a - b for a, b in zip(outer(integers()), outer(integers()))])
            multiple = float(int(uniform(rng, -8.0, 9.0)))
            rows.append([a + (multiple if k < 3 else 0.0) for k, a in enumerate(outer(integers()))])
        while len(rows) < per_scenario:
            exponent = (-140, 100, 0)[len(rows) % 3]
            row = [math.ldexp(uniform(rng, -1.0, 1.0), exponent) for _ in range(6)]
            if exponent == 0:
                row[int(6 * rng.random())] = (F32_MIN_SUBNORMAL, 1e-20, 1e10, math.ldexp(1.0, 63))[len(rows) // 3 % 4]
            rows.append(row)
        return [[to_f32(c) for c in row] for row in rows]

    def invariants(row):
        xx, yy, zz, xy, xz, yz = [Fraction(v) for v in row]
        minors = xx * yy - xy * xy + xx * zz - xz * xz + yy * zz - yz * yz
        return xx + yy + zz, minors, xx * (yy * zz - yz * yz) - xy * (xy * zz - yz * xz) + xz * (xy * yz - yy * xz)

    def rational(x):
        return mpf(x.numerator) / x.denominator

    def solve(row, digits_now):
        mp.dps = digits_now
        xx, yy, zz, xy, xz, yz = [mpf(v) for v in row]
        largest = max(abs(v) for v in row)
        exponent = math.frexp(largest)[1]
        a = mpmath.matrix([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]]) * mp.ldexp(1, -exponent)
        e, q = mpmath.eigsy(a)
        order = sorted(range(3), key=lambda k: e[k])
        return [mp.ldexp(e[k], exponent) for k in order], [[q[i, k] for i in range(3)] for k in order]

    def truth(row):
        trace, minors, det = invariants(row)
        if not any(row):
            return [mpf(0)] * 3 + [None] * 9
        # The discriminant of e^3 - trace e^2 + minors e - det.
        discriminant = (
            18 * trace * minors * det - 4 * trace**3 * det + trace**2 * minors**2 - 4 * minors**3 - 27 * det**2
        )
        digits_now = FEWEST_DIGITS
        while digits_now <= MOST_DIGITS:
            finer, finer_vectors = solve(row, 2 * digits_now)
            values, vectors = solve(row, digits_now)
            tolerance = mpf(AGREEMENT)
            by_size = sorted(range(3), key=lambda k: abs(values[k]))
            zeros = [] if det != 0 else by_size[: 1 if minors != 0 else 2]
            gaps = [values[1] - values[0], values[2] - values[1]]
            equal = []
            if discriminant == 0:
                equal = [0, 1] if abs(gaps[0]) < tolerance * abs(values[by_size[2]]) else []
                equal += [1, 2] if abs(gaps[1]) < tolerance * abs(values[by_size[2]]) else []
            agree = discriminant != 0 or bool(equal)
            for k in range(3):
                if k in zeros:
                    values[k] = mpf(0)
                elif abs(values[k] - finer[k]) > tolerance * abs(values[k]):
                    agree = False
            product, pairs = values[0] * values[1] * values[2], values[0] * values[1] + values[0] * values[2] + values[1] * values[2]
            norm = max(abs(v) for v in values)
            agree = agree and abs(product - rational(det)) <= tolerance * abs(product)
            agree = agree and abs(pairs - rational(minors)) <= tolerance * norm**2
            agree = agree and abs(sum(values) - rational(trace)) <= tolerance * norm
            cells = []
            for k in range(3):
                if k in equal:
                    cells += [None] * 3
                    continue
                one, other = axis_cells(vectors[k]), axis_cells(finer_vectors[k])
                agree = agree and all(abs(p - q) <= tolerance for p, q in zip(one, other))
                cells += one
            if agree:
                return values + cells
            digits_now *= 2
        raise ArithmeticError(f"no agreement at {MOST_DIGITS} digits on {row}")

    return Golden(
        inputs=["xx", "yy", "zz", "xy", "xz", "yz"],
        outputs=["e0", "e1", "e2"] + [f"q{k}_{c}" for k in range(3) for c in "xyz"],
        conditions=[],
        tolerances=[
            ("e0", "1e-11", "plain f64 is taken while its own bound stays below this"),
            ("e1", "1e-11", "plain f64 is taken while its own bound stays below this"),
            ("e2", "1e-11", "plain f64 is taken while its own bound stays below this"),
            ("q0", "1e-11", "plain f64 is taken while its own bound stays below this"),
            ("q1", "1e-11", "plain f64 is taken while its own bound stays below this"),
            ("q2", "1e-11", "plain f64 is taken while its own bound stays below this"),
        ],
        scenarios={f.__name__: f for f in (scene, near_equal, graded, indefinite, light_cone, edge)},
        truth=truth,
    )
