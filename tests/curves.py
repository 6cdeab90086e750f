#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Does a plot say what the table says? tests/curves.py PLOT.svg TABLE.csv XFACTOR YFACTOR [NUMBER]: reads the ticks, their labels and
one curve back (the first; bands count, too), and compares each of its points with the table, whose first two columns are divided by the factors.
With - instead of
the table: writes the points of the curve, in units of the axes. Ends with status 3 where they differ, with 1 where the plot cannot be read."""
import bisect
import math
import re
import sys

svg = open(sys.argv[1], encoding="utf-8").read()
points = []
if sys.argv[2] != "-":
    with open(sys.argv[2], encoding="utf-8") as table:
        points = [tuple(float(x) / float(by) for x, by in zip(line.split(",")[:2], sys.argv[3:5])) for line in list(table)[1:]]


def path(text):
    return [tuple(map(float, pair)) for pair in re.findall(r"[ML] ([-\d.]+) ([-\d.]+)", text)]


def long_strokes(axis):
    """Of the path of ticks that keep this coordinate: where those with labels, the longest, begin."""
    for d in re.findall(r'<path [^>]*fill(?:="none"|:none;)[^>]* d="([^"]+)"', svg):
        points_of = [] if "Z" in d else path(d)  # no frame
        strokes = list(zip(points_of[::2], points_of[1::2]))
        if len(strokes) > 1 and all(abs(a[axis] - b[axis]) < 1e-9 for a, b in strokes):
            size = max(abs(a[1 - axis] - b[1 - axis]) for a, b in strokes)
            return [a[axis] for a, b in strokes if abs(a[1 - axis] - b[1 - axis]) > 0.9 * size]
    raise SystemExit("no ticks")


down, left = long_strokes(0), long_strokes(1)
labels = [float(x.replace("\u2212", "-")) for x in re.findall(r">([\u2212\d.]+)</tspan>", svg)]
bar = 'image' in svg  # of colours: its ticks come last
assert len(labels) > len(down) + len(left) if bar else len(labels) == len(down) + len(left), (labels, down, left)


def scale(places, values):
    """The line through the first and the last tick; those in between lie on it, up to a unit of the device, or they do so by their
    logarithms."""
    def line(values):
        by = (values[-1] - values[0]) / (places[-1] - places[0])
        on_it = all(abs(values[0] + by * (place - places[0]) - value) <= 1.5 * abs(by) for place, value in zip(places, values))
        return on_it, by
    even, by = line(values)
    if even:
        return lambda at: values[0] + by * (at - places[0]), 2 * abs(by)
    logs = [math.log(value) for value in values]
    even, rate = line(logs)
    assert even, (places, values)
    return lambda at: math.exp(logs[0] + rate * (at - places[0])), 2 * abs(rate) * max(values)


to_x, unit_x = scale(down, labels[:len(down)])
to_y, unit_y = scale(left, labels[len(down):len(down) + len(left)])
number = int(sys.argv[5]) if len(sys.argv) > 5 else 0
curves = re.findall(r'<g clip-path="[^"]*"[^>]*>\n<path [^>]* d="([^"]+)"', svg)
if not curves:  # none reaches the frame; only lines of curves are round where they bend
    curves = re.findall(r'<path [^>]*stroke-linejoin(?:="|:)round[^>]* d="([^"]+)"', svg)
curve = [(to_x(x), to_y(y)) for x, y in path(curves[number])]
if not points:
    print("\n".join(f"{x:.9g},{y:.9g}" for x, y in curve))
    sys.exit()
assert len(curve) > 50
xs = [p[0] for p in points]
for x, y in curve:
    near = points[max(0, bisect.bisect_left(xs, x - 2 * unit_x) - 1):bisect.bisect_right(xs, x + 2 * unit_x) + 1]
    low, high = min(p[1] for p in near), max(p[1] for p in near)
    if not low - unit_y <= y <= high + unit_y:
        print(f"the curve has {y} at {x}, the table {low} to {high}")
        sys.exit(3)
highest, largest = max(y for _, y in curve), max(p[1] for p in points)
if abs(highest - largest) > unit_y:
    print(f"the curve's height is {highest}, the table's {largest}")
    sys.exit(3)
print(f"{len(curve)} points, largest {largest:.6g}")
