#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Completion in bash, zsh and fish, as typed on a terminal: options, their values, scenes and files, all as the programs name them.
source "$(dirname "$0")/../shell.bash"
scripts=$top/assets/completions
export PATH=$BUILD:$PATH
mkdir "$T/here" && cd "$T/here" && touch 'my scene.yaml' notes.txt run.h5 || exit 1

# What is typed, and what stands there after TAB. Each shell has one terminal for all of them.
cases=(
    'an option' 'beadreel --canv' 'beadreel --canvas'
    'a value behind =' 'beadreel --canvas=p' 'beadreel --canvas=plain'
    'a choice stays open, its option written once' 'beadreel --canvas=' 'beadreel --canvas='
    'a list' 'beadsim --list=mea' 'beadsim --list=measures'
    'a value behind a blank' 'beadreel --progress js' 'beadreel --progress json'
    'no option that beadsim has not' 'beadsim --canv' 'beadsim --canv'
    'a ready scene' 'beadreel clean-v' 'beadreel clean-vs-delocalised'
    'a scene file, its blank kept' 'beadreel my' 'beadreel my scene.yaml'
    'any file behind an option that takes one' 'beadreel --info no' 'beadreel --info notes.txt'
    'any file behind =' 'beadreel --output=no' 'beadreel --output=notes.txt'
    'nothing where nothing is known' 'beadreel --set a=' 'beadreel --set a='
    'a colour map' 'beadreel --colormap vir' 'beadreel --colormap viridis'
    'a style behind =' 'beadreel --style=sl' 'beadreel --style=slide'
    'a field' 'beadreel --field contact-f' 'beadreel --field contact-force'
    'a view' 'beadreel --views spacet' 'beadreel --views spacetime'
    'a part of --list keys' 'beadsim --list keys mov' 'beadsim --list keys movie'
)
completed() { # SHELL : $T/made has a line for each case
    local script=$scripts/beadreel.$1 lines=() i
    [ "$1" != zsh ] || script=$scripts/_beadreel
    for ((i = 1; i < ${#cases[@]}; i += 3)); do lines+=("${cases[i]}"); done
    timeout 120 "$top/tests/complete.py" "$1" "$script" "${lines[@]}" >"$T/made"
}
is_line() { # NUMBER LINE
    local made
    made=$(sed -n "$1p" "$T/made")
    [ "$made" = "$2" ] || { echo "'$made' is not '$2'"; return 1; }
}
for shell in bash zsh fish; do
    if ! command -v $shell >/dev/null || ! command -v python3 >/dev/null; then
        skip "$shell, python3" "$shell completes what is typed"
        continue
    fi
    if ! python3 -c 'import pty; pty.openpty()' 2>/dev/null; then
        skip "a terminal (/dev/pts)" "$shell completes what is typed"
        continue
    fi
    ok "$shell completes what is typed" completed $shell
    for ((i = 0; i < ${#cases[@]}; i += 3)); do ok "$shell: ${cases[i]}" is_line $((i / 3 + 1)) "${cases[i + 2]}"; done
done

# fish says what it knows of all options at once, with their help.
fish_knows() {
    local program
    for program in beadreel beadsim; do
        fish --no-config -c "source $scripts/beadreel.fish; complete -C '$program --'" | cut -f 1 | sort >"$T/known"
        $program --help=words | cut -d' ' -f 1 | sort | diff - "$T/known" || return 1
    done
}
command -v fish >/dev/null && ok "fish: every option" fish_knows
# The words themselves: each option of --help, with its help.
words_are_options() {
    local program
    for program in beadreel beadsim; do
        $program --help=words | cut -d' ' -f 1 | sort >"$T/words"
        $program --help | sed '/^Examples:/q' | grep -oE -- '--[a-z][a-z-]+' | sort -u | diff - "$T/words" || return 1
    done
    ! "$beadreel" --help=words | grep -vP '^--[a-z-]+ (-[a-zA-Z]|\.\.) [^\t]+\t[^\t]+$'
}
ok "--help=words has every option and its help" words_are_options
finish
