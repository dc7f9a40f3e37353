"""Golden values of the family orthonormal_basis."""

from truths.common import *  # the small language in which truths are written


def orthonormal_basis():
    """The residuals of given bases, right and wrong ones.

    There is no one true basis, so a row's outputs are an answer that is exact in f32: the axis on which n is smallest,
    orthogonalised against n (Gram and Schmidt) and completed by a cross product, then rounded; two of three rows spoil
    it in one of seven ways. The residuals are worked from the Gram matrix G of (b1, b2, n/|n|): its diagonal and
    off-diagonal elements, and the root of its determinant with the sign of the volume.

    Conditions: b1_residual, b2_residual, the largest magnitude of the residuals that an output takes part in.
    """
    per_scenario = 60

    def unit(rng):
        return rotation(rng)[0]

    def store(n):
        return [to_f32(c) for c in n]

    def near_z(rng, i, sign):
        gap = min(magnitude(rng, -24 + i * 24 // per_scenario, -23 + i * 24 // per_scenario), 1.0)
        c, s = circle_point(rng)
        r = math.sqrt(gap * (2.0 - gap))
        return store([r * c, r * s, sign * (1.0 - gap)])

    def sphere(rng):
        return [store(unit(rng)) for _ in range(per_scenario)]

    def near_minus_z(rng):
        """1 + z from 2^-24 to 1."""
        return [near_z(rng, i, -1.0) for i in range(per_scenario)]

    def near_plus_z(rng):
        """1 - z from 2^-24 to 1."""
        return [near_z(rng, i, 1.0) for i in range(per_scenario)]

    def equator(rng):
        """|z| from 2^-40 to 1."""
        rows = []
        for i in range(per_scenario):
            z = (1 if i % 2 else -1) * min(magnitude(rng, -40 + i * 2 // 3, -39 + i * 2 // 3), 1.0)
            c, s = circle_point(rng)
            r = math.sqrt(1.0 - z * z)
            rows.append(store([r * c, r * s, z]))
        return rows

    def not_unit(rng):
        """Lengths off by 2^-24 to 2^-12, and a few of quite another scale."""
        rows = []
        for i in range(per_scenario):
            scale = 1.0 + (1 if i % 2 else -1) * magnitude(rng, -24 + i // 5, -23 + i // 5)
            if i % 10 == 9:
                scale = math.ldexp(1.0, 24 * (i // 10) - 60)
            rows.append(store([scale * c for c in unit(rng)]))
        return rows

    def edge(rng):
        """Axes, zeros of either sign, coordinate planes, diagonals, steps off the poles."""
        rows = [[s if k == j else z for k in range(3)] for j in range(3) for s in (1.0, -1.0) for z in (0.0, -0.0)]
        for j in range(3):
            for s in (1.0, -1.0):
                c, d = circle_point(rng)
                rows.append(store([-0.0 if k == j else (c, s * d)[k == (j + 1) % 3] for k in range(3)]))
        third, half = math.sqrt(1.0 / 3.0), math.sqrt(0.5)
        rows += [store([a * third, b * third, c * third]) for a in (1, -1) for b in (1, -1) for c in (1, -1)]
        rows += [store([half, 0.0, -half]), store([0.0, -half, half]), store([-half, half, 0.0])]
        while len(rows) < per_scenario:
            tiny = f32_step(0.0, 1 + len(rows) % 90)
            z = f32_step(1.0, -(len(rows) % 5)) * (1 if len(rows) % 2 else -1)
            x = math.sqrt(max(0.0, 1.0 - z * z))
            rows.append(store([(tiny, x)[len(rows) % 3 > 0], tiny, z]))
        return rows

    def dot(p, q):
        return sum(s * t for s, t in zip(p, q))

    def cross(p, q):
        return [p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]]

    def normalized(v):
        length = mp.sqrt(dot(v, v))
        return [c / length for c in v]

    def spoiled(b1, b2, n, way, size):
        def add(v, w):
            return [c + size * d for c, d in zip(v, w)]

        return [
            (b1, b2),
            ([(1 + size) * c for c in b1], b2),
            (b1, [(1 - size) * c for c in b2]),
            (add(b1, n), b2),
            (b1, add(b2, n)),
            (add(b1, b2), b2),
            (b2, b1),
            ([-c for c in b1], add(b2, b1)),
        ][way]

    def truth(row):
        mp.dps = FEWEST_DIGITS
        n = normalized([mpf(c) for c in row])
        least = min(range(3), key=lambda k: abs(n[k]))
        e = [mpf(k == least) for k in range(3)]
        b1 = normalized([a - n[least] * c for a, c in zip(e, n)])
        b2 = cross(n, b1)
        truth.calls += 1
        way = 0 if truth.calls % 3 == 0 else 1 + truth.calls % 7
        b1, b2 = spoiled(b1, b2, n, way, mpf(2) ** -(2 + truth.calls % 18))
        b1, b2 = ([mpf(to_f32(float(c))) for c in b] for b in (b1, b2))
        frame = (b1, b2, n)
        gram = mp.matrix([[dot(p, q) for q in frame] for p in frame])
        volume = mp.sqrt(mp.det(gram)) * mp.sign(dot(cross(b1, b2), n))
        shared = [abs(gram[0, 1]), abs(volume - 1)]
        residuals = [max([abs(gram[k, k] - 1), abs(gram[k, 2])] + shared) for k in (0, 1)]
        return b1 + b2 + residuals

    truth.calls = 0

    return Golden(
        inputs=[f"n_{c}" for c in "xyz"],
        outputs=[f"b{k}_{c}" for k in (1, 2) for c in "xyz"],
        conditions=["b1_residual", "b2_residual"],
        scenarios={f.__name__: f for f in (sphere, near_minus_z, near_plus_z, equator, not_unit, edge)},
        truth=truth,
        method=f"Answers right and wrong, exact in f32, and their residuals in {FEWEST_DIGITS} digits from Gram matrices",
    )
