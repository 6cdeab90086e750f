# SPDX-License-Identifier: GPL-3.0-or-later
"""What the tests reach of sim and render, by room: python3 tests/coverage.py FOLDER [PAGE WHEN], where FOLDER has a report of `gcov
--json-format` for each object (tests/coverage.sh). PAGE is a file in Markdown, in which the figures between two marks are written anew; WHEN says of what they are.

Names the lines that nothing reaches and the branches that are never taken, as file:line: text. Ends with whether the aims hold."""
import collections
import glob
import itertools
import json
import os
import re
import sys

AIMED = ["sim/" + room for room in ("chain", "integrate", "run", "scene", "output", "sweep")]
AIMS = (95, 85)  # percent of lines, of branches

# What cannot be reached by design, as (pattern of file:line's text, why). Keep it short: code that cannot be reached is better deleted.
UNREACHABLE = []


class Count:
    """Lines and branches: how many there are, and how many are reached."""

    def __init__(self):
        self.reached, self.all = [0, 0], [0, 0]

    def add(self, kind, reached):
        self.all[kind] += 1
        self.reached[kind] += reached

    def percent(self, kind):
        return 100 * self.reached[kind] / self.all[kind] if self.all[kind] else 100.0

    def cells(self, name):
        return f"| {name} | " + " | ".join(f"{self.reached[k]} of {self.all[k]} | {self.percent(k):.1f} %" for k in (0, 1)) + " |"

    def row(self, name):
        lines, branches = (f"{self.reached[k]:6} of {self.all[k]:6} {self.percent(k):6.2f} %" for k in (0, 1))
        return f"{name:<18}{lines}   {branches}"


def left_out(path, text):
    return any(re.search(pattern, f"{path}: {text}") for pattern, _ in UNREACHABLE)


def count_file(file, counts, unreached):
    path = file["file"]
    names = (os.path.dirname(path), f"all of {path.split('/')[0]}", "all") + (("aimed at",) if os.path.dirname(path) in AIMED else ())
    with open(path, encoding="utf-8") as source:
        text = [line.strip() for line in source]
    for line in file["lines"]:
        number, branches = line["line_number"], [b["count"] > 0 for b in line["branches"]]
        if left_out(path, text[number - 1]):
            continue
        for name in names:
            counts[name].add(0, line["count"] > 0)
            for taken in branches:
                counts[name].add(1, taken)
        if line["count"] == 0:
            unreached.append(f"{path}:{number}: {text[number - 1]}")
        elif not all(branches):
            unreached.append(f"{path}:{number}: {text[number - 1]}  [{branches.count(False)} of {len(branches)} branches]")


BEGINS, ENDS = "<!-- Written by tests/coverage.sh. -->", "<!-- The end of the coverage. -->"


def write_page(page, when, counts, order):
    with open(page, encoding="utf-8") as file:
        before, rest = file.read().split(BEGINS)
    table = [when, "", "| room | lines | | branches | |", "|---|--:|--:|--:|--:|"] + [counts[name].cells(name) for name in order]
    with open(page, "w", encoding="utf-8") as file:
        file.write(before + "\n".join([BEGINS, "", *table, "", ENDS]) + rest.split(ENDS)[1])


def merged(folder):
    """The files of all reports. A line, or a branch, of several objects is reached where one of them has reached it."""
    files = {}
    for report in glob.glob(f"{folder}/*.json"):
        with open(report, encoding="utf-8") as text:
            for file in json.load(text)["files"]:
                if not file["file"].startswith(("sim/", "render/")):
                    continue
                lines = files.setdefault(file["file"], {})
                for line in file["lines"]:
                    into = lines.setdefault(line["line_number"], line)
                    if into is line:
                        continue
                    into["count"] = max(into["count"], line["count"])
                    for one, other in itertools.zip_longest(into["branches"], line["branches"]):
                        if one and other:
                            one["count"] = max(one["count"], other["count"])
                        elif other:
                            into["branches"].append(other)
    return [{"file": name, "lines": list(lines.values())} for name, lines in files.items()]


def main():
    files = merged(sys.argv[1])
    if not files:
        sys.exit(f"{sys.argv[1]} has no reports")
    counts, unreached = collections.defaultdict(Count), []
    for file in sorted(files, key=lambda f: f["file"]):
        count_file(file, counts, unreached)
    print("Nothing reaches these lines, or (in brackets) so many ways out of them:", *unreached, sep="\n")
    print(f"\n{'room':<18}{'lines':>24}   {'branches':>24}")
    totals = ("all of sim", "all of render", "all", "aimed at")
    rooms, sums = sorted(set(counts) - set(totals)), [t for t in totals if t in counts]
    for name in rooms + [""] + sums:
        print(counts[name].row(name) if name else "")
    if len(sys.argv) > 3:
        write_page(sys.argv[2], sys.argv[3], counts, rooms + sums)
    for pattern, why in UNREACHABLE:
        print(f"left out: {pattern}: {why}")
    below = [f"{room} ({counts[room].percent(0):.2f} % of lines, {counts[room].percent(1):.2f} % of branches)" for room in AIMED
             if any(counts[room].percent(kind) < aim for kind, aim in enumerate(AIMS))]
    if below:
        print("Below the aims:", "; ".join(below))
    print(f"The aims, {AIMS[0]} % of lines and {AIMS[1]} % of branches in each of {', '.join(AIMED)}, {'DO NOT HOLD' if below else 'hold'}: "
          f"{counts['aimed at'].percent(0):.2f} % and {counts['aimed at'].percent(1):.2f} % of all of these")
    return 1 if below else 0


if __name__ == "__main__":
    sys.exit(main())
