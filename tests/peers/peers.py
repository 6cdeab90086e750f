#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The program beside others: peers.py BEADSIM; the table goes to stdout, and to RESULTS.md where no peer is missing. Status 1 if a
difference is larger than it may be."""
import importlib.util
import math
import os
import pathlib
import shutil
import subprocess
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.dont_write_bytecode = True


def number(value):
    return "" if math.isnan(value) else f"{value:.0e}" if value else "0"


def closed_forms(beadsim):
    from closed_forms import compare

    for what, difference, most in compare(beadsim):
        yield [what, number(difference)], difference < most


def dop853(beadsim):
    from dop853 import compare

    for name, speeds, forces in compare(beadsim):
        yield [name, number(speeds), number(forces)], max(speeds, forces) < 1e-9


def lammps(beadsim):
    from lammps import compare

    for name, time, found in compare(beadsim):
        for k, (step, places, speeds, better) in enumerate(found):
            order = math.log2(found[k - 1][2] / speeds) if k else math.nan
            label = [f"{name}, after {1e3 * time:g} ms" if k == 0 else "", f"{1e9 * step:.4g}", number(places), number(speeds),
                     "" if k == 0 else f"{order:.2f}", number(better)]
            # Of order 2 until the last steps, and then no further away than their rounding errors make them.
            yield label, not 1 <= k <= 6 or abs(order - 2) < 0.2
        yield None, min(better for *_, better in found[1:]) < 1e-7


def versions():
    import numpy
    import scipy

    lines = subprocess.run(["lmp", "-h"], capture_output=True, text=True, check=False).stdout.splitlines()
    release = next((line.split(" - ", 1)[1] for line in lines if "Simulator - " in line), "?")
    return f"LAMMPS of {release}, SciPy {scipy.__version__}, NumPy {numpy.__version__}"


PARTS = [
    ("Exact results", closed_forms, ["numpy"], ["", "relative difference"],
     "Hertz's collision, statics, the modes of a pressed chain (its motion is linear but for terms that fall with the speed), similarity,\n"
     "and the solitary wave from its own equation, by Petviashvili's iteration. Requested accuracy 1e-13."),
    ("SciPy's DOP853", dop853, ["numpy", "scipy"], ["chain", "velocities at the end", "peak forces"],
     "From contact event to contact event with a tolerance of 1e-13. Differences in units of the largest."),
    ("LAMMPS", lammps, ["numpy", "lmp"], ["chain", "step (ns)", "displacements", "velocities", "order", "velocities extrapolated"],
     "`pair_style granular`, velocity Verlet. Differences in units of the largest: they fall with the square of the step down to LAMMPS's\n"
     "rounding errors; those of velocities extrapolated from two steps (4 v(h) - v(2h))/3 are without that."),
]
PACKAGES = {"numpy": "python3-numpy", "scipy": "python3-scipy", "lmp": "lammps"}


def missing(needs):
    return [PACKAGES[need] for need in needs if not (shutil.which(need) or importlib.util.find_spec(need))]


def table(part, beadsim):
    """Lines of a table, and whether all of its differences are small enough."""
    title, rows, needs, header, text = part
    lines, good = ["", f"## {title}", "", text, "", "| " + " | ".join(header) + " |", "|" + "---|" * len(header)], True
    for cells, small in rows(beadsim):
        lines += ["| " + " | ".join(cells + ([] if small else ["**too large**"])) + " |"] if cells else []
        good = good and small
    return lines, good


def main():
    beadsim, lines, good, absent = pathlib.Path(sys.argv[1]).resolve(), [], True, []
    os.environ.setdefault("BEADREEL_ASSETS", str(HERE.parent.parent / "assets"))
    for part in PARTS:
        lacks = missing(part[2])
        if lacks:
            absent.append(f"{part[0]}: skipped, as {', '.join(lacks)} is not installed")
            continue
        found, small = table(part, beadsim)
        lines, good = lines + found, good and small
    if not absent:
        lines = ["# beadsim beside others", "", f"Made by `make peers` with {versions()}.", *lines]
        (HERE / "RESULTS.md").write_text("\n".join(lines) + "\n")
    print("\n".join(lines + absent))
    return 0 if good else 1


sys.exit(main())
