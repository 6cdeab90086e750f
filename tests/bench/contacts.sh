#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# What kinks and patches contribute where contacts open and close, as tables: error, and where there is valgrind, instructions.
#   contacts.sh BUILD      the tables of sim/integrate/README.md
set -e
program=$1/tests/bench/contacts_ways
# instructions WHAT WAY STEP TOLERANCE: millions
instructions() {
    command -v valgrind > /dev/null || { echo -; return; }
    valgrind --tool=callgrind --callgrind-out-file=/dev/null "$program" "$@" alone 2>&1 | awk '/Collected/ {printf "%.1f\n", $NF / 1e6}'
}
# table WHAT TITLE WAY...
table() {
    what=$1 title=$2
    shift 2
    printf '\n%s\n\n| step, tolerance |' "$title"
    for way; do printf ' %s |' "$way"; done
    printf '\n|---|'
    for way; do printf -- '---|'; done
    echo
    for case in '7e-6 1e-6' '5e-6 1e-8' '3e-6 1e-10'; do
        step=${case% *} tolerance=${case#* }
        printf '| %s s, %s m/s |' "$step" "$tolerance"
        for way; do
            printf ' %s, %s M |' "$("$program" "$what" "$way" "$step" "$tolerance")" "$(instructions "$what" "$way" "$step" "$tolerance")"
        done
        echo
    done
}
table ends 'Peaks of 500 beads in random dimers: error, instructions' plain patches kinks-and-patches
table between 'Samples of a steel chain, four a step: error of velocities, instructions' interpolation kinks-and-patches
