#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Reports: what is refused, what a page contains, and what a browser makes of it, where there is one.
source "$(dirname "$0")/../shell.bash"
plain_canvas
cd "$T" || exit 1
cat >scene.yaml <<'YAML'
title: 'A </script><b>title</b> & "more"'
chain:
  striker: {bead: large-steel, velocity: 0.443 m/s}
  beads: [{cell: [large-steel, aluminium], count: 12, spins: random, seed: 5}, {bead: small-steel, sensor: first}, {bead: large-steel, count: 6, radius: 4.7 mm}, {bead: small-steel, sensor: second}]
  wall: brass
simulate: {until: 0.6 ms}
outputs:
  - {report: run.html, every: 1 us, range: [0, 30 N]}
  - {table: force.csv, show: sensors, every: 1 us, uncertainty: false}
  - {table: measures.csv, show: measures}
  - {table: peaks.csv, show: peaks}
  - {image: still.png, size: [320, 200], caption: 'Dimers with $M \to 0$'}
  - {image: still.pdf}
YAML
only() { rm -rf made && exits 0 "$beadreel" scene.yaml -o made --set "outputs=[{$1}]" "${@:2}"; }
refused() { fails 2 "$beadreel" scene.yaml -o made --set "outputs=[{$1}]" && says "$2"; }

ok "a report with its table and pictures" exits 0 "$beadreel" scene.yaml -o .
ok "the plan says what it takes" exits 0 "$beadreel" scene.yaml --plan
ok "... samples and peaks" prints "a page with 601 samples, every 1.00"
holds() { grep -qF -- "$1" "${2:-run.html}" || { echo "'$1' is not there"; return 1; }; }
ok "pictures of the run are in it" holds 'src="data:image/png;base64,iVBOR'
ok "... with their captions as read, and what happens" holds 'alt="Dimers with M → 0. '
ok "... once" test "$(grep -o '<img' run.html | wc -l)" -eq 1
ok "the scene is escaped" holds '&lt;/script&gt;&lt;b&gt;title'
unbroken() { [ "$(grep -o '</script>' run.html | wc -l)" -eq 2 ] && [ "$(grep -o '</body>' run.html | wc -l)" -eq 1 ]; }
ok "no text of the scene ends a script" unbroken
json() { # EXPRESSION of d, in Python
    /usr/bin/python3 -c 'import json, re, sys
d = json.loads(re.search(r"<script type=\"application/json\" id=\"data\">(.*?)</script>", open(sys.argv[2]).read(), re.S).group(1))
assert eval(sys.argv[1]), d.keys()' "$1" "${2:-run.html}"
}
ok "its data are JSON" json 'd["time"]["count"] == 601 and len(d["chains"]) == 1 and len(d["chains"][0]["peaks"]["uncertainty"]) == 33'
same_measures() { # as the table of measures, which has other samples
    awk -F, '$1 == "front speed" || $1 == "peak contact force" || $1 == "participation of energies" { print $1 "," $2 }' measures.csv >wanted
    [ "$(wc -l <wanted)" -eq 3 ] && json 'all(abs([m["value"] for m in d["chains"][0]["measures"] if m["name"] == n][0] / float(v) - 1) < 1e-4 for n, v in (r.strip().split(",") for r in open("wanted")))'
}
ok "measures are those of their table" same_measures
known_measures() { # off from a run to 1e-10 by no more than both say
    "$beadreel" scene.yaml -q -o exact --only measures.csv --set simulate.accuracy=1e-10 && python3 - <<'PY'
import csv, json, re
d = json.loads(re.search(r'id="data">(.*?)</script>', open("run.html").read(), re.S).group(1))
exact = {r["name"]: (float(r["value"]), float(r["uncertainty"] or 0)) for r in csv.DictReader(open("exact/measures.csv"))}
found = d["chains"][0]["measures"]
off = [(m["name"], m["value"], m["uncertainty"]) for m in found if m["uncertainty"] is None or not m["note"] and
       not abs(m["value"] - exact[m["name"]][0]) <= m["uncertainty"] + exact[m["name"]][1] + 1e-9 * abs(m["value"])]
exit(str(off) if off or sum(m["uncertainty"] > 0 for m in found) < 20 else 0)
PY
}
ok "... and know their errors" known_measures
outside() { ! grep -oiE '(src|href)="?(https?:|//)[^"]*' run.html; }
ok "it names nothing on the network" outside
ok "it is no program of another kind" holds "default-src 'none'"

alone() { rm -rf made && exits 0 "$beadreel" scene.yaml -o made --only run.html && ! grep -q '<img' made/run.html; }
ok "pictures that this run has not made are not in it" alone
opened() {
    only 'report: r.html}, {table: p.csv, show: peaks' --set simulate.until='10 us' || return 1
    open=$(grep ,open made/p.csv | cut -d, -f1 | paste -sd,)
    [[ $open == 0,* ]] && json "d['chains'][0]['peaks']['open'] == [$open]" made/r.html
}
ok "peaks that the run's end cuts off are those of the table, from the first contact on" opened
ok "no uncertainty without peaks of beads" only 'report: r.html, field: velocity, time: [0.1 ms, 0.2 ms], beads: [2, 9]'
ok "... but the beads asked for" json 'd["chains"][0]["values"] == 8 and d["chains"][0]["first"] == 2 and d["chains"][0]["field"]["signed"]' made/r.html
ok "... and no measures of a part of the run" json 'd["chains"][0]["measures"] == []' made/r.html
pressed() { only 'report: r.html, field: contact-force' --set 'chain={precompression: 20 N, beads: [{bead: glass, count: 20}], wall: brass}' --set chain.striker.velocity="$1" --set simulate.until=auto; }
ok "a small wave in a pressed chain" pressed '0.01 m/s'
ok "... has colours about the static force, as far as its peaks" json 'd["range"]["scale"] == "linear" and d["range"]["rest"] == 20 and abs(d["range"]["low"] + d["range"]["high"] - 40) < 1e-9 and .99 < (d["range"]["high"] - 20) / (max(d["chains"][0]["peaks"]["force"]) - 20) <= 1' made/r.html
ok "a large one" pressed '1 m/s'
ok "... has colours from 0" json 'd["range"]["scale"] == "sqrt" and d["range"]["low"] == 0 and d["range"]["rest"] == 0' made/r.html
ok "contact forces" only 'report: r.html, field: contact-force'
ok "... one more than pairs of beads, with the wall" json 'd["chains"][0]["values"] == 33 and d["field"]["contacts"]' made/r.html
# A chain of one bead on the page, which has none of the contacts asked for.
cat >unlike.yaml <<'YAML'
chains: [{name: A, beads: [{bead: brass, count: 9}], striker: {bead: brass, velocity: 0.1 m/s}}, {name: B, beads: [{bead: brass, count: 5}], striker: {bead: brass, velocity: 0.1 m/s}}]
simulate: {until: 0.1 ms}
outputs: [{report: r.html, beads: [5, 9]}]
YAML
ok "one bead of a chain" exits 0 "$beadreel" unlike.yaml -o made
ok "... is on the page, beside five of the other" json '[c["beads"] for c in d["chains"]] == [5, 1]' made/r.html
ok "none of its contacts" fails 2 "$beadreel" unlike.yaml -o made --set outputs.0.field=contact-force
ok "... is said" says "beads: some chains have fewer beads"
ok "another ending is refused" refused 'report: r.png' 'lacks the extension'
ok "an unknown key is refused" refused 'report: r.html, fps: 30' 'fps'
ok "an unknown map is refused" refused 'report: r.html, colormap: rainbow' 'there is no colour map'
ok "a range upside down is refused" refused 'report: r.html, range: [3, 2]' 'the first must be below the second'
ok "an end behind the run's is refused" refused 'report: r.html, time: [0, 9 ms]' 'must not go beyond'
ok "too many samples are refused" refused 'report: r.html, every: 1 ns' 'too large for browsers'
long_chain() { fails 2 "$beadreel" scene.yaml -o made --set 'outputs=[{report: r.html}]' --set 'chain.beads=[{bead: large-steel, count: 20000}]' --plan && says 'show fewer'; }
ok "too many beads are refused" long_chain
ok "a file outside is refused" refused 'report: ../r.html' 'leaves the output directory'
ok "beadsim leaves it out" exits 0 "$beadsim" scene.yaml -o data
ok "... and says so" test ! -e data/run.html

again() { exits 0 "$beadsim" scene.yaml -o again --set 'outputs=[{trajectory: run.h5, every: 2 us}]' && exits 0 "$beadreel" again/run.h5 -o again/run.html; }
ok "a trajectory becomes a report" again
ok "... of its samples, without peaks" json 'd["time"]["count"] == 301 and "peaks" not in d["chains"][0]' again/run.html
equation() { exits 0 "$beadreel" kdv -o kdv --set chain.points=400 --set 'outputs=[{report: kdv.html}]' && json '"radius" not in d["chains"][0] and d["time"]["unit"] == "" and all(m["uncertainty"] is not None for m in d["chains"][0]["measures"])' kdv/kdv.html; }
ok "equations have reports without beads" equation
swings() { # nothing that goes on swinging is replaced by its largest values
    exits 0 "$beadreel" fput -o kdv --set 'outputs=[{report: fput.html}]' && json 'not d["time"]["held"] and d["time"]["every"] > 5' kdv/fput.html &&
        exits 0 "$beadreel" cradle.yaml -o kdv --set 'outputs=[{report: speed.html, field: velocity}]' && json 'not d["time"]["held"]' kdv/speed.html
}
# Impacts of a tenth of a millisecond, in samples further apart than that.
cat >cradle.yaml <<'YAML'
chain: {cradle: {length: 20 cm}, striker: {bead: large-steel, velocity: 0.4 m/s}, beads: [{bead: large-steel, count: 4}]}
simulate: {until: 0.5 s}
outputs: [{report: cradle.html, field: contact-force}, {report: few.html, field: contact-force, every: 1 ms, time: [0, 0.5 s]}]
YAML
ok "a cradle has a report" exits 0 "$beadreel" cradle.yaml -o cradle
impacts() { # FILE : each contact has its largest force in some sample
    /usr/bin/python3 - "$1" <<'PY'
import base64, json, re, struct, sys
d = json.loads(re.search(r'<script type="application/json" id="data">(.*?)</script>', open(sys.argv[1]).read(), re.S).group(1))
chain, field = d["chains"][0], d["chains"][0]["field"]
raw = base64.b64decode(field["data"])
whole = struct.unpack("<%d%s" % (len(raw) // 2, "h" if field["signed"] else "H"), raw)
n = chain["values"]
largest = [max(whole[k::n]) * field["step"] for k in range(n)]
parts = [a / b for a, b in zip(largest, chain["peaks"]["force"])]
print("# the largest samples are", [round(p, 4) for p in parts], "of the peaks, samples every", d["time"]["every"])
sys.exit(not (d["time"]["held"] and len(parts) == 4 and all(0.95 < p < 1.0001 for p in parts)))
PY
}
ok "... whose short impacts are not between its samples" impacts cradle/cradle.html
ok "... nor where few are asked for" impacts cradle/few.html
ok "... but speeds and strings are as they are at each time" swings
body() { # TEXT MESSAGE : of assets whose body of pages is the text
    rm -rf made assets && cp -rs "$BEADREEL_ASSETS" assets && rm assets/report/run.html && printf "$1" >assets/report/run.html &&
        BEADREEL_ASSETS=$T/assets fails 1 "$beadreel" scene.yaml -o made --set 'outputs=[{report: r.html}]' && says "report/run.html: $2" &&
        [ ! -e made/r.html ]
}
ok "a body in itself is refused" body 'licence\n{{body}}\n' 'its first line is not the licence, or it contains {{body}}'
ok "... and an unnamed part" body 'licence\n{{' '`{{` without a name'
small() { exits 0 "$beadreel" clean-vs-delocalised -o demo --set 'outputs=[{report: run.html, range: [0, 45 N]}, {image: force.png, size: [1920, 1080]}]' && [ "$(stat -c %s demo/run.html)" -le 3000000 ]; }
ok "that of the demo is not above 3 MB" small
long_files() { ! wc -l "$top"/assets/report/*.js | awk '$2 != "total" && $1 >= 500' | grep .; }
ok "no file of its program is long" long_files
no_script_end() { ! grep -n '</script' "$top"/assets/report/*.js; }
ok "... or ends the script" no_script_end

cat >sweep.yaml <<'YAML'
title: Ten cells
sweep: {cells: 10, magnetism: [0, 0.6, 1], configurations: 3, seed: 4}
simulate: {until: 0.4 ms}
outputs: [{report: sweep.html, range: [0, 30 N]}, {sweep: sweep.h5}, {table: configurations.csv, show: configurations}]
YAML
ok "a sweep has a report" exits 0 "$beadreel" sweep.yaml -o .
ok "... with the clean chain's image and those of its configurations" json 'len(d["panels"][0]["images"]) == 8' sweep.html
ok "... and its size is bounded" test "$(stat -c %s sweep.html)" -le 3000000
size=$(grep -oE '"times": [0-9]+' sweep.html | head -n 1 | tr -dc 0-9)
wide=$(grep -oE '"places": [0-9]+' sweep.html | head -n 1 | tr -dc 0-9)
ok "a run of a configuration" exits 0 "$beadreel" sweep.h5 --configuration 3 -o image.png --set outputs.0.axes=false --set outputs.0.orientation=time-down \
    --set "outputs.0.size=[$wide, $size]" --set 'outputs.0.range=[0, 30 N]' --set outputs.0.scale=sqrt --set outputs.0.colormap=inferno
ok "the plan of a sweep's file" exits 0 "$beadreel" sweep.h5 -o read.html --plan
ok "... says that images are run" prints "nothing is simulated but what a sheet or report shows"
ok "the file of a sweep becomes a report" exits 0 "$beadreel" sweep.h5 -o read.html
same_data() { diff <(grep -A9999 'id="data"' sweep.html) <(grep -A9999 'id="data"' read.html) >/dev/null; }
ok "... the same" same_data
# Without `until` all images end as the last front arrives: the first is not the slowest here.
arrived() {
    /usr/bin/python3 - auto.html <<'PYTHON'
import base64, json, re, sys
page = re.search(r'id="data">(.*?)</script>', open(sys.argv[1], encoding="utf-8").read(), re.DOTALL)
for image in json.loads(page[1])["panels"][0]["images"]:
    data, at, reached = base64.b64decode(image["data"]), 0, []
    while at < len(data):
        reached.append(data[at] | data[at + 1] << 8)
        at += 2 + reached[-1]
    assert reached[-1] == image["places"] and reached[0] < 9, (image["index"], reached)
PYTHON
}
ok "images of a sweep end as the last front arrives" eval '"$beadreel" sweep.yaml -q -o . --set simulate.until=auto --set sweep.seed=6 --set "outputs=[{report: auto.html}]" && arrived'
no_peaks() { fails 2 "$beadreel" sweep.yaml -o made --set 'outputs=[{report: r.html}]' --set 'sweep.measure={peak: none, decay: true}' && says 'measures none'; }
ok "peaks that are not measured are missed" no_peaks

if find_browser; then
    run timeout 240 /usr/bin/python3 "$top/tests/report.py" "$browser" "$top/assets" "$T" demo/run.html kdv/kdv.html cradle/cradle.html
    relay
else
    skip "a Chromium that runs here (chromium)" "a browser reads a report"
fi
finish
