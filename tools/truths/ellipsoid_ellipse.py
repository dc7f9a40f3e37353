"""Golden values of ellipsoid_ellipse; and the rows of ellipsoids that other families draw."""

from truths.common import *  # the small language in which truths are written

ELLIPSOID_COLUMNS = [f"center_{c}" for c in "xyz"] + [f"rotation_{c}" for c in "xyzw"] + [f"radius_{c}" for c in "xyz"]


def quaternion(rng):
    while True:
        q = [uniform(rng, -1.0, 1.0) for _ in range(4)]
        if 1e-2 < sum(x * x for x in q) <= 1.0:
            return q


def columns(q):
    """The rotation's columns of q/|q|, in whatever numbers q has; the identity for q = 0."""
    n = sum(x * x for x in q)
    x, y, z, w = q
    if n == 0:
        return [[1, 0, 0], [0, 1, 0], [0, 0, 1]]
    rows = (
        (n - 2 * (y * y + z * z), 2 * (x * y + z * w), 2 * (x * z - y * w)),
        (2 * (x * y - z * w), n - 2 * (x * x + z * z), 2 * (y * z + x * w)),
        (2 * (x * z + y * w), 2 * (y * z - x * w), n - 2 * (x * x + y * y)),
    )
    return [[c / n for c in column] for column in rows]


def ellipsoid_scenarios(per_scenario):
    """Rows of centre, quaternion and semi-axes."""

    def row(c, q, r):
        return [to_f32(x) for part in (c, q, r) for x in part]

    def scene(radii, off):
        def draw(rng):
            rows = []
            for _ in range(per_scenario):
                q, r, d = quaternion(rng), radii(rng), rotation(rng)[0]
                local = [(1.0 + off(rng)) * p * s for p, s in zip(d, r)]
                c = [sum(axis[i] * p for axis, p in zip(columns(q), local)) for i in range(3)]
                rows.append(row(c, q, r))
            return rows

        return draw

    def round_radii(rng):
        return [uniform(rng, 0.25, 1.0) for _ in range(3)]

    def sphere_radii(rng):
        size = magnitude(rng, -4, 0)
        if rng.random() < 0.5:
            return [size] * 3
        return [size * (1.0 - magnitude(rng, -23, -6)) for _ in range(3)]

    def edge(rng):
        q, one = quaternion(rng), [0.0, 0.0, 0.0, 1.0]
        rows = [row([0.1, 0.05, 0.0], q, [1.0, 0.5, 0.25]), row([0.0] * 3, q, [1.0] * 3), row([0.0] * 3, q, [0.0] * 3)]
        rows += [row([1.0, 1.0, 1.0], q, r) for r in ([1.0, 0.0, 0.0], [0.0] * 3)]
        rows += [row([1.0, 2.0, 3.0], q, r) for r in ([1.0, 2.0, 0.0], [0.0, 0.5, 1.0], [0.5, 0.0, 1.0])]
        rows += [row([3.0, 0.0, 0.0], one, [1.0, 1.0, 0.0]), row([0.0, 0.0, 2.0], one, [1.0, 0.5, 2.0])]
        rows += [row([0.0, 0.0, 4.0], one, [1.0, 1.0, 2.0]), row([0.0, -4.0, 0.0], one, [0.5, 2.0, 0.5])]
        rows += [row([2.0, 3.0, 6.0], [s, 0.0, 0.0, s], [1.0, 2.0, 4.0]) for s in (0.0, 1.0, -3.0, 1e6, 1e-6, 1e-20)]
        rows += [row([0.0, 0.0, f32_step(2.0, k)], one, [1.0, 0.5, 2.0]) for k in (1, 2, -1)]
        rows += [row([1.5, 2.5, -3.5], [0.5, 0.5, -0.5, 0.5], [1.0, 0.5, 2.0])]
        for exponent in (-30, -20, 20, 30):
            s = math.ldexp(1.0, exponent)
            rows.append(row([2.0 * s, s, 0.5 * s], q, [s, 0.5 * s, 0.25 * s]))
        return rows

    return {
        "scene": scene(round_radii, lambda rng: magnitude(rng, -4, 6)),
        "sphere": scene(sphere_radii, lambda rng: magnitude(rng, -4, 6)),
        "flat": scene(lambda rng: [magnitude(rng, -10, 0) for _ in range(3)], lambda rng: magnitude(rng, -3, 4)),
        "far": scene(round_radii, lambda rng: magnitude(rng, 4, 17)),
        "near_surface": scene(round_radii, lambda rng: magnitude(rng, -17, -3)),
        "edge": edge,
    }


def outline(row):
    """(centre, rotation's columns, semi-axes, b = R^T c, |D^-1 b|^2 or None for infinity), exact rationals; None where no
    ellipse is seen, with whether the point is inside."""
    cells = [Fraction(x) for x in row]
    c, q, r = cells[:3], cells[3:7], [abs(x) for x in cells[7:]]
    axes = columns(q)
    b = [sum(p * x for p, x in zip(axis, c)) for axis in axes]
    flat = [k for k in range(3) if r[k] == 0]
    if len(flat) > 1 or (flat and b[flat[0]] == 0):
        return None, False
    if flat:
        return (c, axes, r, b, None), False
    square = sum((x / s) ** 2 for x, s in zip(b, r))
    if square <= 1:
        return None, True
    return (c, axes, r, b, square), False


def ellipsoid_ellipse():
    """Truth is the 3x3 eigensystem of (1 - 1/s)(E - c c^T/s), E = R D^2 R^T and s = c^T E^-1 c, whose eigenvectors are the
    axes and whose eigenvalues their squared lengths, by mpmath in two precisions that agree. Whether the point is inside,
    and whether the ellipse is a circle, is decided in exact rational arithmetic."""

    def real(f):
        return mpf(f.numerator) / f.denominator

    def solve(axes, r, c, square):
        matrix = mpmath.matrix(3, 3)
        share = 1 if square is None else 1 - 1 / real(square)
        for i in range(3):
            for j in range(3):
                entry = sum(real(s * s * axis[i] * axis[j]) for s, axis in zip(r, axes))
                if square is not None:
                    entry -= real(c[i] * c[j] / square)
                matrix[i, j] = share * entry
        scale = max(real(s) for s in r) ** 2
        e, q = mpmath.eigsy(matrix / scale)
        lengths = [mp.sqrt(scale * e[k]) for k in (2, 1)]
        return share, lengths, [[q[i, k] for i in range(3)] for k in (2, 1)]

    def truth(row):
        seen, _ = outline(row)
        if seen is None:
            return [mpf(0)] * 9
        c, axes, r, b, square = seen
        found = []
        for digits_used in (120, 160):
            mp.dps = digits_used
            found.append(solve(axes, r, c, square))
        (share, lengths, vectors), (_, other_lengths, other_vectors) = found[1], found[0]
        center = [share * real(x) for x in c]
        gap = (lengths[0] - lengths[1]) / lengths[0]
        if gap < mpf("1e-50"):
            return center + [None] * 6
        cells = []
        for length, axis, other_length, other in zip(lengths, vectors, other_lengths, other_vectors):
            unit, check = axis_cells(axis), axis_cells(other)
            if not (abs(length - other_length) <= mpf("1e-60") * length and all(abs(p - q) < mpf("1e-40") for p, q in zip(unit, check))):
                raise ArithmeticError(f"{found} on {row}")
            cells += [length * p for p in unit]
        return center + cells

    return Golden(
        method="mpmath, eigensystems of the ellipse's dual quadric in 120 and 160 digits agreeing to 1e-40",
        inputs=ELLIPSOID_COLUMNS,
        outputs=[f"{name}_{c}" for name in ("center", "major", "minor") for c in "xyz"],
        conditions=[],
        scenarios=ellipsoid_scenarios(24),
        truth=truth,
    )
