"""Golden values of the family atan."""

from truths.common import *  # the small language in which truths are written


def atan():
    """Everywhere."""
    return unary(lambda x: mp.atan(x), -4.0, 4.0, [1.0, 0.5, 2.0, 1e9])
