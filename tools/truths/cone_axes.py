"""Golden values of the family cone_axes."""

from truths.common import *  # the small language in which truths are written


def cone_axes():
    """Mean direction and tangents of the half angles of the cone over an ellipse with semi-axes hx, hy and centre c.

    Truth comes from mpmath's eigensolver applied to the dual matrix S = diag(hx^2, hy^2, 0) - c c^T and, independently
    where no tangent is 0, to the cone's own quadric adj(S), both formed in exact rational arithmetic: tan^2 are the
    ratios of eigenvalues to the one of the other sign. No cubic is solved. Where S has no negative eigenvalue, which
    is decided exactly, the origin lies in the light and everything is undefined.
    """
    per_scenario = 60

    def light(rng, aspect=5.0):
        """Semi-axes of about 1/16 to 8 in either order, and a direction."""
        longer = magnitude(rng, -3, 3)
        shorter = longer / math.sqrt(uniform(rng, 1.0, aspect * aspect))
        hx, hy = (longer, shorter) if rng.random() < 0.5 else (shorter, longer)
        return hx, hy, rotation(rng)[2]

    def row(hx, hy, c):
        return [to_f32(v) for v in (hx, hy, *c)]

    def scene(rng):
        """Lights as artists place them, 1/4 to 16 away."""
        rows = []
        for _ in range(per_scenario):
            hx, hy, (x, y, z) = light(rng)
            d = magnitude(rng, -2, 4)
            rows.append(row(hx, hy, (d * x, d * y, d * abs(z))))
        return rows

    def facing(rng):
        """Discs on the axis, then off by 2^-24 to 2^-6 in shape and place."""
        rows = []
        for i in range(per_scenario):
            r, d = to_f32(magnitude(rng, -4, 3)), magnitude(rng, -3, 4)
            off = [math.ldexp(uniform(rng, -1.0, 1.0), -24 + 18 * i // per_scenario) if i % 2 else 0.0 for _ in range(3)]
            rows.append(row(r, r * (1.0 + off[0]), (d * off[1], d * off[2], d)))
        return rows

    def far(rng):
        """Distances of 8 to 2^17 radii."""
        rows = []
        for i in range(per_scenario):
            hx, hy, (x, y, z) = light(rng)
            d = max(hx, hy) * magnitude(rng, 3 + 14 * i // per_scenario, 4 + 14 * i // per_scenario)
            rows.append(row(hx, hy, (d * x, d * y, d * abs(z))))
        return rows

    def near_plane(rng):
        """Heights of 2^-17 to 2^-3 radii, up to two semi-axes from the centre; every third one beside the rim."""
        rows = []
        for i in range(per_scenario):
            hx, hy, _ = light(rng)
            cos, sin = circle_point(rng)
            offset = 1.0 + math.ldexp(uniform(rng, -1.0, 1.0), -i // 3) if i % 3 == 0 else uniform(rng, 0.0, 2.0)
            height = max(hx, hy) * magnitude(rng, -17 + 14 * i // per_scenario, -16 + 14 * i // per_scenario)
            rows.append(row(hx, hy, (hx * offset * cos, hy * offset * sin, height)))
        return rows

    def needle(rng):
        """Aspects of 1 to 2^14, seen from 1/8 to 8 major semi-axes away."""
        rows = []
        for i in range(per_scenario):
            longer = magnitude(rng, -3, 3)
            shorter = longer / magnitude(rng, 14 * i // per_scenario, 1 + 14 * i // per_scenario)
            x, y, z = rotation(rng)[2]
            d = longer * magnitude(rng, -3, 3)
            hx, hy = (longer, shorter) if i % 2 else (shorter, longer)
            rows.append(row(hx, hy, (d * x, d * y, d * abs(z))))
        return rows

    def edge(rng):
        """Centres on the axis, in the plane, on the rim and within; zero and equal semi-axes; both sides; any scale."""
        rows = [[1.0, 1.0, 0.0, 0.0, 1.0], [1.0, 1.0, 0.0, 0.0, -2.0], [2.0, 1.0, 0.0, 0.0, 3.0], [1.0, 2.0, 0.0, 0.0, -3.0]]
        # In the plane: outside, on the rim, inside, at the centre.
        rows += [[1.0, 1.0, 2.0, 0.0, 0.0], [3.0, 2.0, 0.0, 5.0, 0.0], [3.0, 2.0, 3.0, 2.0, 0.0], [1.0, 2.0, 1.0, -0.0, -0.0]]
        rows += [[1.0, 1.0, 0.0, 1.0, 0.0], [5.0, 5.0, 3.0, 4.0, 0.0], [1.0, 2.0, 0.5, 0.5, 0.0], [1.0, 2.0, 0.0, 0.0, 0.0]]
        rows += [[5.0, 5.0, 3.0, f32_step(4.0, 1), 0.0], [1.0, 1.0, f32_step(1.0, 1), 0.0, 0.0], [1.0, 1.0, f32_step(1.0, -1), 0.0, 0.0]]
        # Above the rim, down to the least height.
        for exponent in (0, -10, -24, -60, -126, -149):
            rows += [[1.0, 1.0, 1.0, 0.0, math.ldexp(1.0, exponent)], [2.0, 1.0, 0.0, -1.0, -math.ldexp(1.0, exponent)]]
            rows.append([1.0, 1.0, 0.5, 0.0, math.ldexp(1.0, exponent)])
        # No area, no width, a point; the origin on a segment, beside it, at a point.
        rows += [[1.0, 0.0, 0.0, 0.0, 2.0], [0.0, 1.0, 1.0, 1.0, 2.0], [0.0, 0.0, 1.0, 2.0, 2.0], [0.0, 0.0, 0.0, 0.0, 0.0]]
        rows += [[1.0, 0.0, 0.5, 0.0, 0.0], [1.0, 0.0, 2.0, 0.0, 0.0], [0.0, 1.0, 0.0, 1.0, 0.0], [1.0, 0.0, 0.0, 3.0, 0.0]]
        rows += [[F32_MIN_SUBNORMAL, 1.0, 0.0, 0.0, 1.0], [1.0, 1.0, F32_MIN_SUBNORMAL, 0.0, 1.0]]
        while len(rows) < per_scenario:
            hx, hy, (x, y, z) = light(rng)
            exponent = (-100, -40, 40, 100)[len(rows) % 4]
            rows.append([math.ldexp(v, exponent) for v in (hx, hy, x, y, z)])
        return [[to_f32(c) for c in r] for r in rows]

    def by_dual(s):
        e, q = mpmath.eigsy(s)
        k = min(range(3), key=lambda i: e[i])
        rest = sorted((max(e[i], 0) for i in range(3) if i != k), reverse=True)
        return [q[i, k] for i in range(3)], [mp.sqrt(v / -e[k]) for v in rest]

    def by_quadric(adjugate):
        e, q = mpmath.eigsy(adjugate)
        k = max(range(3), key=lambda i: e[i])
        rest = sorted((-e[i] for i in range(3) if i != k))
        return [q[i, k] for i in range(3)], [mp.sqrt(max(e[k], 0) / v) for v in rest]

    def matrix(entries, scale):
        return mpmath.matrix([[mpf((v * scale).numerator) / (v * scale).denominator for v in line] for line in entries])

    def adjugate(s):
        def minor(i, j):
            a, b = [k for k in range(3) if k != i], [k for k in range(3) if k != j]
            return (-1) ** (i + j) * (s[a[0]][b[0]] * s[a[1]][b[1]] - s[a[0]][b[1]] * s[a[1]][b[0]])

        return [[minor(i, j) for i in range(3)] for j in range(3)]

    def power_of_two(entries):
        """The scale that brings the largest entry to about 1."""
        largest = max(abs(v) for line in entries for v in line)
        exponent = largest.numerator.bit_length() - largest.denominator.bit_length()
        return Fraction(1, 2**exponent) if exponent >= 0 else Fraction(2**-exponent)

    def truth(row):
        hx, hy, x, y, z = [Fraction(v) for v in row]
        c = (x, y, z)
        s = [[(hx * hx, hy * hy, 0)[i] * (i == j) - c[i] * c[j] for j in range(3)] for i in range(3)]
        trace = s[0][0] + s[1][1] + s[2][2]
        adj = adjugate(s)
        # S has at most one negative eigenvalue; it has none if all its invariants are >= 0.
        if hx * hy * z == 0 and trace >= 0 and adj[0][0] + adj[1][1] + adj[2][2] >= 0:
            return [None] * 5
        mp.dps = FEWEST_DIGITS
        while mp.dps <= MOST_DIGITS:
            dual = by_dual(matrix(s, power_of_two(s)))
            if hx * hy * z != 0:
                other = by_quadric(matrix(adj, power_of_two(adj)))
            else:
                dual[1][1] = mpf(0)
                if adj[0][0] + adj[1][1] + adj[2][2] == 0:
                    dual[1][0] = mpf(0)
                other = dual
            tolerance = mpf(AGREEMENT)
            agree = all(abs(a - b) <= tolerance * abs(a) for a, b in zip(dual[1], other[1]))
            pairs = list(zip(axis_cells(dual[0]), axis_cells(other[0])))
            if agree and all(abs(p - q) <= tolerance for p, q in pairs):
                axis = axis_cells(dual[0])
                sign = 1 if sum(a * mpf(v) for a, v in zip(axis, row[2:])) > 0 else -1
                return [sign * a for a in axis] + dual[1]
            mp.dps *= 2
        raise ArithmeticError(f"both eigensystems disagree at {MOST_DIGITS} digits on {row}")

    return Golden(
        inputs=["half_x", "half_y", "center_x", "center_y", "center_z"],
        outputs=["axis_x", "axis_y", "axis_z", "tan_major", "tan_minor"],
        conditions=[],
        scenarios={f.__name__: f for f in (scene, facing, far, near_plane, needle, edge)},
        truth=truth,
    )
