# SPDX-License-Identifier: GPL-3.0-or-later
"""Checks of a Python program, counted and printed as TAP; `relay` of shell.bash makes them those of a script."""
import sys

count = failed = 0
where = ""  # begins what each check says


def ok(good, what, *details):
    """A check, and what to say where it failed."""
    global count, failed
    count += 1
    failed += not good
    print("ok" if good else "not ok", count, "-", where + what, flush=True)
    for detail in details if not good else ():
        print("# " + str(detail).replace("\n", "\n# "), flush=True)


def skip(missing, what):
    """A check left out, as this machine lacks a program or module; with its Debian package."""
    global count
    count += 1
    print(f"# missing: {missing}\nok {count} - {where}{what} # SKIP", flush=True)


def finish():
    """The last call of a program."""
    print(f"1..{count}")
    sys.exit(failed > 0)
