"""Golden values of the family inversesqrt."""

from truths.common import *  # the small language in which truths are written


def inversesqrt():
    """Undefined from 0 downwards."""
    return unary(lambda x: 1 / mp.sqrt(x), 0.0, 4.0, [1.0, 4.0, 2.0], defined=lambda x: x > 0)
