"""Golden values of the family asin."""

from truths.common import *  # the small language in which truths are written


def asin():
    """Undefined beyond 1."""
    return unary(lambda x: mp.asin(x), -1.0, 1.0, [1.0, 0.5, math.sqrt(0.5)], defined=lambda x: abs(x) <= 1)
