# SPDX-License-Identifier: GPL-3.0-or-later
"""Read reports as people do, in a headless Chromium: report.py CHROMIUM ASSETS DIRECTORY PAGE... Prints TAP.

DIRECTORY has run.html with force.csv, the forces at its sensors at the same times, and peaks.csv; and sweep.html with the forces of
configurations.csv and image.png, the pixels of configuration 3 in inferno. All pages, and those further ones, fit on phones."""
import base64
import csv
import math
import os
import re
import sys
import time
import xml.etree.ElementTree

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


def saved(page, what, kind):
    """The bytes of the file that the button `Save WHAT as KIND` makes. Browsers keep ten files of a page without asking, so this looks
    at what the page hands over."""
    spot = page.run("(() => { const button = document.querySelector('button[aria-label=\"Save %s as %s\"]'); "
                    "button.scrollIntoView({block: 'center'}); const b = button.getBoundingClientRect(); window.handed = null; "
                    "return {x: b.x + b.width / 2, y: b.y + b.height / 2}; })()" % (what, kind))
    page.click(spot["x"], spot["y"])
    return base64.b64decode(page.run("""(async () => {
        while (!window.handed)
            await new Promise(done => setTimeout(done, 20));
        const bytes = new Uint8Array(await window.handed.arrayBuffer());
        return btoa([...bytes].map(c => String.fromCharCode(c)).join('')); })()"""))


def kept(directory):
    """The first file that comes there."""
    for _ in range(600):
        names = [name for name in os.listdir(directory) if not name.endswith("download")]
        if names:
            with open(os.path.join(directory, names[0]), "rb") as file:
                return names[0], file.read()
        time.sleep(0.05)
    return None, b""


def table(content):
    return list(csv.DictReader(content.decode().splitlines()))


def check_saving(page, rows, directory):
    """What buttons save: numbers as in the program's own tables, pictures as on the page."""
    os.makedirs(directory + "/saved", exist_ok=True)
    page.call("Page.setDownloadBehavior", behavior="allow", downloadPath=directory + "/saved")
    page.run("(() => { const make = URL.createObjectURL; URL.createObjectURL = blob => { window.handed = blob; return make.call(URL, blob); }; })()")
    curve = saved(page, "these curves", "CSV")
    name, content = kept(directory + "/saved")
    ok(content == curve and re.fullmatch(r"A-script-b-title-b-more-bead-\d+\.csv", name or ""), "a saved file has the name of what it shows", name)
    step = page.run("report.chains[0].field.step")
    for name in (n for n in rows[0] if n != "time_s"):
        bead = page.run("report.chains[0].sensors.find(s => s.name === '%s').bead" % name)
        page.run("report.choose(%d)" % bead)
        mine = table(saved(page, "these curves", "CSV"))
        ok(list(mine[0]) == ["time_s", "bead", "force_N"], "a saved curve has the columns of a table of profiles", mine[0])
        worst = max(abs(float(a["force_N"]) - float(b[name])) for a, b in zip(mine, rows))
        ok(len(mine) == len(rows) and all(int(a["bead"]) == bead for a in mine) and worst <= 0.51 * step
           and max(abs(float(a["time_s"]) - float(b["time_s"])) for a, b in zip(mine, rows)) < 1e-12,
           "the curve at %s is the table's, to the %.2g N of the page" % (name, step), worst)
        at = rows[len(rows) // 2]
        page.run("report.seek(%r)" % float(at["time_s"]))
        profile = table(saved(page, "this picture", "CSV"))
        found = [float(p["force_N"]) for p in profile if int(p["bead"]) == bead]
        ok(len(profile) == page.run("report.chains[0].values") and abs(found[0] - float(at[name])) <= 0.51 * step, "so is the profile", found)
    with open(directory + "/peaks.csv", "rb") as file:
        wanted = table(file.read())
    peaks = table(saved(page, "the peaks", "CSV"))
    rounded = lambda name: 0.0101 if "uncertainty" in name else 1e-11
    same = all(set(a) == set(b) and all(abs(float(a[k] or 0) - float(b[k] or 0)) <= rounded(k) * abs(float(b[k] or 0)) for k in b if k != "state")
               for a, b in zip(peaks, wanted))
    ok(len(peaks) == len(wanted) > 20 and same, "saved peaks are those of the table", peaks[:2])
    listed = page.run("[...document.querySelectorAll('#peaks-table tbody tr')].map(row => [...row.cells].slice(-1)[0].textContent)")
    read = [re.fullmatch(r"([\d.]+) ± ([\d.]+) ([mµn]?)s", text) for text in listed]
    unit = {"": 1, "m": 1e-3, "µ": 1e-6, "n": 1e-9}
    ok(len(read) == len(wanted) and all(r and abs(float(r[1]) * unit[r[3]] - float(w["time_s"])) <= float(r[2]) * unit[r[3]]
                                        and float(r[2]) * unit[r[3]] >= 0.999 * float(w["time_s_uncertainty"]) for r, w in zip(read, wanted)),
       "listed peaks say how well their times are known", listed[:3])
    for what, words in (("this picture", "force (N)"), ("these curves", "bead force (N), bead"), ("the peaks", "peak force (N)")):
        drawn = xml.etree.ElementTree.fromstring(saved(page, what, "SVG"))
        texts = " ".join(t for e in drawn.iter() for t in e.itertext())
        ok(words in texts and "var(" not in xml.etree.ElementTree.tostring(drawn).decode(), "%s as SVG has its words and colours" % what, texts[:200])
        ok(not [e for e in drawn.iter() for k, v in e.items() if "href" in k and not v.startswith("data:")], "... and nothing from elsewhere")
        size = page.run("(() => { const b = document.getElementById('%s').getBoundingClientRect(); return [b.width, b.height]; })()"
                        % {"this picture": "stage", "these curves": "one-chart", "the peaks": "peaks-chart"}[what])
        picture = saved(page, what, "PNG")
        width, height = (int.from_bytes(picture[i:i + 4], "big") for i in (16, 20))
        ok(picture[:8] == b"\x89PNG\r\n\x1a\n" and width >= 2 * size[0] and height >= 2 * size[1], "... as PNG it is sharp", width, height, size)
        if what == "this picture":
            stage = picture
    check_stage(page, stage)


def check_stage(page, picture):
    """A saved picture of the chain has the pixels of the canvas, but for the edges of type and beads."""
    far_off = page.run("""(async () => {
        const image = new Image(), canvas = document.createElement('canvas'), stage = document.getElementById('stage').getBoundingClientRect();
        image.src = 'data:image/png;base64,%s';
        await image.decode();
        const shown = report.canvases[0], box = shown.getBoundingClientRect(), w = shown.width, h = shown.height, margin = (image.width / 2 - stage.width) / 2;
        canvas.width = w, canvas.height = h;
        const context = canvas.getContext('2d');
        context.fillStyle = getComputedStyle(document.documentElement).backgroundColor;
        context.fillRect(0, 0, w, h);
        context.drawImage(shown, 0, 0);
        const wanted = context.getImageData(0, 0, w, h).data;
        context.drawImage(image, 2 * (box.left - stage.left + margin), 2 * (box.top - stage.top + margin), 2 * box.width, 2 * box.height, 0, 0, w, h);
        const got = context.getImageData(0, 0, w, h).data;
        let count = 0;
        for (let i = 0; i < got.length; i += 4)
            count += Math.abs(got[i] - wanted[i]) + Math.abs(got[i + 1] - wanted[i + 1]) + Math.abs(got[i + 2] - wanted[i + 2]) > 40;
        return count / (got.length / 4); })()""" % base64.b64encode(picture).decode())
    ok(far_off < 0.03, "the saved picture is the one on the page", "%.3f of its pixels differ" % far_off)


def check_still(page, directory):
    """A click moves nothing but what it is for."""
    for width, height in ((1280, 700), (390, 700)):
        page.resize(width, height, mobile=width < 500)
        page.open("file://%s/run.html" % directory)
        page.settle()
        for what in ("canvas", "peaks"):
            page.run("scrollTo(0, %s)" % ("60" if what == "canvas" else "document.getElementById('peaks-chart').getBoundingClientRect().top + scrollY - 100"))
            page.settle()
            before = page.run("scrollY")
            spot = page.run("(() => { const b = %s.getBoundingClientRect(); return {x: b.x + b.width * .4, y: b.y + b.height * .5}; })()"
                            % ("report.canvases[0]" if what == "canvas" else "document.getElementById('peaks-chart')"))
            page.run("report.state.bead = null")
            page.click(spot["x"], spot["y"])
            page.run("new Promise(done => setTimeout(done, 700))")
            ok(page.run("report.state.bead !== null && scrollY === %r" % before), "%d px: a click on the %s chooses a bead and scrolls nowhere" % (width, what),
               before, page.run("scrollY"))


def check_link(page, directory):
    """An address shows its moment, and follows what is done."""
    shown = "[report.data.time.start + report.state.sample * report.data.time.every, report.state.bead]"
    page.resize(1280, 800)
    for link in ("t=0.3ms&bead=20", "t=300us&bead=20", "bead=20&t=300%C2%B5s", "t=3e-4&bead=20"):
        page.open("about:blank")
        page.open("file://%s/run.html#%s" % (directory, link))
        page.settle()
        seconds, bead = page.run(shown)
        ok(abs(seconds - 3e-4) < 1e-9 and bead == 20, "#%s opens at that moment and bead" % link, seconds, bead)
    ok(page.run("document.getElementById('bead').value") == "20" and page.run("document.getElementById('clock').textContent").startswith(("300", "0.300")),
       "... and says so", page.run("document.getElementById('clock').textContent"))
    page.run("report.canvases[0].focus()")
    page.press("ArrowRight")
    page.press(".", ".")
    page.run("new Promise(done => setTimeout(done, 700))")
    moved, link = page.run(shown), page.run("location.hash")
    ok(moved[1] == 21 and moved[0] > 3e-4 and re.search(r"bead=21\b", link), "moving changes the address", link)
    page.open("about:blank")
    page.open("file://%s/run.html%s" % (directory, link))
    page.settle()
    again = page.run(shown)
    ok(abs(again[0] - moved[0]) < 0.51e-6 and again[1] == 21, "... which leads back there", moved, again)
    page.run("location.hash = '#t=0.1ms&bead=5'")
    page.settle()
    ok(page.run(shown)[1] == 5, "another address of the same page is followed")
    for link, wanted in (("t=soon&bead=x", None), ("t=9s&bead=9999", page.run("report.chains[0].values - 1")), ("t=-3ms&bead=-7", 0), ("controls", None), ("t=1kg", None)):
        page.open("about:blank")
        page.open("file://%s/run.html#%s" % (directory, link))
        page.settle()
        ok(page.run(shown)[1] == wanted, "#%s shows what there is" % link, page.run(shown))
    page.open("about:blank")
    page.open("file://%s/sweep.html#configuration=3" % directory)
    page.settle()
    ok(page.run("report.state.image.index") == 3, "the address of a configuration shows it")
    page.press("ArrowRight")
    page.run("new Promise(done => setTimeout(done, 700))")
    ok(page.run("location.hash === '#configuration=' + report.state.image.index && report.state.image.index !== 3"), "... and follows",
       page.run("location.hash"))


def check_phones(page, pages):
    """Nothing is wider than the window: not a box, and no text in its box; what is longer scrolls by itself."""
    for name in pages:
        for width in (390, 320):
            page.resize(width, 800, mobile=True)
            page.open("file://" + name)
            page.settle()
            page.run("document.querySelectorAll('details').forEach(d => { d.open = true; })")
            page.settle()
            wide = page.run("""[...document.querySelectorAll('body *')].filter(e => !e.closest('#tip, .hidden, .skip, #peaks-table')).filter(e => {
                const box = e.getBoundingClientRect();
                return box.width > 0 && (box.right > innerWidth + 0.5 || box.left < -0.5 || e.clientWidth > 0 && e.scrollWidth > e.clientWidth + 1 && !e.closest('svg') && !e.querySelector('#peaks-table'));
                }).map(e => `${e.tagName}#${e.id}.${e.className.baseVal ?? e.className}: ${e.textContent.slice(0, 30)}`)""")
            ok(not wide and page.run("document.documentElement.scrollWidth <= innerWidth"), "%s: nothing is cut at %d px" % (os.path.basename(name), width), wide)
            cut = page.run("""[...document.querySelectorAll('select')].filter(s => s.offsetWidth > 0).filter(s => {
                const context = document.createElement('canvas').getContext('2d'), look = getComputedStyle(s);
                context.font = `${look.fontSize} ${look.fontFamily}`;
                const text = Math.max(...[...s.options].map(o => context.measureText(o.text).width));
                return text + parseFloat(look.paddingLeft) + parseFloat(look.paddingRight) > s.clientWidth + 1; }).map(s => s.id)""")
            ok(not cut, "... nor in a menu", cut)


def of_round(value):
    """1, 2 or 5 times a power of ten."""
    return ("%.6e" % value).split("e")[0] in ("1.000000", "2.000000", "5.000000")


def check_ticks(page):
    """Round numbers at the bar that do not crowd, of any range."""
    found = page.run("""(() => { const out = [];
        for (const [scale, length, room] of [['sqrt', 480, 28], ['sqrt', 300, 28], ['linear', 480, 28], ['log', 480, 28]])
            for (let high = 0.013; high < 3e4; high *= 1.17)
                out.push([scale, high, length, room, report.ticks(scale, scale === 'log' ? high / 3000 : 0, high, length, room).sort((a, b) => a.place - b.place)]);
        return out; })()""")
    crowded, uneven, few, hollow = [], [], [], []
    for scale, high, length, room, ticks in found:
        values, places = [t["value"] for t in ticks], [t["place"] * length for t in ticks]
        gaps = [b - a for a, b in zip(places, places[1:])]
        even = values[-1] - values[-2]
        crowded += [(scale, high, values)] if min(gaps) < room - 1e-6 or len(ticks) > 12 else []
        uneven += [(scale, high, values)] if any(v and not of_round(v) and (scale == "log" or not of_round(even) or abs(v / even - round(v / even)) > 1e-6)
                                                 for v in values) else []
        few += [(scale, high, values)] if len(ticks) < 3 else []
        hollow += [(scale, high, values)] if max(gaps) > 0.45 * length else []
        if scale == "sqrt":  # numbers near zero stand apart: 0, 0.05, 0.2, 0.5 is a crowd
            near = [p for v, p in zip(values, places) if v < even * 1.0001]
            crowded += [(scale, high, values)] if any(b - a < 2 * room - 1e-6 for a, b in zip(near, near[1:])) and len(ticks) > 5 else []
    ok(len(found) > 200 and not crowded, "numbers at the bar do not crowd", crowded[:3])
    ok(not uneven, "they are round", uneven[:3])
    ok(not few and not hollow, "there are some, all along the bar", few[:3], hollow[:3])


SIZES = {"m": 1e-3, "µ": 1e-6, "n": 1e-9, "p": 1e-12, "k": 1e3, "M": 1e6}


def plain(text):
    """A number as the page writes it."""
    raised = re.sub("[⁰-⁹⁻¹²³]+", lambda found: "".join("0123456789-"["⁰¹²³⁴⁵⁶⁷⁸⁹⁻".index(c)] for c in found[0]), text)
    return float(raised.replace("−", "-").replace(" × 10", "e"))


def within(value, error, text):
    """The text is of this number, and says an error that is as large, or larger by a digit's rounding."""
    number, _, rest = text.partition(" ± ")
    said, unit = re.match(r"([\d.]+(?: × 10[⁻⁰-⁹¹²³]+)?) ?(.*)", rest).groups() if rest else ("nan", "")
    size = SIZES.get(unit[:1], 1) if len(unit) > 1 and unit[:2] != "m/" and unit not in ("beads", "contacts") else 1
    return error <= 1.0000001 * plain(said) * size <= max(2.2 * error, 2e-9 * size) and abs(plain(number) * size - value) <= plain(said) * size


def check_text(page, scene):
    ok(page.run("document.title") == scene["title"], "the title is the scene's, whatever it contains", page.run("document.title"))
    ok(page.run("document.querySelectorAll('h1 *, #scene-text *').length") == 0, "no element comes from the scene")
    ok("title:" in page.run("document.getElementById('scene-text').textContent"), "the scene is there")
    page.run("navigator.clipboard.writeText = async text => { window.copied = text; }")
    page.run("document.getElementById('copy').click()")
    page.settle()
    ok(page.run("window.copied === document.getElementById('scene-text').textContent"), "its button copies it")
    facts = page.run("document.getElementById('facts').textContent")
    ok(facts.count("large steel") == 1, "beads that differ in size only are named once", facts)
    table = page.run("document.getElementById('numbers-table').textContent")
    ok(re.search(r"\d ± 0\.0*\d", table), "numbers have their uncertainty", table)
    listed = page.run("[...document.querySelectorAll('#measures-table tbody tr')].map(row => [...row.cells].map(cell => cell.textContent))")
    found = {m["name"]: m for m in page.run("JSON.parse(document.getElementById('data').textContent).chains[0].measures")}
    told = [(found[name]["value"], found[name]["uncertainty"], re.sub(r" \(.*\)$", "", text)) for name, text in listed]
    ok(len(told) > 20 and all(error == 0 or within(value, error, text) for value, error, text in told), "so have measures, of any size",
       [row for row in told if row[1] and not within(*row)])


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
    page.run("report.data.panels[0].places[0].threshold = [0.2673, 0.0031, 0.62274, 0.01028]")
    page.prefer("light")
    page.settle()
    said = [page.run("document.getElementById('%s').textContent" % part) for part in ("force-chart", "threshold")]
    ok(all("0.623 ± 0.010" in words for words in said), "chart and words have one error of the threshold", said)
    page.prefer("dark")
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
    chromium, assets, directory, *further = sys.argv[1:]
    with open(directory + "/force.csv") as file:
        rows = [row for row in csv.DictReader(file)]
    page = Browser(chromium)
    try:
        page.open("file://%s/run.html" % directory)
        page.settle()
        for scheme in ("dark", "light"):
            check_pixels(page, assets, scheme, rows)
        check_ticks(page)
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
        page.prefer("light")
        check_phones(page, ["%s/%s" % (directory, name) for name in ["run.html", "sweep.html", *further]])
        check_still(page, directory)
        check_link(page, directory)
        page.open("file://%s/run.html" % directory)
        page.settle()
        check_saving(page, rows, directory)
        ok(not page.errors, "no error in the console", page.errors)
        ok(all(re.match(r"file://%s/[^#]*\.html(#.*)?$|about:blank$|blob:" % re.escape(directory), r) for r in page.requests), "nothing is asked for but the page",
             page.requests)
    finally:
        page.close()
    finish()


main()
