#!/usr/bin/env python3
"""Writes tests/golden/<family>.csv: exact inputs, and results computed with mpmath in many digits.

File format
-----------
Comma-separated, one header line, no quoting. Lines that begin with '#' are comments; those of the form
'# tolerance OUTPUT NUMBER: reason' or '# tolerance OUTPUT NUMBER/CONDITION: reason' say how much more than 1e-13 of an
output its oracle may be off by, relatively (in radians for a direction), where an oracle promises less.

scenario      which part of the input space the row stands for
<inputs>      exact f32 values as C hex floats (0x1.8p+3); truth belongs to exactly these bits
<outputs>     25 significant digits. A cell is empty where the result is undefined (the axes of a circle).
              Components of unit vectors below 1e-50 are written as 0, so a row states them to 25 digits or to 1e-50.
<conditions>  numbers from which a test derives the accuracy that it may ask for; empty means infinite or 0/0

Unit vectors are free in sign; here the first of their largest components is positive.

Draws use random.Random.random() and the exactly rounded operations + - * / sqrt only, so every platform draws the
same bits. Each scenario has its own seed: adding one changes no other row.

A new family is one file, tools/truths/<family>.py, with a function of that name that returns a Golden.
"""

import argparse
import importlib
import itertools
import pathlib
import random
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE))

from truths.common import PRINTED_DIGITS, digits, hex_float, to_f32  # noqa: E402

FAMILIES = sorted(path.stem for path in (HERE / "truths").glob("*.py") if path.stem != "common")


def render(family):
    """The text of tests/golden/<family>.csv."""
    golden = getattr(importlib.import_module(f"truths.{family}"), family)()
    lines = [
        f"# Written by tools/golden.py {family} (make golden) with mpmath; do not edit.",
        f"# {golden.method}; printed to {PRINTED_DIGITS} significant digits.",
        *(f"# tolerance {output} {tolerance}: {reason}" for output, tolerance, reason in golden.tolerances),
        ",".join(["scenario"] + golden.inputs + golden.outputs + golden.conditions),
    ]
    for scenario, draw in golden.scenarios.items():
        for row in draw(random.Random(f"{family}/{scenario}")):
            assert len(row) == len(golden.inputs) and all(to_f32(c) == c for c in row), row
            truth = golden.truth(row)
            assert len(truth) == len(golden.outputs) + len(golden.conditions), row
            lines.append(",".join([scenario] + [hex_float(c) for c in row] + [digits(x) for x in truth]))
    return "\n".join(lines) + "\n"


def first_difference(old, new):
    """Number and texts of the first line in which two files differ."""
    lines = itertools.zip_longest(old.splitlines(), new.splitlines(), fillvalue="(end of file)")
    return next((n, a, b) for n, (a, b) in enumerate(lines, 1) if a != b)


def main():
    parser = argparse.ArgumentParser(
        description=__doc__.split("\n")[0],
        epilog="families: " + ", ".join(FAMILIES),
    )
    parser.add_argument("family", nargs="*", help="which files to write (default: all)")
    parser.add_argument("--check", action="store_true", help="write nothing; fail if a file is not what this script writes")
    parser.add_argument(
        "--dir",
        type=pathlib.Path,
        default=HERE.parent / "tests" / "golden",
        help="folder of the files (default: tests/golden of this checkout)",
    )
    args = parser.parse_args()
    unknown = [f for f in args.family if f not in FAMILIES]
    if unknown:
        parser.error(f"no family {unknown[0]!r}; there are: {', '.join(FAMILIES)}")

    differing = 0
    for family in args.family or FAMILIES:
        path = args.dir / f"{family}.csv"
        text = render(family)
        if not args.check:
            args.dir.mkdir(parents=True, exist_ok=True)
            path.write_text(text, encoding="ascii", newline="\n")
            print(f"{path}: {text.count(chr(10))} lines", file=sys.stderr)
            continue
        old = path.read_bytes().decode("ascii", "replace") if path.exists() else ""
        if old != text:
            differing += 1
            line, was, now = first_difference(old, text) if old else (1, "(no file)", text.split("\n")[0])
            print(f"{path}:{line}: differs\n  file   {was}\n  script {now}", file=sys.stderr)
    return 1 if differing else 0


if __name__ == "__main__":
    sys.exit(main())
