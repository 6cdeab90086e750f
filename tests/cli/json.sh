#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# What programs read: the result of a run, as one line of JSON on stdout.
source "$(dirname "$0")/../shell.bash"
cd "$T" || exit 1
cat >scene.yaml <<'YAML'
chains:
  - {name: a, beads: [{bead: brass, count: 12}]}
  - {name: "b \"two\"", striker: {velocity: 0.1 m/s}, beads: [{bead: ptfe, count: 8}]}
outputs:
  - {table: peaks.csv, show: peaks}
  - {image: "folder/µ.png", size: [480, 320]}
  - {movie: m.mp4, size: [320, 240], duration: 0.2 s, fps: 10, poster: p.png}
YAML

# is EXPRESSION : of the line in out, `j`, which holds in Python; same(A, B): with all keys, and numbers to twelve digits.
is() {
    [ "$(wc -l <out)" -eq 1 ] || { echo "not one line:"; cat out; return 1; }
    python3 -c '
import json, sys
from math import pi
def wrong(word): raise ValueError(word)
def same(a, b):
    if isinstance(a, dict): return list(a) == list(b) and all(same(a[k], b[k]) or print(k, a[k], b[k]) for k in a)
    if isinstance(a, list): return len(a) == len(b) and all(map(same, a, b))
    return a == b if not isinstance(a, float) or b is None else abs(a - b) <= 1e-12 * abs(b)
def of(file): return json.load(open(file, encoding="utf-8"))
j = json.loads(open("out", encoding="utf-8").read(), parse_constant=wrong)
sys.exit(0 if eval(sys.argv[1]) else str(j))' "$1"
}
keys='["status", "exit", "seconds", "outputs", "skipped", "runs", "sweep", "warnings", "errors"]'
if ! command -v python3 >/dev/null; then
    skip python3 "the result as JSON"
    finish
fi

ok "--progress json" exits 0 "$beadreel" scene.yaml -o all --progress json
ok "... ends with the result" is "list(j) == $keys and j['status'] == 'done' and j['exit'] == 0"
ok "... which names outputs, files and kinds" is '[(o["name"], o["path"], o["kind"]) for o in j["outputs"]] == [
    ("peaks.csv", "all/peaks.csv", "table"), ("folder/µ.png", "all/folder/µ.png", "image"), ("m.mp4", "all/m.mp4", "movie"),
    ("p.png", "all/p.png", "poster")]'
ok "... with their sizes" is '[o["bytes"] for o in j["outputs"]] == [__import__("os").path.getsize(o["path"]) for o in j["outputs"]]'
ok "... each chain" is '[r["chain"] for r in j["runs"]] == ["a", "b \"two\""]'
ok "... the peak known least well" is '0 < j["runs"][0]["worst_peak"]["uncertainty_N"] <= 3e-6 * j["runs"][0]["worst_peak"]["force_N"]'
ok "... and its run" is 'j["runs"][1]["method"] == "rkn8" and 0 < j["runs"][1]["front_arrival_s"] <= j["runs"][1]["end_s"] and j["runs"][0]["steps"] > 10'
ok "... and nothing that is wrong" is 'j["warnings"] == j["errors"] == [] and j["sweep"] is None'
ok "... while stderr has JSON only" bash -c "! grep -v '^{.*}$' err"
ok "--json is the same" exits 0 "$beadsim" scene.yaml -o data --json
ok "... with what beadsim skips" is 'j["skipped"] == ["folder/µ.png", "m.mp4"] and len(j["outputs"]) == 1'
ok "... and no progress" test ! -s err

# Measures have a check run, peaks do not.
arrival() { exits 0 "$beadsim" scene.yaml -o data --json --set "simulate.accuracy=$1" --set 'outputs=[{table: m.csv, show: measures}]'; }
ok "a run to nine digits" arrival 1e-9
right=$(python3 -c 'import json, sys; print(json.load(sys.stdin)["runs"][0]["front_arrival_s"])' <out)
ok "... and to four" arrival 1e-4
ok "... the front's arrival is off by less than it says" is '0 < abs(j["runs"][0]["front_arrival_s"] - '"$right"') < j["runs"][0]["front_arrival_s_uncertainty"] < 1e-4 * '"$right"

ok "a wrong scene" exits 2 "$beadreel" scene.yaml -o none --json --set chains.1.beads.0.bead=brsas
ok "... says where" is 'list(j) == '"$keys"' and j["status"] == "failed" and j["exit"] == 2 and j["errors"] == [
    {"file": "--set", "line": 1, "column": 23, "message": "chains.1.beads.0.bead: there is no material `brsas`; did you mean `brass`?"}]'
ok "... to people, too" says 'did you mean `brass`?'
cp scene.yaml a:7:b:7:8.yaml
echo 'simulate: {until: 0}' >>a:7:b:7:8.yaml
ok "a file's name with colons" exits 2 "$beadreel" a:7:b:7:8.yaml -o none --json
ok "... is told from the place" is '[(e["file"], e["line"], e["column"]) for e in j["errors"]] == [("a:7:b:7:8.yaml", 8, 19)]'
ok "no scene" exits 2 "$beadreel" nothing --json
ok "... has no place" is 'j["errors"][0]["file"] is None and j["errors"][0]["line"] is None and "nothing" in j["errors"][0]["message"]'
ok "a wrong command line" exits 2 "$beadreel" --json --threads x
ok "... as well" is 'j["exit"] == 2 and "--threads" in j["errors"][0]["message"]'
cp scene.yaml "$(printf 'bad\351.yaml')"
ok "a name that is no UTF-8" exits 2 "$beadreel" "$(printf 'bad\351.yaml')" --json --set x=1
ok "... does no harm" is 'j["errors"] and j["exit"] == 2'
ok "a run that cannot be verified" exits 1 "$beadreel" scene.yaml -o verify --only peaks.csv --json --set simulate='{verify: true, accuracy: 1e-14}'
ok "... failed, with its file" is 'j["status"] == "failed" and j["exit"] == 1 and len(j["outputs"]) == 1 and j["warnings"] and j["errors"]'
ok "a sweep" exits 0 "$beadsim" sweep -o sweep --json --set sweep.cells=6 --set sweep.configurations=2 --only force.csv
ok "... counts its chains" is 'j["sweep"]["computed"] == j["sweep"]["known"] == j["sweep"]["chains"] > 4 and j["runs"] == []'

# What people are told of a run, line by line, is what programs are told of it.
cat >words.py <<'PYTHON'
import csv, json, math, re
j, said = json.load(open("out", encoding="utf-8")), open("said", encoding="utf-8").read().splitlines()
def of(x, unit):  # "4.76 mm", "1.8 kB"
    power = 3 * math.floor(math.log10(float(f"{x:.3e}")) / 3)
    return f"{x / 10 ** power:.4g} {dict(zip((-9, -6, -3, 0, 3, 6), 'num kM'))[power].strip()}{unit}"
def several(n, what): return f"{n} {what}{'' if n == 1 else 's'}"
def largest(key): return max((r[key] for r in j["runs"] if r[key] is not None), default=None)
def lost(path):
    rows = csv.DictReader(open(path, encoding="utf-8")) if path.endswith(".csv") else []
    return [float(row["time_s"]) for row in rows if "unpredictable" in row.get("state", "")]
files, runs, sweep = j["outputs"], j["runs"], j["sweep"]
width = max(len(f["path"]) for f in files)
lines = [f"{f['path']:{width}}  {of(f['bytes'], 'B'):>8}" for f in files]
if j["skipped"]: lines += ["skipped, beadsim does not make these: " + ", ".join(j["skipped"])]
last = f"{several(len(files), 'file')}, {of(sum(f['bytes'] for f in files), 'B')}, in * s"
if runs:
    last += f": {several(len(runs), 'chain')} to {of(largest('end_s'), 's')} with {runs[0]['method']}, first step {of(runs[0]['step_s'], 's')}"
    errors = [(name, largest(name + "_error")) for name in ("energy", "embedded", "event")]
    last += "; errors seen: " + ", ".join(f"{name.replace('event', 'events')} {x:.1g}" for name, x in errors if x is not None)
    peaks = [r["worst_peak"] for r in runs if r["worst_peak"]]
    if peaks:
        worst = max(peaks, key=lambda p: p["uncertainty_N"] / p["force_N"])
        last += f"; least certain peak: {list(worst)[0]} {list(worst.values())[0]:.0f}, {worst['force_N']:.6g} N to {worst['uncertainty_N']:.2g} N"
    times = [t for f in files for t in lost(f["path"])]
    if times: last += "; not all peaks are predictable from * ms on"
    horizon = [1e-3 * float(x) for x in re.findall(r"predictable from ([0-9.]+) ms", said[-1])]  # others may be overtaken after it
    if [x for x in horizon if not min(times) <= x <= max(times)]: raise SystemExit(f"predictable until {horizon}")
if sweep and sweep["computed"]:
    before = sweep["known"] - sweep["computed"]
    last += f": {several(sweep['computed'], 'chain')}" + (f" of {sweep['chains']}, {before} there before" if before else "") + ", * a second"
    seconds, rate = map(float, re.search(r"in ([0-9.]+) s: .* ([0-9.e+]+) a second", said[-1]).groups())
    if not rate * max(seconds - 0.0051, 0) <= 1.006 * sweep["computed"] <= 1.012 * rate * (seconds + 0.0051): raise SystemExit(f"{rate} chains a second for {seconds} s")
    for f in files:
        rows = [r for r in csv.DictReader(open(f["path"], encoding="utf-8")) if r.get("peak_force_N")]
        off = max((float(r["uncertainty_N"]) / float(r["peak_force_N"]) for r in rows), default=0)
        if off > 1e-5: last += f"; forces are known to {off:.2g} of themselves, not to the 1e-06 asked for"
lines += [last]
for before, after in ((r"in [0-9.]+ s", "in * s"), (r"[0-9.e+]+ a second", "* a second"), (r"from [0-9.]+ ms on", "from * ms on")):
    said[-1] = re.sub(before, after, said[-1])
for a, b in zip(said, lines):
    if a != b: raise SystemExit(f"{a!r}, not {b!r}")
if len(said) != len(lines): raise SystemExit(f"{len(said)} lines, not {len(lines)}")
warned = ["beadsim: warning: " + w for w in j["warnings"]]
if open("warned", encoding="utf-8").read().splitlines() != warned: raise SystemExit("other warnings")
PYTHON
told() { "$beadsim" "$@" >said 2>warned && exits 0 "$beadsim" "$@" --json && python3 words.py; }
ok "words of a run of two chains" told scene.yaml -o told
ok "... of peaks of beads, without errors that the method cannot tell" told scene.yaml -o told --set 'outputs=[{table: b.csv, show: bead-peaks}]' --set simulate.method=rk4
ok "... of one chain beyond the model" told scene.yaml -o told --set 'chains=[{name: a, striker: {velocity: 9 m/s}, beads: [{bead: brass, count: 3}]}]' --only peaks.csv
ok "... of a chain whose peaks are lost" told "$top/tests/errors/accB0.yaml" -o told --set simulate.until=30ms --set simulate.accuracy=1e-4
ok "... of a sweep" told sweep -o told --set sweep.cells=6 --set sweep.configurations=1 --set sweep.magnetism=1 --only force.csv
ok "... whose steps are too long" told sweep -o told --set sweep.cells=6 --set sweep.configurations=1 --set sweep.magnetism=0.5 --set simulate='{step: 3 us, method: rk4}' --set 'outputs=[{table: f.csv, show: configurations}]'

# ---- --plan and --info ----

ok "--plan --json" exits 0 "$beadreel" scene.yaml --plan --json -o out --only peaks.csv
ok "... has chains" is '[(c["name"], c["beads"], c["contacts"], c["wall"]) for c in j["chains"]] == [("a", 13, 12, "none"), ("b \"two\"", 9, 8, "none")]'
ok "... outputs, and which are made" is '[(o["name"], o["path"], o["kind"], o["made"]) for o in j["outputs"]] == [
    ("peaks.csv", "out/peaks.csv", "table", True), ("folder/µ.png", None, "image", False), ("m.mp4", None, "movie", False)]'
ok "... and the plan in words" is 'len(j["lines"]) > 4 and any("skipped" in line for line in j["lines"])'
ok "... nothing is made" test ! -e out/peaks.csv
cp out plan
ok "--plan --json of a sweep" exits 0 "$beadsim" sweep --plan --json
ok "... as well" is 'j["chains"] == [] and ("sweep.h5", "sweep") in [(o["name"], o["kind"]) for o in j["outputs"]]'
ok "--info --json of a scene" exits 0 "$beadreel" --info scene.yaml --json
# Hertz: A = (4/3) sqrt(R*) E*; all the energy e at a contact compresses it by d, (2/5) A d^(5/2) = e, to p = 3 A sqrt(d) / (2 pi R*) in its centre.
ok "... describes all of it" is '[o["kind"] for o in j.pop("outputs")] == ["table", "image", "movie"] and [same(j, {
    "file": "scene.yaml", "kind": "scene", "title": "", "until_s": None, "accuracy": 1e-6, "chains": [dict(
        name="a", equation=None, beads=13, contacts=12, striker="large-steel", velocity_m_s=0.443,
        kinds=[dict(material="brass", own=False, beads=12, radius_m=[R, R], mass_kg=[m, m], modulus_Pa=[E, E], poisson=0.34)],
        law="hertz", coefficient=[A, B], coefficient_power=1.5, energy_J=e, strike_bar_speed=0.443 / (E / 8500) ** 0.5,
        compression_radius_most=(e / 0.4 / A) ** 0.4 / R, pressure_yield_most=3 * B * (e / 0.4 / B) ** 0.2 / (pi * R) / 0.51e9,
        wall="none", spins="", magnetism=None, sensors=[]), j["chains"][1]]})
    for R, E, n in [(4.76e-3, 90.2e9, (1 - 0.34 ** 2) / 90.2e9)] for m, e in [(8500 * 4 / 3 * pi * R ** 3, 3.63e-3 * 0.443 ** 2 / 2)]
    for A, B in [[4 / 3 * (R / 2) ** 0.5 / (n + other) for other in (n, (1 - 0.3 ** 2) / 193e9)]]] == [True]'
ok "... as the plan does" is 'j["chains"] == of("plan")["chains"]'
cp out scene
ok "--info --json of a ready scene" exits 0 "$beadreel" --info clean-vs-delocalised --json
ok "... with beads and contacts" is '[(k["material"], k["beads"], k["own"]) for k in j["chains"][0]["kinds"]] == [("large-steel", 64, False), ("aluminium", 64, False)] and j["chains"][0]["coefficient_power"] == 1.5 and 2e9 < j["chains"][0]["coefficient"][0] < j["chains"][0]["coefficient"][1] < 1e10'
ok "... with spins" is 'j["chains"][1]["magnetism"] == 0 and len(j["chains"][1]["spins"]) == 64'
ok "--info --json of an equation" exits 0 "$beadreel" --info kdv --json
ok "... has points" is 'j["chains"] == [dict(name="", equation="kdv", points=800)]'
"$beadsim" scene.yaml -o data --set 'outputs=[{trajectory: run.h5, every: 2 us}]' --json >run
"$beadsim" scene.yaml -o grid --set 'outputs=[{trajectory: run.h5, every: 2 us}]' --set 'simulate.until=30 us' >/dev/null
ok "--info of a trajectory" exits 0 "$beadreel" --info grid/run.h5
ok "... has first and last sample" prints "samples: 16, every 2 us from 0 s to 30 us"
ok "--info --json of a trajectory" exits 0 "$beadreel" --info data/run.h5 --json
ok "... has the chains of the scene, samples, and runs" is 'same(j, dict(of("scene"), file="data/run.h5", kind="trajectory", outputs=[{"name": "run.h5", "kind": "trajectory"}],
    samples=dict(count=1 + int(j["runs"][0]["end_s"] / 2e-6), start_s=0, every_s=2e-6, end_s=2e-6 * (j["samples"]["count"] - 1), first_bead=0, last_bead=None,
    fields=["force", "contact-force", "compression", "velocity", "displacement"]), runs=of("run")["runs"]))'
"$beadsim" data/run.h5 -o data/measures.csv --set outputs.0.show=measures >/dev/null
"$beadreel" --info data/run.h5 >words
# `out` has the same in JSON, the table has the measures.
cat >words.py <<'PYTHON'
import csv, json, math
def of(x, unit, digits=4):  # "4.76 mm"
    power = min(0, 3 * math.floor(math.log10(abs(float(f"{x:.{digits - 1}e}"))) / 3)) if x else 0
    return f"{x / 10 ** power:.{digits}g} {dict(zip((0, -3, -6, -9, -12), ('', 'm', 'u', 'n', 'p')))[power]}{unit}"
def measure(name, value, unit, note):
    said = of(float(value), unit) if len(unit) == 1 else f"{float(value):.6g} {unit}".strip()
    return f"  {name:27} {said}{', ' if note else ''}{note}"
j, lines = json.load(open("out", encoding="utf-8")), ["data/run.h5: trajectory"]
table = list(csv.reader(open("data/measures.csv", encoding="utf-8")))[1:]
for c in j["chains"]:
    k = c["kinds"][0]
    lines += [f"chain {c['name']}: striker and {c['beads'] - 1} beads, {c['contacts']} contacts, free end",
              f"  striker {c['striker']} at {of(c['velocity_m_s'], 'm/s')}, energy {of(c['energy_J'], 'J')}",
              f"  {k['beads']} beads of {k['material']}: radius {of(k['radius_m'][0], 'm')}, mass {of(1e3 * k['mass_kg'][0], 'g')}, "
              f"modulus {k['modulus_Pa'][0] / 1e9:.4g} GPa, Poisson {k['poisson']:.3g}",
              f"  contacts: law hertz, coefficient {c['coefficient'][0]:.4g} to {c['coefficient'][1]:.4g} N/m^1.5",
              f"  strike at {c['strike_bar_speed']:.3g} of the bar speed; compression at most {c['compression_radius_most']:.3g} of the radius, "
              f"pressure at most {c['pressure_yield_most']:.3g} of the yield strength"]
s = j["samples"]
lines += [f"samples: {s['count']}, every {of(s['every_s'], 's')} from 0 s to {of(s['end_s'], 's')}, all beads",
          "fields: force (N) contact-force (N) compression (m) velocity (m/s) displacement (m)"]
for i, r in enumerate(j["runs"]):
    lines += [f"run of chain {i}: {r['method']}, step {of(r['step_s'], 's')}, {r['steps']} steps to {of(r['end_s'], 's')}",
              f"  front arrived at the end at {of(r['front_arrival_s'], 's')}",
              f"  errors seen: energy {r['energy_error']:.2g}, embedded method {r['embedded_error']:.2g}, contact events {r['event_error']:.2g}",
              f"measures of chain {i}, from these samples:"] + [measure(*row[1:5]) for row in table if row[0] == r["chain"]]
said = open("words", encoding="utf-8").read().splitlines()
for a, b in zip(said, lines):
    if a != b: raise SystemExit(f"{a!r}, not {b!r}")
if len(said) != len(lines): raise SystemExit(f"{len(said)} lines, not {len(lines)}")
PYTHON
ok "... the same in words, and the measures of a table" python3 words.py
cat >all.yaml <<'YAML'
chain:
  striker: {velocity: 0}
  precompression: 20 N
  tilt: 12.5 deg
  wall: rigid
  start: [{bead: [3, 4], velocity: 0.1}, {bead: [5, 12], displacement: 2 nm}]
  damping: {coefficient: 2, exponent: 1.3}
  beads: [{cell: [large-steel, aluminium], spins: "11010111000111111100000001111000100100110101110001111111000000011110001001001"}, {bead: ptfe, sensor: end}]
simulate: {until: 10 us, step: 0.1 us, method: rk4}
outputs: [{table: p.csv, show: peaks}]
YAML
ok "--info of what is given" exits 0 "$beadsim" --info all.yaml
sed 's/energy .*/energy/; s/^  contacts.*/  contacts/; s/^  strike at.*/  strike/' out >words
ok "... says all of it" diff words - <<'TEXT'
all.yaml: scene
chain 0: striker and 155 beads, 156 contacts, rigid wall
  striker large-steel at 0 m/s, energy
  bead 3 starts at 100 mm/s, displaced by 0 m
  bead 4 starts at 100 mm/s, displaced by 0 m
  bead 5 starts at 0 m/s, displaced by 2 nm
  bead 6 starts at 0 m/s, displaced by 2 nm
  bead 7 starts at 0 m/s, displaced by 2 nm
  bead 8 starts at 0 m/s, displaced by 2 nm
  bead 9 starts at 0 m/s, displaced by 2 nm
  bead 10 starts at 0 m/s, displaced by 2 nm
  ... and 2 beads more
  77 beads of large-steel: radius 4.76 mm, mass 3.63 g, modulus 193 GPa, Poisson 0.3
  1 bead of ptfe: radius 2.38 mm, mass 123 mg, modulus 1.46 GPa, Poisson 0.46
  77 beads of aluminium: radius 4.76 mm, mass 1.26 g, modulus 72.4 GPa, Poisson 0.33
  contacts
  precompression 20 N
  tilt 12.5 deg
  damping 2 N (s/m)^1.3
  strike
  spins 110101110001111111000000011110001001001101011100011111110000000111100010... (77), M = 0.01299
  sensor end on bead 155
until 10 us, accuracy 1e-06, method rk4, step 100 ns
output 0: table p.csv
TEXT
ok "... in JSON" exits 0 "$beadsim" --info all.yaml --json
ok "... too" is '[(c["beads"], c["contacts"], c["wall"], len(c["spins"]), round(77 * c["magnetism"]), c["sensors"], [k["beads"] for k in c["kinds"]])
    for c in j["chains"]] == [(156, 156, "rigid", 77, 1, [{"name": "end", "bead": 155}], [77, 1, 77])] and j["until_s"] == 1e-5'
"$beadsim" sweep -o sweep --set sweep.cells=6 --set sweep.configurations=2 --only sweep.h5 >/dev/null
cat >ends.yaml <<'YAML'
chains:
  - {name: given, wall: {absorbing: 20 kg/s}, beads: [{bead: brass, count: 3}]}
  - {name: pressed, precompression: 8 N, wall: absorbing, beads: [{bead: brass, count: 3}]}
  - {name: loose, wall: absorbing, damping: {coefficient: 3, exponent: 1, compression: 0.5}, beads: [{bead: brass, count: 3}]}
simulate: {until: 1 ms}
outputs: [{table: p.csv}]
YAML
# sqrt(k m), where F = A d^1.5; of solitary waves cos^4 in velocity, cos^6 in force: means of cos^6 over those of cos^4.8.
ok "--info of absorbing ends" exits 0 "$beadsim" --info ends.yaml
ok "... has their impedances, and damping" python3 -c '
from math import gamma, pi
A, m = 4 / 3 * (4.76e-3 / 2) ** 0.5 / (2 * (1 - 0.34 ** 2) / 90.2e9), 8500 * 4 / 3 * pi * 4.76e-3 ** 3
def cosines(p): return pi ** 0.5 * gamma((p + 1) / 2) / gamma(p / 2 + 1)
said = [line for line in open("out") if "end of" in line or "damping" in line]
ends = ["20 kg/s", f"{(1.5 * A ** (2 / 3) * 8 ** (1 / 3) * m) ** 0.5:.4g} kg/s",
        f"{A * (1.25 * m / A) ** 0.6 * cosines(6) / cosines(4.8):.4g} N (s/m)^1.2"]
expected = [f"chain {name}: striker and 3 beads, 3 contacts, absorbing end of {end}\n" for name, end in zip(("given", "pressed", "loose"), ends)]
if said != expected + ["  damping 3 N (s/m)^1 / m^0.5\n"]: raise SystemExit(str(said))'
cat >rest.yaml <<'YAML'
chains:
  - {name: pressed, striker: {velocity: 0}, precompression: 20 N, wall: rigid, beads: [{bead: brass, count: 5}]}
  - {name: springs, law: {fpu-alpha: 10, stiffness: 1e7}, beads: [{bead: brass, count: 5}]}
simulate: {until: 1 ms}
outputs: [{table: p.csv}]
YAML
ok "--info of a chain that is not struck, and of springs" exits 0 "$beadsim" --info rest.yaml
# Two spheres of brass bear (9 F^2 / (16 R* E*^2))^(1/3) / R = .000696; the striker's contact p0 = (6 F E*^2 / (pi^3 R*^2))^(1/3), 1.48 GPa.
sed 's/energy .*/energy/; s/^  contacts: law hertz.*/  contacts/' out >words
ok "... has what its contacts bear, and no strike" diff words - <<'TEXT'
rest.yaml: scene
chain pressed: striker and 5 beads, 6 contacts, rigid wall
  striker large-steel at 0 m/s, energy
  5 beads of brass: radius 4.76 mm, mass 3.84 g, modulus 90.2 GPa, Poisson 0.34
  contacts
  precompression 20 N
  compression at most 0.000696 of the radius, pressure at most 2.9 of the yield strength
chain springs: striker and 5 beads, 5 contacts, free end
  striker large-steel at 443 mm/s, energy
  5 beads of brass: radius 4.76 mm, mass 3.84 g, modulus 90.2 GPa, Poisson 0.34
  contacts: law fpu-alpha, coefficient 1e+07 N/m^1
until 1 ms, accuracy 1e-06, method auto
output 0: table p.csv
TEXT
ok "--info of an equation" exits 0 "$beadsim" --info kdv
ok "... has its grid" prints "chain 0: equation kdv, 800 points from x = -12, 0.0425 apart" # 34 / 800
ok "--info of a sweep" exits 0 "$beadsim" --info sweep/sweep.h5
sed 's/^  peak: .*/  peak/' out >words
ok "... says all of it" diff words - <<TEXT
sweep/sweep.h5: sweep
title: 64 random dimers of steel and aluminium
sweep 7 configurations of striker and 42 beads, 6 random cells, seed 2009
  magnetism: 4 from 0 to 1
  peak
computed by version $("$beadsim" --version | awk 'NR == 1 {print $2}')
output 0: plot force.png
output 1: table force.csv
output 2: sheet sheet.png
output 3: sheet sheet.pdf
output 4: sweep sweep.h5
TEXT
# Steps follow from the accuracy and the chain.
planned() { "$beadsim" "$@" --plan -o out >out.txt && sed -E 's/steps (from|of) [0-9.]+ us/steps \1 N us/' out.txt | diff - plan; }
cat >plan <<'TEXT'
chain a: 13 beads, 12 contacts; rkn8 (contacts open and close) with steps from N us
chain b "two": 9 beads, 8 contacts; rkn8 (contacts open and close) with steps from N us
time: until the first pulse has passed the end; no output needs the end time in advance: no scouting run
output out/peaks.csv: largest force of every contact
  samples: none
  maxima of every contact's force until the front reaches the end, found between steps
output folder/µ.png: skipped: this program makes data only
output m.mp4: skipped: this program makes data only
comparison run: uncertainties of out/peaks.csv needs all chains a second time, for comparison: accuracy 0.0003 instead of 1e-06, steps of N us; a third one if many peaks respond strongly
skipped: samples (no output reads any)
skipped: HDF5 (no trajectory output)
skipped: drawing (no picture asked for)
skipped: beads ahead of the front, until it comes (exactly at rest)
TEXT
ok "--plan says all of it" planned scene.yaml
cat >parts.yaml <<'YAML'
chain:
  beads:
    - {cell: [large-steel, aluminium], count: 12, spins: random, magnetism: 0.5, seed: 1}
    - {bead: small-steel, sensor: s}
    - {bead: large-steel, count: 30}
sweep: {name: abc, configurations: 4, magnetism: [0, 1], seed: 5, measure: {decay: true, sensor: s}}
outputs: [{sweep: s.h5}, {table: f.csv}]
YAML
# Four configurations and the one that is all up; 1 + 2 * 12 + 1 + 30 beads.
cat >plan <<'TEXT'
sweep abc: 5 configurations of 56 beads, 2 magnetisms from 0 to 1, and the one with all of 12 random cells up; rkn8 with steps from N us
  measured: largest force at sensor s
  measured: peaks of the force and energy of every bead
  all beads are kept: the decay is measured on all of them
time: each chain until its front reaches the end
of these, part 2 of 3
output out/s.2of3.h5: spins and results of every configuration; in its .part until the end
output f.csv: skipped: a part has no statistics
skipped: samples, contact forces and all peaks that are not measured; beads ahead of the front
TEXT
ok "... of a part of a sweep" planned parts.yaml --shard 2/3
ok "--info --json of a sweep" exits 0 "$beadreel" --info sweep/sweep.h5 --json
ok "... counts" is 'j["known"] > 4 and same(j, dict(file="sweep/sweep.h5", kind="sweep", title=j["title"], until_s=None, accuracy=1e-6, outputs=j["outputs"],
    chains=j["known"], known=j["known"], part=1, parts=1, version="'"$("$beadsim" --version | awk 'NR == 1 {print $2}')"'"))'
ok "--info --json of nothing" exits 2 "$beadreel" --info nothing.yaml --json
ok "... has the error" is 'j["status"] == "failed" and "nothing.yaml" in j["errors"][0]["message"]'
ok "--plan --json of a wrong scene" exits 2 "$beadreel" --plan scene.yaml --json --set chains=1
ok "... too" is 'j["errors"][0]["file"] == "--set"'

stopped() {
    "$beadsim" scene.yaml -o stop --json --set simulate='{until: 10 s, method: rk4, step: 0.1 us}' --set 'outputs=[{table: peaks.csv}, {trajectory: run.h5, every: 1 ms}]' >out 2>err &
    await test -e stop/peaks.csv.part
    kill -TERM $! && wait $!
    [ $? -eq 143 ]
}
ok "a stopped run" stopped
ok "... says so" is 'j["status"] == "stopped" and j["exit"] == 143 and "signal 15" in j["errors"][0]["message"]'
ok "... and what is left" is '[(o["name"], o["path"], o["kind"]) for o in j["outputs"]] == [("run.h5", "stop/run.h5.part", "trajectory")]'
finish
