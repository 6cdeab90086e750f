#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# The full campaign, an hour or two, and its figures: tests/campaign.sh BUILD [ROW...] (make campaign)
# Builds and runs fuzzing (twice: with the address sanitizer, and longer with the one of undefined behaviour alone, which is faster),
# torture and the thread sanitizer. Then writes the figures into tests/stress/RESULTS.md, each row with its date and commit; rows that
# were not run anew stay as they are. ROW: a target of fuzzing, a part of the torture (kills, pairs, want, signals, allocations), or
# tsan; with `figures` instead nothing is run. Fuzzing adds to what earlier runs of this commit have counted in BUILD-*fuzz/runs.txt.
# KILLS, ALLOCATIONS, PAIRS and RUNS (of each target in each build): smaller numbers.
set -u
cd "$(dirname "$0")/.." || exit 1
build=$1
logs=$build/campaign
mkdir -p "$logs"
fast=$build-undefined

# Executions of each target, in both builds.
targets='scene 2000000 8000000
plan 50000 50000
set 100000 0
config 100000 0
command 100000 0
trajectory 40000 0
sweep 20000 0
merge 20000 0
journal 40000 0
origin 1000000 0'

commit=$(git describe --always --abbrev=10)
rows=("${@:2}")
[ ${#rows[@]} -gt 0 ] || mapfile -t rows < <(cut -d' ' -f1 <<<"$targets"; printf '%s\n' kills pairs want signals allocations tsan)

# fuzz BUILD SANITIZERS TARGET RUNS : what is missing of them
fuzz() {
    local most=$4 left
    [ "${RUNS:-$most}" -ge "$most" ] || most=$RUNS
    left=$(awk -v target="$3" -v commit="$commit" -v left="$most" '$1 == target && $6 == commit { left -= $2 } END { print left }' \
        "$1-fuzz/runs.txt" 2>/dev/null)
    left=${left:-$most}
    [ "$left" -le 0 ] || make fuzz BUILD="$1" FUZZ_SANITIZERS="$2" TARGETS="$3" FUZZ_RUNS="$left" FUZZ_SECONDS=100000 FUZZ_SEED=$RANDOM </dev/null
}
# run ROW
run() {
    local numbers
    if numbers=$(grep "^$1 " <<<"$targets"); then
        read -r _ slow quick <<<"$numbers"
        fuzz "$build" address,undefined "$1" "$slow"
        fuzz "$fast" undefined "$1" "$quick"
        return
    fi
    {
        echo "measured $(date +%F) $commit"
        case $1 in
        tsan) make tsan ;;
        kills | pairs | want | signals | allocations)
            make torture PARTS="$1" KILLS="${KILLS:-1000}" ALLOCATIONS="${ALLOCATIONS:-all}" PAIRS="${PAIRS:-50}" ;;
        *) echo "campaign.sh: there is no row $1" >&2; exit 1 ;;
        esac
    } | tee "$logs/$1.log"
}

machine() {
    printf -- '- %s, %s cores, %s GB of memory\n' "$(sed -n 's/^model name\s*: //p' /proc/cpuinfo | head -n 1)" "$(nproc)" \
        "$(awk '/MemTotal/ {printf "%.0f", $2 / 1048576}' /proc/meminfo)"
    printf -- '- %s\n' "$(. /etc/os-release && echo "$PRETTY_NAME" "$(cat /etc/debian_version 2>/dev/null)")"
    printf -- '- %s; %s for fuzzing\n' "$(gcc --version | head -n 1)" "$(clang --version | head -n 1)"
}
# The rows below begin with the heading of their table.
# Sums of runs.txt for each target that was run at this commit: executions, seconds, faults. libFuzzer ends with 72 where a run is
# interrupted.
executions() {
    {
        sed 's/^/asked /' <<<"$targets"
        for file in "$build-fuzz/runs.txt" "$fast-fuzz/runs.txt"; do sed "s,^,$file ," "$file" 2>/dev/null; done
    } | awk -v slow="$build-fuzz/runs.txt" -v commit="$commit" '
        $1 == "asked" { order[++count] = $2; asked[$2] = $3 + $4; next }
        $7 == commit { date[$2] = $6; run[$2] += $3; address[$2] += $1 == slow ? $3 : 0; time[$2] += $4
            hdf5[$2] += $5 == "hdf5"; faults[$2] += $5 != "hdf5" && $5 != 0 && $5 != 72 }
        END { for (i = 1; i <= count; i++) { t = order[i]
            if (t in run) printf "Fuzzing| %s | %d | %d | %d | %d | %d | %d | %s | %s |\n", \
                t, asked[t], run[t], address[t], time[t], hdf5[t], faults[t], date[t], commit } }'
}
# The tables of the parts of the torture.
torture() {
    for part in kills pairs want signals allocations; do
        awk -v commit="$commit" '
            FNR == 1 { at = $2; if ($3 != commit) exit }
            /^ +runs +finished/ { columns = NF; inside = 1; next }
            /meant to be 0/ { exit }
            inside { name = $1; for (i = 2; i <= NF - columns; i++) name = name " " $i
                line = "Torture| " name " |"; for (i = NF - columns + 1; i <= NF; i++) line = line " " $i " |"
                print line " " at " | " commit " |" }' "$logs/$part.log" 2>/dev/null
    done
}
races() {
    awk -v commit="$commit" 'FNR == 1 { at = $2; if ($3 != commit) exit } END {
        if ($2 == "passed,") printf "Thread sanitizer| demo, sweep, every kind of output | %d | %d | %s | %s |\n", $1, $3, at, commit }' \
        "$logs/tsan.log" 2>/dev/null
}
# The page with these rows instead of those of the same name; new ones at the ends of their tables.
write() {
    local page=tests/stress/RESULTS.md
    { executions; torture; races; } >"$logs/rows"
    machine >"$logs/machine"
    awk -v rows="$logs/rows" -v machine="$logs/machine" '
        function rest(key) { for (i = 1; i <= count; i++) if ((key = order[i]) in row && index(key, heading "|") == 1) { print row[key]; delete row[key] } }
        BEGIN { while ((getline line < rows) > 0) { split(line, cell, "|"); key = cell[1] "|" cell[2]
            row[key] = substr(line, index(line, "|")); order[++count] = key } }
        /^<!-- Written by tests\/campaign/ { print; print ""; while ((getline line < machine) > 0) print line; print ""; skipped = 1; next }
        /^## / { heading = substr($0, 4); skipped = 0 }
        skipped { next }
        table && !/^\|/ { rest() }
        { table = /^\|/; split($0, cell, "|"); key = heading "|" cell[2]
            if (table && key in row) { print row[key]; delete row[key] } else print }' "$page" >"$logs/page.md" && cp "$logs/page.md" "$page"
}

[ "${rows[0]}" = figures ] || for row in "${rows[@]}"; do run "$row" || exit 1; done
write
