# SPDX-License-Identifier: GPL-3.0-or-later
"""Read reports as people do, in a headless Chromium: report.py CHROMIUM ASSETS DIRECTORY. Prints TAP.

DIRECTORY has run.html with force.csv, the forces at its sensors at the same times; and sweep.html with force of configurations.csv and
image.png, the pixels of configuration 3 in inferno."""
import base64
import csv
import math
import re
import sys

from devtools import Browser
from tap import finish, ok


def load_map(assets, name):
    with open("%s/colormaps/%s.txt" % (assets, name)) as file:
        rows = [line.split() for line in file if line.strip() and not line.startswith("#")]
    return [tuple(int(c) for c in row[:3]) for row in rows]


def map_colour(colours, value, high):
    """Of a scale of square roots from 0."""
    return colours[min(255, max(0, int(256 * math.sqrt(max(0, value) / high))))]


def bead_colour(colours, own, value, high):
    """As films mix it: the material's near zero, the map's from 0.3 of the bar on."""
    weight = min(1, math.sqrt(max(0, value) / high) / 0.3)
    weight = weight * weight * (3 - 2 * weight)
    return [(1 - weight) * a + weight * b for a, b in zip(own, map_colour(colours, value, high))]


def far(a, b):
    return max(abs(x - y) for x, y in zip(a, b))


def pixel(page, chain, x, y):
    """Of a chain's canvas, at CSS pixels."""
    return page.run("(() => { const c = report.canvases[%d], r = devicePixelRatio;"
                    "return [...c.getContext('2d').getImageData(Math.round(%g * r), Math.round(%g * r), 1, 1).data].slice(0, 3); })()" % (chain, x, y))


def check_pixels(page, assets, scheme, rows):
    page.prefer(scheme)
    page.settle()
    colours = load_map(assets, {"dark": "inferno", "light": "ember"}[scheme])
    high = page.run("report.data.range.high")
    materials = page.run("report.data.materials.map(m => m.colour)")
    worst = {"bead": 0, "image": 0}
    strongest = 0
    for row in rows[20:: max(1, len(rows) // 12)]:
        page.run("report.seek(%r)" % float(row["time_s"]))
        for name, value in ((n, float(v)) for n, v in row.items() if n != "time_s"):
            bead = page.run("report.chains[0].sensors.find(s => s.name === '%s').bead" % name)
            page.run("report.choose(%d)" % bead)
            page.run("report.state.bead = null; report.seek(%r)" % float(row["time_s"]))
            where = page.run("report.chains[0].where(%d)" % bead)
            own = materials[page.run("report.chains[0].material[%d]" % bead)]
            worst["bead"] = max(worst["bead"], far(pixel(page, 0, where["x"], where["y"]), bead_colour(colours, own, value, high)))
            page.run("report.setZoom({places: [%d, %d], samples: [report.state.sample - 4, report.state.sample + 4]}); report.seek(%r)"
                     % (bead - 2, bead + 2, float(row["time_s"])))
            spot = page.run("(() => { const c = report.chains[0], [s, t] = c.times(); return {x: c.x(%d), "
                            "y: c.image.y + c.image.h * (report.state.sample - s) / (t - s) - 2}; })()" % bead)
            worst["image"] = max(worst["image"], far(pixel(page, 0, spot["x"], spot["y"]), map_colour(colours, value, high)))
            page.run("report.setZoom(null)")
            strongest = max(strongest, value)
    ok(strongest > 0.2 * high, "%s: forces that show, up to %.3g of %.3g N" % (scheme, strongest, high))
    ok(worst["bead"] <= 6, "%s: beads have the colours of their forces in the table" % scheme, "off by %g levels" % worst["bead"])
    ok(worst["image"] <= 14, "%s: so has the space-time image" % scheme, "off by %g levels" % worst["image"])


def check_reading(page):
    """Names for a screen reader, contrast, and keys."""
    nodes = page.call("Accessibility.getFullAXTree")["nodes"]
    roles = {}
    for node in nodes:
        role = node.get("role", {}).get("value")
        roles.setdefault(role, []).append(node.get("name", {}).get("value", ""))
    for role in ("button", "slider", "combobox", "spinbutton", "application"):
        ok(roles.get(role) and all(roles[role]), "every %s has a name" % role, roles.get(role))
    images = roles.get("image", []) + roles.get("img", []) + roles.get("graphics-document", [])
    ok(len(images) >= 3 and all(images), "pictures have their texts", images)
    for scheme in ("dark", "light"):
        page.prefer(scheme)
        ratio = page.run("""(() => {
            const level = name => { const c = getComputedStyle(document.documentElement).getPropertyValue('--' + name).trim();
                const full = c.length === 4 ? c.replace(/[^#]/g, '$&$&') : c;
                const v = [1, 3, 5].map(i => parseInt(full.slice(i, i + 2), 16) / 255).map(x => x <= .04045 ? x / 12.92 : ((x + .055) / 1.055) ** 2.4);
                return .2126 * v[0] + .7152 * v[1] + .0722 * v[2]; };
            const contrast = (a, b) => (Math.max(a, b) + .05) / (Math.min(a, b) + .05);
            return Math.min(...['ink', 'faint', 'accent'].flatMap(t => ['background', 'panel'].map(b => contrast(level(t), level(b))))); })()""")
        ok(ratio >= 4.5, "%s: text has contrast, %.2f at least" % (scheme, ratio))


def check_playing(page):
    page.run("report.setZoom(null); report.seek(0)")
    page.run("document.activeElement.blur()")
    page.press(" ", " ")
    page.run("new Promise(done => setTimeout(done, 300))")
    first = page.run("report.state.sample")
    page.press(" ", " ")
    ok(first > 0 and not page.run("report.state.playing"), "space plays and stops")
    before = page.run("report.state.sample")
    page.press(".", ".")
    page.press(".", ".")
    page.press(",", ",")
    ok(page.run("report.state.sample") == round(before) + 1, "full stop and comma step", before)
    page.press("+", "+")
    ok(page.run("report.state.zoom !== null"), "+ zooms")
    page.press("0", "0")
    ok(page.run("report.state.zoom === null"), "0 shows all")
    page.run("report.canvases[0].focus(); report.state.bead = 3")
    page.press("ArrowRight")
    ok(page.run("report.state.bead") == 4 and page.run("document.getElementById('bead').value") == "4", "arrows choose a bead")
    ok("bead 4" in page.run("document.getElementById('said').textContent"), "and what it is is said")


def check_pointer(page, rows):
    page.run("scrollTo(0, 0)")
    page.run("report.setZoom(null)")
    page.settle()
    name = next(n for n in rows[0] if n != "time_s")
    bead = page.run("report.chains[0].sensors.find(s => s.name === '%s').bead" % name)
    spot = page.run("(() => { const c = report.chains[0], b = report.canvases[0].getBoundingClientRect(), i = c.image; "
                    "return {x: b.x + c.x(%d), y: b.y + i.y + i.h / 2, left: b.x + i.x, top: b.y + i.y, w: i.w, h: i.h}; })()" % bead)
    page.mouse("mouseMoved", spot["x"], spot["y"])
    tip = page.run("document.getElementById('tip').textContent")
    shown = page.run("document.getElementById('tip').style.visibility")
    ok(shown == "visible" and re.search(r"bead %d\b" % bead, tip) and " N" in tip, "the pointer shows values", tip)
    page.click(spot["x"], spot["y"])
    page.settle()
    ok(page.run("report.state.bead") == bead, "a click chooses the bead under it", page.run("report.state.bead"))
    label = page.run("document.getElementById('one-chart').getAttribute('aria-label')")
    largest = max(float(row[name]) for row in rows)
    said = re.search(r"largest ([0-9.]+) (m?)N", label)
    value = float(said.group(1)) * (1e-3 if said.group(2) else 1) if said else 0
    ok(abs(value - largest) < 2e-3 * largest, "its chart has the largest force of the table, %.4g N" % largest, label)
    page.run("scrollTo(0, 0)")
    page.settle()
    page.drag(spot["left"] + 0.25 * spot["w"], spot["top"] + 0.25 * spot["h"], spot["left"] + 0.5 * spot["w"], spot["top"] + 0.5 * spot["h"])
    zoom = page.run("report.state.zoom")
    ok(zoom and zoom["places"][1] - zoom["places"][0] < 0.35 * page.run("report.chains[0].values"), "dragging zooms", zoom)


def check_touch(page, directory):
    page.resize(390, 844, mobile=True)
    page.call("Emulation.setTouchEmulationEnabled", enabled=True, maxTouchPoints=2)
    page.open("file://%s/run.html" % directory)
    page.settle()
    spot = page.run("(() => { const b = report.canvases[0].getBoundingClientRect(), i = report.chains[0].image; "
                    "return {x: b.x + i.x + i.w / 2, y: b.y + i.y + i.h / 2}; })()")
    x, y = spot["x"], spot["y"]
    page.touch("touchStart", (x - 20, y))
    page.touch("touchStart", (x - 20, y), (x + 20, y))
    for far_out in range(30, 90, 20):
        page.touch("touchMove", (x - far_out, y), (x + far_out, y))
    page.touch("touchEnd")
    page.settle()
    ok(page.run("report.state.zoom !== null && report.state.bead === null"), "two fingers zoom, and choose nothing")
    page.run("report.setZoom(null)")
    page.touch("touchStart", (x, y))
    page.touch("touchEnd")
    page.settle()
    ok(page.run("report.state.bead !== null"), "one finger chooses a bead")
    page.call("Emulation.setTouchEmulationEnabled", enabled=False)


def check_text(page, scene):
    ok(page.run("document.title") == scene["title"], "the title is the scene's, whatever it contains", page.run("document.title"))
    ok(page.run("document.querySelectorAll('h1 *, #scene-text *').length") == 0, "no element comes from the scene")
    ok("title:" in page.run("document.getElementById('scene-text').textContent"), "the scene is there")
    page.run("navigator.clipboard.writeText = async text => { window.copied = text; }")
    page.run("document.getElementById('copy').click()")
    page.settle()
    ok(page.run("window.copied === document.getElementById('scene-text').textContent"), "its button copies it")
    table = page.run("document.getElementById('numbers-table').textContent")
    ok(re.search(r"\d ± 0\.0*\d", table), "numbers have their uncertainty", table)


def check_sweep(page, directory):
    """A click on a point shows its image, which is that of the configuration's own run."""
    page.resize(1280, 800)
    page.prefer("dark")
    page.open("file://%s/sweep.html" % directory)
    page.settle()
    with open(directory + "/configurations.csv") as file:
        forces = {int(row["configuration"]): float(row["peak_force_N"]) for row in csv.DictReader(file) if row["configuration"]}
    shown = page.run("Object.fromEntries(report.data.panels[0].places[0].indices.map((index, i) => "
                     "[index, report.data.panels[0].places[0].values[i] * report.data.panels[0].places[0].clean]))")
    ok(len(shown) == len(forces) and all(abs(shown[str(i)] - f) < 1e-9 * f for i, f in forces.items()), "points have the forces of the table", shown)
    for number in (3, 0):
        spot = page.run("(() => { const b = document.querySelector('#force-chart [data-index=\"%d\"]').getBoundingClientRect();"
                        "return {x: b.x + b.width / 2, y: b.y + b.height / 2}; })()" % number)
        page.click(spot["x"], spot["y"])
        page.settle()
        ok(page.run("report.state.image.index") == number, "a click on the point of configuration %d shows it" % number)
    page.run("report.choose(3)")
    with open(directory + "/image.png", "rb") as file:
        picture = base64.b64encode(file.read()).decode()
    mean = page.run("""(async () => {
        const image = new Image(), canvas = document.createElement('canvas'), mine = report.pixels(report.state.image);
        image.src = 'data:image/png;base64,%s';
        await image.decode();
        if (image.width !== mine.width || image.height !== mine.height)
            return 999;
        canvas.width = image.width, canvas.height = image.height;
        const context = canvas.getContext('2d');
        context.drawImage(image, 0, 0);
        const other = context.getImageData(0, 0, image.width, image.height).data;
        return other.reduce((sum, v, i) => sum + Math.abs(v - mine.data[i]), 0) / other.length; })()""" % picture)
    ok(mean < 1.5, "its pixels are those of the run itself", "%s levels apart" % mean)
    page.press("ArrowRight")
    ok(page.run("report.state.image.index") != 3 and page.run("document.getElementById('said').textContent") != "", "arrows go to the next")
    page.resize(390, 844, mobile=True)
    page.open("file://%s/sweep.html" % directory)
    page.settle()
    ok(page.run("document.documentElement.scrollWidth <= innerWidth"), "a sweep fits a phone")


def main():
    chromium, assets, directory = sys.argv[1:4]
    with open(directory + "/force.csv") as file:
        rows = [row for row in csv.DictReader(file)]
    page = Browser(chromium)
    try:
        page.open("file://%s/run.html" % directory)
        page.settle()
        for scheme in ("dark", "light"):
            check_pixels(page, assets, scheme, rows)
        check_playing(page)
        check_pointer(page, rows)
        check_reading(page)
        check_text(page, {"title": "A </script><b>title</b> & \"more\""})
        for width, height in ((390, 844), (1280, 800), (1920, 1080)):
            page.resize(width, height, mobile=width < 500)
            page.open("file://%s/run.html" % directory)
            page.settle()
            fits = page.run("document.documentElement.scrollWidth <= innerWidth && document.getElementById('controls').getBoundingClientRect().bottom <= innerHeight + 1")
            ok(fits, "%d x %d: nothing is wider than the window, and the controls are in it" % (width, height))
        check_touch(page, directory)
        check_sweep(page, directory)
        ok(not page.errors, "no error in the console", page.errors)
        ok(all(r.startswith("file://%s/" % directory) and r.endswith(".html") for r in page.requests), "nothing is asked for but the page",
             page.requests)
    finally:
        page.close()
    finish()


main()
