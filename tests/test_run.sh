#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# tests/run.sh: what it counts as passed, failed and skipped, and what it says is missing.
source "$(dirname "$0")/shell.bash"
mkdir -p "$T/tests/cli" "$T/build/tests"
cp "$top/tests/run.sh" "$T/tests"
# program NAME <<TEXT : a test program of which a source is there
program() {
    { echo '#!/bin/sh'; cat; } >"$T/build/tests/$1"
    chmod +x "$T/build/tests/$1"
    touch "$T/tests/$1.c"
}
program test_good <<'SH'
printf '1..2\nok 1 - a\nok 2 - b\n'
SH
program test_bad <<'SH'
printf '1..2\nok 1 - a\nnot ok 2 - b\n# why\n'
exit 1
SH
program test_dies <<'SH'
printf '1..3\nok 1 - a\n'
kill -SEGV $$
SH
program test_stops <<'SH'
printf '1..3\nok 1 - a\nok 2 - b\n'
SH
program test_silent <<'SH'
exit 0
SH
# As cmocka 1.1 and 2 say it, and as other programs do.
program test_skips <<'SH'
printf '1..3\n# missing: a pump\nnot ok 1 # SKIP a\n# missing: a pump\nok 2 - b # SKIP\n# missing: a valve\nok 3 - c # SKIP\n'
SH
program test_skips_one <<'SH'
printf '1..2\nok 1 - a\n# missing: a valve\nok 2 - b # SKIP\n'
SH
program test_excuse <<'SH'
printf '1..3\nok 1 - a\n# missing: a pump\nok 2 - b # SKIP\nok 3 - c # SKIP\n'
SH
printf '#!/bin/sh\necho "ok 1 - a"\n' >"$T/tests/cli/shell.sh"
chmod +x "$T/tests/cli/shell.sh"
cp "$T/build/tests/test_bad" "$T/build/tests/test_left" # its source is gone

# ends STATUS LINE NAME... : run.sh on tests by name
ends() {
    local status=$1 line=$2
    shift 2
    exits "$status" "$T/tests/run.sh" "$T/build" "$@" || return 1
    [ "$(tail -n 1 "$T/out")" = "$line" ] || { cat "$T/out"; return 1; }
}
ok "passed tests are counted" ends 0 "3 passed, 0 failed" test_good shell
ok "so are failed ones" ends 1 "3 passed, 1 failed" test_good test_bad
ok "... and shown" prints "not ok 2 - b"
ok "a program that dies has failed" ends 1 "1 passed, 1 failed" test_dies
ok "... with its status" prints "ended with status"
ok "so has one that stops early" ends 1 "2 passed, 1 failed" test_stops
ok "... and one that says nothing" ends 1 "0 passed, 1 failed" test_silent
ok "skipped is neither passed nor failed" ends 0 "3 passed, 0 failed, 4 skipped" test_good test_skips test_skips_one
listed() { sed -n '/^Skipped, as this machine lacks:$/,$p' "$T/out" | grep -qE "^ +$1 $2\$" || { cat "$T/out"; return 1; }; }
ok "... and what is missing is named" listed 2 "a pump"
ok "... with how many tests want it" listed 2 "a valve"
ok "nothing but skipped is no failure" ends 0 "0 passed, 0 failed, 3 skipped" test_skips
ok "a skip that names nothing missing is one" ends 1 "1 passed, 1 failed, 1 skipped" test_excuse
ok "no test at all is a failure" ends 1 "0 passed, 0 failed" test_unknown
ok "all of a folder, but for what has no source" ends 1 "9 passed, 5 failed, 5 skipped"
printf 'test_bad slow\ntest_dies slower\n' >"$T/tests/long.txt"
part() { PART=$1 ends "${@:2}"; }
ok "... and all but the long ones" part short 1 "7 passed, 3 failed, 5 skipped"
ok "... which are run by name" part short 1 "1 passed, 1 failed" test_bad
mv "$T/tests/long.txt" "$T/tests/slow.txt"
ok "... and all but the slow ones" part quick 1 "7 passed, 3 failed, 5 skipped"
ok "... and these alone" part slow 1 "2 passed, 2 failed"
program test_reports <<'SH'
printf '1..1\nnot ok 1 - a\n'
case $ASAN_OPTIONS in *symbolize=0*) echo 'Sanitizer: 0x1' >&2 ;; *) echo '#0 main' >&2 ;; esac
exit 1
SH
reports() { ASAN_OPTIONS='' ends 1 "0 passed, 1 failed" test_reports && prints "Sanitizer: 0x1" && prints "#0 main"; }
ok "what a sanitizer reports is shown with its names, too" reports
# Names in the list are names of tests.
all_are_tests() {
    local name rest
    while read -r name rest; do
        [ -e "$top/tests/$name.sh" ] || [ -e "$top/tests/cli/$name.sh" ] || compgen -G "$top/tests/*/$name.c" >/dev/null || { echo "$name"; return 1; }
    done < <(grep -v '^#' "$top/tests/$1.txt")
}
ok "tests/long.txt names tests" all_are_tests long
ok "so does tests/slow.txt" all_are_tests slow
finish
