#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Line and branch coverage of sim and render by all tests: tests/coverage.sh BUILD [NAME...], a build with gcc's --coverage.
# With names, only these tests are run, and add to what others have reached before. The report stays as BUILD/coverage.txt; that of
# all tests also goes into tests/stress/RESULTS.md.
# Programs killed by SIGKILL write no counts; kernels compiled for several instruction sets count as one source.
set -u
cd "$(dirname "$0")/.." || exit 1
build=$1
shift
# gcov's own failures, where a test leaves it no descriptors or no disk, are not the program's messages.
export GCOV_ERROR_FILE=/dev/null
export TEST_TIMEOUT=${TEST_TIMEOUT:-3600}
page=()
if [ $# -eq 0 ]; then
    find "$build" -name '*.gcda' -delete
    tests/run.sh "$build" | tee "$build/tests.txt"
    # Starved of disk, file size and descriptors; under every signal. Killed programs count nothing.
    tests/torture/torture.sh "$build" 0 20 1 | tail -n 1
    page=(tests/stress/RESULTS.md "$(date +%F), commit $(git describe --always --abbrev=10), ${PART:+only part $PART of the tests, }$(tail -n 1 "$build/tests.txt").")
else
    tests/run.sh "$build" "$@"
fi
rm -rf "$build/coverage" && mkdir "$build/coverage"
find "$build/sim" "$build/render" -name '*.gcda' | while read -r object; do
    gcov --branch-probabilities --json-format --stdout "$object" >"$build/coverage/${object//\//-}.json" || exit 1
done || exit 1
python3 tests/coverage.py "$build/coverage" "${page[@]}" | tee "$build/coverage.txt"
exit "${PIPESTATUS[0]}"
