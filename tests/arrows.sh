#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Print every arrow between rooms that runs up: tests/arrows.sh ROOT [BUILD]
# A room is a folder of sim/ or render/; sim/README.md and render/README.md list them from the top floor down, and render stands on
# sim. An arrow is an #include or, where BUILD has the objects, a name that one room uses and another defines: calls of functions that
# a public header declares have no #include between rooms to show them.
# Exit status 1 if any arrow runs up, or if a room is missing in its README.
set -u
root=$1 build=${2:-}

# Rooms with their floors, `5 sim/scene`, from the ground up.
floors() {
    for hall in sim render; do
        sed -n "s,^| \[\`\([a-z]*\)/\`\](.*,$hall/\1,p" "$root/$hall/README.md" | tac
    done
    echo render
}
# Arrows by #include, `file room file room`.
includes() {
    (cd "$root" && grep -HE '^ *# *include "(sim|render)/' sim/*/*.[ch] render/*.[ch] render/*/*.[ch]) |
        sed -E 's/^([^:]*): *# *include "([^"]*)".*/\1 \2/'
}
# Arrows by names, the same.
names() {
    [ -d "$build/sim" ] || return 0
    (cd "$build" && nm -A --format=posix sim/*/*.o render/*.o render/*/*.o) | sed 's/\.o: / /' | awk '
        $3 == "U" { use[$1 " " $2] = 1; next }
        $3 ~ /^[A-TV-Z]$/ { home[$2] = $1 }
        END { for (u in use) { split(u, w, " "); if (w[2] in home) print w[1] ".c", home[w[2]] ".c", w[2] } }'
}
{
    floors | awk '{print "floor", $1, NR}'
    includes
    names
} | awk '
    function room(file) { sub(/\/[^\/]*$/, "", file); return file }
    $1 == "floor" { floor[$2] = $3; next }
    {
        from = room($1); to = room($2)
        if (!(from in floor) || !(to in floor)) { print (from in floor ? to : from) ": stands in no README"; bad = 1; next }
        if (floor[from] < floor[to]) { print $1 " -> " $2 ($3 ? " (" $3 ")" : "") ": " from " is below " to; bad = 1 }
    }
    END { if (!length(floor)) bad = 1; exit bad }' | sort -u
exit "${PIPESTATUS[1]}"
