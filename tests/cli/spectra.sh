#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Spectra: a sine's line and Parseval's sum, a chirp's line over time, waves that fade where no band is, and the bands of a cell, from
# runs.
source "$(dirname "$0")/../shell.bash"
cd "$T" || exit 1
near() { awk -v a="$1" -v b="$2" -v t="$3" 'BEGIN {d = a / b - 1; exit !(a != "" && (d < 0 ? -d : d) <= t)}' || { echo "$1 is not $2 to $3"; return 1; }; }
# FILE COLUMN : half of the sum of the squares of a column; where it is largest, and how large
halves() { awk -F, -v c="$2" 'NR > 1 {sum += $c * $c} END {printf "%.15g", sum / 2}' "$1"; }
largest() { awk -F, -v c="$2" 'NR > 1 && $c > most {most = $c; at = $1} END {print at}' "$1"; }
# FILE COLUMN ROWS : mean square about the mean of the first rows
square() { awk -F, -v c="$2" -v n="$3" 'NR > 1 && NR <= n + 1 {s += $c; q += $c * $c} END {printf "%.15g", q / n - s * s / n / n}' "$1"; }

# 10 periods in 1000 samples; one more does not fit.
cat >sine.yaml <<'YAML'
chain:
  precompression: 20 N
  wall: rigid
  beads: [{bead: large-steel, count: 30}]
  drive: {displacement: sine, amplitude: 10 nm, frequency: 5 kHz}
simulate: {until: 2 ms}
outputs:
  - {table: hann.csv, show: spectrum, beads: [0, 20], field: displacement, every: 2 us}
  - {table: none.csv, show: spectrum, beads: [0, 20], field: displacement, every: 2 us, window: none}
  - {table: time.csv, show: sensors, beads: [0, 20], field: displacement, every: 2 us}
YAML
ok "a driven chain" exits 0 "$beadreel" sine.yaml -o .
ok "a sine has its line at its frequency" test "$(largest none.csv 2)" = 5000
ok "... in Hann's window" test "$(largest hann.csv 2)" = 5000
ok "... of its amplitude" near "$(awk -F, '$1 == 5000 {print $2}' hann.csv)" 1e-8 1e-9
ok "the squares of a sine add up to half of its own" near "$(halves none.csv 2)" 5e-17 1e-9
ok "... times 3/2 in Hann's window" near "$(halves hann.csv 2)" 7.5e-17 1e-9
ok "those of any curve to its mean square" near "$(halves none.csv 3)" "$(square time.csv 3 1000)" 1e-10

# Equal beads above their band: cosh(k / 2) = f / f1, amplitudes fall as exp(-k n).
cat >fade.yaml <<'YAML'
chain:
  precompression: 20 N
  wall: rigid
  beads: [{bead: large-steel, count: 60}]
  drive: {displacement: sine, amplitude: 1 nm, frequency: 30 kHz, ramp: 2 ms}
simulate: {until: 6 ms}
outputs:
  - {table: fade.csv, show: transfer, beads: [1, 5], time: [2 ms, 6 ms], every: 1 us, window: none}
  - {table: bands.csv, show: bands}
YAML
ok "a chain driven above its band" exits 0 "$beadreel" fade.yaml -o .
ok "transfer has the one frequency that is driven" test "$(wc -l <fade.csv)" = 2
fades() { # COLUMN BEADS
    local f1; f1=$(awk -F, '$3 == "band" {print $6}' bands.csv)
    near "$(awk -F, -v c="$1" 'NR == 2 {print $c}' fade.csv)" "$(awk -v x="$f1" -v n="$2" 'BEGIN {x = 30000 / x; k = 2 * log(x + sqrt(x * x - 1)); printf "%.15g", exp(-k * n)}')" 1e-4
}
ok "waves above the band fade from bead to bead" fades 2 1
ok "... by the same factor" fades 3 5
# So do forces and compressions of contacts, from that of the driven bead on.
for what in "force contacts" "compression contacts" "contact-force contacts"; do
    ok "... $what, too" exits 0 "$beadsim" fade.yaml -o . --set "outputs.0={table: fade.csv, show: transfer, ${what#* }: [1, 5], field: ${what% *}, time: [2 ms, 6 ms], every: 1 us, window: none}"
    ok "... by that factor" fades 2 1
    ok "... and that" fades 3 5
done

{ dimers 400; cat; } >dimer.yaml <<'YAML'
  start: [{bead: [400, 401], velocity: 1 um/s}]
simulate: {until: 20 ms}
outputs: [{table: dispersion.csv, show: dispersion}, {plot: dispersion.svg, show: dispersion}]
YAML
line() { awk -F, -v q="$1" -v b="$2" '$1 == q && $2 == b {print $4}' dispersion.csv; }
ok "a dimer, struck in the middle" exits 0 "$beadreel" dimer.yaml -o .
ok "the dispersion has the top of the lower band" near "$(line 1 1)" 4710.94 1e-3
ok "... the bottom of the upper one" near "$(line 1 2)" 8102.20 1e-3
ok "... and its top" near "$(line 0 2)" 9372.22 1e-3
ok "lines of long and short waves lie on the exact bands" eval \
    'awk -F, "NR > 1 && \$1 > 0.05 {d = \$4 / \$3 - 1; n += d * d < 1e-6; all++} END {exit !(all > 350 && n > 0.99 * all)}" dispersion.csv'

for field in compression energy force; do
    ok "so has that of $field" exits 0 "$beadsim" dimer.yaml -o . --set "outputs=[{table: dispersion.csv, show: dispersion, field: $field}]"
    case $field in # energies, squares, have twice the frequency and no line of their own; the force of beads has none for short waves
        compression) ok "... the same top of the lower band" near "$(line 1 1)" 4710.94 1e-3 ;;
    esac
    [ "$field" = energy ] || ok "... and of the upper" near "$(line 0 2)" 9372.22 1e-2
done

# f^2 = (f1^2 + f2^2) / 2 -+ sqrt((f1^2 + f2^2)^2 / 4 - (f1 f2 sin(q / 2))^2).
awk 'BEGIN { pi = atan2(0, -1); print "part,Hz"
             for (b = -1; b <= 1; b += 2) for (i = 0; i <= 1000; i++) {
                 q = i / 1000; f1 = 4710.94 ^ 2; f2 = 8102.20 ^ 2
                 printf "%.9g,%.9g\n", q, sqrt((f1 + f2) / 2 + b * sqrt((f1 + f2) ^ 2 / 4 - f1 * f2 * sin(pi * q / 2) ^ 2)) } }' >closed.csv
sort -t, -k1g,1 closed.csv >bands.csv
ok "a plot has the exact bands over it" python3 "$top/tests/curves.py" dispersion.svg bands.csv 1 1e3
# The axis of wave numbers ends where they do: the bands reach from the left edge of the frame, the first that is closed, to the right.
across() {
    python3 -c 'import re, sys
svg = open(sys.argv[1]).read()
frame, curve = ([float(x) for x, _ in re.findall(r"[ML] ([-.\d]+) ([-.\d]+)", re.search(p, svg).group(1))]
                for p in (r"<path [^>]*fill(?::|=\")none[^>]* d=\"([^\"]*Z[^\"]*)\"", r"<g clip-path=\"[^\"]*\"[^>]*>\n<path [^>]* d=\"([^\"]+)\""))
off = [abs(edge(frame) - edge(curve)) / (max(frame) - min(frame)) for edge in (min, max)]
sys.exit(max(off) > 0.005 and f"bands end {off} of the width beside the edges")' "$1"
}
ok "... from the first wave number to the last" across dispersion.svg
loose() {
    "$beadreel" -q -o . loose.yaml >log 2>&1 && ! grep -q "exact bands" loose.svg && grep -q ">10<" loose.svg || { cat log; return 1; }
}
printf '%s\n' 'chain: {beads: [{cell: [large-steel, aluminium], count: 8}]}' 'simulate: {until: 1 ms}' \
    'outputs: [{plot: loose.svg, show: dispersion, field: velocity, frequencies: [0 Hz, auto]}]' >loose.yaml
ok "a chain that nothing presses has none, and waves all the same" loose
ok "nor has one that stands still" "$beadreel" -q -o . loose.yaml --set 'chain.striker.velocity=0' --set chain.precompression=1N \
    --set 'outputs=[{plot: still.svg, show: spectrogram, beads: 3, field: force}]'
ok "... but all frequencies" grep -qF 'frequency (' still.svg
{ dimers 30; cat; } >gap.yaml <<'YAML'
  drive: {displacement: noise, amplitude: 10 pm, frequency: 12 kHz} # more would make waves in the gap from two in the bands
simulate: {until: 40 ms, accuracy: 1e-8}
outputs:
  - {table: gap.csv, show: transfer, beads: 40, every: 20 us, segment: 20 ms}
  - {table: spectrum.csv, show: spectrum, beads: 40, every: 20 us, window: none}
YAML
# cosh k = 2 f^2 (f3^2 - f^2) / (f1 f2)^2 - 1 within the gap; by cell.
ok "a dimer driven by a sine in its gap" exits 0 "$beadsim" gap.yaml -o . --set 'chain.drive={displacement: sine, amplitude: 1 nm, frequency: 5.1 kHz, ramp: 20 ms}' \
    --set chain.striker.bead=light --set 'outputs=[{table: cell.csv, show: transfer, beads: [2, 20], time: [20 ms, 40 ms], every: 10 us}]'
cells() { awk -v n="$1" 'BEGIN {f = 5100; x = 2 * f ^ 2 * (9372.22 ^ 2 - f ^ 2) / (4710.94 * 8102.20) ^ 2 - 1; printf "%.15g", exp(-n * log(x + sqrt(x * x - 1)))}'; }
ok "waves in the gap fade by the closed form" near "$(awk -F, '$1 == 5100 {print $2}' cell.csv)" "$(cells 1)" 1e-4
ok "... ten cells on" near "$(awk -F, '$1 == 5100 {print $3}' cell.csv)" "$(cells 10)" 1e-3
# The driven bead's own contact, on its left where it is the last bead, has the ratio 1 to itself.
cat >own.yaml <<'YAML'
chain: {precompression: 10 N, drive: {bead: 6, displacement: noise, amplitude: 10 pm, frequency: 12 kHz}, beads: [{bead: large-steel, count: 6}]}
simulate: {until: 4 ms}
outputs: [{table: own.csv, show: transfer, contacts: [4, last], every: 20 us, uncertainty: false}]
YAML
ok "a transfer from the last bead" exits 0 "$beadsim" own.yaml -o .
ok "... is 1 at its own contact" awk -F, 'NR > 1 {all++; bad += $3 != 1 || $2 == 1} END {exit !(all > 50 && bad == 0)}' own.csv
between() { awk -F, -v a="$1" -v b="$2" '$1 > a && $1 < b && $2 > most {most = $2} END {print most}' gap.csv; }
ok "a dimer driven by noise" exits 0 "$beadsim" gap.yaml -o .
ok "inside the gap less than a thousandth passes" awk -v t="$(between 5100 7700)" 'BEGIN {exit !(t > 0 && t < 1e-3)}'
ok "in the bands most of it" awk -v a="$(between 500 4600)" -v b="$(between 8200 9300)" 'BEGIN {exit !(a > 0.5 && b > 0.5)}'

# Chirps over the edges of the bands, which 20 cells on are where a tenth of the wave is left: there exp(-20 k) = 1/10, and cosh k
# is 1.0066, .1 % from the edge at most.
{ dimers 100; cat; } >edge.yaml <<'YAML'
  drive: {displacement: chirp, amplitude: 100 pm, frequency: 1 kHz, to: 2 kHz}
simulate: {until: 80 ms, accuracy: 1e-8}
outputs: [{table: edge.csv, show: transfer, beads: 40, every: 20 us}]
YAML
edge() { # FROM TO first|last : the first, or the last frequency of which a tenth arrives, away from where the window is small
    "$beadsim" edge.yaml -q -o . --set chain.drive.frequency="$1 Hz" --set chain.drive.to="$2 Hz" >log 2>&1 || return 1
    awk -F, -v a="$1" -v b="$2" -v w="$3" '$1 > a + 150 && $1 < b - 150 && $2 > 0.1 && (w == "last" || at == "") {at = $1} END {print at}' edge.csv
}
ok "a chirp finds the top of the lower band" near "$(edge 4200 5200 last)" 4710.94 5e-3
ok "... the bottom of the upper one" near "$(edge 7300 8900 first)" 8102.20 5e-3
ok "... and its top" near "$(edge 8700 10000 last)" 9372.22 5e-3

# A chirp from 1 to 21 kHz in 20 ms: at time t it is at 1 kHz + t * 1 MHz/s.
cat >chirp.yaml <<'YAML'
chain:
  precompression: 20 N
  wall: rigid
  beads: [{bead: large-steel, count: 10}]
  drive: {displacement: chirp, amplitude: 1 nm, frequency: 1 kHz, to: 21 kHz}
simulate: {until: 20 ms}
outputs:
  - {table: chirp.csv, show: spectrogram, beads: 0, field: displacement, every: 10 us}
YAML
follows() {
    awk -F, 'function check() {if (time != "") {d = at - 1000 - 1e6 * time; all++; bad += d > 1000 || d < -1000}}
             NR == 1 {next}
             $1 != time {check(); time = $1; most = 0}
             $3 > most {most = $3; at = $2}
             END {check(); exit !(all > 100 && bad == 0)}' chirp.csv
}
ok "a chirp" exits 0 "$beadsim" chirp.yaml -o .
ok "a chirp's line climbs with it" follows
ok "... with the amplitude of the sine" near "$(awk -F, 'NR > 1 && $3 > most {most = $3} END {print most}' chirp.csv)" 1e-9 0.15

# Where the frequencies are those of the chirp, from 1 to 21 kHz in 20 ms, its line is narrowest with the length that is chosen,
# 2 sqrt(20 ms / 20 kHz): the spread of the power about the line, mean over times.
spread() { # SETTING...
    "$beadsim" chirp.yaml -o wide --set 'outputs.0.frequencies=[1 kHz, 21 kHz]' "$@" >wide.log 2>&1 && awk -F, 'NR > 1 {
            f = 1000 + 1e6 * $1; if (f > 5000 && f < 17000) {p += $3 * $3; s += $3 * $3 * ($2 - f) * ($2 - f)}} END {printf "%.0f", sqrt(s / p)}' wide/chirp.csv
}
narrowest() { echo "$1 with $2 and $3"; test "$1" -gt 0 && test "$1" -lt "$2" && test "$1" -lt "$3"; }
ok "a spectrogram chooses the segments that make a chirp's line narrow" narrowest "$(spread)" "$(spread --set 'outputs.0.segment=1.2 ms')" \
    "$(spread --set 'outputs.0.segment=3.2 ms')"
step() { spread >/dev/null && awk -F, 'NR > 2 && $2 > f {print $2 - f; exit} {f = $2}' wide/chirp.csv; }
ok "... of 2 ms, of samples whose number has small factors" near "$(step)" 500 0.05

ok "panels of a figure: images and curves over frequency beside those over time" exits 0 "$beadreel" gap.yaml -o . --set \
    'outputs=[{plot: parts.svg, panels: [[{show: dispersion}, {show: spectrogram, beads: 9}], [{show: spectrum, beads: 9}, {show: bands}], [{show: sensors, beads: 9}]]}]'
ok "... each with its axis" eval 'grep -qF "(dB)" parts.svg && grep -qF "wave number" parts.svg && grep -qF ">gap<" parts.svg'

cat >short.yaml <<'YAML'
chain: {striker: {bead: large-steel, velocity: 0.4 m/s}, wall: brass, precompression: 2 N, beads: [{bead: large-steel, count: 6}]}
simulate: {until: 1 ms}
outputs: [{plot: short.svg, show: spectrum, beads: [0, 3], every: 1 us, frequencies: [490 kHz, auto]}]
YAML
ok "frequencies beyond all that a spectrum has are refused" fails "1 2" "$beadreel" short.yaml -o .
ok "... as they would be" says "frequencies: from 490000 to 1"

ok "a segment must fit" fails "1 2" "$beadsim" gap.yaml -o . --set 'outputs.0.segment=1 s'
ok "... and be said" says "segment: has 50000 of 2001 samples"
ok "spectrograms have one curve" fails "1 2" "$beadsim" --plan chirp.yaml --set outputs.0.beads='[0, 1]'
finish
