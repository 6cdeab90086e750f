#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Every word of the house's tables has a test with a number known from elsewhere: truths.txt names it.
source "$(dirname "$0")/shell.bash"
cd "$top" || exit 1

# KIND|WORD of everything that the programs can show, measure, compute and draw.
words() {
    "$beadreel" --list schema | python3 -c '
import json, sys
parts = json.load(sys.stdin)["definitions"]
for name, part in parts.items():
    if name.startswith("outputs:") and "enum" in part.get("properties", {}).get("show", {}):
        for word in part["properties"]["show"]["enum"]:
            print(name[8:].replace("-", " ") + "|" + word)
    if name.startswith("chain.start:"):
        print("excitation|" + name[12:])
    if name in ("chain.striker", "chain.starts"):
        print("excitation|" + name)
for word in parts["outputs:image"]["properties"]["field"]["enum"]:
    print("field|" + word)'
    for kind in measure law equation view; do
        "$beadreel" --list "${kind}s" | sed -n 's/^\([^ ].*\)$/\1/p' | sed 's/  .*//' | sed "s/^/$kind|/"
    done
}
words >"$T/words"
sed -n 's/^\([^#|][^|]*[^ |]\) *| *\([^|]*[^ |]\) *|.*/\1|\2/p' tests/truths.txt >"$T/rows"
ok "there are words" test "$(wc -l <"$T/words")" -gt 90
each() { # LIST OTHER : those of LIST that OTHER has not
    grep -vxFf "$2" "$1" | sed 's/^/tests\/truths.txt and the tables differ in: /'
}
ok "each has its test" eval '[ -z "$(each "$T/words" "$T/rows")" ] || { each "$T/words" "$T/rows"; false; }'
ok "none is of a word that is gone" eval '[ -z "$(each "$T/rows" "$T/words")" ] || { each "$T/rows" "$T/words"; false; }'
ok "each row is there once" eval '[ -z "$(sort "$T/rows" | uniq -d)" ] || { sort "$T/rows" | uniq -d; false; }'

# The test that a row names is one of the suite's, and no hash or golden picture.
there() {
    local file=$1 name=$2
    case $file in
    bits.sh | test_golden.c) return 1 ;;
    *.c) grep -qE "cmocka_unit_test[a-z_]*\(${name}[,)]|[A-Z]+\(${name}\)" tests/*/"$file" ;;
    *.sh) grep -qF "ok \"$name\"" tests/cli/"$file" ;;
    *.py) grep -q "^def $name(" tests/"$file" ;;
    esac
}
all_there() {
    local bad=0 file name from
    while IFS='|' read -r _ _ test from; do
        file=$(echo "${test%%:*}" | xargs) name=${test#*: }
        name=${name% }
        there "$file" "$name" && [ -n "${from# }" ] || { echo "no such test, or no reason: $test"; bad=1; }
    done < <(grep '^[^#]' tests/truths.txt)
    return $bad
}
ok "each names a test that there is, and its number" all_there
missing() { ! there test_measure.c none_such && ! there bits.sh "anything"; }
ok "a test that is not there is noticed" missing
finish
