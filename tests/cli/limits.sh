#!/bin/bash
# How many beads there can be: stated limits are checked before memory is taken, and plans of long chains are cheap.
source "$(dirname "$0")/../shell.bash"
scene() { # BEADS
    echo "chain: {beads: [{bead: large-steel, count: $1}]}
outputs: [{table: peaks.csv, show: peaks}]"
}
scene 100000000 >"$T/longest.yaml"
scene "50000000}, {bead: large-steel, count: 50000001" >"$T/longer.yaml"
scene 2000000 >"$T/long.yaml"
plan() { # KILOBYTES SCENE
    (ulimit -v "$1" && exec "$beadsim" --plan "$T/$2.yaml") >"$T/out" 2>"$T/err"
    status=$?
}
ok "more than 1e8 beads behind the striker" fails 2 "$beadsim" --plan "$T/longer.yaml"
ok "... the message has the limit" says "longer than 100000000 beads, the most that is allowed"
plan 1000000 long
if [ $status -ne 0 ] && ! grep -q beads "$T/err"; then
    skip "limits of memory (sanitizers need all there is)" "plans within limits of memory"
else
    ok "2e6 beads are planned in 1 GB" prints "chain 2000001 beads"
    plan 1000000 longest
    ok "1e8 beads are not: status 1" test $status -eq 1
    ok "... one line" test "$(wc -l <"$T/err")" -eq 1
    ok "... what, where, how much" grep -qE 'longest.yaml:1:8: chain: 100000001 beads need 6.4 GB of memory; [01]\.?[0-9]* GB are free$' "$T/err"
fi
# Without precompression nothing is written to the arrays of static forces.
if [ -x /usr/bin/time ]; then
    cheap() { /usr/bin/time -f %M -o "$T/kilobytes" "$beadsim" --plan "$T/long.yaml" && [ "$(tail -1 "$T/kilobytes")" -lt $((20000 + 2000 * 56)) ]; }
    plan 1000000 long
    if [ $status -eq 0 ]; then ok "a planned bead takes less than 56 bytes" cheap; fi
fi
finish
