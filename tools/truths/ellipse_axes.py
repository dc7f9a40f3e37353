"""Golden values of the family ellipse_axes."""

from truths.common import *  # the small language in which truths are written


def ellipse_axes():
    """Semi-axes of the ellipse with conjugate semi-diameters V1, V2: singular values and left singular vectors of the
    3x2 matrix A = [V1 V2].

    Truth comes from mpmath's SVD of A and, independently, from its eigensolver applied to the 3x3 matrix A A^T. No
    closed form is involved. Degeneracy is decided in exact rational arithmetic: V1 x V2 = 0 (minor_len is 0 and the
    minor axis undefined), |V1| = |V2| with V1.V2 = 0 (a circle: both axes undefined).

    Conditions: gap = (major_len - minor_len)/major_len, which divides the error of the axes; aspect =
    major_len/minor_len, which multiplies the relative error of minor_len under perturbed inputs; skew =
    |V1||V2|/|V1 x V2|, which multiplies the relative error of the area when its products are rounded.
    """
    per_scenario = 60

    def pair(frame, major, minor, cos_phi, sin_phi):
        """Conjugate semi-diameters at eccentric angle phi of the ellipse with these semi-axes, rounded to f32."""
        u, v, _ = frame
        v1 = [major * cos_phi * a + minor * sin_phi * b for a, b in zip(u, v)]
        v2 = [minor * cos_phi * b - major * sin_phi * a for a, b in zip(u, v)]
        return [to_f32(c) for c in v1 + v2]

    def scene(rng):
        """Lights as artists place them: radii 1/8 to 8, half of them with orthogonal semi-diameters."""
        rows = []
        for i in range(per_scenario):
            a, b = magnitude(rng, -3, 3), magnitude(rng, -3, 3)
            phi = (1.0, 0.0) if i % 2 else circle_point(rng)
            rows.append(pair(rotation(rng), a, b, *phi))
        return rows

    def aspect(rng):
        """Aspect 1 to 1e7, evenly in binary exponent; long axis in V1, in V2, shared equally, shared at random."""
        half = math.sqrt(0.5)
        rows = []
        for i in range(per_scenario):
            ratio = min(magnitude(rng, i * 24 // per_scenario, i * 24 // per_scenario + 1), 1e7)
            major = magnitude(rng, -2, 2)
            phi = ((1.0, 0.0), (0.0, 1.0), (half, half), circle_point(rng))[i % 4]
            rows.append(pair(rotation(rng), major, major / ratio, *phi))
        return rows

    def near_circle(rng):
        """Gaps 2^-1 to 2^-24 and below: drawn, f32 neighbours of a circle, and the tiniest third component."""
        rows = []
        for k in range(1, 25):
            r = magnitude(rng, -2, 2)
            rows.append(pair(rotation(rng), r, r * (1.0 - math.ldexp(1.0, -k)), *circle_point(rng)))
        for _ in range(12):
            r = magnitude(rng, -2, 2)
            rows.append(pair(rotation(rng), r, r, *circle_point(rng)))
        for i in range(12):
            r = to_f32(magnitude(rng, -2, 2))
            neighbour = f32_step(r, (1, -1, 2, -3)[i % 4])
            v = [[r, 0.0, 0.0], [0.0, neighbour, 0.0]]
            rows.append([v[j][(c + i // 4) % 3] for j in range(2) for c in range(3)])
        for k in range(1, 13):
            # Exactly orthogonal, and lengths that differ by z^2/2 in relative terms: gaps 2^-3 to 2^-25.
            x, y = (to_f32(magnitude(rng, -2, 2)) for _ in range(2))
            z = to_f32(math.ldexp(math.sqrt(x * x + y * y), -k))
            rows.append([x, y, 0.0, -y, x, z])
        return rows

    def scale(rng):
        """A scene at scales 2^-40 to 2^40, then V1 and V2 at different scales, subnormal, and near the f32 limit."""
        rows = []

        def at(exponent1, exponent2):
            # Orthogonal semi-diameters at equal scales say nothing about d12: draw an eccentric angle always.
            row = pair(rotation(rng), magnitude(rng, -1, 1), magnitude(rng, -3, 1), *circle_point(rng))
            exponents = [exponent1] * 3 + [exponent2] * 3
            rows.append([to_f32(math.ldexp(c, e)) for c, e in zip(row, exponents)])

        for exponent in range(-40, 41, 2):
            at(exponent, exponent)
        for exponent1, exponent2 in ((-40, 40), (40, -40), (-20, 20), (20, -20), (0, -40), (40, 0), (-100, 100)):
            at(exponent1, exponent2)
        for exponent in (-120, -126, -130, -135, -140, -145):
            at(exponent, exponent)
        for exponent in (100, 110, 120, 122, 123, 124):
            at(exponent, exponent)
        return rows

    def edge(rng):
        """Parallel, zero, circular, axis-aligned and neighbouring vectors, with the signs and limits of f32."""
        zero, x, y, z = [0.0] * 3, [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]

        def times(v, factor):
            return [c * factor for c in v]

        rows = [zero + zero, times(x, 0.0) + times(y, -0.0), x + zero, zero + z, [0.0, 3.0, 4.0] + zero]
        rows += [zero + [1.0, -2.0, 2.0], [F32_MIN_SUBNORMAL, 0.0, 0.0] + zero, [F32_MAX, 0.0, 0.0] + zero]
        # Parallel, exactly: minor_len is 0.
        for v, factor in itertools.product(([1.0, 2.0, 3.0], [-5.0, 0.0, 7.0]), (1.0, -1.0, 3.0, math.ldexp(1.0, -40))):
            rows.append(v + times(v, factor))
        # Circles, exactly: both axes undefined.
        rows += [x + y, y + x, z + times(x, -1.0), times(y, 1e10) + times(z, -1e10), [3.0, 4.0, 0.0, -4.0, 3.0, 0.0]]
        rows += [[1.0, 2.0, 2.0, 2.0, 1.0, -2.0], [2.0, 3.0, 6.0, 6.0, 2.0, -3.0]]
        rows += [times(x, F32_MIN_SUBNORMAL) + times(y, F32_MIN_SUBNORMAL), times(y, F32_MAX) + times(z, F32_MAX)]
        # Axis-aligned, either order, aspect 2 to 2^149.
        for u, v in itertools.permutations((x, y, z), 2):
            rows.append(times(u, 2.0) + v)
        rows += [x + times(z, F32_MIN_NORMAL), times(y, F32_MIN_SUBNORMAL) + z, x + times(y, math.ldexp(1.0, -24))]
        # Equal lengths, not orthogonal (tau is 0), either sign of V1.V2; then equal up to one f32 step.
        rows += [[1.0, 1.0, 0.0, 1.0, 0.0, 1.0], [1.0, 1.0, 0.0, -1.0, 0.0, 1.0], [2.0, 1.0, 2.0, 2.0, -1.0, 2.0]]
        rows += [[1.0, 1e-4, 0.0, 1.0, -1e-4, 0.0], [1.0, 1e-4, 0.0, -1.0, 1e-4, 0.0]]
        rows += [[1.0, 1.0, 0.0, 1.0, 0.0, f32_step(1.0, 1)], [1.0, 1.0, 0.0, 1.0, 0.0, f32_step(1.0, -1)]]
        # V1.V2 is tiny: orthogonal up to one small component, at aspects 2 and 1.
        rows += [[2.0, 0.0, 0.0, 1e-7, 1.0, 0.0], [1.0, 1e-7, 0.0, 0.0, 1.0, 0.0], [1.0, 1e-20, 0.0, 0.0, 2.0, 0.0]]
        # Nearly parallel: V2 is V1 with one component moved by an f32 step, the area a few steps of its products.
        while len(rows) < per_scenario:
            v = [to_f32(uniform(rng, -2.0, 2.0)) for _ in range(3)]
            moved = list(v)
            moved[len(rows) % 3] = f32_step(v[len(rows) % 3], 1 + len(rows) % 2)
            rows.append(v + moved)
        return [[to_f32(c) for c in row] for row in rows]

    def by_svd(a):
        u, s, _ = mpmath.svd_r(a)
        return s[0], s[1], [u[i, 0] for i in range(3)], [u[i, 1] for i in range(3)]

    def by_eigenvalues(a):
        e, q = mpmath.eigsy(a * a.T)
        lengths = [mp.sqrt(max(e[k], 0)) for k in (2, 1)]
        return *lengths, [q[i, 2] for i in range(3)], [q[i, 1] for i in range(3)]

    def solve(row, parallel, circle):
        """Lengths and axes, at the least precision where both solvers agree. Axes are None where undefined."""
        exponent = max(math.frexp(c)[1] for c in row if c != 0.0)
        mp.dps = FEWEST_DIGITS
        while mp.dps <= MOST_DIGITS:
            # A power of two is exact and spares the solvers' absolute thresholds.
            a = mpmath.matrix(3, 2)
            for i in range(3):
                a[i, 0], a[i, 1] = (mp.ldexp(mpf(row[i + 3 * j]), -exponent) for j in range(2))
            major_len, minor_len, major, minor = by_svd(a)
            other_major_len, other_minor_len, other_major, other_minor = by_eigenvalues(a)
            tolerance = mpf(AGREEMENT)
            agree = abs(major_len - other_major_len) <= tolerance * major_len
            if parallel:
                agree = agree and max(minor_len, other_minor_len) <= tolerance * major_len
                minor_len, minor = mpf(0), None
            else:
                agree = agree and abs(minor_len - other_minor_len) <= tolerance * minor_len
            if circle:
                agree = agree and abs(major_len - minor_len) <= tolerance * major_len
                minor_len, major, minor = major_len, None, None
            for axis, other in ((major, other_major), (minor, other_minor)):
                if axis is not None:
                    pairs = list(zip(axis_cells(axis), axis_cells(other)))
                    agree = agree and all(abs(p - q) <= tolerance for p, q in pairs)
            if agree:
                return mp.ldexp(major_len, exponent), mp.ldexp(minor_len, exponent), major, minor
            mp.dps *= 2
        raise ArithmeticError(f"SVD and eigensolver disagree at {MOST_DIGITS} digits on {row}")

    def truth(row):
        v1, v2 = [[Fraction(c) for c in row[3 * j : 3 * j + 3]] for j in range(2)]
        d11, d22, d12 = (sum(a * b for a, b in zip(p, q)) for p, q in ((v1, v1), (v2, v2), (v1, v2)))
        area2 = d11 * d22 - d12 * d12
        if d11 + d22 == 0:
            return [None] * 6 + [mpf(0), mpf(0)] + [None] * 3
        circle = d11 == d22 and d12 == 0
        major_len, minor_len, major, minor = solve(row, area2 == 0, circle)
        gap = (major_len - minor_len) / major_len
        aspect_ratio = skew = None
        if area2 != 0:
            aspect_ratio = major_len / minor_len
            sin2 = area2 / (d11 * d22)
            skew = 1 / mp.sqrt(mpf(sin2.numerator) / sin2.denominator)
        axes = [c for axis in (major, minor) for c in (axis_cells(axis) if axis else [None] * 3)]
        return axes + [major_len, minor_len, gap, aspect_ratio, skew]

    def xyz(*names):
        return [f"{name}_{c}" for name in names for c in "xyz"]

    return Golden(
        inputs=xyz("v1", "v2"),
        outputs=xyz("major", "minor") + ["major_len", "minor_len"],
        conditions=["gap", "aspect", "skew"],
        tolerances=[
            ("major", "4.5e-16/gap", "dot products in f64 turn the axes by at most 2^-51/gap"),
            ("minor", "4.5e-16/gap", "dot products in f64 turn the axes by at most 2^-51/gap"),
        ],
        scenarios={f.__name__: f for f in (scene, aspect, near_circle, scale, edge)},
        truth=truth,
    )
