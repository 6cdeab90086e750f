#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""What tables of samples and measures say of their errors, beside the errors: the chains of stress_errors, for three accuracies, and
runs that are much finer, of which a second one tells how well they are known.

By hand, as it takes minutes: tables.py BUILD [FIRST [LAST]]   seeds. A miss is a number that is off by more than was asked and than it
says; it says too much if that is more than ten times the larger of the error and what was asked: of a column of samples at all its
times, in parts of its largest value; of a measure, in parts of itself. Measures that are called unpredictable count apart."""
import collections
import csv
import math
import os
import re
import subprocess
import sys
import tempfile

ASKED = ("1e-4", "1e-6", "1e-8")
FINE = {True: ("1e-8", "4e-8"), False: ("1e-12", "1e-11")}  # of damped chains, and others
SAMPLES = 500
DENSE = 8  # samples of measures in the first of these for each of the usual ones
PATIENCE = 60  # s
FIELDS = ("force", "velocity", "displacement")
ROUNDING = 1e-12


def number(text):
    return float(text) if text else math.nan


def run(beadsim, scene, work, accuracy, outputs, *options):
    """The tables' rows by name; None: it ended with a message, or not in time."""
    sets = ["--set", f"simulate.accuracy={accuracy}", "--set", "outputs=[" + ", ".join(outputs) + "]", *options]
    try:
        done = subprocess.run([beadsim, scene, "-o", work, "--quiet", *sets], capture_output=True, timeout=PATIENCE, check=False)
    except subprocess.TimeoutExpired:
        return None
    if done.returncode:
        return None
    tables = {}
    for output in outputs:
        name = output.split(":")[1].split(",")[0].strip()
        with open(os.path.join(work, name), encoding="utf-8", newline="") as file:
            tables[name] = list(csv.reader(file))
    return tables


class Count:
    def __init__(self):
        self.numbers = self.missed = self.much = self.lost = 0
        self.worst, self.ratios = 0.0, []

    def judge(self, error, known, said, asked):
        """One number: False if it is a miss, or says too much. Nothing where the references know too little."""
        if not known <= 0.3 * max(error, asked):
            return True
        self.numbers += 1
        if math.isnan(said):
            return True
        much = said > 10 * max(error, asked)
        missed = error - known > max(said, asked)
        self.missed += missed
        self.worst = max(self.worst, (error - known) / max(said, asked))
        self.much += much
        if error > max(asked, 10 * known):
            self.ratios.append(said / error)
        return not missed and not much

    def text(self):
        ratios = sorted(self.ratios)
        quartiles = " ".join(f"{ratios[len(ratios) * q // 4]:.2g}" for q in (1, 2, 3)) if ratios else "-"
        return f"{self.numbers} | {self.missed} ({self.worst:.2g}) | {self.much} | {self.lost} | {quartiles} of {len(ratios)}"


def judge_samples(count, rows, exact, other, asked):
    """A column at all times is one number: its worst error beside what is said then."""
    told = []
    columns = (len(rows[0]) - 1) // 2
    for c in range(1, columns + 1):
        scale = max(abs(number(row[c])) for row in exact[1:])
        if scale == 0:
            continue
        worst = (0.0, 0.0, math.nan)
        for row, right, near in zip(rows[1:], exact[1:], other[1:]):
            error, known = abs(number(row[c]) - number(right[c])), abs(number(near[c]) - number(right[c]))
            said = number(row[c + columns]) + ROUNDING * scale
            if math.isnan(worst[2]) or error / max(said, asked * scale) > worst[0] / max(worst[2], asked * scale):
                worst = (error, known, said)
        if not count.judge(*worst, asked * scale):
            told.append(f"{rows[0][c]}: off by {worst[0]:.3g}, says {worst[2]:.3g}")
    return told


def judge_measures(count, rows, exact, other, asked):
    told = []
    right, near = ({row[0]: number(row[1]) for row in table[1:]} for table in (exact, other))
    for name, value, _, note, said in rows[1:]:
        if name not in right or name not in near or said in ("", "0"):
            continue
        if "unpredictable" in note:
            count.lost += 1
            continue
        error, known = abs(number(value) - right[name]), abs(near[name] - right[name])
        # digits that all runs share by rounding
        if not count.judge(error, known, number(said) + ROUNDING * abs(right[name]), asked * abs(right[name])):
            told.append(f"{name}: off by {error:.3g}, says {said}, of {value}")
    return told


def measured_samples(beadsim, scene, until):
    """The number of samples that measures of a run come from."""
    plan = subprocess.run([beadsim, "--plan", scene, *until, "--set", "outputs=[{table: m.csv, show: measures, uncertainty: false}]"],
                          capture_output=True, text=True, check=True).stdout
    return int(re.search(r"from (\d+) samples", plan)[1])


def outputs_of(beads, every, uncertainty, measured=None):
    """Sensors at the first, middle and last part of the chain. `measured`: time between the samples of measures."""
    places = sorted({min(beads - 1, p) for p in (1, beads // 3, beads // 2, beads - 1)})
    last = "" if uncertainty else ", uncertainty: false"
    tables = [f"{{table: {f}.csv, show: sensors, beads: {places}, field: {f}, every: {every:.9g}{last}}}" for f in FIELDS]
    dense = f", every: {measured:.9g}" if measured else ""
    return tables + [f"{{table: measures.csv, show: measures{last}{dense}}}"]


def try_seed(build, seed, work, counts):
    scene = os.path.join(work, "scene.yaml")
    program = os.path.join(build, "tests", "stress", "stress_errors")
    text = subprocess.run([program, "scene", str(seed)], capture_output=True, text=True, check=True).stdout
    kind, text = text.split("\n", 1)
    with open(scene, "w", encoding="utf-8") as file:
        file.write(text)
    beadsim = os.path.join(build, "beadsim")
    first = run(beadsim, scene, work, "1e-4", ["{table: c.csv, show: bead-peaks, uncertainty: false}", "{table: m.csv, show: measures, uncertainty: false}"])
    if not first:
        return print(f"  seed {seed}, {kind[2:]}: no run", flush=True)
    beads = len(first["c.csv"]) - 1
    times = [number(row[2]) for row in first["c.csv"][1:]]
    arrival = next((number(row[1]) for row in first["m.csv"] if row[0] == "front arrival"), math.nan)
    end = max([t for t in [*times, arrival] if not math.isnan(t)], default=0) * 1.05
    until = ("--set", f"simulate.until={end:.9g}")
    damped = "damping" in text
    dense = end / (DENSE * measured_samples(beadsim, scene, until)) if end > 0 else 0
    fine = [run(beadsim, scene, work, a, outputs_of(beads, end / SAMPLES, False, dense / (1 + i)), *until) for i, a in enumerate(FINE[damped])]
    if end <= 0 or not all(fine):
        return print(f"  seed {seed}, {kind[2:]}: no reference", flush=True)
    for asked in ASKED[: 2 if damped else 3]:
        got = run(beadsim, scene, work, asked, outputs_of(beads, end / SAMPLES, True), *until)
        for name in got or ():
            what = name[:-4]
            count, judge = counts[what, asked], judge_measures if what == "measures" else judge_samples
            for told in judge(count, got[name], fine[0][name], fine[1][name], float(asked)):
                print(f"    at {asked}: {what}: {told}")
    print(f"  seed {seed}, {kind[2:]}: {beads} beads{'' if got else ', not in time'}", flush=True)
    return None


def main():
    build, first = os.path.abspath(sys.argv[1]), int(sys.argv[2]) if len(sys.argv) > 2 else 0
    last = int(sys.argv[3]) if len(sys.argv) > 3 else first + 15
    counts = collections.defaultdict(Count)
    with tempfile.TemporaryDirectory() as work:
        for seed in range(first, last):
            try_seed(build, seed, work, counts)
    print("| numbers | asked | all | missed (error over what is said) | too much | unpredictable | said over error, of those above what was asked |")
    print("|---|---|---|---|---|---|---|")
    for (what, asked), count in counts.items():
        print(f"| {what} | {asked} | {count.text()} |")
    return any(count.missed for count in counts.values())


if __name__ == "__main__":
    sys.exit(main())
