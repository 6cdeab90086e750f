#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# The full campaign, an hour or two, and its figures: tests/campaign.sh BUILD (make campaign)
# Builds and runs fuzzing (twice: with the address sanitizer, and longer with the one of undefined behaviour alone, which is faster),
# torture and the thread sanitizer. Fuzzing adds to what earlier runs have counted in BUILD-*fuzz/runs.txt. Then writes the figures into
# tests/stress/RESULTS.md; with `figures` behind BUILD it does only that.
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

# fuzz BUILD SANITIZERS TARGET RUNS : what is missing of them
fuzz() {
    local left
    left=$(awk -v target="$3" -v asked="$4" '$1 == target { asked -= $2 } END { print asked }' "$1-fuzz/runs.txt" 2>/dev/null)
    left=${left:-$4}
    [ "$left" -le 0 ] || make fuzz BUILD="$1" FUZZ_SANITIZERS="$2" TARGETS="$3" FUZZ_RUNS="$left" FUZZ_SECONDS=100000 FUZZ_SEED=$RANDOM </dev/null
}
run() {
    while read -r target slow quick; do
        fuzz "$build" address,undefined "$target" "$slow"
        fuzz "$fast" undefined "$target" "$quick"
    done <<<"$targets"
    make torture KILLS=1000 ALLOCATIONS=all PAIRS=50 | tee "$logs/torture.log"
    make tsan | tee "$logs/tsan.log"
}

machine() {
    printf -- '- %s, %s cores, %s GB of memory\n' "$(sed -n 's/^model name\s*: //p' /proc/cpuinfo | head -n 1)" "$(nproc)" \
        "$(awk '/MemTotal/ {printf "%.0f", $2 / 1048576}' /proc/meminfo)"
    printf -- '- %s\n' "$(. /etc/os-release && echo "$PRETTY_NAME" "$(cat /etc/debian_version 2>/dev/null)")"
    printf -- '- %s; %s for fuzzing\n' "$(gcc --version | head -n 1)" "$(clang --version | head -n 1)"
}
# Sums of runs.txt for each target: executions, seconds, faults. libFuzzer ends with 72 where a run is interrupted.
executions() {
    echo '| target | asked | run | of them with the address sanitizer | processor time, s | ended within libhdf5 | faults |'
    echo '|---|--:|--:|--:|--:|--:|--:|'
    {
        sed 's/^/asked /' <<<"$targets"
        for file in "$build-fuzz/runs.txt" "$fast-fuzz/runs.txt"; do sed "s,^,$file ," "$file" 2>/dev/null; done
    } | awk -v slow="$build-fuzz/runs.txt" '
        $1 == "asked" { order[++count] = $2; asked[$2] = $3 + $4; next }
        { run[$2] += $3; address[$2] += $1 == slow ? $3 : 0; time[$2] += $4
            hdf5[$2] += $5 == "hdf5"; faults[$2] += $5 != "hdf5" && $5 != 0 && $5 != 72 }
        END { for (i = 1; i <= count; i++) { t = order[i]
            printf "| %s | %d | %d | %d | %d | %d | %d |\n", t, asked[t], run[t], address[t], time[t], hdf5[t], faults[t] } }'
}
# The tables of the torture, added up, as Markdown.
torture() {
    cat "$logs"/torture*.log | awk '
        /^ +runs +finished/ { split($0, head); if (!columns) { columns = NF; line = "| |"; rule = "|---|"
            for (i = 1; i <= NF; i++) { line = line " " $i " |"; rule = rule "--:|" } print line; print rule }; inside = 1; next }
        /meant to be 0/ { inside = 0 }
        inside { name = $1; for (i = 2; i <= NF - columns; i++) name = name " " $i
            if (!(name in seen)) { seen[name]; order[++count] = name }
            for (i = 1; i <= columns; i++) sum[name, i] += $(NF - columns + i) }
        END { for (k = 1; k <= count; k++) { line = "| " order[k] " |"
            for (i = 1; i <= columns; i++) { line = line " " sum[order[k], i] " |"; all[i] += sum[order[k], i] } print line }
            line = "| all |"; for (i = 1; i <= columns; i++) line = line " " all[i] " |"; print line }'
}
figures() {
    echo "<!-- Written by tests/campaign.sh. -->"
    echo
    echo "- $(date +%F), commit $(git describe --always --abbrev=10)"
    machine
    printf '\n## Fuzzing\n\nExecutions of the targets in `tests/fuzz`.\n\n'
    executions
    printf '\n## Torture\n\nRuns and what came of them. unreadable, broken and wrong are meant to be 0.\n\n'
    torture
    printf '\n## Thread sanitizer\n\nDemo, sweep and every kind of output: %s.\n\n' "$(tail -n 1 "$logs/tsan.log" 2>/dev/null)"
    echo "<!-- The end of the figures. -->"
}
write() {
    local page=tests/stress/RESULTS.md
    figures >"$logs/figures.md"
    sed -e "/^<!-- Written by/,/^<!-- The end/ { /^<!-- The end/ r $logs/figures.md
        d }" "$page" >"$logs/page.md" && cp "$logs/page.md" "$page"
}

[ "${2:-}" = figures ] || run
write
