"""Golden values of the family log2."""

from truths.common import *  # the small language in which truths are written


def log2():
    """Undefined from 0 downwards."""
    return unary(lambda x: mp.log(x) / mp.log(2), 0.25, 4.0, [1.0, 0.5, 2.0, math.e], defined=lambda x: x > 0)
