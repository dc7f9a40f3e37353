"""Golden values of the family acos."""

from truths.common import *  # the small language in which truths are written


def acos():
    """Undefined beyond 1."""
    return unary(lambda x: mp.acos(x), -1.0, 1.0, [1.0, 0.5, math.sqrt(0.5)], defined=lambda x: abs(x) <= 1)
