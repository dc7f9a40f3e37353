"""What the families' truths share: f32, draws, printing, and what a file consists of."""

import itertools
import math
import random
import struct
import sys
from fractions import Fraction
from typing import Callable, NamedTuple

try:
    import mpmath
    from mpmath import mp, mpf
except ImportError:
    sys.exit("golden.py needs the Python package mpmath (Debian: python3-mpmath)")

PRINTED_DIGITS = 25
FEWEST_DIGITS = 120
MOST_DIGITS = 1920
# Two independent solvers agree this well before a row is written: 25 digits of the smallest printed component.
AGREEMENT = "1e-75"
SMALLEST_COMPONENT = "1e-50"


class Golden(NamedTuple):
    """The content of one file. `scenarios` maps a name to a function from a random source to input rows; `truth`
    maps one input row to its outputs followed by its conditions, None for an empty cell."""

    inputs: list[str]
    outputs: list[str]
    conditions: list[str]
    scenarios: dict[str, Callable[[random.Random], list[list[float]]]]
    truth: Callable[[list[float]], list]
    method: str = f"Worked in {FEWEST_DIGITS} digits or more, two solvers agreeing to {AGREEMENT}"
    # (output, relative tolerance or tolerance/condition, reason) where an oracle promises less than 1e-13.
    tolerances: list[tuple[str, str, str]] = []


# --- f32 -------------------------------------------------------------------------------------------------------------

F32_MAX = math.ldexp(2.0 - 2.0**-23, 127)
F32_MIN_NORMAL = math.ldexp(1.0, -126)
F32_MIN_SUBNORMAL = math.ldexp(1.0, -149)


def to_f32(x):
    """The nearest f32 to a Python float."""
    return struct.unpack("<f", struct.pack("<f", x))[0]


def f32_step(x, steps):
    """The f32 that lies `steps` representable values away from zero, seen from x (towards it if negative)."""
    bits = struct.unpack("<i", struct.pack("<f", x))[0]
    return struct.unpack("<f", struct.pack("<i", bits + steps))[0]


def hex_float(x):
    """The shortest C hex float: 0x1.8p+3, -0x0p+0."""
    mantissa, exponent = x.hex().split("p")
    if "." in mantissa:
        mantissa = mantissa.rstrip("0").rstrip(".")
    return f"{mantissa}p{exponent}"


# --- draws -----------------------------------------------------------------------------------------------------------


def uniform(rng, low, high):
    return low + (high - low) * rng.random()


def magnitude(rng, low_exponent, high_exponent):
    """A positive number whose binary exponent is uniform in low..high-1, with a uniform mantissa."""
    exponent = low_exponent + int(rng.random() * (high_exponent - low_exponent))
    return math.ldexp(uniform(rng, 1.0, 2.0), exponent)


def circle_point(rng):
    """(cos, sin) of a uniform angle, by rejection: no library sine whose last bit depends on the platform."""
    while True:
        x, y = uniform(rng, -1.0, 1.0), uniform(rng, -1.0, 1.0)
        r2 = x * x + y * y
        if 1e-3 < r2 <= 1.0:
            r = math.sqrt(r2)
            return x / r, y / r


def rotation(rng):
    """The columns of a uniform rotation matrix, from a quaternion drawn by rejection from the 4-ball."""
    while True:
        x, y, z, w = (uniform(rng, -1.0, 1.0) for _ in range(4))
        n = x * x + y * y + z * z + w * w
        if 1e-3 < n <= 1.0:
            break
    s = 2.0 / n
    return (
        (1.0 - s * (y * y + z * z), s * (x * y + z * w), s * (x * z - y * w)),
        (s * (x * y - z * w), 1.0 - s * (x * x + z * z), s * (y * z + x * w)),
        (s * (x * z + y * w), s * (y * z - x * w), 1.0 - s * (x * x + y * y)),
    )


# --- printing --------------------------------------------------------------------------------------------------------


def digits(x):
    """25 significant digits, always scientific, trailing zeros dropped; an empty cell for None."""
    if x is None:
        return ""
    if x == 0:
        return "0"
    text = mpmath.nstr(x, PRINTED_DIGITS, strip_zeros=False, min_fixed=1, max_fixed=0, show_zero_exponent=True)
    mantissa, exponent = text.split("e")
    mantissa = mantissa.rstrip("0").rstrip(".")
    return f"{mantissa}e{int(exponent)}"


def axis_cells(axis):
    """A unit vector with its sign chosen (first largest component positive) and negligible components as 0."""
    largest = max(abs(c) for c in axis)
    # Components that are equal in truth differ by the last digit here; the first of them decides.
    leading = next(c for c in axis if largest - abs(c) < mpf(SMALLEST_COMPONENT))
    sign = 1 if leading > 0 else -1
    return [sign * c if abs(c) >= mpf(SMALLEST_COMPONENT) else mpf(0) for c in axis]


# --- builtins --------------------------------------------------------------------------------------------------------


def neighbours(*values):
    """Each value of either sign, with the two f32 either side."""
    rows = []
    for value in values:
        rows += [s * f32_step(to_f32(value), k) for s in (1.0, -1.0) for k in (-2, -1, 0, 1, 2) if value != 0 or k >= 0]
    return rows


def builtin(inputs, outputs, function, scenarios):
    """The golden values of a device's instruction: `function` takes exact mpf inputs and returns one mpf an output, or
    None where it is undefined. Worked in two precisions that agree."""

    def truth(row):
        values = []
        for dps in (60, 100):
            mp.dps = dps
            values.append(function(*[mpf(x) for x in row]))
        first, second = values
        if second is None:
            return [None] * len(outputs)
        for one, other in zip(first, second):
            if not abs(one - other) <= mpf("1e-50") * abs(other):
                raise ArithmeticError(f"{one} and {other} on {row}")
        return second

    return Golden(inputs, outputs, [], scenarios, truth, "Worked in 60 and 100 digits, agreeing to 1e-50")


def unary(function, low, high, ends, edges=(), defined=lambda x: True, largest=F32_MAX):
    """A function of one variable: `domain` is low..high, in steps of the axis and of its exponents; `edge` has the f32
    neighbours of `ends` and `edges` themselves, powers of two and subnormals, of magnitudes up to `largest`."""

    def domain(rng):
        span = max(abs(low), abs(high))
        rows = [uniform(rng, low, high) for _ in range(30)]
        logs = [span * math.ldexp(uniform(rng, 0.5, 1.0), -int(40 * rng.random())) for _ in range(30)]
        rows += [x if low >= 0 or k % 2 else -x for k, x in enumerate(logs)]
        return [[to_f32(min(max(x, low), high))] for x in rows]

    def edge(rng):
        rows = neighbours(*ends) + list(edges)
        rows += [F32_MIN_SUBNORMAL, -F32_MIN_SUBNORMAL, 0.0, -0.0, largest, -largest]
        rows += neighbours(F32_MIN_NORMAL)
        rows += [s * math.ldexp(1.0, k) for k in range(-120, 121, 30) for s in (1.0, -1.0)]
        rows += [s * magnitude(rng, -126, 128) for s in (1.0, -1.0) * 8]
        return [[to_f32(x)] for x in rows if abs(x) <= largest]

    def value(x):
        return [function(x)] if defined(x) else None

    return builtin(["x"], ["y"], value, {f.__name__: f for f in (domain, edge)})
