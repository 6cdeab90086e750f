#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Contact sheets: of a sweep, of its file, of one random chain; only what they show is run.
source "$(dirname "$0")/../shell.bash"
cat >"$T/sweep.yaml" <<'YAML'
title: Sheet
sweep: {cells: 12, configurations: 500, seed: 7}
outputs:
  - {sheet: sheet.png, size: [640, 480]}
  - {sheet: sheet.svg, size: [640, 480], theme: dark}
  - {sweep: sweep.h5}
YAML
cat >"$T/chain.yaml" <<'YAML'
chain: {beads: [{cell: [large-steel, aluminium], count: 12, spins: random, magnetism: 0.5}, {cell: [large-steel, aluminium], count: 4}]}
outputs: [{image: force.png}]
YAML
same() { cmp "$1" "$2"; }

ok "a sheet" exits 0 "$beadreel" "$T/sweep.yaml" --only sheet.png --threads 1 -o "$T/one"
ok "... with two threads" exits 0 "$beadreel" "$T/sweep.yaml" --only sheet.png --threads 2 -o "$T/two"
ok "... is the same" same "$T/one/sheet.png" "$T/two/sheet.png"
ok "... and nothing else is run" [ ! -e "$T/one/sweep.h5" ]
ok "--plan" exits 0 "$beadreel" "$T/sweep.yaml" --only sheet.png --plan
ok "... says so" prints "only those that outputs show"
ok "a drawing with the sweep's file" exits 0 "$beadreel" "$T/sweep.yaml" --set sweep.configurations=3 -o "$T/all"
ok "--sheet of the file" exits 0 "$beadreel" --sheet "$T/all/sweep.h5" -o "$T/again.png" --set 'outputs.0.size=[640, 480]'
ok "--sheet of the scene" exits 0 "$beadreel" --sheet "$T/sweep.yaml" -o "$T/scene.png" --set 'outputs.0.size=[640, 480]' --set sweep.configurations=3
# What the files say about themselves stands before the pixels.
same_pixels() { cmp <(tail -c 20000 "$1") <(tail -c 20000 "$2"); }
ok "... is the same picture" same_pixels "$T/again.png" "$T/scene.png"
ok "--sheet of one random chain" exits 0 "$beadreel" --sheet "$T/chain.yaml" -o "$T/chain.png"
ok "... of which one can be run alone" exits 0 "$beadreel" "$T/chain.yaml" --configuration 70 -o "$T/alone.h5"
ok "... --info" exits 0 "$beadreel" --info "$T/alone.h5"
ok "... another magnetism than the scene's" prints "M = 0.1667"
ok "--sheet without -o" fails 2 "$beadreel" --sheet "$T/sweep.yaml"
ok "--sheet into a movie" fails 2 "$beadreel" --sheet "$T/sweep.yaml" -o "$T/a.mp4"
ok "--sheet of an equation" fails 2 "$beadreel" --sheet fput -o "$T/a.png"
ok "--sheet of one ordered chain" fails 2 "$beadreel" --sheet "$T/chain.yaml" --set chain.beads.0.spins=up -o "$T/a.png"
ok "--sheet of one run" fails 2 "$beadreel" --sheet "$T/alone.h5" -o "$T/a.png"
ok "--sheet and --configuration" fails 2 "$beadreel" --sheet "$T/sweep.yaml" --configuration 1 -o "$T/a.png"
# Of configurations that are listed, each picture says its magnetism, |up - down| / cells; rows of one magnetism have it in front.
said() { # FILE PATTERN : words of the sheet that have it
    (cd "$top/tests" && /usr/bin/python3 -c 'import re, sys, svg_plots
print(*(t.words for t in svg_plots.texts_of(open(sys.argv[1]).read()) if re.search(sys.argv[2], t.words)), sep="|")' "$1" "$2")
}
ok "configurations that are listed" exits 0 "$beadreel" "$T/sweep.yaml" -o "$T/listed" --set 'sweep={cells: 8, spins: ["11101111", "10110100", "00001000"]}' --only sheet.svg
ok "... have their magnetism" [ "$(said "$T/listed/sheet.svg" '^#')" = "#0  M 0.75|#1  M 0|#2  M 0.75" ]
ok "... the others have not" [ "$(said "$T/all/sheet.svg" '^#.* M')" = "" ]
sweep="{cells: 2, magnetism: [0, 1], configurations: 2, name:"
echo "{sweeps: [$sweep a}, $sweep b}, $sweep c}], outputs: [{sheet: a.png, size: [640, 90]}]}" >"$T/many.yaml"
ok "more sweeps than rows" fails 2 "$beadreel" "$T/many.yaml" -o "$T"
ok "... have a row each" says "no room for 3 rows"
ok "no room" fails 2 "$beadreel" --sheet "$T/sweep.yaml" --set 'outputs.0.size=[90, 60]' -o "$T/a.png"
ok "... nothing is left" [ ! -e "$T/a.png" ]
finish
