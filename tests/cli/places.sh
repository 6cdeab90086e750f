#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Curves and rows of the beads and contacts that plots and tables list; curves of several chains in one panel.
source "$(dirname "$0")/../shell.bash"
cd "$T" || exit 1
cat >s.yaml <<'YAML'
chain: {beads: [{bead: large-steel, count: 9}, {bead: large-steel, sensor: S}, {bead: large-steel, count: 10}], wall: brass}
simulate: {until: 0.5 ms}
outputs:
  - {table: sensor.csv, show: sensors, every: 1 us}
  - {table: both.csv, show: sensors, beads: [12, 10, 10], contacts: [20], every: 1 us, uncertainty: false}
  - {table: moving.csv, show: sensors, beads: 10, field: velocity, every: 1 us}
  - {table: all.csv, show: peaks}
  - {table: some.csv, show: peaks, contacts: [7, 3]}
  - {table: beads.csv, show: bead-peaks, beads: 12}
YAML
column() { tail -n +2 "$1" | cut -d, -f"$2"; }
largest() { column "$1" "$2" | sort -g | tail -n 1; }
begins() { [ "$(head -n 1 "$1")" = "$2" ]; }
near() { awk -v a="$1" -v b="$2" -v t="$3" 'BEGIN {exit !(a > 0 && (a > b ? a - b : b - a) <= t * b)}'; }
ok "tables of places" exits 0 "$beadsim" s.yaml -o .
ok "... have a column each, rising and once" begins both.csv time_s,bead_10,bead_12,contact_20
ok "... that of a bead is that of its sensor, to the last digit" cmp <(column sensor.csv 2) <(column both.csv 2)
ok "... a field has its name" begins moving.csv time_s,bead_10_velocity,bead_10_velocity_uncertainty
# Physics: the fastest bead of a steel chain has .68163 of the velocity of an equal striker.
ok "... and its values" near "$(largest moving.csv 2)" "$(awk 'BEGIN {print 0.68163 * 0.443}')" 1e-3
ok "... the contact with the wall has the peak of the table" near "$(largest both.csv 4)" "$(tail -n 1 all.csv | cut -d, -f2)" 1e-3
ok "peaks of the contacts listed only" cmp some.csv <(head -n 1 all.csv; grep -E '^(3|7),' all.csv)
ok "peaks of one bead" eval '[ "$(wc -l <beads.csv)" = 2 ]'
ok "a plot needs no sensor" exits 0 "$beadreel" s.yaml -o p.svg --set 'outputs=[{plot: p.svg, beads: [3, 5], contacts: 4}]'
ok "... and names them" grep -qF '>contact 4</tspan>' p.svg
last() { # SCENE KEYS HEADER
    exits 0 "$beadsim" "$1" -o last.csv --set "outputs=[{table: last.csv, show: sensors, every: 50 us, uncertainty: false, $2}]" && begins last.csv "$3"
}
ok "the last bead, the last contact" last s.yaml 'beads: last, contacts: [last, 3]' time_s,bead_20,contact_3,contact_20
sed 's/, wall: brass//; s/contacts: \[20\]/contacts: [19]/' s.yaml >free.yaml
ok "... without a wall" last free.yaml 'beads: [last, 2], contacts: last' time_s,bead_2,bead_20,contact_19
ok "... of notes, of sound, of what a picture shows" exits 0 "$beadreel" s.yaml --plan --set 'outputs=[{movie: m.mp4, sound: contact last, notes: [{at: 0.1 ms, bead: last, text: a}, {at: 0.2 ms, contact: last, text: b}]}, {image: i.png, beads: [10, last]}, {image: j.png, beads: last}]'
ok "... on the command line" exits 0 "$beadreel" s.yaml --plan -o i.png --beads 10:last
wrong() { # KEYS MESSAGE
    fails 2 "$beadsim" s.yaml --plan --set "outputs=[{table: t.csv, $1}]" && says "$2"
}
ok "a bead that is not there" wrong 'show: sensors, beads: 21' 'outputs.0.beads: is 21, but the last bead is 20'
ok "a contact that is not there" wrong 'show: sensors, contacts: 21' 'outputs.0.contacts: is 21, but the last contact is 20'
ok "contacts have no velocity" wrong 'show: sensors, contacts: 3, field: velocity' 'outputs.0.field: belongs to beads'
ok "tables of peaks of contacts have no beads" wrong 'beads: 3' 'outputs.0.beads: belongs to `show: sensors, bead-peaks, energy, spectrum, spectrogram, transfer`'

cat >two.yaml <<'YAML'
chains:
  - {name: steel, beads: [{bead: large-steel, count: 9}]}
  - {name: brass, beads: [{bead: brass, radius: 4 mm, count: 9}]}
outputs:
  - {plot: apart.svg, beads: 5, size: [600, 400]}
  - {plot: over.svg, beads: 5, overlay: true, size: [600, 400]}
  - {plot: profiles.svg, show: profiles, at: [50 us, 90 us], overlay: true, size: [600, 400]}
YAML
ok "panels need no sensor" exits 0 "$beadreel" two.yaml -o panels.svg --set 'outputs=[{image: panels.svg, panels: [[{show: sensors, chain: steel, beads: 5}], [{show: sensors, chain: brass, contacts: [2, 8]}]]}]'
ok "... where they say which beads or contacts" grep -qF '>contact 8</tspan>' panels.svg
ok "... but else they do" fails 2 "$beadreel" two.yaml --plan --set 'outputs=[{image: p.svg, panels: [[{show: sensors, chain: steel}]]}]'
ok "... as they say" says "no bead of the chain has a \`sensor\`; give one, or say which \`beads\`"
ok "the last bead of chains of two lengths" exits 0 "$beadreel" two.yaml --plan --set chains.1.beads.0.count=12 --set 'outputs=[{plot: p.svg, beads: [3, last]}]'
ok "... is that of each" prints 'samples: force of beads 3 to 12'
ok "... and none of a range" fails 2 "$beadreel" two.yaml --plan --set chains.1.beads.0.count=12 --set 'outputs=[{image: p.svg, beads: [3, last]}]'
ok "... of which it would be the end" says 'outputs.0.beads.1: is last, which is 9 in one chain and 12 in another'
ok "an overlay" exits 0 "$beadreel" two.yaml -o .
ok "... names the chains in its legend" grep -qF '>brass</tspan>' over.svg
ok "... has one panel" eval '! grep -qF "(b)" over.svg && grep -qF "(b)" apart.svg'
ok "... of profiles tells times and chains apart" grep -qE 'brass: ' profiles.svg
finish
