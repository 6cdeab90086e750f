#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Check that H5Web shows the space-time picture of a trajectory as it opens, with the right numbers: h5web.py CHROMIUM DIRECTORY FILE...

DIRECTORY has the files, and H5Web as main.js and main.css (h5web.jsx, bundled). Prints TAP.
"""
import functools
import http.server
import sys
import threading
import time

import h5py
import numpy as np

from devtools import Browser
from tap import finish, ok

PAGE = b"""<!DOCTYPE html>
<meta charset="utf-8"><link rel="icon" href="data:,"><link rel="stylesheet" href="main.css">
<style>html, body, #root { height: 100%; margin: 0 }</style>
<body><div id="root"></div><script type="module" src="main.js"></script></body>"""


class Server(http.server.SimpleHTTPRequestHandler):
    def do_GET(self):
        if not self.path.startswith("/?"):
            return super().do_GET()
        self.send_response(200)
        self.send_header("Content-Type", "text/html")
        self.send_header("Content-Length", str(len(PAGE)))
        self.end_headers()
        self.wfile.write(PAGE)

    def log_message(self, *_):
        pass


def wait_for(page, script):
    """The value of the expression as soon as it has one; empty after a minute."""
    for _ in range(600):
        value = page.run(script)
        if value:
            return value
        time.sleep(0.1)
    return ""


def under_pointer(page, x, y):
    """What H5Web says of the place: its coordinates by name, and the value."""
    page.mouse("mouseMoved", x, y)
    page.settle()
    lines = wait_for(page, "document.querySelector('.visx-tooltip')?.innerText").split("\n")
    return dict(part.split("=") for part in lines[0].split(", ")), float(lines[1].split()[0])


def check_values(page, name, plot):
    """Under the pointer, along the pulse, stand the values that h5py reads."""
    dataset, times = plot[plot.attrs["signal"]], plot["time"][:]
    box = page.run("document.querySelector('canvas').getBoundingClientRect().toJSON()")
    rows, beads = dataset.shape
    values, seen, good = dataset[:], [], True
    for bead in np.linspace(1, beads - 2, 12).astype(int):
        row = int(values[:, bead].argmax())
        where, value = under_pointer(page, box["left"] + (bead + 0.5) / beads * box["width"],
                                     box["bottom"] - min(row + 0.5, rows - 1) / rows * box["height"])
        axes = list(where)
        column = int(float(where[axes[0]]))
        column = column if axes[0] == "x" else plot[axes[0]][:].tolist().index(column)  # one chain: its beads by their numbers
        near = np.abs(times - float(where[axes[1]])) <= 1e-5 * times[-1] + 0.5 * times[1]
        good = good and np.any(np.isclose(values[near, column], value, rtol=1e-4, atol=1e-6))
        good = good and abs(column - bead) <= 1 and axes[1] == "time (s)"
        seen.append(value)
    ok(good and max(seen) > 0.2 * values.max(), f"{name}: H5Web's values under the pointer are h5py's")


def check(page, address, directory, name):
    page.open(f"{address}/?file={name}")
    shown = wait_for(page, "document.querySelector('canvas') && [...document.querySelectorAll('[aria-selected=true]')].map(e => e.innerText)")
    ok("NX Heatmap" in shown, f"{name}: H5Web opens with a heat map")
    with h5py.File(f"{directory}/{name}", "r") as file:
        plot = file
        while "default" in plot.attrs:
            plot = plot[plot.attrs["default"]]
        value = plot[plot.attrs["signal"]]
        text = wait_for(page, "document.body.innerText.includes('time (s)') && document.body.innerText").split("\n")
        ok(value.attrs["long_name"].decode() in text and "time (s)" in text, f"{name}: H5Web names the field and the axis of time")
        ok(f"{value[:].max():.3e}".replace("e+0", "e+") in text, f"{name}: H5Web's colours go to the largest value")
        check_values(page, name, plot)
    ok(not page.errors, f"{name}: H5Web meets no error" + "".join(f" ({error[:100]})" for error in page.errors[:1]))


def main():
    if len(sys.argv) < 4:
        sys.exit(__doc__)
    directory = sys.argv[2]
    server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), functools.partial(Server, directory=directory))
    threading.Thread(target=server.serve_forever, daemon=True).start()
    # Its pictures are made with WebGL, here without a graphics card.
    page = Browser(sys.argv[1], flags=["--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--ignore-gpu-blocklist"])
    try:
        for name in sys.argv[3:]:
            check(page, f"http://127.0.0.1:{server.server_port}", directory, name)
    finally:
        page.close()
        server.shutdown()
    finish()


main()
