#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Do plots say what tables say? tests/plots.py BEADREEL: runs chains, strings and sweeps, reads every panel of their plots back from SVG
and compares all points with the numbers of the table, in both ways: curves, bands, marks, bars, the looks that legends give them, titles
and units of axes. Prints TAP."""
import csv
import math
import re
import subprocess
import sys

import tap
from svg_plots import NEAR, PREFIX, Outline, bar_of, read, some


def rows(file):
    """{column: numbers or words} of a table."""
    with open(file, encoding="utf-8", newline="") as table:
        lines = list(csv.reader(table))
    def value(word):
        try:
            return float(word) if word else math.nan
        except ValueError:
            return word
    return {name: [value(line[i]) for line in lines[1:]] for i, name in enumerate(lines[0])}


def shown(unit, base):
    """How much one of an axis's unit is in those of the table."""
    assert unit.endswith(base) and unit[:len(unit) - len(base)] in PREFIX, f"{unit} is not {base}"
    return PREFIX[unit[:len(unit) - len(base)]]


class Curve:
    """What a plot must show: points in the units of the table; `marks`: each has a mark, or none (False), or some (None)."""

    def __init__(self, label, x, y, line=True, marks=False, upper=None, bars=None, anywhere=False):
        self.label, self.line, self.marks, self.upper, self.bars, self.anywhere = label, line, marks, upper, bars, anywhere
        self.points = list(zip(x, y, upper or y, bars or y))

    def parts(self, panel, k, per):
        """Lines in pt, interrupted where there is no value."""
        parts = [[]]
        for point in self.points:
            if math.isnan(point[k]) or any(axis.kind == "log" and v <= 0 for axis, v in zip(panel.axes, (point[0], point[k]))):
                parts.append([])
            else:
                parts[-1].append(panel.place(point[0] / per[0], point[k] / per[1]))
        return [p for p in parts if p]


def differences(panel, curves, legend, units):
    """What is not as it should be."""
    left, top, right, bottom = panel.frame
    try:
        per = [shown(axis.unit, unit) for axis, unit in zip(panel.axes, units)]
    except AssertionError as wrong:
        return [str(wrong)]
    found, edges, drawn, every = [], [], list(panel.drawn), []

    def inside(x, y, room=0.0):
        return left + room <= x <= right - room and top + room <= y <= bottom - room

    def same_line(curve, paths, expected, what):
        wanted, there = Outline(expected), Outline([p for path in paths for p in path.parts])
        for path in paths:
            far = [p for p in some(path.points) if wanted.off(*p) > NEAR and inside(*p, 0.5)]
            if far:
                found.append(f"{curve.label}: {what} goes through {far[0]}, the table does not; {len(far)} such")
        far = [p for part in expected for p in some(part) if inside(*p, 0.5) and there.off(*p) > NEAR]
        if far and not every:
            every.append(Outline([p for d in panel.drawn if d.round for p in d.parts]))
        far = [p for p in far if every[0].off(*p) > NEAR]  # lines on each other are one
        if far:
            found.append(f"{curve.label}: {what} leaves out {far[0]}; {len(far)} such")

    for curve in curves:
        looks = legend.get(curve.label) if curve.label else None
        if curve.label and not looks:
            found.append(f"{curve.label}: not in the legend {list(legend)}")
            continue
        if curve.upper:
            if all(low == high for _, low, high, _ in curve.points):
                continue
            paths = [d for d in drawn if d.filled and not d.stroke and (not looks or looks == [("band", d.filled)])][:1]
            same_line(curve, paths, curve.parts(panel, 1, per) + curve.parts(panel, 2, per), "the band")
            edges.append(Outline(curve.parts(panel, 1, per) + curve.parts(panel, 2, per)))
            drawn = [d for d in drawn if d not in paths]
            continue
        whole = curve.parts(panel, 1, per)
        if curve.line:
            paths = [d for d in drawn if d.round and not d.closed and not d.bars() and (not looks or d.look() in looks)][:1]
            if not paths and any(inside(*p, 0.5) for part in whole for p in part):
                found.append(f"{curve.label}: no line {looks}")
                continue
            if curve.anywhere:  # as high as it may be
                higher = paths[0].points[0][1] - whole[0][0][1]
                whole = [[(x, y + higher) for x, y in part] for part in whole]
            same_line(curve, paths, whole, "the line")
            drawn = [d for d in drawn if d not in paths]
        if curve.marks is not False:
            marks = [d for d in drawn if d.closed and d.stroke and (not looks or d.look() in looks)]
            places = [p for part in whole for p in part if inside(*p)]
            close = [[p for p in places if math.dist(p, m.middle()) < 3 * NEAR] for m in marks]
            if not marks or not all(close) or curve.marks and len(marks) != len(places):
                found.append(f"{curve.label}: {len(marks)} marks, of which {sum(map(bool, close))} at the {len(places)} points")
            drawn = [d for d in drawn if d not in marks]
        if curve.bars:
            bars = [d for d in drawn if d.bars()]
            ends = sorted((p[0][0], *sorted((p[0][1], p[1][1]))) for d in bars for p in d.parts if abs(p[0][0] - p[1][0]) < 1e-6)
            wanted = sorted((*panel.place(x / per[0], (y + bar) / per[1]), panel.axes[1].at((y - bar) / per[1]))
                            for x, y, _, bar in curve.points if bar > 0)
            if len(ends) != len(wanted) or any(math.dist(a, b) > NEAR for a, b in zip(ends, wanted)):
                found.append(f"{curve.label}: bars at {ends}, not {wanted}")
            drawn = [d for d in drawn if d not in bars]
    left_over = [d for d in drawn if d.round and not any(all(e.off(*p) < NEAR for p in some(d.points) if inside(*p, 0.5)) for e in edges)]
    if left_over:
        found.append(f"{len(left_over)} lines more: {[d.look() for d in left_over]}")
    return found


def reach(panel, k):
    """Values at the ends of an axis."""
    axis, left, top, right, bottom = panel.axes[k], *panel.frame
    found = [(place - axis.first) / axis.by for place in ((bottom, top) if k else (left, right))]
    return [{"linear": float, "log": math.exp, "sqrt": lambda v: v * abs(v)}[axis.kind](v) for v in found]


def begins_at(file, low):
    """Logarithmic axes of amplitudes leave out what is less than a millionth of the largest of all panels."""
    found = [reach(panel, 1)[0] for panel in read(file)]
    return all(abs(math.log(v / low)) < 0.03 for v in found), f"{file}: amplitudes from {low:.3g} on", found


def check(what, file, panels, units, titles, scales=("linear", "linear")):
    """The panels of a plot are these: [(title, [Curve])], their axes have these titles and scales, their numbers are in these units."""
    try:
        there = read(file)
        wrong = [] if len(there) == len(panels) else [f"{len(there)} panels"]
        legend = {}
        for panel in there:
            legend = {**legend, **panel.legend}
        for panel, (title, curves, *own) in zip(there, panels):
            wrong += differences(panel, curves, {**legend, **panel.legend}, units)
            names = re.sub(r"^\([a-z]\)\s?", "", panel.title), [a.title for a in panel.axes]
            if names != (title, own[0] if own else titles):
                wrong.append(f"titles are {names}")
            if tuple(a.kind for a in panel.axes) != scales:
                wrong.append(f"axes are {[a.kind for a in panel.axes]}")
    except SystemExit as stopped:
        wrong = [str(stopped)]
    tap.ok(not wrong, what, *wrong)


def run(scene, text):
    with open(scene, "w", encoding="utf-8") as file:
        file.write(text)
    done = subprocess.run([sys.argv[1], "-q", scene, "-o", "."], capture_output=True, text=True, check=False)
    tap.ok(done.returncode == 0, f"{scene} runs", done.stdout + done.stderr)


# ---- chains ----

NAMES = {"one": "one", "two": "two, M = 1"}
SHOWN = {
    "sensors": "contacts: [0, 3], beads: [2], time: [1 ms, 5 ms]",
    "overlay": "show: sensors, contacts: [0, 3], overlay: true, time: [1 ms, 5 ms]",
    "first": "show: sensors, contacts: [1, 3], normalise: first, time: [0 ms, 5 ms]",
    "largest": "show: sensors, contacts: [1, 3], normalise: max, time: [0 ms, 5 ms]",
    "peaks": "",
    "root": "show: peaks, scale: sqrt",
    "profiles": "field: velocity, at: [5 ms, 10 ms, 12.5 ms]",
    "forces": "show: profiles, field: contact-force, at: [5 ms, 10 ms]",
    "bands": "",
    "eigenmodes": "",
    "energy": "beads: 5, time: [2 ms, 12 ms], every: 40 us",
    "place": "show: energy, parts: place, every: 50 us",
    "spreading": "theory: true",
    "spectrum": "contacts: [0, 3], scale: log",
    "transfer": "beads: [3, 5]",
}


def of(table, chain):
    """The rows of one chain."""
    which = [i for i, name in enumerate(table["chain"]) if name == chain]
    return {name: [column[i] for i in which] for name, column in table.items()}


def alike(name, places, *titles, units=("s", "N"), x="time_s", per=None, names=NAMES):
    """A panel for each chain with a curve for each place, whose columns are divided by `per` of them."""
    table, panels = rows(f"{name}.csv"), []
    for chain, title in names.items():
        columns = {p: table[f"{chain}/{p.replace(' ', '_')}"] for p in places}
        label = {p: p.removesuffix(" velocity") for p in places}
        panels.append((title, [Curve(label[p], table[x], [v / (per(columns, p) if per else 1) for v in columns[p]]) for p in places]))
    return f"{name}.svg", panels, units, list(titles)


def peaks(name):
    table = rows(f"{name}.csv")
    curves = [Curve(title, of(table, chain)["contact"], of(table, chain)["peak_force_N"], marks=True) for chain, title in NAMES.items()]
    return f"{name}.svg", [("", curves)], ("", "N"), ["contact", "peak force"]


def profiles(name, field, unit, place, times):
    table, panels = rows(f"{name}.csv"), []
    for chain, title in NAMES.items():
        own = of(table, chain)
        curves = []
        for time in times:
            at = [i for i, t in enumerate(own["time_s"]) if abs(1e3 * t - float(time)) < 1e-9]
            curves.append(Curve(f"t = {time} ms", [own[place][i] for i in at], [own[f"{field}_{unit}"][i] for i in at]))
        panels.append((title, curves))
    return f"{name}.svg", panels, ("", unit), [place, field.replace("-", " ")]


def bands():
    """Between the edges of the table: of equal beads a sine, of two kinds in turn those of their quadratic equation."""
    table, panels, count = rows("bands.csv"), [], 200
    for chain in NAMES:
        own = of(table, chain)
        curves, edges = [], [(own["low_Hz"][i], own["high_Hz"][i]) for i, kind in enumerate(own["kind"]) if kind == "band"]
        x = [i / count for i in range(count + 1)]
        low, high = edges[0][0], edges[-1][1]
        if len(edges) == 1:
            y = [high * math.sin(math.pi * part / 2) for part in x]
        else:  # w^4 - (a + b) w^2 + a b sin^2(q / 2) = 0, where a and b are the inner edges
            a, b = edges[0][1] ** 2, edges[1][0] ** 2
            root = [math.sqrt((a + b) ** 2 - 4 * a * b * math.sin(math.pi * part / 2) ** 2) for part in x]
            x, y = x + [math.nan] + x, [math.sqrt((a + b - r) / 2) for r in root] + [math.nan] + [math.sqrt((a + b + r) / 2) for r in root]
            assert abs(high / math.sqrt(a + b) - 1) < 1e-9 and low == 0
        panels.append((chain, [Curve(None, x, y)]))
    return "bands.svg", panels, ("", "Hz"), ["wave number × cell / π", "frequency"]


def eigenmodes():
    table = rows("eigenmodes.csv")
    panels = [(title, [Curve(None, of(table, chain)["frequency_Hz"], of(table, chain)["participation"], line=False, marks=True)])
              for chain, title in NAMES.items()]
    return "eigenmodes.svg", panels, ("Hz", ""), ["frequency", "participation in beads"]


def energy(name, parts, beside=(), fallen=()):
    """Parts on each other, but for those that fall below 0."""
    table, panels = rows(f"{name}.csv"), []
    time = table["time_s"]
    there = [p for p in parts if any(v for chain in NAMES for v in table[f"{chain}/{p}_J"])]
    put_in = {chain: [a + b for a, b in zip(table[f"{chain}/work_J"], table[f"{chain}/total_J"])] for chain in NAMES}
    lines = {p for p in there for chain in NAMES if any(v < -1e-3 * e for v, e in zip(table[f"{chain}/{p}_J"], put_in[chain]))}
    assert lines == set(fallen), lines
    for chain, title in NAMES.items():
        below, curves = [0] * len(time), []
        for part in there:
            if part in lines:
                curves.append(Curve(part, time, table[f"{chain}/{part}_J"]))
                continue
            above = [a + b for a, b in zip(below, table[f"{chain}/{part}_J"])]
            curves.append(Curve(part, time, below, upper=above))
            below = above
        curves.append(Curve("put in", time, put_in[chain]))
        curves += [Curve(b.replace("_", " "), time, table[f"{chain}/{b}_J"]) for b in beside]
        panels.append((title, curves))
    return f"{name}.svg", panels, ("s", "J"), ["time", "energy"]


SPREADING = ("second moment (beads²)", "second_moment", "gamma"), ("participation", "participation", "eta"), ("front", "front", None)
THEORIES = ("ballistic, exponent 2", 2), ("diffusion, exponent 1", 1)


def spreading():
    table, panels = rows("spreading.csv"), []
    for chain, title in NAMES.items():
        own = of(table, chain)
        time, curves = own["time_s"], []
        for name, column, exponent in SPREADING:
            curves.append(Curve(name, time, own[column]))
            if exponent:  # a line of this slope through the mean of the logarithms of what it fits, all from 0.07 of the last time on
                slope, error = own[exponent][-1], own[f"{exponent}_error"][-1]
                fitted = [(math.log(t), math.log(v)) for t, v in zip(time, own[column]) if t >= 0.07 * time[-1] * (1 - 1e-12)]
                x, y = (sum(f[k] for f in fitted) / len(fitted) for k in (0, 1))
                ends = [0.07 * time[-1], time[-1]]
                curves.append(Curve(f"exponent {slope:.3f} ± {error:.3f}".replace("-", "−"), ends, [math.exp(y + slope * (math.log(t) - x)) for t in ends]))
        first = curves[1].points[0]
        for words, power in THEORIES:
            curves.append(Curve(f"theory: {words}", ends, sloping(ends, power, first[1])))
        panels.append((title, curves))
    return "spreading.svg", panels, ("s", ""), ["time", "beads"]


def chains():
    outputs = ""
    for name, keys in SHOWN.items():
        every = ", every: 10 us" if name in ("sensors", "first", "largest") else ""
        keys = ", ".join(k for k in (keys if "show:" in keys else f"show: {name}", keys if "show:" not in keys else "") if k)
        plain = re.sub(r", (theory|overlay|normalise): \w+|, scale: \w+", "", keys)
        outputs += f"  - {{plot: {name}.svg, {keys}}}\n  - {{table: {name}.csv, {plain}{every}}}\n"
    run("chains.yaml", """materials:
  unit: {mass: 1 kg, radius: 0.5 m, modulus: 1 GPa, poisson: 0}
  light: {mass: 0.3 kg, radius: 0.5 m, modulus: 1 GPa, poisson: 0}
chains:
  - {name: one, precompression: 1 N, striker: {bead: unit, velocity: 30 mm/s}, beads: [{bead: unit, count: 12}]}
  - {name: two, precompression: 2 N, damping: {coefficient: 1}, striker: {bead: unit, velocity: 2 mm/s}, beads: [{cell: [unit, light], count: 4}]}
simulate: {until: 30 ms}
outputs:
""" + outputs)
    force, places = "contact force", ["bead 2", "contact 0", "contact 3"]
    check("forces of beads and contacts", *alike("sensors", places, "time", "force"))
    table = rows("sensors.csv")
    both = [Curve(f"{title}: {p}", table["time_s"], table[f"{chain}/{p.replace(' ', '_')}"])
            for chain, title in NAMES.items() for p in places[1:]]
    check("... of both chains in one panel", "overlay.svg", [("", both)], ("s", "N"), ["time", force])
    larger = [Curve("contact 3", table["time_s"], [1.005 * v for v in table["one/contact_3"]])]
    there = read("sensors.svg")[0]
    tap.ok(len(differences(there, larger, there.legend, ("s", "N"))) > 1, "a table of values 0.5 % larger is noticed")
    places = ["contact 1", "contact 3"]
    check("... divided by the largest of the first", *alike("first", places, "time", f"{force} F/Fmax(contact 1)", units=("s", ""),
                                                            per=lambda columns, _: max(columns[places[0]])))
    check("... and of each", *alike("largest", places, "time", f"{force} F/Fmax", units=("s", ""), per=lambda columns, p: max(columns[p])))
    check("peaks", *peaks("peaks"))
    check("... on an axis of their roots", *peaks("root"), ("linear", "sqrt"))
    check("velocities along the chain", *profiles("profiles", "velocity", "m/s", "bead", ["5.0", "10.0", "12.5"]))
    table = rows("profiles.csv")
    wanted = [(min(beads), max(beads)) for beads in (of(table, chain)["bead"] for chain in NAMES)]
    found = [reach(panel, 0) for panel in read("profiles.svg")]
    tap.ok(all(abs(a - b) < 0.02 for f, w in zip(found, wanted) for a, b in zip(f, w)), "... from the first to the last bead of each", found)
    check("forces of contacts along it", *profiles("forces", "contact-force", "N", "contact", ["5", "10"]))
    check("bands", *bands())
    check("modes of the chain at rest", *eigenmodes())
    check("energies, stacked", *energy("energy", ["kinetic", "contacts", "wall", "gravity", "springs", "dissipated"], ["past_bead_5"]))
    run("slope.yaml", """chains:
  - {name: one, tilt: 60 deg, striker: {velocity: 0.1 m/s}, beads: [{bead: brass, count: 8}], wall: brass}
  - {name: "two", tilt: 5 deg, striker: {velocity: 0.1 m/s}, beads: [{cell: [large-steel, aluminium], count: 4}], wall: brass}
simulate: {until: 0.5 ms}
outputs: [{plot: slope.svg, show: energy, every: 2 us}, {plot: whole.svg, show: energy, time: [0 us, 71.3 us]}, {table: slope.csv, show: energy, every: 2 us}]
""")
    check("... on a slope, where gravity gives energy", *energy("slope", ["kinetic", "contacts", "wall", "gravity"], fallen=["gravity"]))
    panel = read("whole.svg")[0]
    found = [max(p[0] for p in d.points) - panel.frame[2] for d in panel.drawn if d.filled and not d.stroke]
    tap.ok(len(found) == 3 and all(abs(off) < 0.3 for off in found), "... up to the frame", found)
    check("... by place", *energy("place", ["front", "behind", "reflected", "dissipated"]))
    check("spreading", *spreading(), ("log", "log"))
    check("a spectrum", *alike("spectrum", ["contact 0", "contact 3"], "frequency", f"amplitude of {force}", units=("Hz", "N"),
                               x="frequency_Hz"), ("linear", "log"))
    table = rows("spectrum.csv")
    tap.ok(*begins_at("spectrum.svg", 1e-6 * max(max(table[f"{chain}/contact_{k}"]) for chain in NAMES for k in (0, 3))))
    check("a transfer", *alike("transfer", ["bead 3 velocity", "bead 5 velocity"], "frequency", "transfer of velocity", units=("Hz", ""),
                               x="frequency_Hz"))


def theory():
    """Nesterenko's solitary wave, cos^6 of sqrt(2/5) beads, through the largest force and as high as its neighbours have it."""
    run("theory.yaml", """chain: {striker: {bead: large-steel, velocity: 1 m/s}, beads: [{bead: large-steel, count: 40}]}
outputs:
  - {plot: theory.svg, show: profiles, field: contact-force, at: [0.2 ms], theory: true}
  - {table: wave.csv, show: profiles, field: contact-force, at: [0.2 ms]}
  - {table: even.csv, show: spreading, every: 5 us, uncertainty: false}
  - {image: image.svg, field: velocity, beads: [5, 40]}
  - {table: most.csv, show: extremes, field: velocity, uncertainty: false}
""")
    most = rows("most.csv")
    most, (bar, title) = max(v for v, bead in zip(most["largest_m/s"], most["bead"]) if bead >= 5), bar_of("image.svg")
    tap.ok(title == "velocity (mm/s)" and 0.7 * most < max(bar) / 1e3 < 1.01 * most, "colours reach to the largest value", bar, title, most)
    panel, table, times = read("theory.svg")[0], rows("wave.csv"), rows("even.csv")["time_s"]
    label = next((words for words in panel.legend if words.startswith("long waves, ")), "long waves")
    profile = Curve("t = 200 µs", table["contact"], table["contact-force_N"])
    top = max(range(1, len(table["contact"]) - 1), key=lambda i: table["contact-force_N"][i])
    # Sixth roots of forces lie on a cosine; those of three neighbours tell where its middle is.
    place, rate = table["contact"], math.sqrt(2 / 5)
    roots = [table["contact-force_N"][i] ** (1 / 6) for i in (top - 1, top, top + 1)]
    phase = math.atan2(roots[2] - roots[0], 2 * math.sin(rate) * roots[1])
    height = table["contact-force_N"][top] / math.cos(phase) ** 6
    middle = place[top] + phase / rate
    x = [middle + 6 * i / 400 - 3 for i in range(401)]
    wave = Curve(label, x, [height * max(0, math.cos(rate * (v - middle))) ** 6 if abs(rate * (v - middle)) < math.pi / 2 else 0 for v in x])
    check("Nesterenko's wave over the pulse", "theory.svg", [("", [profile, wave])], ("", "N"), ["contact", "contact force"])
    tap.ok(max(abs(b - a - 5e-6) for a, b in zip(times, times[1:])) < 1e-12, "spreading has the times asked for")


# ---- strings ----

def strings():
    run("strings.yaml", """chains:
  - {name: one, equation: fput, points: 31, alpha: 0.25, start: {mode: 1}}
  - {name: two, equation: fput, points: 31, alpha: 0.1, start: {mode: 2}}
simulate: {until: 200}
outputs:
  - {plot: modes.svg, show: modes, modes: 4, every: 1}
  - {table: modes.csv, show: modes, modes: 4, every: 1, uncertainty: false}
  - {plot: powers.svg, show: modes, modes: 4, every: 1, scale: log}
""")
    names = {"one": "one", "two": "two"}
    for name in ("modes", "powers"):
        check(f"energies of modes: {name}", f"{name}.svg",
              *alike("modes", [f"mode {i}" for i in (1, 2, 3, 4)], "time", "energy of the mode", units=("", ""), x="time", names=names)[1:],
              ("linear", "linear" if name == "modes" else "log"))


# ---- sweeps ----

def where(table, **values):
    """The rows with these values."""
    which = [i for i in range(len(next(iter(table.values())))) if all(table[k][i] == v for k, v in values.items())]
    return {name: [column[i] for i in which] for name, column in table.items()}


def sloping(ends, slope, height):
    """A power law through a point."""
    return [height * (t / ends[0]) ** slope for t in ends]


def keys():
    """Over keys: chains of two magnetisms, four seeds each; curves over time, frequency and magnetism."""
    run("keys.yaml", """chain: {beads: [{cell: [large-steel, aluminium], count: 12, spins: random, magnetism: 0.5, seed: 1}]}
simulate: {until: 0.4 ms}
sweep: {over: {chain.beads.0.magnetism: [0.5, 0], chain.beads.0.seed: 1..4}, measure: {beads: [3, 12]}}
outputs:
  - {table: lines.csv, show: sensors, beads: [3, 12], field: velocity, every: 2 us}
  - {plot: lines.svg, show: sensors, beads: [3, 12], field: velocity, every: 2 us}
  - {table: amplitudes.csv, show: spectrum, beads: [3, 12], frequencies: [1 kHz, 60 kHz]}
  - {plot: amplitudes.svg, show: spectrum, beads: [3, 12], frequencies: [1 kHz, 60 kHz]}
  - {table: all.csv, show: spectrum, beads: [3, 12]}
  - {plot: all.svg, show: spectrum, beads: [3, 12], scale: log}
  - {table: spreads.csv, show: spreading}
  - {plot: spreads.svg, show: spreading, theory: true}
  - {table: results.csv}
  - {plot: both.svg, show: both}
  - {plot: mean.svg, show: mean}
  - {plot: median.svg, show: median}
  - {plot: measured.svg, measure: front speed, show: mean}
  - {table: measured.csv, measure: front speed}
""")
    values, count = {"magnetism 0.5": 0.5, "magnetism 0": 0}, 4
    for name, x, unit, column, quantity, field in (("lines", "time_s", ("s", "m/s"), "_velocity", "velocity", "velocity"),
                                                   ("amplitudes", "frequency_Hz", ("Hz", "N"), "", "amplitude of bead force", "force")):
        table, panels = rows(f"{name}.csv"), []
        for place in ("bead 3", "bead 12"):
            curves, bands = [], []
            for curve in values:
                own = where(table, curve=curve)
                mean, error = (own[place.replace(" ", "_") + column + end] for end in ("", "_error"))
                low, high = [m - e for m, e in zip(mean, error)], [m + e for m, e in zip(mean, error)]
                bands.append(Curve(None if curves else "± standard error", own[x], low, upper=high))
                curves.append(Curve(f"{curve}, mean of {count} chains", own[x], mean))
            panels.append((place, bands + curves))
        check(f"means over seeds of {field} and their errors", f"{name}.svg", panels, unit, [x.split("_", maxsplit=1)[0], quantity])
    table = rows("all.csv")
    largest = max(table["bead_3"] + table["bead_12"])
    last = max(f for f, *found in zip(table["frequency_Hz"], table["bead_3"], table["bead_12"]) if max(found) > 1e-3 * largest)
    tap.ok(*begins_at("all.svg", 1e-6 * largest))
    found = [1e3 * reach(panel, 0)[1] for panel in read("all.svg")]
    tap.ok(all(abs(f - last) < 0.005 * last for f in found), "... and frequencies to the last with a thousandth of it", found, last)
    table, panels = rows("spreads.csv"), []
    for curve in values:
        own = where(table, curve=curve)
        time, curves, ends = own["time_s"], [], (own["fit_from_s"][0], own["fit_to_s"][0])
        for label, column, exponent in SPREADING:
            curves.append(Curve(label, time, own[column]))
            if exponent:
                slope = own[exponent][-1]
                curves.append(Curve(f"exponent {slope:.3f} ± {own[exponent + '_error'][-1]:.3f}", ends, sloping(ends, slope, 1), anywhere=True))
        curves += [Curve(f"theory: {words}", ends, sloping(ends, power, 1), anywhere=True) for words, power in THEORIES]
        panels.append((curve, curves))
    check("spreading, means over seeds", "spreads.svg", panels, ("s", ""), ["time", "beads"], ("log", "log"))
    for name, file, unit, quantity in (("both", "results", "N", "peak bead force"), ("mean", "results", "N", "peak bead force"),
                                       ("median", "results", "N", "peak bead force"), ("measured", "measured", "m/s", "front speed")):
        table = rows(f"{file}.csv")
        x, column = table["chain.beads.0.magnetism"], {k.removesuffix("_" + unit): v for k, v in table.items()}
        curves = []
        if name in ("both", "median"):
            curves.append(Curve("quartiles", x, column["lower_quartile"], upper=column["upper_quartile"]))
        if name == "median":
            curves.append(Curve("median", x, column["median"], marks=True))
        else:
            curves.append(Curve("mean", x, column["mean"], marks=True, bars=column["standard_error"]))
        check(f"{quantity} by magnetism: {name}", f"{name}.svg", [("", curves)], ("", unit), ["magnetism", quantity])


def planes():
    """Colours over two keys: the boxes of the outer values end as far beyond them as half way to the next."""
    run("planes.yaml", """chain: {beads: [{bead: large-steel, count: 10}, {bead: large-steel, sensor: near}, {bead: large-steel, sensor: far}]}
sweep: {over: {chain.striker.velocity: [1 m/s, 2 m/s, 4 m/s], chain.beads.0.count: [10, 30]}, measure: {sensor: [near, far]}}
outputs: [{plot: plane.svg, show: plane}, {plot: speed.svg, show: plane, measure: front speed}]
""")
    titles = [[panel.title for panel in read(file)] for file in ("plane.svg", "speed.svg")]
    tap.ok(titles == [["(a)\u2002near", "(b)\u2002far"], [""]], "planes are named after their places, that of a measure has none", titles)
    panel = read("plane.svg")[0]
    left, top, right, bottom = panel.frame
    edges = [panel.axes[0].at(x) for x in (0.5, 5)] + [panel.axes[1].at(y) for y in (0, 40)]
    off = max(abs(a - b) for a, b in zip(edges, (left, right, bottom, top)))
    tap.ok(off < 3 * NEAR and [a.title for a in panel.axes] == ["striker velocity", "count"],
           "a plane is as wide as its keys", edges, panel.frame, [a.title for a in panel.axes])


def spins():
    run("spins.yaml", """sweep: {cells: 20, cell: [large-steel, aluminium], magnetism: [0.5, 0.6, 0.7, 0.8, 0.9, 1], configurations: 4, seed: 3,
        measure: {decay: true}}
outputs:
  - {table: each.csv, show: configurations}
  - {plot: spins.svg, show: both}
  - {plot: orders.svg, against: domain length}
  - {table: groups.csv}
  - {plot: decay.svg, show: decay}
  - {table: decay.csv, show: decay}
""")
    each, groups, force = rows("each.csv"), rows("groups.csv"), "peak force F/F(M = 1)"
    curves = [Curve("mean", groups["magnetism"], groups["mean"], marks=True, bars=groups["standard_error"]),
              Curve("median", groups["magnetism"], groups["median"]),
              Curve("each configuration", each["magnetism"], each["normalised"], line=False, marks=True)]
    check("each configuration, means and medians", "spins.svg", [("", curves)], ("", ""), ["magnetism M", force])
    with open("each.csv", encoding="utf-8") as table:
        words = [line["spins"] for line in csv.DictReader(table)]
    domains = [len(w) / (1 + sum(a != b for a, b in zip(w, w[1:]))) for w in words]
    points = Curve(None, domains, each["normalised"], line=False, marks=True)
    check("... by the length of their domains", "orders.svg", [("", [points])], ("", ""), ["domain length", force], ("log", "linear"))
    table, panels = rows("decay.csv"), []
    clean = where(table, magnetism=1.0)
    for quantity, title in (("force_N", force), ("energy_J", "energy of the front E/E(M = 1)")):
        curves, lines, kind = [], [], quantity.split("_", maxsplit=1)[0]
        for m in sorted(set(table["magnetism"])):
            own = where(table, magnetism=m)
            logs = [math.log(a / b) for a, b in zip(own[quantity], clean[quantity])][:41]  # the striker and 20 cells of two
            smooth = [(a + b) / 2 for a, b in zip(logs, logs[1:])]  # over a cell
            length, error = own[f"{kind}_length"][0], own[f"{kind}_length_error"][0]
            shown_part = range(len(smooth) - len(smooth) // 16)
            label = f"M = {m:.1f}" + ("" if math.isnan(length) else f", γ = {length:.0f} ± {error:.0f}")
            curves.append(Curve(label, [i + 0.5 for i in shown_part], [math.exp(smooth[i]) for i in shown_part], marks=None))
            if not math.isnan(length):  # of this length, through the mean of what it fits
                fitted = range(int(own["fit_first"][0]), int(own["fit_last"][0]) + 1)
                middle, height = sum(fitted) / len(fitted), sum(logs[i] for i in fitted) / len(fitted)
                ends = fitted[0], len(shown_part) - 1
                lines.append(Curve(None, [x + 0.5 for x in ends], [math.exp(height - (x - middle) / length) for x in ends]))
        panels.append(("", curves + lines, ["bead", title]))
    check("decay along the chain", "decay.svg", panels, ("", ""), None, ("linear", "log"))
    run("few.yaml", """sweep: {cells: 4, magnetism: [0.25, 1], configurations: 4, seed: 3}
outputs: [{table: few.csv, show: configurations}, {plot: few.svg, show: both}, {table: means.csv}]
""")
    each, groups = rows("few.csv"), rows("means.csv")
    counts = [each["magnetism"].count(m) for m in groups["magnetism"]]
    curves = [Curve("mean", groups["magnetism"], groups["mean"], marks=True, bars=groups["standard_error"]),
              Curve("median", groups["magnetism"], groups["median"]),
              Curve("each configuration", each["magnetism"], each["normalised"], line=False, marks=True)]
    tap.ok(counts[0] > counts[1], "chains of one spin are fewer", counts)
    check("... and all of the others are shown", "few.svg", [("", curves)], ("", ""), ["magnetism M", force])


def ends_asked_for():
    """Axes, and bars of colours, end where they are asked to."""
    asked = {"sensors": ("contacts: [0, 3], time: [0.2 ms, 0.8 ms]", (0.2e-3, 0.8e-3), (-20, 100)),
             "peaks": ("", None, (10, 100)),
             "profiles": ("field: velocity, at: [0.3 ms]", None, (-1, 1)),
             "energy": ("time: [0.1 ms, 0.7 ms]", (0.1e-3, 0.7e-3), (0.01, 0.06)),
             "spreading": ("", None, (2, 50)),
             "spectrum": ("contacts: 3, frequencies: [2 kHz, 60 kHz]", (2e3, 60e3), (0, 1))}
    outputs = [f"{{plot: ends-{name}.svg, show: {name}, range: [{low}, {high}]{', ' * bool(words)}{words}}}"
               for name, (words, _, (low, high)) in asked.items()]
    run("ends.yaml", f"""chain: {{striker: {{velocity: 0.4 m/s}}, beads: [{{cell: [large-steel, aluminium], count: 10}}]}}
simulate: {{until: 1 ms}}
outputs: [{', '.join(outputs)}]
""")
    for name, (_, *both) in asked.items():
        panel = read(f"ends-{name}.svg")[0]
        left, top, right, bottom = panel.frame
        for axis, ends, places in zip(panel.axes, both, ((left, right), (bottom, top))):
            base = next((base for base in ("Hz", "J", "s") if axis.unit in (base, "k" + base, "m" + base, "µ" + base)), axis.unit)
            off = [axis.at(end / shown(axis.unit, base)) - place for end, place in zip(ends or (), places)]
            tap.ok(all(abs(points) < 2 * NEAR for points in off), f"the {axis.title} of {name} ends as asked", ends, off)
    run("bars.yaml", """chain: {beads: [{bead: large-steel, count: 10}, {bead: large-steel, sensor: far}]}
sweep: {over: {chain.striker.velocity: [1 m/s, 2 m/s], chain.beads.0.count: [3, 5]}}
outputs: [{plot: bar.svg, show: plane, range: [-100, 700]}]
""")
    bar = bar_of("bar.svg")
    tap.ok((bar[0][0], bar[0][-1]) in ((-100, 700), (700, -100)), "a bar of colours ends as asked", bar)


chains()
theory()
strings()
keys()
planes()
spins()
ends_asked_for()
tap.finish()
