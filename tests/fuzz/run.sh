#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Run the fuzz targets of a build and count: tests/fuzz/run.sh BUILD SECONDS RUNS [TARGET...]
# Each target is run for SECONDS, or RUNS executions where that is shorter; -1: any number. JOBS=n runs n side by side.
# What is new in coverage stays in BUILD/corpus/TARGET; the input of a fault in BUILD/faults, and stands in the output; each run adds a
# line to BUILD/runs.txt: target, executions, seconds of processor time, exit status (or `hdf5`), date, commit.
# Ends with a line for each target, its executions, and `N passed, M failed`.
set -u
cd "$(dirname "$0")/../.." || exit 1
build=$1 seconds=$2 runs=$3
shift 3
[ $# -gt 0 ] || set -- scene plan set config command trajectory sweep merge journal origin
passed=0 failed=0 lines=()
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
# What every scene reads is kept small, or it would be what is mostly run: the materials of the seeds, few units.
mkdir "$work/assets"
ln -s "$PWD"/assets/* "$work/assets"
rm "$work/assets/materials.yaml"
grep -E '^(large-steel|small-steel|aluminium|ptfe|brass):' assets/materials.yaml >"$work/assets/materials.yaml" || exit 1
export BEADREEL_ASSETS=$work/assets UDUNITS2_XML_PATH=$PWD/tests/fuzz/units.xml
# HDF5 1.10 itself leaks over damaged bytes; what the program leaves open in it is found by the targets.
{ cat tests/lsan.txt; echo leak:libhdf5; } >"$work/lsan.txt"
# Sizes in damaged files may be any: malloc refuses them as it does without sanitizers.
# What is freed waits in a small queue, and its stacks are short: both take much of the time.
export ASAN_OPTIONS=allocator_may_return_null=1:quarantine_size_mb=1:thread_local_quarantine_size_kb=64:malloc_context_size=${FUZZ_STACK:-6}
export LSAN_OPTIONS="suppressions=$work/lsan.txt:print_suppressions=0" UBSAN_OPTIONS=print_stacktrace=1
mkdir -p "$build/faults"
tests/fuzz/seeds.sh "$build" "$build/seeds" || { echo "0 passed, 1 failed"; exit 1; }
export FUZZ_PART=$build/seeds/sweep.2of2.h5

# HDF5 1.10 itself reads beyond its memory over some damaged files (in H5Aexists, for one), which no caller can prevent: where that ends a
# target, the verdict says so. A report counts as HDF5's if its library stands above all of the project's code.
within_hdf5() {
    awk '/ERROR: AddressSanitizer/ { on = 1 } on && /^ *#[0-9]/ { if (/libhdf5/) { hdf5 = 1; exit } if (/ in .*(sim|render|tests)\//) exit }
         END { exit !hdf5 }' "$1"
}

# fuzz TARGET : leaves log, time and status in a directory of its own.
fuzz() {
    local target=$1 most TIMEFORMAT='%U %S'
    mkdir -p "$build/corpus/$target" "$work/$target/tmp"
    case $target in scene | plan | set | config | command) most=4096 ;; journal) most=16384 ;; *) most=400000 ;; esac
    # One seed of random numbers, so that a run can be repeated; slow is what takes a user's patience, threefold for a busy machine.
    { time TMPDIR=$work/$target/tmp "$build/fuzz/fuzz_$target" -seed="${FUZZ_SEED:-1}" -max_total_time="$seconds" -runs="$runs" -max_len=$most \
        -detect_leaks=0 -entropic=0 -timeout=60 -rss_limit_mb=4096 -print_final_stats=1 -artifact_prefix="$build/faults/$target-" \
        "$build/corpus/$target" "$build/seeds/$target" >"$work/$target/log" 2>&1; } 2>"$work/$target/time"
    echo $? >"$work/$target/status"
}
for target; do
    while [ "$(jobs -pr | wc -l)" -ge "${JOBS:-$(nproc)}" ]; do wait -n; done
    fuzz "$target" &
done
wait

for target; do
    log=$work/$target/log
    status=$(cat "$work/$target/status")
    executed=$(sed -n 's/^stat::number_of_executed_units: *//p' "$log")
    if [ "$status" -eq 0 ] && [ "${executed:-0}" -gt 0 ]; then
        passed=$((passed + 1))
        verdict=ok
    elif within_hdf5 "$log"; then
        passed=$((passed + 1))
        verdict="ok, ended by a fault within libhdf5"
        status=hdf5
    else
        failed=$((failed + 1))
        verdict="FAILED, status $status"
        tail -n 60 "$log"
    fi
    echo "$target ${executed:-0} $(awk '{printf "%.0f", $1 + $2}' "$work/$target/time") $status $(date +%F) $(git describe --always --abbrev=10)" >>"$build/runs.txt"
    lines+=("$(printf '%-12s %9s executions %7s a second  %s' "$target" "${executed:-?}" "$(sed -n 's/^stat::average_exec_per_sec: *//p' "$log")" "$verdict")")
done
printf '%s\n' "${lines[@]}"
echo "$passed passed, $failed failed"
[ "$failed" -eq 0 ]
