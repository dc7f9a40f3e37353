"""Golden values of the family log."""

from truths.common import *  # the small language in which truths are written


def log():
    """Undefined from 0 downwards."""
    return unary(lambda x: mp.log(x), 0.25, 4.0, [1.0, 0.5, 2.0, math.e], defined=lambda x: x > 0)
