#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Make assets/findings.md from its template: make.py [--all | --renew] BEADSIM >findings.md

Runs the template's `sh` blocks, in their order and in a folder of their own, and puts what they wrote into the text: «EXPRESSION:FORMAT»
is a Python format field, a comment <!-- python ... --> defines what such expressions use. A run whose folder (-o NAME) stands in long/
takes seconds or minutes: its tables are taken from there. --all runs these, too; --renew also writes long/ again.
"""
import csv
import os
import pathlib
import re
import subprocess
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
LONG = HERE / "long"

# What `beadsim` is in the blocks: the program, or a copy of what it wrote.
RUN = """set -euo pipefail
beadsim() {
    local to="${*: -1}"
    if [ -d "$LONG/$to" ]; then cp -r "$LONG/$to" .; else "$BEADSIM" "$@" --progress none >/dev/null; fi
}
"""


def rows(path, **where):
    """The rows of a table, as mappings from header to text, that have these values."""
    with open(path, newline="") as file:
        found = [row for row in csv.DictReader(file) if all(same(row[key], value) for key, value in where.items())]
    if not found:
        raise LookupError(f"{path} has no row {where}")
    return found


def same(text, value):
    return text == value if isinstance(value, str) else abs(float(text) - value) < 1e-9


def cell(path, column, **where):
    """A number: the first such row's."""
    return float(rows(path, **where)[0][column])


def measure(path, name, **where):
    return cell(path, "value", name=name, **where)


def first_rows(source, target):
    """Copy a table: only the first row for every value of its first column, which has all that the text says."""
    seen = set()
    with open(source, newline="") as old, open(target, "w", newline="") as new:
        for row in csv.reader(old):
            if row[0] not in seen:
                seen.add(row[0])
                csv.writer(new, lineterminator="\n").writerow(row)


def renew():
    for kept in LONG.glob("*/*.csv"):
        first_rows(kept.relative_to(LONG), kept)


def document(template):
    """The template with its numbers, from the tables in the current folder."""
    names = {"re": re, "rows": rows, "cell": cell, "measure": measure}

    def replaced(found):
        if found["code"]:
            exec(found["code"], names)
            return ""
        return eval("f'''{" + found["field"] + "}'''", names)

    return re.sub(r"^<!-- python\n(?P<code>.*?)^-->\n\n?|«(?P<field>.+?)»", replaced, template, flags=re.S | re.M)


def main():
    program, mode = str(pathlib.Path(sys.argv[-1]).resolve()), sys.argv[1:-1]
    template = (HERE / "findings.md.in").read_text()
    script = RUN + "".join(re.findall(r"^```sh\n(.*?)^```$", template, re.S | re.M))
    environment = {"BEADSIM": program, "LONG": "/nowhere" if mode else str(LONG), "PATH": os.environ["PATH"],
                   "BEADREEL_ASSETS": str(HERE.parent)}
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        if subprocess.run(["bash", "-c", script], env=environment, check=False).returncode:
            sys.exit(1)
        if mode == ["--renew"]:
            renew()
        print(document(template), end="")


main()
