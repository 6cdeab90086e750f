#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Run all tests of a build and count them: tests/run.sh BUILD [NAME...]
# Unit tests are the programs BUILD/tests/test_* (from tests/ROOM/test_*.c), the others tests/*.sh and tests/cli/*.sh; each prints TAP.
# Ends with `N passed, M failed`, or `N passed, M failed, K skipped` where the machine lacks what some need; exit status 1 if any
# failed. JOBS=n runs n at a time. PART=quick leaves out the tests that tests/slow.txt names, PART=slow runs only these, and PART=short
# leaves out those that tests/long.txt names.
set -u
cd "$(dirname "$0")/.." || exit 1
build=$(realpath "${1:-build}")
shift
work=$(mktemp -d "${TMPDIR:-/tmp}/beadreel-tests.XXXXXX") || exit 1
trap 'rm -rf "$work"' EXIT
mkdir "$work/log" "$work/tmp"
export BUILD="$build" BEADREEL_ASSETS="$PWD/assets" TMPDIR="$work/tmp" CMOCKA_MESSAGE_OUTPUT=TAP
# Traps of undefined behaviour are reported. Blocks of thread-local memory are not looked for: the sanitizer takes the 16 bytes before one
# that begins 16 bytes into a page for glibc 2.19's header, and the check for leaks then crashed on what stood there.
export LSAN_OPTIONS="suppressions=$PWD/tests/lsan.txt:print_suppressions=0${LSAN_OPTIONS:+:$LSAN_OPTIONS}" UBSAN_OPTIONS="print_stacktrace=1"
export ASAN_OPTIONS="handle_sigill=1:intercept_tls_get_addr=0${ASAN_OPTIONS:+:$ASAN_OPTIONS}"

left_out() {
    case ${PART:-} in
    quick) grep -q "^$1 " tests/slow.txt ;;
    slow) ! grep -q "^$1 " tests/slow.txt ;;
    short) grep -q "^$1 " tests/long.txt ;;
    *) false ;;
    esac
}
names=()
for t in "$build"/tests/test_* tests/test_*.sh tests/cli/*.sh; do
    [ -f "$t" ] && [ -x "$t" ] || continue
    case "$t" in "$build"/tests/*.*) continue ;; esac
    name=$(basename "$t" .sh)
    # A program whose source is gone is left from an earlier build.
    case "$t" in *.sh) ;; *) compgen -G "tests/$name.c" >/dev/null || compgen -G "tests/*/$name.c" >/dev/null || continue ;; esac
    if [ $# -gt 0 ]; then [[ " $* " == *" $name "* ]] || continue; elif left_out "$name"; then continue; fi
    names+=("$t")
done

# Sanitizers give what they report names and lines only in a second run, of what has failed: for known leaks of libraries, too, they would
# ask a program for them that takes a second to start.
one() {
    log=$1/log/$(basename "$2") TIMEFORMAT='%R %U %S'
    { time ASAN_OPTIONS=$ASAN_OPTIONS:symbolize=0 timeout -k 10 "${TEST_TIMEOUT:-600}" "$2" >"$log.out" 2>"$log.err" </dev/null; } 2>"$log.times"
    local status=$?
    echo $status >"$log.status"
    if [ $status -ne 0 ] && grep -q 'Sanitizer:' "$log.err"; then timeout -k 10 "${TEST_TIMEOUT:-600}" "$2" >/dev/null 2>>"$log.err" </dev/null; fi
}
export -f one
# The long ones first: at the end nothing is left that one core works on alone.
first=() rest=()
for t in "${names[@]}"; do if grep -q "^$(basename "$t" .sh) " tests/long.txt 2>/dev/null; then first+=("$t"); else rest+=("$t"); fi; done
printf '%s\0' "${first[@]}" "${rest[@]}" | xargs -0 -r -P "${JOBS:-$(nproc)}" -I{} bash -c 'one "$1" "$2"' - "$work" {}

# What a log of TAP counts: passed, failed, skipped, planned; its skips for want of what ("# missing: WHAT" stands before each)
# are added to the file `missing`. cmocka says `not ok N # SKIP`, others `ok N ... # SKIP`. A skip that does not say why has failed.
count() {
    awk -v missing="$work/missing" '
        /^# missing: / { what = substr($0, 12) }
        /^(not )?ok .*# SKIP/ { if (what != "") { skipped++; print what >>missing } else failed++; what = ""; next }
        /^ok / { passed++; what = "" }
        /^not ok / { failed++; what = "" }
        /^1\.\.[0-9]/ { planned += substr($0, 4) }
        END { print passed + 0, failed + 0, skipped + 0, planned + 0 }' "$1"
}

passed=0 failed=0 skipped=0
for t in "${names[@]}"; do
    log=$work/log/$(basename "$t")
    status=$(cat "$log.status" 2>/dev/null || echo 99)
    read -r good bad left planned < <(count "$log.out")
    # A program that died, or said nothing of its failure, counts as one more.
    if [ "$bad" -eq 0 ] && { [ "$status" -ne 0 ] || [ $((good + left)) -lt "$planned" ] || [ $((good + left)) -eq 0 ]; }; then
        bad=1
        echo "not ok - ended with status $status after $((good + left)) of $planned tests" >>"$log.out"
    fi
    passed=$((passed + good)) failed=$((failed + bad)) skipped=$((skipped + left))
    printf '%-28s %4d passed %11s %12s %s\n' "$(basename "$t")" "$good" "$([ "$bad" -eq 0 ] || echo "$bad failed")" \
        "$([ "$left" -eq 0 ] || echo "$left skipped")" "$(awk '{printf "%6.1f s, %5.1f s of CPU", $1, $2 + $3}' "$log.times" 2>/dev/null)"
    if [ "$bad" -ne 0 ]; then
        grep -A 12 -E '^not ok |# SKIP' "$log.out" | sed 's/^/    /' | head -60
        tail -n 30 "$log.err" | sed 's/^/    | /'
    fi
done
if [ "$skipped" -gt 0 ]; then
    echo "Skipped, as this machine lacks:"
    sort "$work/missing" | uniq -c | sort -k1,1nr -k2
fi
echo "$passed passed, $failed failed$([ "$skipped" -eq 0 ] || echo ", $skipped skipped")"
[ "$failed" -eq 0 ] && [ $((passed + skipped)) -gt 0 ]
