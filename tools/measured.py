#!/usr/bin/env python3
"""Writes the 'Measured' block of each GLSL header from a run.json, so that no figure is typed by hand.

    target/release/rootq audit ltc_disk -n 1M --seed 1 --out RUN
    tools/measured.py RUN/run.json [more/run.json ...]

A file of the run whose header has a line '// Measured' gets a table of its variants by scenario in the place of that
paragraph. A row that repeats its twin's without '_precise' is left out.
"""

import json
import re
import sys
from pathlib import Path

GLSL = Path(__file__).resolve().parent.parent / "glsl"


def share(count, total):
    """'0', '7x' (as a count) or '12%', in as few characters as say it."""
    if count == 0:
        return "0"
    rate = 100.0 * count / total
    if rate < 0.01:
        return f"{count}x"
    return f"{rate:.2g}%" if rate < 99.5 else f"{rate:.0f}%" if rate < 99.95 else "100%"


def cell(audit, headline):
    total = audit["configurations"]
    failed = share(audit["failed"]["count"], total)
    broken = audit["verdicts"].get("non_finite", {"count": 0})["count"]
    if broken:
        return f"{failed} n{share(broken, total)}"
    errors = [output["worst"]["error"] for output in audit["outputs"] if output["name"] in headline]
    worst = "inf" if None in errors else f"{max(errors):.0e}".replace("e-0", "e-").replace("e+0", "e")
    return f"{failed} {worst}"


def tables(run):
    """By file: the scenarios and the rows (name, cells)."""
    device = run["device"]
    about = f"{device['driver']} ({device['driver_info']}), {run['settings']['configurations']:,} a scenario, seed {run['settings']['seed']}"
    for family in run["families"]:
        headline = [output["name"] for output in family["outputs"] if output["headline"]]
        scenarios = [scenario["name"] for scenario in family["scenarios"]]
        files = {}
        for variant in family["variants"]:
            cells = {r["scenario"]: cell(r["audit"], headline) for r in variant["results"] if "audit" in r}
            files.setdefault(variant["file"], {})[variant["name"]] = [cells[name] for name in scenarios]
        for file, rows in files.items():
            kept = {n: c for n, c in rows.items() if rows.get(n.removesuffix("_precise")) != c or not n.endswith("_precise")}
            yield file, about, scenarios, kept


def block(about, scenarios, rows):
    name = max(map(len, rows)) + 1
    widths = [max(len(head), *(len(cells[i]) for cells in rows.values())) + 2 for i, head in enumerate(scenarios)]
    lines = [f"// Measured: {about}.",
             "// Failed and the worst error, whoever is to blame; n: failed, and so many of them not finite."]
    for title, cells in [("", scenarios), *rows.items()]:
        lines.append("//   " + title.ljust(name) + "".join(c.rjust(w) for c, w in zip(cells, widths)))
    return "\n".join(line.rstrip() for line in lines) + "\n"


def main():
    for path in sys.argv[1:]:
        for file, about, scenarios, rows in tables(json.loads(Path(path).read_text())):
            source = GLSL / file
            text = source.read_text()
            new, count = re.subn(r"// Measured.*\n(?://.+\n)*", lambda _: block(about, scenarios, rows), text, count=1)
            if count == 0:
                print(f"{file}: no line '// Measured'", file=sys.stderr)
            elif new != text:
                source.write_text(new)


main()
