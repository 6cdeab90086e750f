#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Check that other programs' readers open trajectories and read the right numbers: readers.py [python] FILE...

h5py is needed; MDAnalysis, xarray (with h5netcdf), silx, Octave, jsfive, h5wasm and VTK's XDMF reader are tried where they are
installed; a FILE behind the word `python` by those in Python only. Prints TAP.
"""
import os
import shutil
import subprocess
import sys

import h5py
import numpy as np

import tap
from tap import finish, ok, skip


def has(module):
    try:
        __import__(module)
    except ImportError:
        return False
    return True


def elements(group):
    """Time-dependent elements of a group by name."""
    return {name: item for name, item in group.items() if isinstance(item, h5py.Group) and "value" in item}


def check_h5md(file):
    ok(list(file["h5md"].attrs["version"]) == [1, 1], "H5MD 1.1")
    ok("name" in file["h5md/author"].attrs and "version" in file["h5md/creator"].attrs, "author and creator")
    ok(list(file["particles"]) == ["chain"], "one particles group")
    chain = file["particles/chain"]
    ok(chain["box"].attrs["dimension"] == 3 and list(chain["box"].attrs["boundary"]) == [b"none"] * 3, "box without boundaries")
    beads = len(chain["id"])
    ok(len(set(chain["id"][:])) == beads and chain["species"].dtype.kind == "i", "ids are unique, species are integers")
    ok((chain["mass"][:] > 0).all() and (chain["radius"][:] > 0).all(), "masses and radii")
    for name, element in elements(chain).items():
        value, time = element["value"], element["time"][:]
        ok(value.dtype == np.float64 and value.shape[:2] == (len(time), beads) and "units" in value.attrs
           and (value.ndim == 2 or value.shape[2] == 3), f"{name}: shape, type and units")
        ok(len(element["step"]) == len(time) and (np.diff(time) > 0).all(), f"{name}: step and time")
        ok(np.isfinite(value[:]).all(), f"{name}: finite")
    if "position" in chain:
        moved = chain["position/value"][:, :, 0] - chain["displacement/value"][:]
        ok(np.allclose(moved, chain["rest_position"][:], rtol=1e-14, atol=1e-15), "position is rest position and displacement")
        ok((chain["position/value"][:, :, 2] == 0).all(), "z is 0")
    if "velocity" in chain and "displacement" in chain and len(chain["velocity/time"]) > 2:
        # The trapezoidal rule within what velocities change from sample to sample.
        dt = np.diff(chain["velocity/time"][:])[:, None]
        v, u = chain["velocity/value"][:, :, 0], chain["displacement/value"][:]
        miss = np.abs(np.diff(u, axis=0) - dt * (v[1:] + v[:-1]) / 2)
        ok((miss <= 0.5 * dt * np.abs(np.diff(v, axis=0)) + 0.05 * np.abs(v).max() * dt).all(), "velocity is the rate of displacement")
    vmd = file["parameters/vmd_structure"]
    ok(sorted(vmd["indexOfSpecies"][:]) == sorted(set(chain["species"][:])), "VMD: one row for every species there is")
    radius = dict(zip(vmd["indexOfSpecies"][:], vmd["radius"][:]))
    ok(all(radius[s] == r for s, r in zip(chain["species"][:], chain["radius"][:])), "VMD: radii")
    about = file["parameters/beadreel"]
    ok(b"chain" in about["scene"][()] and about.attrs["complete"] in (0, 1), "the scene is stored")


def check_texts(file):
    """Texts are marked as what they are: Octave's `load` stops at the first that is UTF-8."""
    wrong = []

    def look(name, item):
        places = [(item, attribute) for attribute in item.attrs]
        types = [(name, item.id.get_type())] if isinstance(item, h5py.Dataset) else []
        types += [(f"{name}@{attribute}", h5py.h5a.open(item.id, attribute.encode()).get_type()) for item, attribute in places]
        for where, kind in types:
            if isinstance(kind, h5py.h5t.TypeStringID):
                parent, _, attribute = where.partition("@")
                value = file[parent].attrs[attribute] if attribute else file[parent][()]
                raw = np.asarray(value).tobytes()
                if (kind.get_cset() == h5py.h5t.CSET_ASCII) != all(byte < 128 for byte in raw):
                    wrong.append(where)

    file.visititems(look)
    ok(not wrong, "texts are ASCII where they can be" + "".join(" " + name for name in wrong[:3]))


def default_plot(file):
    """The group that NeXus shows first."""
    group = file
    while "default" in group.attrs:
        group = group[group.attrs["default"]]
    return group


def check_nexus(file):
    plot = default_plot(file)
    value = plot[plot.attrs["signal"]]
    axes = [axis.decode() for axis in plot.attrs["axes"]]
    several = len(file["parameters/beadreel/chains/beads"]) > 1
    ok(plot.attrs["NX_class"] == b"NXdata" and len(axes) == value.ndim and value.ndim > 1, f"NeXus: the default plot is {plot.name}")
    ok(axes[0] == "time" and (axes[1] == ".") == several
       and all(axis == "." or len(plot[axis]) == value.shape[i] for i, axis in enumerate(axes)), "NeXus: its axes")
    if not has("silx"):
        skip("silx (python3-silx)", "silx")
        return
    from silx.io import nxdata

    shown = nxdata.get_default(file)
    ok(shown is not None and shown.is_valid and shown.signal.name == value.name and shown.axes_names[0] == "time", "silx: the plot")


SERIES = ("time", "particles/chain/bead_force/value", "particles/chain/displacement/value", "particles/chain/position/value",
          "particles/chain/velocity/value", "particles/chain/force/value")


def same_values(line, dataset):
    """Is the line of a probe, a count and some values, what h5py reads?"""
    count, *some = line.split()
    values = dataset[()].ravel()
    return int(count) == len(values) and np.array_equal(np.array(some, float), values[np.arange(1000) * (len(values) - 1) // 999])


def check_probe(name, missing, command, path, file):
    """A reader in another language; None as command: it is not there."""
    if command is None:
        skip(missing, name)
        return
    here = [series for series in SERIES if series in file]
    done = subprocess.run([*command, path, *here], capture_output=True, text=True)
    lines = done.stdout.splitlines()
    if done.returncode or len(lines) != len(here):
        print("#", *done.stderr.splitlines()[:3])
    ok(len(lines) == len(here) and all(same_values(line, file[series]) for line, series in zip(lines, here)),
       f"{name}: the same numbers")


def check_probes(path, file):
    tests = os.path.dirname(os.path.abspath(__file__))
    for library in ("jsfive", "h5wasm"):
        there = shutil.which("node") and os.path.isdir(os.path.join(os.environ.get("NODE_PATH", ""), library))
        check_probe(library, f"{library} (nodejs, and npm for make deps-ci)",
                    ["node", "--no-warnings", tests + "/probe.js", library] if there else None, path, file)
    octave = shutil.which("octave-cli")
    check_probe("Octave", "Octave (octave)", [octave, "-qf", tests + "/probe.m"] if octave else None, path, file)


def check_xdmf(path, file):
    """The file beside a trajectory, by VTK's reader, which is ParaView's."""
    path = os.path.splitext(path)[0] + ".xdmf"
    if not os.path.exists(path):
        return
    if not has("vtkmodules.vtkIOXdmf2"):
        skip("VTK with its XDMF reader (python3-paraview)", "XDMF")
        return
    from vtkmodules.util.numpy_support import vtk_to_numpy
    from vtkmodules.vtkCommonExecutionModel import vtkStreamingDemandDrivenPipeline
    from vtkmodules.vtkIOXdmf2 import vtkXdmfReader

    chain = file["particles/chain"]
    reader = vtkXdmfReader()
    reader.SetFileName(path)
    reader.UpdateInformation()
    times = reader.GetOutputInformation(0).Get(vtkStreamingDemandDrivenPipeline.TIME_STEPS())
    ok(np.array_equal(times, file["time"][:]), "XDMF: the times")
    good, seen = True, set()
    for i in (0, len(times) // 4, len(times) - 1):
        reader.UpdateTimeStep(times[i])
        grid = reader.GetOutputDataObject(0)
        while grid.IsA("vtkMultiBlockDataSet"):
            grid = grid.GetBlock(0)
        good = good and np.array_equal(vtk_to_numpy(grid.GetPoints().GetData()), chain["position/value"][i])
        good = good and grid.GetNumberOfCells() == len(chain["id"])
        for k in range(grid.GetPointData().GetNumberOfArrays()):
            array = grid.GetPointData().GetArray(k)
            wanted = chain[array.GetName()]
            wanted = wanted["value"][i] if isinstance(wanted, h5py.Group) else wanted[:]
            good = good and np.array_equal(vtk_to_numpy(array), wanted)
            seen.add(array.GetName())
    ok(good, "XDMF: beads at each time where they are")
    ok(seen == {"mass", "radius"} | (set(elements(chain)) - {"position"}), "XDMF: every field of beads")


def check_mdanalysis(path, file):
    if not has("MDAnalysis"):
        skip("MDAnalysis (python3-mdanalysis)", "MDAnalysis")
        return
    import warnings

    import MDAnalysis

    warnings.simplefilter("ignore")
    chain = file["particles/chain"]
    stored = [name for name in ("position", "velocity", "force") if name in chain]
    if not stored:
        return
    beads = len(chain["id"])
    universe = MDAnalysis.Universe.empty(beads, trajectory=False, velocities=True, forces=True)
    universe.load_new(path, format="H5MD", convert_units=False)
    try:
        MDAnalysis.Universe.empty(beads, trajectory=False).load_new(path, format="H5MD")
    except ValueError:
        refused = True
    else:
        refused = False
    ok(refused, "MDAnalysis: without convert_units=False it refuses metres, which its H5MD reader does not know, and reads nothing wrong")
    frames = len(chain[stored[0] + "/time"])
    ok(len(universe.trajectory) == frames, "MDAnalysis: frames")
    good = True
    for i in sorted({0, frames // 2, frames - 1}):
        frame = universe.trajectory[i]
        good = good and frame.time == chain[stored[0] + "/time"][i]
        for name, values in (("position", "positions"), ("velocity", "velocities"), ("force", "forces")):
            if name in stored:
                good = good and np.array_equal(getattr(frame, values), chain[name + "/value"][i].astype(np.float32))
    ok(good, "MDAnalysis: positions, velocities, forces and times")


def check_xarray(path, file):
    if not (has("xarray") and has("h5netcdf")):
        skip("xarray and h5netcdf (python3-xarray, python3-h5netcdf)", "xarray")
        return
    import xarray

    groups = {"particles/chain": "bead", "contacts": "contact"}
    for parent, axis in groups.items():
        if parent not in file:
            continue
        with xarray.open_dataset(path, engine="h5netcdf", group=parent) as constants:
            ok(axis in constants.dims and (parent == "contacts" or "mass" in constants), f"xarray: {parent}")
        for name, element in elements(file[parent]).items():
            with xarray.open_dataset(path, engine="h5netcdf", group=f"{parent}/{name}") as data:
                value = data["value"]
                wanted = ("time", axis, "spatial")[: element["value"].ndim]
                ok(value.dims == wanted and np.array_equal(value.values, element["value"][:])
                   and np.array_equal(data["time"].values, element["time"][:])
                   and np.array_equal(data[axis].values, element[axis][:]), f"xarray: {parent}/{name} {wanted}")


def check(path, probes):
    tap.where = os.path.basename(path).removesuffix(".h5") + ": "
    with h5py.File(path, "r") as file:
        check_h5md(file)
        check_texts(file)
        check_nexus(file)
        if probes:
            check_probes(path, file)
        check_xdmf(path, file)
        check_xarray(path, file)
        check_mdanalysis(path, file)


def main():
    words = sys.argv[1:]
    if not words:
        sys.exit(__doc__)
    for before, path in zip([""] + words, words):
        if path != "python":
            check(path, before != "python")
    finish()


main()
