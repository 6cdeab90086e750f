# SPDX-License-Identifier: GPL-3.0-or-later
"""Plots read back from SVG: panels with axes by their ticks and the numbers beside them, titles with units, curves, bands, marks and
bars, legends. For plots.py."""
import math
import re

NEAR = 0.24  # pt: ticks are on whole pixels of 600 dpi, 0.12 pt
PREFIX = {"n": 1e-9, "µ": 1e-6, "m": 1e-3, "": 1, "k": 1e3, "M": 1e6, "G": 1e9}


def near(stroke, ink):
    """Are these one colour, of a path in percent, perhaps paler for a line under marks, and of a text in hexadecimal digits?"""
    parts = [float(part) for part in re.findall(r"([\d.]+)%", stroke)]
    wanted = [int(ink[i:i + 2], 16) for i in (0, 2, 4)]
    return any(all(abs(255 - 2.55 * (100 - part) / pale - want) < 2.5 for part, want in zip(parts, wanted)) for pale in (1, 0.55))


class Path:
    """What is stroked or filled, in pt."""

    def __init__(self, tag):
        style = dict(re.findall(r"([\w-]+):([^;]*);", re.search(r'style="([^"]*)"', tag)[1]))
        moved = re.search(r'transform="matrix\(([^)]*)\)"', tag)
        a, _, _, d, e, f = map(float, moved[1].split(",")) if moved else (1, 0, 0, 1, 0, 0)
        self.filled, self.stroke = style.get("fill") != "none" and style.get("fill"), style.get("stroke") != "none" and style.get("stroke")
        self.dash, self.round = style.get("stroke-dasharray", ""), style.get("stroke-linejoin") == "round"
        self.parts = []
        words = re.search(r' d="([^"]*)"', tag)[1]
        self.closed = "Z" in words
        for command, numbers in re.findall(r"([MLC]) ([-\d. ]+)", words):
            x, y = map(float, numbers.split()[-2:])
            if command == "M":
                self.parts.append([])
            self.parts[-1].append((a * x + e, d * y + f))
        self.parts = [p + p[:1] if self.closed else p for p in self.parts if len(p) > 1 or not self.closed]
        self.points = [point for part in self.parts for point in part]
        self.box = [f(p[k] for p in self.points) for f in (min, max) for k in (0, 1)]  # left, top, right, bottom

    def look(self):
        """By which a legend tells curves apart."""
        if self.closed:
            return "mark", len(self.points), self.stroke, self.filled == self.stroke
        return "line", self.stroke, self.dash

    def bars(self):
        """Is each a line up and two across its ends?"""
        return len(self.parts) % 3 == 0 and all(len(p) == 2 for p in self.parts)

    def middle(self):
        return (self.box[0] + self.box[2]) / 2, (self.box[1] + self.box[3]) / 2


class Text:
    def __init__(self, place, ink, body):
        a, b, _, d, e, f = map(float, place.split())
        pieces = re.findall(r'<tspan x="([^"]*)" y="([^"]*)" textLength="([^"]*)"[^>]*font-size="([^"]*)"[^>]*>([^<]*)</tspan>', body)
        size = max(float(p[3]) for p in pieces)
        self.upright, scale = abs(b) > abs(a), abs(a) + abs(b)
        width = scale * (float(pieces[-1][0]) + float(pieces[-1][2]))
        self.words = "".join(p[4] for p in pieces).replace("\u00a0", " ").replace("\u2060", "")
        self.left, self.right = e, e + (0 if self.upright else width)
        self.middle = f - width / 2 if self.upright else f + scale * (float(pieces[0][1]) - 0.3 * size)
        self.ink, self.number = ink, None
        plain = self.words.replace("\u2212", "-").replace(" ", "").replace("\u202f", "")
        if len(pieces) == 2 and float(pieces[1][3]) < size and pieces[0][4] == "10":
            self.number = 10.0 ** int(pieces[1][4].replace("\u2212", "-"))
        elif re.fullmatch(r"-?[\d.]+", plain):
            self.number = float(plain)


SCALES = {"linear": lambda v: v, "log": math.log, "sqrt": lambda v: math.copysign(math.sqrt(abs(v)), v)}


class Axis:
    """Along x (k = 0) or y (1): places of ticks with their numbers, which lie evenly as they are, by their roots or by their
    logarithms."""

    def __init__(self, k, ticks, title):
        self.k, self.ticks = k, ticks
        self.title, self.unit = title, ""
        found = re.fullmatch(r"(.*) \(([^()]*)\)", title)
        if found:
            self.title, self.unit = found.groups()
        for self.kind, self.scale in SCALES.items():
            if self.kind == "log" and ticks[0][1] <= 0:
                continue
            values = [self.scale(v) for _, v in ticks]
            if values[-1] == values[0]:
                raise SystemExit(f"all ticks have one number: {ticks}")
            self.by = (ticks[-1][0] - ticks[0][0]) / (values[-1] - values[0])
            self.first = ticks[0][0] - self.by * values[0]
            if all(abs(self.at(v) - place) < NEAR / 2 for place, v in ticks):
                return
        raise SystemExit(f"ticks are not where their numbers lie: {ticks}")

    def at(self, value):
        return self.first + self.by * self.scale(value)


class Panel:
    def __init__(self, frame):
        self.frame, self.left = frame.box, frame.box[0]
        self.drawn, self.ticks, self.samples, self.legend, self.words = [], [], [], {}, []

    def take(self, path):
        strokes = len(path.parts) > 1 and not path.closed and all(len(p) == 2 for p in path.parts) and not path.round
        outside = path.box[1] >= self.frame[3] - 0.5 or path.box[2] <= self.frame[0] + 0.5
        if strokes and outside:
            self.ticks.append(path)
        elif len(self.ticks) == 2:
            self.samples.append(path)
        else:
            self.drawn.append(path)

    def read_axes(self, texts, others):
        left, top, right, bottom = self.frame
        axes = []
        for k, path in enumerate(self.ticks):
            long = max(abs(p[0][1 - k] - p[1][1 - k]) for p in path.parts)
            ticks = [p[0][k] for p in path.parts if abs(p[0][1 - k] - p[1][1 - k]) > 0.9 * long]
            def beside(text, at):
                if k == 0:
                    return abs((text.left + text.right) / 2 - at) < 1 and bottom < text.middle < bottom + 14
                return abs(text.middle - at) < 1.5 and left - 10 < text.right < left
            numbered = [(at, t.number) for at in ticks for t in texts if t.number is not None and not t.upright and beside(t, at)]
            titles = [t.words for t in texts
                      if (k == 0 and not t.upright and bottom + 14 < t.middle and abs((t.left + t.right - left - right) / 2) < 2)
                      or (k == 1 and t.upright and left - 45 < t.left < left and top < t.middle < bottom)]
            if len(numbered) > 1 and titles:
                axes.append(Axis(k, numbered, titles[0]))
                continue
            shared = [o.axes[k] for o in others if abs(o.frame[k] - self.frame[k]) < 0.1
                      and [p[0][k] for p in o.ticks[k].parts] == [p[0][k] for p in path.parts]]
            if not shared:
                raise SystemExit(f"an axis without numbers or title: {numbered}, {titles}")
            axes.append(shared[0])
        self.axes = axes
        self.title = next((t.words for t in texts if abs(t.left - left) < 1 and top - 14 < t.middle < top), "")

    def read_legend(self, texts):
        """{words: looks of the samples before them}"""
        left, top, right, bottom = self.frame
        for text in texts:
            before = [s for s in self.samples if s.box[2] < text.left < s.box[0] + 40 and abs(s.middle()[1] - text.middle) < 4.5]
            looks = [s.look() for s in before]
            fills = [("band", s.filled) for s in before if s.closed and not s.stroke]
            if right < text.left < right + 8:  # names at the ends of lines
                looks = [d.look() for d in self.drawn if d.stroke and (d.round or d.closed) and near(d.stroke, text.ink)]
            if looks:
                self.legend[text.words] = fills or looks

    def place(self, x, y):
        return self.axes[0].at(x), self.axes[1].at(y)


def texts_of(svg):
    return [Text(*found) for found in re.findall(r'<text transform="matrix\(([^)]*)\)" fill="#(\w{6})"[^>]*>(.*?)</text>', svg)]


def bar_of(file):
    """The numbers at the bar of colours of an image, and its title, which are at the right."""
    with open(file, encoding="utf-8") as svg:
        texts = texts_of(svg.read())
    title = max((t for t in texts if t.upright), key=lambda t: t.left)
    column = max(t.left for t in texts if t.number is not None and t.left < title.left)
    return [t.number for t in texts if t.number is not None and abs(t.left - column) < 1 and t.middle < max(u.middle for u in texts) - 12], title.words


def read(file):
    with open(file, encoding="utf-8") as svg:
        body = re.sub(r"<(metadata|defs)>.*?</\1>", "", svg.read(), flags=re.DOTALL)
    panels = []
    for tag in re.findall(r"<path [^>]*/>", body):
        path = Path(tag)
        large = path.closed and not path.filled and path.box[2] - path.box[0] > 40 and path.box[3] - path.box[1] > 40
        if large:
            panels.append(Panel(path))
        elif panels:
            panels[-1].take(path)
    texts = texts_of(body)
    for i, panel in enumerate(panels):
        panel.read_axes(texts, panels[:i])
        panel.read_legend(texts)
    return panels


def some(points):
    """Not so many that comparing takes long."""
    return points[::len(points) // 200 + 1]


class Outline:
    """Lines between points, for distances from them."""

    def __init__(self, parts):
        self.cells = {}
        for part in parts:
            p = part[0]
            for q in part[1:] or part:
                if q is not part[-1] and abs(q[0] - p[0]) < NEAR / 2 and abs(q[1] - p[1]) < NEAR / 2:
                    continue  # as good as one point
                for cell in range(math.floor(min(p[0], q[0])) - 1, math.floor(max(p[0], q[0])) + 2):
                    self.cells.setdefault(cell, []).append((p, q))
                p = q

    def off(self, x, y):
        best = math.inf
        for (ax, ay), (bx, by) in self.cells.get(math.floor(x), ()):
            dx, dy = bx - ax, by - ay
            along = min(1, max(0, ((x - ax) * dx + (y - ay) * dy) / (dx * dx + dy * dy or 1)))
            best = min(best, math.hypot(x - ax - along * dx, y - ay - along * dy))
        return best
