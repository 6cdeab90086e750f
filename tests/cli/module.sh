#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# The Python module, and the notebook that uses it.
source "$(dirname "$0")/../shell.bash"
python=/usr/bin/python3
export PYTHONPATH=$top/assets/python BEADREEL=$beadreel
if ! "$python" -c 'import h5py, numpy' 2>/dev/null; then
    skip "python3-h5py" "the Python module"
    finish
fi
run "$python" "$top/tests/module.py" "$T"
relay

found() { # the program of the source tree that the module is in, without a variable
    mkdir -p "$T/tree/assets/python" "$T/tree/build" && cp -r "$top/assets/python/beadreel" "$T/tree/assets/python" &&
        ln -sf "$beadreel" "$T/tree/build/beadreel" &&
        [ "$(env -u BEADREEL PYTHONPATH="$T/tree/assets/python" "$python" -c 'from beadreel._program import program; print(program())')" = "$T/tree/build/beadreel" ]
}
ok "the module finds the program of its tree" found
there() { "$python" -c 'import importlib.util, sys; sys.exit(not all(map(importlib.util.find_spec, sys.argv[1:])))' "$@"; }
if there nbconvert ipykernel xarray; then
    cp "$top/assets/python/waves.ipynb" "$T"
    ok "the notebook runs" exits 0 env HOME="$T" "$python" -m nbconvert --to notebook --execute "$T/waves.ipynb" --output done.ipynb
    ok "... and shows a picture and a film" bash -c "grep -q 'data:image/png;base64' '$T/done.ipynb' && grep -q 'data:video/mp4' '$T/done.ipynb'"
else
    skip "jupyter-nbconvert, python3-ipykernel, python3-xarray" "the notebook runs"
fi
finish
