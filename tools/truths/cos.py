"""Golden values of the family cos."""

from truths.common import *  # the small language in which truths are written


def cos():
    """mpmath reduces an argument with as many digits of pi as it needs; the edges have f32 that lie close to multiples of
    pi/2, such as 16367173 * 2^72."""
    return unary(lambda x: mp.cos(x), -math.pi, math.pi, [math.pi / 4, math.pi / 2, math.pi, 2 * math.pi, 355.0, 22.0], [16367173.0 * 2.0**72, 1e10, 1e20, 1e30, 13176795.0 / 2**22])
