"""Golden values of ellipsoid_solid_angle."""

from truths.common import *  # the small language in which truths are written
from truths.ellipse_solid_angle import cone_solid_angle
from truths.ellipsoid_ellipse import ELLIPSOID_COLUMNS, ellipsoid_scenarios, outline


def ellipsoid_solid_angle():
    """See cone_solid_angle; S = R D^2 R^T - c c^T, in rational arithmetic until its eigenvalues are taken."""

    def truth(row):
        seen, inside = outline(row)
        if seen is None:
            return [4 * mp.pi if inside else mpf(0)]
        c, axes, r, _, _ = seen
        scale = max(abs(x) for x in c + r)
        mp.dps = 400
        matrix = mpmath.matrix(3, 3)
        for i in range(3):
            for j in range(3):
                entry = (sum(s * s * axis[i] * axis[j] for s, axis in zip(r, axes)) - c[i] * c[j]) / scale**2
                matrix[i, j] = mpf(entry.numerator) / entry.denominator
        return [cone_solid_angle(matrix)]

    return Golden(
        method="mpmath, 400 digits of the eigenvalues and of the integral of the third kind; quadrature agrees to 1e-18",
        inputs=ELLIPSOID_COLUMNS,
        outputs=["solid_angle"],
        conditions=[],
        scenarios=ellipsoid_scenarios(24),
        truth=truth,
    )
