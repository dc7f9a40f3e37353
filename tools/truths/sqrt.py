"""Golden values of the family sqrt."""

from truths.common import *  # the small language in which truths are written


def sqrt():
    """Undefined below 0."""
    return unary(lambda x: mp.sqrt(x), 0.0, 4.0, [1.0, 4.0, 2.0], defined=lambda x: x >= 0)
