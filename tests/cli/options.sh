#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# The command line: help, lists, near misses, wrong values.
source "$(dirname "$0")/../shell.bash"
mkdir "$T/here"
cd "$T/here" || exit 1

for program in beadreel beadsim; do
    p=$BUILD/$program
    ok "$program --help" exits 0 "$p" --help
    ok "$program --help fits a screen" test "$(wc -l <"$T/out")" -le 40
    ok "$program --help fits 132 columns" test "$(wc -L <"$T/out")" -le 132
    ok "$program --help has examples" prints "Example"
    ok "$program -h is --help" cmp <("$p" -h) <("$p" --help)
    ok "$program --version" exits 0 "$p" --version
    ok "$program --version names itself" prints "$program $(sed -n 's/^#define BEADREEL_VERSION "\(.*\)"/\1/p' "$top/include/beadreel/api.h")"
    ok "$program without arguments" fails 2 "$p"
    ok "$program without arguments points to --help" says --help
    ok "$program starts its error with its name" grep -q "^$program: " "$T/err"
    ok "$program stdout closed" fails 1 bash -c "'$p' --help >/dev/full"
done

for what in scenes materials methods laws equations keys colormaps codecs libraries views; do
    ok "--list $what" exits 0 "$beadreel" --list $what
    ok "--list $what has lines" test -s "$T/out"
    ok "--list $what is quiet on stderr" test ! -s "$T/err"
done
ok "materials: brass" bash -c "'$beadreel' --list materials | grep -q '^brass'"
ok "scenes: clean-vs-delocalised" bash -c "'$beadreel' --list scenes | grep -q '^clean-vs-delocalised'"
ok "methods: rkn8" bash -c "'$beadreel' --list methods | grep -q '^rkn8'"
ok "laws: thesis-appendix" bash -c "'$beadreel' --list laws | grep -q '^thesis-appendix'"
ok "colormaps: viridis" bash -c "'$beadreel' --list colormaps | grep -q '^viridis'"
ok "codecs: mp4" bash -c "'$beadreel' --list codecs | grep -q '^mp4'"
ok "beadsim lists no codecs" fails 2 "$beadsim" --list codecs
# listed : every library that a movie with beads opens is in the list, and some are opened. (libasan opens for the program.)
listed() {
    local opened
    opened=$(LD_DEBUG=files "$beadreel" clean-vs-delocalised --only waves.mp4 --set outputs.0.duration='0.05 s' -o "$T/movie" 2>&1 >/dev/null |
        sed -n 's/.*file=\(lib[^ ]*\) .*dynamically loaded by [^ ]*\(beadreel\|libasan\)[^ ]* .*/\1/p')
    [ "$(echo "$opened" | grep -c libav)" -eq 3 ] || { echo "opened: $opened"; return 1; }
    echo "$opened" | while read -r library; do "$beadreel" --list libraries | grep -q "^${library%.so*}.so" || { echo "$library"; return 1; }; done
}
ok "libraries: those that a movie opens" listed

# near_miss EXPECTED ARGUMENT... : exit 2, one line that suggests.
near_miss() {
    local expected=$1
    shift
    fails 2 "$beadreel" "$@" && says "did you mean \`$expected\`"
}

for part in scene chain simulate sweep trajectory image movie plot table sheet captions panels fput power pulse; do
    ok "--list keys $part" exits 0 "$beadsim" --list keys $part
    ok "--list keys $part is a part of --list keys" bash -c "[ -s '$T/out' ] && ! grep -vxFf <('$beadsim' --list keys) '$T/out' | grep -q ."
done
ok "--list keys movie names its keys" bash -c "'$beadreel' --list keys movie | grep -q '^  duration '"
ok "--list keys movie has no keys of tables" bash -c "! '$beadreel' --list keys movie | grep -q '^  show '"
ok "--list keys chain has its striker" bash -c "'$beadreel' --list keys chain | grep -q '^chain.striker: '"
ok "strain is a field to store" bash -c "'$beadreel' --list keys trajectory | grep -q 'energy, strain'"
ok "--list keys moovie" near_miss movie --list keys moovie
ok "unknown long option" near_miss --threads --thraeds 2 scene.yaml
ok "unknown long option with a value" near_miss --progress --progres5=plain scene.yaml
ok "unknown long option far from all" fails 2 "$beadreel" --frobnicate scene.yaml
ok "... says so" says '`--frobnicate`'
for key in contacts:outputs.N dpi:outputs.N velocity:chain.striker until:simulate; do
    ok "a key as an option, ${key%:*}" fails 2 "$beadreel" clean-vs-delocalised "--${key%:*}" 3
    ok "... is set by its path" says "unknown option \`--${key%:*}\`; it is a key of scenes: --set ${key#*:}.${key%:*}=VALUE"
done
ok "unknown short option" fails 2 "$beadreel" -x scene.yaml
ok "... says so" says '`-x`'
ok "missing value" fails 2 "$beadreel" clean-vs-delocalised --set
ok "... says so" says "--set: needs a value"
ok "empty value" fails 2 "$beadreel" clean-vs-delocalised --frame ""
ok "... says so" says "--frame: MOMENT is empty"
ok "beadsim draws no frame" fails 2 "$beadsim" clean-vs-delocalised --frame peak
ok "... says so" says "--frame: beadsim does not draw"
ok "missing value of a short option" fails 2 "$beadreel" clean-vs-delocalised -o
ok "value where none belongs" fails 2 "$beadreel" --plan=yes clean-vs-delocalised
ok "unknown list" near_miss colormaps --list colourmaps
ok "unknown progress" near_miss json --progress=jsn clean-vs-delocalised
ok "unknown instructions" near_miss avx2 --instructions=avx3 clean-vs-delocalised
for threads in -1 two 1.5 99999999999999999999 ''; do
    ok "--threads '$threads'" fails 2 "$beadreel" "--threads=$threads" clean-vs-delocalised
done
ok "--set without =" fails 2 "$beadreel" clean-vs-delocalised --set simulate.step
ok "--set with an empty key" fails 2 "$beadreel" clean-vs-delocalised --set =1
ok "--set of an unknown key" fails 2 "$beadreel" clean-vs-delocalised --set simulate.stpe=1us
ok "... names it" says stpe
ok "--set with a wrong unit" fails 2 "$beadreel" clean-vs-delocalised --set simulate.until=3kg
ok "--only of no output" fails 2 "$beadreel" clean-vs-delocalised --only nothing.png
ok "... names it" says nothing.png
ok "two scenes" fails 2 "$beadreel" "$top/assets/scenes/kdv.yaml" "$top/assets/scenes/fput.yaml"
ok "... are one too many" says "one file at a time"
ok "files that are not there" fails 1 "$beadreel" one.yaml two.yaml
ok "... are named" says "one.yaml: cannot be read"
ok "a ready scene nearly named" fails 2 "$beadreel" clean-vs-delocalized
ok "... suggests" says clean-vs-delocalised
ok "--info of a ready scene" exits 0 "$beadreel" --info clean-vs-delocalised
ok "--info says M" prints "M = "
ok "--info says what beads there are" prints "64 beads of aluminium: radius 4.76 mm, mass 1.26 g, modulus 72.4 GPa, Poisson 0.33"
printf 'chain: {beads: [{bead: brass, radius: 2 mm, count: 9}], start: [{bead: 7, velocity: -1 m/s}]}\nsimulate: {until: 1 ms}\noutputs: [{table: t.csv}]\n' >"$T/tiny.yaml"
ok "--info of a chain with other radii" exits 0 "$beadreel" --info "$T/tiny.yaml"
ok "... says so" prints "9 beads of brass: radius 2 mm, mass"
ok "... and what moves" prints "bead 7 starts at -1 m/s"
ok "--plan of a ready scene" exits 0 "$beadreel" --plan clean-vs-delocalised
ok "--plan prints lines" test -s "$T/out"
ok "--plan of an equation has times without unit" bash -c "'$beadreel' --plan fput | grep -q 'pixels, every [0-9.]*$'"
ok "nothing was written" empty "$T/here"

# What the shell would offer for the last of some words.
offers() {
    (source "$top/assets/completions/beadreel.bash"
    COMP_WORDS=("$@") COMP_CWORD=$(($# - 1)) COMPREPLY=()
    _beadreel
    printf '%s\n' "${COMPREPLY[@]}")
}
completion_knows() {
    local program option
    for program in "$beadreel" "$beadsim"; do
        "$program" --help | grep -oE -- '^ +(-[a-zA-Z], )?--[a-z-]+' | tr -d ', ' | sed 's/^\(-[a-zA-Z]\)--/\1\n--/' | while read -r option; do
            offers "$program" - | grep -qx -- "$option" || { echo "$program $option"; return 1; }
        done || return 1
    done
}
ok "the completion knows every option" completion_knows
completion_lists() { # what bash offers behind `--list t`
    local offered
    offered=$(bash -c "source '$top/assets/completions/beadreel.bash'
        COMP_WORDS=('$beadreel' --list t) COMP_CWORD=2; _beadreel '$beadreel' t --list; echo \"\${COMPREPLY[*]}\"")
    [ "$offered" = thresholds ] || { echo "'$offered'"; return 1; }
}
ok "... and what can be listed" completion_lists
listed() { "$beadreel" --list nothing 2>&1 | sed 's/.*allowed: \(.*\))$/\1/' | tr -d ',' | tr ' ' '\n'; }
ok "... every list" diff <(offers "$beadreel" --list '' | sort) <(listed | sort)
ok "... values behind =" test "$(offers "$beadsim" --progress=pl)" = --progress=plain
ok "... scenes" bash -c "grep -qx kdv <<<'$(offers "$beadreel" kd)'"
ok "... that beadsim does not draw" test -z "$(offers "$beadsim" --canvas '' | grep osmesa)"
printf '%s\n' 'chain: {striker: {velocity: 0.1}, beads: [{bead: brass, count: 4}]}' 'outputs: [{table: p.csv}]' >"$T/quiet.yaml"
ok "progress in JSON" eval '"$beadsim" "$T/quiet.yaml" -o "$T/quiet" --progress json >"$T/out" 2>"$T/err" && grep -q "^{\"what\"" "$T/err"'
ok "... none with --quiet behind it" eval '"$beadsim" "$T/quiet.yaml" -o "$T/quiet" --progress json -q >"$T/out" 2>"$T/err" && test ! -s "$T/err"'
ok "-o - is the file on standard output" eval '"$beadsim" "$T/quiet.yaml" -o - -q | cmp - "$T/quiet/p.csv"'
finish
