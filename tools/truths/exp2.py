"""Golden values of the family exp2."""

from truths.common import *  # the small language in which truths are written


def exp2():
    """Up to 1000, so that a double holds the value."""
    return unary(lambda x: mp.mpf(2) ** x, -126.0, 128.0, [1.0, 10.0, 126.0, 128.0, 149.0], largest=1000.0)
