#!/bin/bash
# Run the fuzz targets of a build and count: tests/fuzz/run.sh BUILD SECONDS [TARGET...]
# What is new in coverage stays in BUILD/corpus/TARGET; the input of a fault in BUILD/faults, and stands in the output.
# Ends with a line for each target, its executions, and `N passed, M failed`.
set -u
cd "$(dirname "$0")/../.." || exit 1
build=$1 seconds=$2
shift 2
[ $# -gt 0 ] || set -- scene plan set trajectory sweep journal
export BEADREEL_ASSETS=$PWD/assets
passed=0 failed=0 lines=()
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
export TMPDIR=$work
# HDF5 1.10 itself leaks over damaged bytes; what the program leaves open in it is found by the targets.
{ cat tests/lsan.txt; echo leak:libhdf5; } >"$work/lsan.txt"
# Sizes in damaged files may be any: malloc refuses them as it does without sanitizers.
export ASAN_OPTIONS=allocator_may_return_null=1
export LSAN_OPTIONS="suppressions=$work/lsan.txt:print_suppressions=0" UBSAN_OPTIONS=print_stacktrace=1
mkdir -p "$build/faults"
tests/fuzz/seeds.sh "$build" "$build/seeds" || { echo "0 passed, 1 failed"; exit 1; }

for target; do
    mkdir -p "$build/corpus/$target"
    case $target in scene | plan | set) most=8192 ;; journal) most=16384 ;; *) most=400000 ;; esac
    # One seed of random numbers, so that a run can be repeated; slow is what takes a user's patience.
    "$build/fuzz/fuzz_$target" -seed="${FUZZ_SEED:-1}" -max_total_time="$seconds" -max_len=$most -timeout=20 -rss_limit_mb=4096 -print_final_stats=1 \
        -artifact_prefix="$build/faults/$target-" "$build/corpus/$target" "$build/seeds/$target" >"$work/log" 2>&1
    status=$?
    runs=$(sed -n 's/^stat::number_of_executed_units: *//p' "$work/log")
    if [ $status -eq 0 ] && [ "${runs:-0}" -gt 0 ]; then
        passed=$((passed + 1))
        verdict=ok
    else
        failed=$((failed + 1))
        verdict="FAILED, status $status"
        tail -n 60 "$work/log"
    fi
    lines+=("$(printf '%-12s %9s executions %7s a second  %s' "$target" "${runs:-?}" "$(sed -n 's/^stat::average_exec_per_sec: *//p' "$work/log")" "$verdict")")
done
printf '%s\n' "${lines[@]}"
echo "$passed passed, $failed failed"
[ "$failed" -eq 0 ]
