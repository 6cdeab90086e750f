#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""tests/ends.py PLOT.svg: words in the colours of curves, read back. Prints for each its colour, and from the right end of the curve of
this colour how far the word begins to the right and how far its middle is below, in sizes of its type; then how many there are."""
import re
import sys

svg = open(sys.argv[1], encoding="utf-8").read()


def numbers(text):
    return [float(x) for x in re.findall(r"-?[\d.]+(?:e-?\d+)?", text)]


def stroke(tag):
    found = re.search(r'stroke(?:="|:)(?:rgb\(([^)]+)\)|#(\w{6}))', tag)
    if found and found[2]:
        return tuple(int(found[2][i:i + 2], 16) for i in (0, 2, 4))
    return tuple(round(2.55 * x) for x in numbers(found[1])) if found else None


curves = {}
for tag in re.findall(r'<path [^>]*stroke-linejoin(?:="|:)round[^>]*>', svg):
    place = re.search(r'transform="matrix\(([^)]+)\)"', tag)
    a, _, _, d, e, f = numbers(place[1]) if place else (1, 0, 0, 1, 0, 0)
    points = [numbers(pair) for pair in re.findall(r"[ML] (-?[\d.]+ -?[\d.]+)", re.search(r' d="([^"]+)"', tag)[1])]
    x, y = max(points)
    curves[stroke(tag)] = (a * x + e, d * y + f)

count = 0
for place, fill, body in re.findall(r'<text transform="matrix\(([^)]+)\)" fill="#(\w{6})"[^>]*>(.*?)</text>', svg):
    colour = tuple(int(fill[i:i + 2], 16) for i in (0, 2, 4))
    a, _, _, d, e, f = numbers(place)
    size, base = float(re.search(r'font-size="([\d.]+)"', body)[1]), float(re.search(r' y="([\d.]+)"', body)[1])
    near = [end for ink, end in curves.items() if ink and max(abs(p - q) for p, q in zip(ink, colour)) <= 2]
    if not near:
        continue  # of axes and legends
    assert len(near) == 1, (fill, curves)
    middle = f + d * (base - 0.3 * size)  # of digits and small letters
    print(f"{fill}: {(e - near[0][0]) / (a * size):.2f} {(middle - near[0][1]) / (a * size):.2f}")
    count += 1
print(f"{count} names")
