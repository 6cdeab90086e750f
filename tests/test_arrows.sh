#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Rooms use only the rooms below them, and the check of that sees what it should.
source "$(dirname "$0")/shell.bash"
cd "$top" || exit 1

ok "no arrow between rooms runs up" tests/arrows.sh . "$BUILD"

mkdir "$T/house"
cp -r sim render "$T/house"
runs_up() { # FROM TO : an include of TO in FROM is found
    cp "$1" "$T/kept" && echo "#include \"$2\"" >>"$T/house/$1"
    run tests/arrows.sh "$T/house"
    cp "$T/kept" "$T/house/$1"
    [ "$status" -eq 1 ] || { echo "status $status"; return 1; }
    prints "$1 -> $2"
}
ok "a chain that includes a scene's header" runs_up sim/chain/law.c sim/scene/options.h
ok "a plot that includes a figure's header" runs_up render/plot/graph.h render/figure/figure.h
ok "sim that includes render" runs_up sim/cli/beadsim.c render/draw/text.h
ok "the copy without these passes" tests/arrows.sh "$T/house"

mkdir "$T/house/sim/attic" && echo '#include "sim/base/yaml.h"' >"$T/house/sim/attic/box.c"
no_room() { run tests/arrows.sh "$T/house"; [ "$status" -eq 1 ] && prints "sim/attic: stands in no README"; }
ok "a room that no README names" no_room

mkdir -p "$T/objects/sim/base" "$T/objects/sim/chain" "$T/objects/render/draw"
rm -r "$T/house/sim/attic"
compile() { echo "$2" | ${CC:-cc} -x c -c - -o "$T/objects/$1.o"; }
compile sim/base/low 'void high(void); void low(void) { high(); }'
compile sim/chain/high 'void high(void) {}'
compile render/draw/none 'int none;' && cp "$T/objects/render/draw/none.o" "$T/objects/render/top.o"
calls_up() { run tests/arrows.sh "$T/house" "$T/objects"; [ "$status" -eq 1 ] && prints "sim/base/low.c -> sim/chain/high.c (high)"; }
ok "a call upwards through a public header" calls_up
finish
