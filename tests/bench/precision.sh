#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Work against error of our methods and of whatever else is installed, as a table and as a diagram:
#   precision.sh BUILD       writes BUILD/bench/work-precision.csv, .png and .pdf (errors of peaks), work-precision-velocities.png
#                            and .pdf (of velocities at an early time)
# BENCH_QUICK=1: seconds instead of minutes. BENCH_LIMIT: CPU seconds that one run may take (default 5).
set -e
programs=$1/tests/bench here=$(dirname "$0") out=$1/bench
table=$out/work-precision.csv
quick=''
limit=${BENCH_LIMIT:-5}
case ${BENCH_QUICK:-0} in 0) ;; *) quick=1 limit=${BENCH_LIMIT:-0.05} ;; esac
problems='P1 P2 P3 P4 500_beads'
mkdir -p "$out"
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

say() { echo "bench: $*" >&2; }
# Whether the last row took longer than one run may.
too_long() { awk -F, -v limit="$limit" '{cpu = $4} END {exit !(cpu > limit)}' "$work/row"; }
# sweep SOLVER SETTINGS COMMAND...: COMMAND FILE SETTING writes a stream; as long as there is time.
sweep() {
    solver=$1 settings=$2
    shift 2
    for p in $problems; do
        "$programs/precision_stream" --problem "$p" > "$work/problem"
        for setting in $settings; do
            "$@" "$work/problem" "$setting" 2> "$work/errors" | "$programs/precision_stream" "$p" "$solver" "$setting" \
                > "$work/row" || { say "$solver gave up on $p at $setting: $(tail -n 1 "$work/errors")"; break; }
            cat "$work/row"
            ! too_long || break
        done
    done
}
scipy() { "$python" "$here/precision_scipy.py" "$2" "$1" "$3"; }
boost() { "$work/boost" "$2" "$1" "$3"; }
thesis() { octave-cli --norc --quiet "$here/precision_thesis.m" "$1" "$2"; }

peers() {
    "$programs/precision_plain"
    "$programs/precision_gsl"
    "$programs/precision_sundials"
    python=''
    for p in python3 /usr/bin/python3; do
        if "$p" -c 'import scipy.integrate' 2> "$work/errors"; then python=$p && break; fi
    done
    if [ "$python" ]; then
        tolerances=${quick:+1e-4}
        for solver in DOP853 LSODA; do
            sweep "SciPy $solver" "${tolerances:-1e-3 1e-4 1e-5 1e-6 1e-7 1e-8 1e-9 1e-10 1e-11 1e-12}" scipy "$solver"
        done
    else
        say "SciPy is not installed and left out: python3-scipy would add it"
    fi
    if c++ -O3 -march=native -o "$work/boost" "$here/precision_boost.cc" 2> "$work/errors"; then
        steps=${quick:+2e-6} tolerances=${quick:+1e-4}
        sweep "Boost rkn_sb3a" "${steps:-4e-6 2e-6 1e-6 0.5e-6 0.25e-6 0.1e-6 0.05e-6 0.025e-6}" boost rkn_sb3a
        sweep "Boost rkf78" "${tolerances:-1e-3 1e-4 1e-5 1e-6 1e-7 1e-8 1e-9 1e-10 1e-11 1e-12}" boost rkf78
    else
        say "Boost.odeint is not installed (or no C++ compiler) and left out: g++ and libboost-dev would add it"
    fi
    if octave-cli --version > "$work/version" 2>&1; then
        steps=${quick:+0.8e-6}
        [ ! "$quick" ] || problems=P1
        # The thesis's own step first.
        sweep "thesis (Octave)" "${steps:-0.1e-6 0.2e-6 0.4e-6 0.8e-6}" thesis
    else
        say "GNU Octave is not installed and left out: octave would add it"
    fi
}

# The default's time for an error, and the fastest of all others.
summary() {
    awk -F, 'FNR > 1 && $4 > 0 {
        if (!($1 in seen)) { seen[$1] = 1; problem[++problems] = $1 }
        for (digits = 4; digits <= 12; digits += 2)
            if ($5 <= 10 ^ -digits) {
                which = $2 == "auto" ? "auto" : "other"
                key = $1 SUBSEP digits SUBSEP which
                if (!(key in best) || $4 < best[key]) { best[key] = $4; name[key] = $2 }
            }
    }
    END {
        printf "\nCPU ms of the default for an error of peaks, and of the fastest other solver\n"
        for (p = 1; p <= problems; p++)
            for (digits = 4; digits <= 12; digits += 2) {
                a = problem[p] SUBSEP digits SUBSEP "auto"; o = problem[p] SUBSEP digits SUBSEP "other"
                printf "%-10s 1e-%-2d %10s %10s %s\n", problem[p], digits, a in best ? sprintf("%.3f", 1e3 * best[a]) : "-",
                    o in best ? sprintf("%.3f", 1e3 * best[o]) : "-", name[o]
            }
    }' "$table"
}

echo problem,solver,setting,cpu_s,error_peaks,error_velocity,evaluations > "$table.part"
{
    "$programs/precision_ours"
    peers
    touch "$work/done"
} | tee -a "$table.part"
[ -e "$work/done" ]
mv "$table.part" "$table"
summary
"$programs/precision_diagram" "$table" "$out/work-precision"
"$programs/precision_diagram" "$table" "$out/work-precision-velocities" velocity
say "wrote $table, $out/work-precision.png and .pdf, work-precision-velocities.png and .pdf"
