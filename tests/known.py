#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Every number that a table says knows its error: each word of `show`, of beads and equations, has a column of uncertainties for each
column of numbers but those named below, with the reason; what these say is at least the error against a run that is far more exact,
and hardly ever more than ten times the larger of error and request. So do those of sweeps. `known.py BEADSIM SCHEMA`; for known.sh."""
import csv
import json
import math
import os
import subprocess
import sys
import tempfile

import tap

ASKED = 1e-4
ROUNDING, TINY = 1e-11, 1e-14  # of the largest number in a column, that of the references; of the sums of an equation

# What is given, counted, or chosen by the table: columns of any table, and of some.
PLAIN = {
    "time_s", "time", "x", "bead", "contact", "mode", "material", "sensor", "state", "note", "unit", "name", "kind", "frequency_Hz",
    "frequency", "band", "wave_number_cell_pi", "first_bead", "last_bead", "number", "configuration", "configurations", "curve", "magnetism",
    "spins",
}
WITHOUT = {
    "chain": "what was given, and what follows from it in closed form",
    "bands": "eigenvalues of what was given, to rounding",
    "eigenmodes": "eigenvalues of what was given, to rounding",
    "fit": "of another kind: its standard errors are those of what was measured",
    "sensitivities": {"peak_force_N": "the table of peaks says it", "time_s": "as well"},
    "dispersion": {"exact_Hz": "an eigenvalue, to rounding"},
    "spreading": {"fit_from_s": "chosen", "fit_to_s": "chosen"},
    "decay": {"fit_first": "a bead", "fit_last": "a bead"},
}
PLACES = (3, 5, 8)
FINER = 4  # cells of the reference of the equation whose errors are the grid's
# Keys that a word needs beside `show`.
KEYS = {
    "profiles": "at: [{half:.9g}, {end:.9g}]{strain}",
    "sensors": "beads: [{places}], every: {every:.9g}{field}",
    "spectrum": "beads: [3, 5, 8], every: {every:.9g}{field}",
    "spectrogram": "beads: 5, every: {every:.9g}{field}",
    "transfer": "beads: [5, 8], every: {every:.9g}{field}",
    "sensitivities": "contacts: [3, 5, 8]",
    "dispersion": "every: {every:.9g}{field}",
    "energy": "every: {every:.9g}",
    "extremes": "every: {every:.9g}{strain}",
}

BEADS = """materials:
  a: {{density: 7800, modulus: 200 GPa, poisson: 0.3, radius: 5 mm}}
  b: {{density: 2700, modulus: 70 GPa, poisson: 0.33, radius: 4 mm}}
chain: {{striker: {{bead: a, velocity: 0.3}}, wall: {wall}, beads: [{{cell: [a, b], count: 10, disorder: {{mass: normal 8 %, seed: {seed}}}}}]{more}}}
simulate: {{until: 0.6 ms}}
"""
END = 0.6e-3
# Scene, end of the run, accuracy of the reference, its other settings.
SYSTEMS = {
    "beads": (BEADS.format(wall="a", more="", seed=1), END, "1e-11", ()),
    "pressed": (BEADS.format(wall="rigid", more=", precompression: 10 N", seed=2), END, "1e-11", ()),
    "equal cells": (BEADS.format(wall="rigid", more=", precompression: 10 N", seed=2).replace(", disorder: {mass: normal 8 %, seed: 2}", ""),
                    END, "1e-11", ()),
    "driven": (BEADS.format(wall="rigid", more=", precompression: 10 N, drive: {displacement: sine, amplitude: 0.1 um, frequency: 8 kHz}", seed=3)
               .replace("striker: {bead: a, velocity: 0.3}, ", "striker: {bead: a, velocity: 0}, "), END, "1e-11", ()),
    "damped": (BEADS.format(wall="none", more=", damping: {coefficient: 2, exponent: 1.3}", seed=4), END, "1e-9", ()),
    "fput": ("chain: {equation: fput, points: 32, alpha: 0.25, start: {mode: 1, amplitude: 1}}\nsimulate: {until: 60}\n", 60, "1e-12", ()),
    "kdv": ("chain: {equation: kdv, low: -12, length: 24, points: 160, start: {solitons: [{speed: 9, at: -6}, {speed: 4, at: 0}]}}\n"
            "simulate: {until: 0.5}\n", 0.5, "1e-8", ()),
    "shock": ("chain: {equation: shock, epsilon: 0.5, points: 96, length: 6.283185307179586, start: {simple-wave: 1, amplitude: 1}}\n"
              "simulate: {until: 6}\n", 6, "1e-4", ("--set", f"chain.points={96 * FINER}")),
}


# Scenes of sweeps, the accuracy of the reference; of each word of `show` its scene and keys.
CELLS = """chain: {{{pressed}beads: [{{cell: [large-steel, aluminium], count: 12, spins: random, magnetism: 0.5, seed: 1}}]}}
simulate: {{until: {until}}}
sweep: {{over: {{chain.beads.0.magnetism: [0, 0.5, 0.8], chain.beads.0.seed: {seeds}}}}}
"""
STRUCK = "precompression: 20 N, start: [{bead: [12, 13], velocity: 1 mm/s}], striker: {bead: large-steel, velocity: 0}, wall: rigid, "
SHAKEN = ("precompression: 20 N, drive: {displacement: noise, amplitude: 10 nm, frequency: 12 kHz, seed: 1}, "
          "striker: {bead: large-steel, velocity: 0}, wall: rigid, ")
MANY, FEW = "1..11", "1..5"  # a sample of the chains is run twice, or all are
SPINS = "sweep: {cells: 16, configurations: 3, magnetism: [0, 0.1, 0.5, 0.8, 0.9, 1], seed: 3, measure: {decay: true}}\n"
FINEST = "1e-9"
SWEEPS = {
    "magnetism": [(SPINS, ""), (CELLS.format(pressed="", until="auto", seeds=MANY), ""),
                  (CELLS.format(pressed="", until="auto", seeds=MANY), "measure: front speed")],
    "configurations": [(SPINS, ""), (CELLS.format(pressed="", until="auto", seeds=MANY), "")],
    "decay": [(SPINS, "")],
    "spreading": [(CELLS.format(pressed=STRUCK, until="0.4 ms", seeds=MANY), "")],
    "sensors": [(CELLS.format(pressed="", until="0.4 ms", seeds=MANY), "beads: [3, 12], field: velocity, every: 2 us")],
    "spectrum": [(CELLS.format(pressed="", until="0.4 ms", seeds=FEW), "beads: [3, 12], field: velocity, every: 2 us")],
    "transfer": [(CELLS.format(pressed=SHAKEN, until="1.5 ms", seeds=FEW).replace("0, 0.5, 0.8", "0.5"), "beads: [2, 12], every: 20 us, segment: 0.7 ms")],
    "dispersion": [(CELLS.format(pressed=STRUCK, until="2 ms", seeds=MANY), "")],
}
OTHER_WORDS = {"statistics"}  # for magnetism


def number(text):
    try:
        return float(text)
    except ValueError:
        return math.nan


def nothing(*_):
    return 0.0


# What is not known of the reference, from its own row: derivatives are hardly more accurate, and a clean wave has its own accuracy.
SLACK = {"measures": lambda right, u: number(right[u]), "sensitivities": lambda right, u: number(right[u])}
# Keys of references only: measures come from curves through samples.
DENSE = {"measures": "every: {dense:.9g}"}


def keys_of(show, system, end, finer=1, table_of=KEYS):
    """`finer`: of a grid of so many times as many cells."""
    fields = {"fput": ", field: displacement", "kdv": ", field: displacement", "shock": ", field: strain"}
    words = {"end": end, "half": end / 2, "every": end / 300, "dense": end / 6000, "field": fields.get(system, ", field: velocity"),
             "strain": ", field: strain" if system == "shock" else "",
             "places": ", ".join(str(i) for place in PLACES for i in range(finer * place, finer * (place + 1)))}
    return table_of.get(show, "").format(**words)


def table(beadsim, scene, accuracy, show, keys, *options):
    """The rows, or the message with which the table was refused."""
    output = f"{{table: t.csv, show: {show}{', ' * bool(keys)}{keys}}}"
    done = subprocess.run([beadsim, scene, "-o", "out", "--quiet", "--set", f"simulate.accuracy={accuracy}", "--set", f"outputs=[{output}]",
                           *options], capture_output=True, text=True, check=False)
    if done.returncode:
        return done.stderr
    with open("out/t.csv", encoding="utf-8", newline="") as file:
        return list(csv.reader(file))


def names_of_uncertainty(name):
    """Of a column: its own, or where the table is of one number the only one."""
    stem, _, unit = name.rpartition("_")
    return (name + "_uncertainty", f"{stem}_uncertainty_{unit}", f"uncertainty_{unit}", "uncertainty", "uncertainty_N")


def pairs(show, header):
    """Columns with those of their uncertainties; columns that have none. No two columns have the same one."""
    without = WITHOUT.get(show, {})
    found, missing, taken = [], [], set()
    for c, name in enumerate(header):
        if isinstance(without, str) or (name in PLAIN and name + "_uncertainty" not in header) or name in without or "." in name:
            continue
        if "uncertainty" in name or name.endswith("_error") or name.startswith("standard_error"):  # errors themselves
            continue
        of_all = [header.index(other) for other in names_of_uncertainty(name) if other in header and other not in taken]
        if of_all:
            found.append((c, of_all[0]))
            taken.add(header[of_all[0]])
        else:
            missing.append(name)
    return found, missing


def mean(texts):
    return repr(sum(number(x) for x in texts) / len(texts))


def merge_cells(show, rows):
    """Of a finer grid, means of cells: along profiles, or of the columns of sensors. Other tables have numbers of single cells: None."""
    if show == "profiles":
        return rows[:1] + [[mean(column) for column in zip(*rows[i : i + FINER])] for i in range(1, len(rows), FINER)]
    if show == "sensors":
        return rows[:1] + [[row[0]] + [mean(row[1 + FINER * i : 1 + FINER * (i + 1)]) for i in range(len(PLACES))] for row in rows[1:]]
    return rows if show == "measures" else None


class Count:
    def __init__(self):
        self.numbers = self.missed = self.columns = self.much = self.unknown = 0
        self.told = []

    def judge(self, show, system, rows, exact, c, u):
        """A column of numbers, and what is said of them."""
        scale = max((abs(number(row[c])) for row in exact if not math.isnan(number(row[c]))), default=0)
        worst = said = 0.0
        for row, right in zip(rows, exact):
            value, true, bound = number(row[c]), number(right[c]), number(row[u])
            if math.isnan(value) or math.isnan(true) or "unpredictable" in row:
                continue
            self.numbers += 1
            self.unknown += math.isnan(bound)
            error = abs(value - true)
            if error > bound + SLACK.get(show, nothing)(right, u) + ROUNDING * scale + TINY:
                self.missed += 1
                self.told.append(f"{show} of {system}: {row}: off by {error:.3g} from {true!r}")
            worst, said = max(worst, error), max(said, bound)
        if scale > 0:
            self.columns += 1
            self.much += said > 10 * max(worst, ASKED * scale)


def try_table(beadsim, system, show, count):
    """True: the system has the table."""
    text, end, finest, options = SYSTEMS[system]
    with open("scene.yaml", "w", encoding="utf-8") as file:
        file.write(text)
    keys = keys_of(show, system, end)
    rows = table(beadsim, "scene.yaml", ASKED, show, keys)
    if isinstance(rows, str):
        known = (" has the derivatives", " lists beads", " has the bands", " has the modes", "is the budget", "are those of", "is one of",
                 "do not exist", "are not known", "has small vibrations", "is that of", "must be", "spreads", "stores", "needs", "no bead", "`fit`")
        tap.ok(any(word in rows for word in known), f"{show} of {system} is refused with a reason", rows)
        return False
    found, missing = pairs(show, rows[0])
    tap.ok(not missing, f"{show} of {system}: every column of numbers knows its error", ", ".join(missing))
    if not found:
        return True
    finer = FINER if options else 1
    exact = table(beadsim, "scene.yaml", finest, show, keys_of(show, system, end, finer, KEYS | DENSE), *options)
    exact = merge_cells(show, exact) if options else exact
    if not exact:
        return True
    by_name = {tuple(row[:1]): row for row in exact[1:]} if show == "measures" else None
    body = rows[1:]
    right = [by_name[tuple(row[:1])] for row in body if tuple(row[:1]) in by_name] if by_name else exact[1:]
    if by_name:
        body = [row for row in body if tuple(row[:1]) in by_name]
    for c, u in found:
        if by_name: # each is a column of its own
            for row, other in zip(body, right):
                count.judge(show, system, [row], [other], c, u)
        else:
            count.judge(show, system, body, right, c, u)
    return True


def try_sweep(beadsim, show, text, keys):
    count = Count()
    with open("scene.yaml", "w", encoding="utf-8") as file:
        file.write(text)
    rows, exact = (table(beadsim, "scene.yaml", accuracy, show, keys) for accuracy in (ASKED, FINEST))
    tap.ok(not isinstance(rows, str) and len(rows) == len(exact) > 1, f"{show} of a sweep is a table", rows)
    found, missing = pairs(show, rows[0])
    tap.ok(found and not missing, f"{show} of a sweep: every column of numbers knows its error", ", ".join(missing))
    for c, u in found:
        count.judge(show, "a sweep", rows[1:], exact[1:], c, u)
    tap.ok(count.numbers and count.missed == 0, f"{show} of a sweep: none of {count.numbers} numbers is off by more than is said", *count.told[:8])
    tap.ok(10 * count.much <= count.columns, f"{show} of a sweep: at most a tenth of {count.columns} columns says ten times too much", count.much)
    print("#", show, keys, count.numbers, count.missed, count.columns, count.much, count.unknown, flush=True)


def try_redrawn(beadsim, show, path):
    """A table drawn again from a trajectory has the columns of the run's, and says of each number that nothing is known."""
    keys = keys_of(show, "beads", END)
    of_run = table(beadsim, "scene.yaml", ASKED, show, keys)
    subprocess.run([beadsim, path, "-o", "again.csv", "--quiet", "--set", f"outputs=[{{table: again.csv, show: {show}{', ' * bool(keys)}{keys}}}]"],
                   check=True)
    with open("again.csv", encoding="utf-8", newline="") as file:
        rows = list(csv.reader(file))
    unknown = [c for c, name in enumerate(rows[0]) if "uncertainty" in name]
    tap.ok(rows[0] == of_run[0] and unknown, f"{show}: the columns of the run's table, from its trajectory", rows[0], of_run[0])
    tap.ok(all(math.isnan(number(row[c])) for row in rows[1:] for c in unknown), f"{show}: ... where nothing is known of errors")


def main():
    beadsim, schema = os.path.abspath(sys.argv[1]), json.load(open(sys.argv[2], encoding="utf-8"))
    shows = schema["definitions"]["outputs:table"]["properties"]["show"]["enum"]
    with tempfile.TemporaryDirectory() as work:
        os.chdir(work)
        for show in shows:
            if show == "fit":  # needs a measured curve
                continue
            count = Count()
            of = [system for system in SYSTEMS if try_table(beadsim, system, show, count)]
            tap.ok(of, f"{show} is a table of something")
            if count.numbers:
                tap.ok(count.missed == 0, f"{show}: none of {count.numbers} numbers is off by more than is said", *count.told[:8])
                tap.ok(10 * count.much <= count.columns, f"{show}: at most a tenth of {count.columns} columns says ten times too much", count.much)
            print("#", show, count.numbers, count.missed, count.columns, count.much, count.unknown, flush=True)
        for show in schema["definitions"]["outputs:table-of-a-sweep"]["properties"]["show"]["enum"]:
            for text, keys in () if show in OTHER_WORDS else SWEEPS[show]:
                try_sweep(beadsim, show, text, keys)
        with open("scene.yaml", "w", encoding="utf-8") as file:
            file.write(SYSTEMS["beads"][0])
        subprocess.run([beadsim, "scene.yaml", "-o", "out", "--quiet", "--set", f"simulate.accuracy={ASKED}", "--set",
                        "outputs=[{trajectory: run.h5, every: 1 us, fields: [displacement, velocity, force, energy, contact-force]}]"], check=True)
        for show in ("sensors", "measures", "profiles", "extremes", "spreading", "spectrum", "spectrogram", "transfer", "dispersion"):
            try_redrawn(beadsim, show, "out/run.h5")
    tap.finish()


if __name__ == "__main__":
    main()
