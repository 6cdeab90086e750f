#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Plots of every kind have the scene's title on a screen and none on paper, where captions are; their panels have letters.
source "$(dirname "$0")/../shell.bash"
plain_canvas
cd "$T" || exit 1
chain='{striker: {bead: large-steel, velocity: 0.4 m/s}, beads: [{bead: large-steel, count: 4}, {bead: small-steel, sensor: S}]}'
string='{equation: fput, points: 8, alpha: 0.25, start: {mode: 1, amplitude: 1}}'
two() { echo "chains: [$(sed "s/^{/{name: one, /" <<<"$1"), $(sed "s/^{/{name: two, /" <<<"$1")]"; }
cat >sweep.yaml <<<'sweeps: [{name: one, cells: 4, configurations: 2}, {name: two, cells: 5, configurations: 2}]'
{ two "$chain"; echo 'simulate: {until: 0.2 ms}'; } >chains.yaml
{ two "$string"; echo 'simulate: {until: 20}'; } >strings.yaml
has() { grep -qF -- ">$2</tspan>" "$1"; }
has_not() { ! has "$@"; }
# plot SCENE KEYS : on a screen and on paper
plot() {
    ok "$1: ${2:-sweep}" exits 0 "$beadreel" "$1.yaml" -o . --set title=Headline \
        --set "outputs=[{plot: px.svg, $2 size: [800, 600]}, {plot: mm.svg, $2 size: [178 mm, 120 mm]}]"
    ok "... the title on a screen" has px.svg Headline
    ok "... none on paper" has_not mm.svg Headline
}
plot chains "show: peaks,"
plot chains "show: sensors,"
ok "... letters on a screen" has px.svg "(b)"
ok "... and on paper" has mm.svg "(b)"
plot strings "show: modes,"
ok "... letters on a screen" has px.svg "(b)"
plot strings "show: profiles, at: [0, 10],"
ok "... letters on a screen" has px.svg "(b)"
plot sweep ""
ok "... letters on a screen" has px.svg "(b)"

# One bead, or one time, of several chains on one axis: the legend names the chains, the title what they show. Such a plot has one panel,
# and on paper one column.
one() { # SHOWN WORDS
    "$beadreel" chains.yaml -q -o . --set "outputs=[{plot: one.svg, $1, overlay: true, style: paper}]" && grep -qE "$2</tspan>" one.svg && grep -qE 'width="24[34]' one.svg
}
ok "curves of one bead of two chains say which" one "beads: 3" ">bead 3"
ok "... and of one time" one "show: profiles, at: [0.1 ms]" "100.*s"
two() { "$beadreel" chains.yaml -q -o . --set 'outputs=[{plot: two.svg, beads: [3, 5], overlay: true}]' && grep -q ': bead 3</tspan>' two.svg && has_not two.svg "bead 3"; }
ok "... two beads are told in the legend" two
ok "a spectrogram says of which bead" eval '"$beadreel" chains.yaml -q -o . --set "outputs=[{plot: gram.svg, show: spectrogram, beads: 3, field: velocity}]" && grep -q ": bead 3</tspan>" gram.svg'
ok "... and of what" has gram.svg "amplitude of velocity (dB)"

# Headings say M of the chain in every kind of plot, after a comma; images of slides have the same, in the letters and colours of plots.
cat >spins.yaml <<'YAML'
chains:
  - {name: one, beads: [{cell: [large-steel, aluminium], count: 6, spins: "111111"}], wall: rigid, precompression: 10 N}
  - {name: two, beads: [{cell: [large-steel, aluminium], count: 6, spins: "110100"}], wall: rigid, precompression: 10 N}
simulate: {until: 0.3 ms}
outputs: [{table: t.csv}]
YAML
heading() { # KEYS: those of the chain "two" over the plot
    "$beadreel" spins.yaml -q -o . --set "outputs=[{$1}]" 2>"$T/out" || { cat "$T/out"; return 1; }
    python3 -c 'import re, sys
words = "\n".join(re.sub("<[^>]*>", "", line).strip("\n") for line in open(sys.argv[1]) if line.startswith("<text"))
sys.exit(not re.search("two\\n?,\\s*M\\s*=\\s*0\\b", words))' "$2"
}
for show in "sensors, beads: 3" "profiles, at: [0.2 ms]" "spectrum, beads: 3" "spectrogram, beads: 3" dispersion energy spreading eigenmodes; do
    ok "M over a plot: $show" heading "plot: h.svg, show: $show" h.svg
done
ok "... not over bands, which are those of the cell" eval '! heading "plot: h.svg, show: bands" h.svg'
ok "... over images of slides" heading "image: h.svg, style: slide" h.svg
colours() { grep "^<text" "$1" | grep -E ">(two|M)</tspan>" | grep -o 'fill="[^"]*"' | sort -u; }
ok "... in the colour of names" [ "$(colours h.svg | wc -l)" -eq 1 ]

# A title longer than the axes begins at the margin of the page, over images as over plots; one longer than the page is cut.
long() { "$beadreel" chains.yaml -q -o . --set title="$1" --set "outputs=[{image: long.svg, size: [390, 292]}]" && has long.svg "$1"; }
ok "a title as long as the page" long "The program of Appendix 4 and Eq. 13"
ok "... over a still" eval '"$beadreel" chains.yaml -q -o . --set title="Two short chains" --set "outputs=[{image: still.svg, size: [390, 500], views: [beads, spacetime], at: 0.1 ms}]" && has still.svg "Two short chains"'
ok "... a longer one" eval '! long "The program of Appendix 4 and Eq. 13, side by side, as they came" && grep -q ">The program of .*…</tspan>" long.svg'

# Names of axes of like views have one size, also where rows are low.
ok "three views of two chains" exits 0 "$beadreel" chains.yaml -o . \
    --set 'outputs=[{image: low.svg, size: [1280, 720], views: [beads, profile, spacetime], at: 0.1 ms}]'
sizes() { grep -oE 'font-size="[0-9.]+">(force \(N\)|time \()' low.svg | cut -d '"' -f 2 | sort -u; }
ok "... names of axes in one size" [ "$(sizes | wc -l)" -eq 1 ]
cat >drawing.yaml <<'YAML'
chain: {beads: [{bead: large-steel, count: 20, taper: 5 %}]}
outputs: [{plot: setup.svg, show: setup, size: [800, 300]}]
YAML
ok "a drawing" exits 0 "$beadreel" drawing.yaml -o .
ok "... says how many beads, once" [ "$(grep -oF '>20 beads</tspan>' setup.svg | wc -l)" -eq 1 ]

# The peak that a range of colours leaves out, where two waves meet, is that of the forces, however coarse the pixels are.
meet='{striker: {bead: large-steel, velocity: 0.4 m/s}, start: [{bead: last, velocity: -0.4 m/s}], beads: [{bead: large-steel, count: 79}]}'
echo "{chain: $meet, simulate: {until: 1.3 ms}}" >meet.yaml
"$beadreel" meet.yaml -q -o . --set 'outputs=[{image: small.svg, size: [390, 219]}, {image: large.svg, size: [1600, 900]}, {table: force.csv, show: extremes, field: force, every: 0.1 us}]'
peak=$(awk -F, 'NR > 1 && $2 > most {most = $2} END {printf "%.0f", most}' force.csv)
for size in small large; do
    ok "a $size image names the peak of forces, $peak N" grep -q "; peak $peak" $size.svg
done
finish
