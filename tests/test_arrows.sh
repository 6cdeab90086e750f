#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Rooms use only the rooms below them, no objects of a room go round in a circle, and the check of that sees what it should.
source "$(dirname "$0")/shell.bash"
cd "$top" || exit 1

ok "no arrow between rooms runs up, and there is no cycle within a room" tests/arrows.sh . "$BUILD"

mkdir "$T/house"
cp -r sim render "$T/house"
runs_up() { # FROM TO : an include of TO in FROM is found
    cp "$1" "$T/kept" && echo "#include \"$2\"" >>"$T/house/$1"
    run tests/arrows.sh "$T/house"
    cp "$T/kept" "$T/house/$1"
    [ "$status" -eq 1 ] || { echo "status $status"; return 1; }
    prints "$1 -> $2"
}
ok "a chain that includes a scene's header" runs_up sim/chain/law.c sim/options/options.h
ok "a plot that includes a figure's header" runs_up render/plot/graph.h render/figure/figure.h
ok "sim that includes render" runs_up sim/cli/beadsim.c render/draw/markup.h
ok "the copy without these passes" tests/arrows.sh "$T/house"

mkdir "$T/house/sim/attic" && echo '#include "sim/yaml/yaml.h"' >"$T/house/sim/attic/box.c"
no_room() { run tests/arrows.sh "$T/house"; [ "$status" -eq 1 ] && prints "sim/attic: is in no README"; }
ok "a room that no README names" no_room

mkdir -p "$T/objects/sim/base" "$T/objects/sim/chain" "$T/objects/render/draw"
rm -r "$T/house/sim/attic"
compile() { echo "$2" >"$T/house/$1.c" && ${CC:-cc} -c "$T/house/$1.c" -o "$T/objects/$1.o"; }
compile sim/base/low 'void high(void); void low(void) { high(); }'
compile sim/chain/high 'void high(void) {}'
compile render/draw/none 'int none;' && compile render/top 'int top;'
calls_up() { run tests/arrows.sh "$T/house" "$T/objects"; [ "$status" -eq 1 ] && prints "sim/base/low.c -> sim/chain/high.c (high)"; }
ok "a call upwards through a public header" calls_up
rm "$T/house/sim/base/low.c"
ok "an object whose source is gone counts no more" tests/arrows.sh "$T/house" "$T/objects"

compile sim/chain/one 'void two(void); void one(void) { two(); }'
compile sim/chain/two 'void three(void); void two(void) { three(); }'
compile sim/chain/three 'void high(void); void three(void) { high(); }'
ok "calls within a room that do not come back" tests/arrows.sh "$T/house" "$T/objects"
compile sim/chain/three 'void one(void); void three(void) { one(); }'
circle() {
    run tests/arrows.sh "$T/house" "$T/objects"
    [ "$status" -eq 1 ] && [ "$(grep -c cycle "$T/out")" -eq 1 ] && prints "sim/chain: cycle of sim/chain/one.c sim/chain/two.c sim/chain/three.c"
}
ok "calls within a room that go round in a circle" circle
finish
