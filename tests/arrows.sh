#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Print every arrow between rooms that runs up, and every cycle within a room: tests/arrows.sh ROOT [BUILD]
# A room is a folder of sim/ or render/; sim/README.md and render/README.md list them from the top floor down, and render stands on
# sim. An arrow is an #include or, where BUILD has the objects, a name that one room uses and another defines: calls of functions that
# a public header declares have no #include between rooms to show them. A cycle is a set of files of one room whose objects use names
# of each other, all of them reaching all others.
# Exit status 1 if any arrow runs up, if there is a cycle, or if a room is missing in its README.
set -u
root=$(cd "$1" && pwd) build=${2:-}

# Rooms with their floors, `5 sim/scene`, from the ground up.
floors() {
    for hall in sim render; do
        sed -n "s,^| \[\`\([a-z0-9]*\)/\`\](.*,$hall/\1,p" "$root/$hall/README.md" | tac
    done
    echo render
}
# Arrows by #include, `file room file room`.
includes() {
    (cd "$root" && grep -HE '^ *# *include "(sim|render)/' sim/*/*.[ch] render/*.[ch] render/*/*.[ch]) |
        sed -E 's/^([^:]*): *# *include "([^"]*)".*/\1 \2/'
}
# Objects whose sources are there still.
objects() {
    local object
    for object in sim/*/*.o render/*.o render/*/*.o; do
        [ ! -e "$root/${object%o}c" ] || echo "$object"
    done
}
# Arrows by names, the same.
names() {
    [ -d "$build/sim" ] || return 0
    # shellcheck disable=SC2046
    (cd "$build" && nm -A --format=posix $(objects)) | sed 's/\.o: / /' | awk '
        $3 == "U" { use[$1 " " $2] = 1; next }
        $3 ~ /^[A-TV-Z]$/ { home[$2] = $1 }
        END { for (u in use) { split(u, w, " "); if (w[2] in home) print w[1] ".c", home[w[2]] ".c", w[2] } }'
}
# Sets of files that reach each other, `room: file file ...`, from arrows by names.
cycles() {
    awk '
        function room(file) { sub(/\/[^\/]*$/, "", file); return file }
        room($1) == room($2) && $1 != $2 {
            reach[$1, $2] = 1
            for (i = 1; i <= 2; i++)
                if (!($i in seen)) { seen[$i] = 1; files[room($i), ++count[room($i)]] = $i }
        }
        END {
            for (r in count) {
                n = count[r]
                for (k = 1; k <= n; k++)
                    for (i = 1; i <= n; i++)
                        for (j = 1; j <= n && (files[r, i], files[r, k]) in reach; j++)
                            if ((files[r, k], files[r, j]) in reach) reach[files[r, i], files[r, j]] = 1
                for (i = 1; i <= n; i++) {
                    cycle = a = files[r, i]
                    if (a in told || !((a, a) in reach)) continue
                    for (j = i + 1; j <= n; j++) {
                        b = files[r, j]
                        if ((a, b) in reach && (b, a) in reach) { cycle = cycle " " b; told[b] = 1 }
                    }
                    print r ": cycle of " cycle
                }
            }
        }'
}
# Arrows that run up, and rooms that no README has.
upwards() {
    {
        floors | awk '{print "floor", $1, NR}'
        includes
        names
    } | awk '
        function room(file) { sub(/\/[^\/]*$/, "", file); return file }
        $1 == "floor" { floor[$2] = $3; next }
        {
            from = room($1); to = room($2)
            if (!(from in floor) || !(to in floor)) { print (from in floor ? to : from) ": is in no README"; next }
            if (floor[from] < floor[to]) print $1 " -> " $2 ($3 ? " (" $3 ")" : "") ": " from " is below " to
        }'
}
found=$({ upwards; names | sort | cycles; } | sort -u)
[ -z "$found" ] || { echo "$found"; exit 1; }
