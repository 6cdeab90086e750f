#!/bin/sh
# Work against error of our methods and of whatever else is installed, as a table and as a diagram:
#   precision.sh BUILD       writes BUILD/bench/work-precision.csv, .png and .pdf
# BENCH_QUICK=1: seconds instead of minutes. BENCH_LIMIT: CPU seconds that one run may take (default 20).
set -e
programs=$1/tests/bench here=$(dirname "$0") out=$1/bench
table=$out/work-precision.csv
quick=''
limit=${BENCH_LIMIT:-20}
case ${BENCH_QUICK:-0} in 0) ;; *) quick=1 limit=${BENCH_LIMIT:-0.05} ;; esac
problems='P1 P2 P3 P4 500_beads'
mkdir -p "$out"
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

say() { echo "bench: $*" >&2; }
# Whether the last row took longer than one run may.
too_long() { awk -F, -v limit="$limit" '{cpu = $4} END {exit !(cpu > limit)}' "$work/row"; }
# sweep SOLVER SETTINGS COMMAND...: COMMAND FILE SETTING writes a stream; coarse to fine, as long as there is time.
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
thesis() { octave-cli --norc --quiet "$here/precision_thesis.m" "$1" "$2"; }

peers() {
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
    if octave-cli --version > "$work/version" 2>&1; then
        steps=${quick:+0.8e-6}
        [ ! "$quick" ] || problems=P1
        sweep "thesis (Octave)" "${steps:-0.8e-6 0.4e-6 0.2e-6 0.1e-6 0.05e-6}" thesis
    else
        say "GNU Octave is not installed and left out: octave would add it"
    fi
}

echo problem,solver,setting,cpu_s,error_peaks,error_velocity,evaluations > "$table.part"
{
    "$programs/precision_ours"
    peers
    touch "$work/done"
} | tee -a "$table.part"
[ -e "$work/done" ]
mv "$table.part" "$table"
"$programs/precision_diagram" "$table" "$out/work-precision"
say "wrote $table, $out/work-precision.png and .pdf"
