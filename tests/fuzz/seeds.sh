#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Seeds of the fuzz targets, from the ready scenes, the wrong scenes of the tests, and runs of small scenes:
#   tests/fuzz/seeds.sh BUILD DIRECTORY     one directory of seeds for each target
set -eu
cd "$(dirname "$0")/../.."
build=$1 seeds=$2
export BEADREEL_ASSETS=$PWD/assets
mkdir -p "$seeds"/{scene,plan,set,config,command,trajectory,sweep,merge,journal,origin}
find assets/scenes tests/bad tests/golden -name '*.yaml' | while read -r scene; do
    cp "$scene" "$seeds/scene/$(tr / - <<<"${scene#*/}")"
done
cp "$seeds"/scene/{scenes,golden}-* "$seeds/plan"

n=0
while read -r setting; do
    n=$((n + 1))
    printf '%b' "$setting" >"$seeds/set/$n"
done <<'SETTINGS'
simulate.method=rkn8\nsimulate.step=0.1 us
chain.striker.velocity=1 m/s
outputs.0.size=[640, 360]\noutputs.1.field=velocity
outputs.+={table: b.csv, show: measures}
outputs.m.mp4.captions.0.text="*F*_{max}"
chain.beads.0.magnetism=0.5\nchain.beads.0.spins="010"
chain={beads: [{bead: brass, count: 3}]}
materials.light.mass=1 g
simulate.until=follow
outputs=[]
chain.start=[{bead: last, velocity: -1 m/s}, {bead: [0, last], velocity: 1 mm/s}]
chain.drive={bead: last, force: 1 N}
outputs.0.beads=[0, last]
outputs.m.mp4.duration=auto\noutputs.m.mp4.speed=[{at: 0, factor: 1/100}, {at: 20 us, factor: 1/4000}]
SETTINGS

settings() { cat >"$seeds/config/$1"; }
settings all <<'YAML'
style: movie
font: Lato
canvas: plain
materials: materials.yaml
colormaps: {own: own.txt, other: /somewhere/other.txt}
YAML
settings wrong <<<'style: [1, 2]'
cat >"$seeds/scene/over" <<'YAML'
chain: {striker: {velocity: 1 m/s}, beads: [{bead: large-steel, count: 4}], start: [{bead: [2, last], velocity: 1 mm/s}]}
sweep: {over: {chain.striker.velocity: {from: 0.1 m/s, to: 10 m/s, count: 3, spacing: log}, chain.beads.0.count: [2, 4]}}
simulate: {until: 100 us}
outputs: [{sweep: sweep.h5}]
YAML
# Each option of the program, with a value that it may have; a whole command line a row.
"$build/beadsim" --help=words | cut -f 1 | while read -r name _ argument value _; do
    printf '%s\n' "$name" ${argument%.} | sed "s/^[A-Z].*/${value:-1}/" >"$seeds/command/${name#--}"
done
n=0
while read -r line; do
    n=$((n + 1))
    printf '%b' "$line" >"$seeds/command/line$n"
done <<'LINES'
scene.yaml\n-o\nout\n--set\nchain.wall=rigid\n--only\na.png
--info\nrun.h5\n--json
--merge\na.h5\nb.h5\n-o\nc.h5
run.h5\n-o\na.png\n--beads\n10-20\n--range\n-5:5\n--size\n86mmx60mm\n--time\n0.2ms:1ms\n--views\nbeads,profile
sweep\n--shard\n3/8\n--threads\n4\n-q
--list\nkeys\nmovie
LINES

# The least of each format that has a text; the first byte is the row of the format's table.
python3 - "$seeds/origin" <<'PY'
import struct, sys, zlib
text = b"beadreel 0.1.0, scene:\nchain: {}\n"
names = text.replace(b"{", b"&#123;")
def box(name, inner): return struct.pack(">I", 8 + len(inner)) + name + inner
def element(name, inner): return bytes.fromhex(name) + struct.pack(">Q", 1 << 56 | len(inner)) + inner
def chunk(name, inner): return struct.pack(">I", len(inner)) + name + inner + struct.pack(">I", zlib.crc32(name + inner))
packet = b'<x:xmpmeta><rdf:li xml:lang="x-default">' + names + b"</rdf:li></x:xmpmeta>"
files = [
    b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", 1, 1, 8, 0, 0, 0, 0)) + chunk(b"tEXt", b"Software\0beadreel 0.1.0")
    + chunk(b"tEXt", b"Source\0chain: {}") + chunk(b"IDAT", zlib.compress(b"\0\0")) + chunk(b"IEND", b""),
    b"\xff\xd8\xff\xfe" + struct.pack(">H", 2 + len(text)) + text + b"\xff\xda",
    b"II*\0\x08\0\0\0\1\0" + struct.pack("<HHII", 270, 2, len(text) + 1, 26) + b"\0\0\0\0" + text + b"\0",
    b"RIFF\0\0\0\0WEBPXMP " + struct.pack("<I", len(packet)) + packet + b"\0\0",
    b"GIF89a\1\0\1\0\0\0\0\x21\xfe" + bytes([len(text)]) + text + b"\0;",
    box(b"uuid", bytes.fromhex("be7acfcb97a942e89c71999491e3afac") + packet),
    box(b"moov", box(b"udta", box(b"meta", b"\0\0\0\0" + box(b"ilst", box(b"\xa9cmt", box(b"data", b"\0\0\0\1\0\0\0\0" + text)))))),
    element("18538067", element("1254c367", element("7373", element("67c8", element("4487", text))))),
    b"<svg><metadata>" + names + b"</metadata></svg>",
    b"<< /Type /EmbeddedFile /Length %d >>\nstream\n" % len(text) + text,
    b"%!PS-Adobe-3.0 EPSF-3.0\n" + b"".join(b"%scene:" + line + b"\\134\n%scene+ more\n" for line in text.split(b"\n")),
    b'<html><meta name="generator" content="beadreel 0.1.0"><code id="scene-text">' + names + b"</code></html>",
]
for row, file in enumerate(files):
    with open(f"{sys.argv[1]}/{row}", "wb") as seed:
        seed.write(bytes([row]) + file)
PY

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
chain='striker: {bead: large-steel, velocity: 0.443 m/s}, beads: [{cell: [large-steel, aluminium], count: 3, spins: random, magnetism: 0.3, seed: 7}]'
trajectory() {
    printf 'chain: {%s}\nsimulate: {until: 60 us}\noutputs: [{trajectory: %s.h5, every: 10 us, fields: %s}]\n' "$chain" "$1" "$2" >"$work/scene.yaml"
    "$build/beadsim" "$work/scene.yaml" -o "$seeds/trajectory" >"$work/log" 2>&1 || { cat "$work/log"; return 1; }
}
trajectory all all
trajectory displacement '[displacement]'
trajectory force '[force, energy]'
cat >"$work/sweep.yaml" <<'YAML'
sweep: {cells: 4, fixed: 4, magnetism: [0, 0.5], configurations: 4, measure: {decay: true, beads: [1, 2]}}
simulate: {step: 1 us}
outputs: [{sweep: sweep.h5}]
YAML
sweep() { "$build/beadsim" "$work/sweep.yaml" "$@" >"$work/log" 2>&1; }
sweep -o "$seeds/sweep" || { cat "$work/log"; exit 1; }
for part in 1 2; do sweep --shard $part/2 -o "$work" || { cat "$work/log"; exit 1; }; done
cp "$work/sweep.2of2.h5" "$seeds"
cp "$work/sweep.1of2.h5" "$seeds/merge"
cp "$work/sweep.1of2.h5" "$seeds/sweep" || { cat "$work/log"; exit 1; }
# Journals are what a sweep leaves that cannot write on.
for kib in 1 2 4; do
    (ulimit -f $kib; sweep -o "$work/limit$kib") || true
    cp "$work/limit$kib/sweep.h5.part" "$seeds/journal/$kib" || exit 1
done
