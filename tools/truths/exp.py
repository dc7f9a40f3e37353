"""Golden values of the family exp."""

from truths.common import *  # the small language in which truths are written


def exp():
    """Up to 700, so that a double holds the value."""
    return unary(lambda x: mp.exp(x), -87.0, 88.0, [math.log(2.0), 88.72284, 87.33654, 103.97208], largest=700.0)
