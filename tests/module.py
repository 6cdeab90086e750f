#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The module assets/python/beadreel, as a user has it: module.py FOLDER. numpy and h5py are needed. Prints TAP."""
import inspect
import os
import pathlib
import subprocess
import sys
import warnings

import h5py
import numpy as np

import beadreel
from tap import finish, ok, skip

folder = pathlib.Path(sys.argv[1])
STEEL = {"chain": {"beads": [{"bead": "large-steel", "count": 20}]}}


def refused(kind, words, function, *arguments, **settings):
    """Does it raise `kind`, and say `words`?"""
    try:
        function(*arguments, **settings)
    except kind as error:
        return words in str(error)
    return False


def has_xarray():
    try:
        import xarray  # noqa: F401
    except ImportError:
        return False
    return True


def demo():
    """The numbers of the demo, as the program wrote them."""
    run = beadreel.run("clean-vs-delocalised", out=folder / "demo", only=["peaks.csv", "run.h5"])
    ok(sorted(run.outputs) == ["peaks.csv", "run.h5"] and run.outputs["run.h5"] == folder / "demo/run.h5", "outputs by name")
    peaks = run.peaks
    ok(len(peaks) == 258 and set(peaks["chain"]) == {"Clean", "Delocalised"} and peaks["contact"].dtype.kind == "i"
       and abs(peaks["peak_force_N"].max() - 84.3222) < 1e-3, "peaks are a structured array")
    ok([chain["chain"] for chain in run.result["runs"]] == ["Clean", "Delocalised"], "the result has each chain")
    return run


def trajectories(run):
    """Chains are a dimension; what is read is what the file has, wherever one cuts."""
    if not has_xarray():
        return skip("python3-xarray", "the trajectory in xarray")
    data = run.trajectory
    with h5py.File(run.outputs["run.h5"]) as file:
        stored = file["particles/chain/bead_force/value"][:]
        places = file["particles/chain/position/value"][::50, 129:]
        times = file["time"][:]
    ok(data.bead_force.dims == ("chain", "time", "bead") and list(data.chain) == ["Clean", "Delocalised"]
       and data.position.dims == ("chain", "time", "bead", "spatial") and np.array_equal(data.time, times), "trajectory: an xarray")
    clean = data.sel(chain="Clean")
    ok(clean.bead_force.dims == ("time", "bead") and np.array_equal(clean.bead_force, stored[:, :129])
       and np.array_equal(data.isel(chain=1).position[::50], places), "... that knows chains by name")
    ok(float(data.bead_force.sel(chain="Delocalised", bead=7)[900]) == stored[900, 136]
       and np.array_equal(data.bead_force.isel(chain=[1, 0], time=[5, 3], bead=[9, 2]).values[0], stored[[5, 3]][:, [138, 131]])
       and np.array_equal(data.bead_force[0, 2800:2790:-3, ::60], stored[2800:2790:-3, :129:60]), "... read in parts, in any order")
    ok(data.bead_force.attrs == {"units": "N", "long_name": "mean of the forces in the two contacts of the bead"}
       and data.time.attrs["units"] == "s" and data.mass.attrs["units"] == "kg" and data.attrs["title"] == "Clean and delocalised waves",
       "... with units and attributes")
    both = beadreel.run({"chains": [{"name": name, "beads": [{"bead": "large-steel", "count": count}]} for name, count in (("A", 9), ("B", 4))]},
                        outputs=[{"trajectory": "run.h5", "fields": ["displacement", "contact-force"], "beads": [1, 5], "every": "10 us"}]).trajectory
    ok(list(both.bead) == [1, 2, 3, 4, 5] and bool(both.displacement.sel(chain="B", bead=5).isnull().all())
       and not bool(both.displacement.sel(chain="B", bead=[1, 4]).isnull().any()) and both.contact_force.dims == ("chain", "time", "contact")
       and bool((both.contact_force.sel(chain="A", contact=2) > 0).any()), "unlike chains are filled up with NaN; beads have their numbers")
    try:
        import matplotlib
    except ImportError:
        return skip("python3-matplotlib", "xarray plots it")
    matplotlib.use("Agg")
    image = clean.bead_force.plot()
    ok(image.axes.get_xlabel() == "bead" and image.axes.get_ylabel() == "time [s]" and image.get_array().size == clean.bead_force.size
       and len(data.bead_force.plot(col="chain").axs.flat) == 2 and data.bead_force.plot() is not None, "xarray plots it, with units")


def without_xarray():
    names = {name: sys.modules.get(name) for name in ("xarray",)}
    sys.modules.update(dict.fromkeys(names))
    file = beadreel.open_trajectory(folder / "demo/run.h5")
    ok(isinstance(file, h5py.File) and len(file["time"]) == 2801, "trajectory without xarray: an h5py.File")
    file.close()
    for name, module in names.items():
        sys.modules.pop(name)
        if module:
            sys.modules[name] = module


def scenes():
    run = beadreel.run(STEEL, simulate={"until": "0.1 ms"}, chain__striker__velocity="1 m/s")
    ok(run.settings == {"simulate.until": "0.1 ms", "chain.striker.velocity": "1 m/s"}, "settings by sections and by paths")
    ok(abs(run.result["runs"][0]["end_s"] - 1e-4) < 1e-12 and run.peaks["peak_force_N"][0] > 200, "... reach the run")
    ok(sorted(run.outputs) == ["force.png", "peaks.csv", "run.h5"], "a dictionary without outputs has some")
    ok(run._repr_html_().startswith('<img alt="force.png"') and "base64,iVBOR" in run._repr_html_(), "a notebook shows the picture")
    film = run.film(size=[320, 240], duration="0.2 s")
    again = beadreel.run(run.outputs["run.h5"], outputs=[{"image": "a.png", "size": [320, 240]}, {"image": "b.svg"}])
    ok(sorted(again.outputs) == ["a.png", "b.svg"] and b"<svg" in again.outputs["b.svg"].read_bytes() and again.folder != run.folder,
       "a trajectory drawn again")
    ok(refused(ValueError, "nothing to draw", beadreel.run, run.outputs["run.h5"], only="b.png")
       and refused(ValueError, "without this setting", beadreel.run, run.outputs["run.h5"], simulate__until="1 s"), "... and what cannot be")
    page = beadreel.run(STEEL, outputs=[{"report": "page.html"}], simulate__until="0.1 ms")
    ok("<iframe" in page._repr_html_() and "&lt;html" in page._repr_html_(), "a notebook shows the report")
    ok(film.exists() and "<video" in film._repr_html_() and b"ftyp" in film.read_bytes()[:16], "a film from the trajectory")
    ok("peak_force_N" in run.outputs["peaks.csv"]._repr_html_(), "a notebook shows a table")
    place = run.folder
    del run, film
    ok(not place.exists(), "a temporary folder goes with its run")
    text = beadreel.run("chain: {beads: [{bead: brass, count: 3}]}\noutputs: [{table: peaks.csv}]\n", out=folder / "text")
    ok(len(text.peaks) == 3 and text.table("peaks.csv").dtype.names == text.peaks.dtype.names, "a scene as text")
    ok(refused(LookupError, "no trajectory", lambda: text.trajectory) and refused(LookupError, "no film", text.film), "what is not there")
    ok(list(text.peaks["state"]) == ["", "", ""], "words that a run leaves empty")
    drawn = beadreel.sweep(cells=4, spins=["0110"], outputs=[{"table": "all.csv", "show": "configurations"}])
    ok(list(drawn.table("all.csv")["spins"]) == ["0110"], "spins are no numbers")
    said = beadreel.run(STEEL, title="Force: 5 N # 1", outputs=[{"image": "a.svg", "colormap": "#000000 #ffffff"}],
                        simulate__until="20 us")
    ok("Force: 5 N # 1" in said.outputs["a.svg"].read_text(), "texts that would be maps and comments")
    ok(beadreel.run(STEEL, outputs="[{table: peaks.csv}]", simulate__until="20 us").peaks.size == 20, "a list as YAML")
    numbers = beadreel.run(STEEL, only="peaks.csv", simulate={"until": np.float64(5e-5)}, threads=1)
    ok(numbers.result["runs"][0]["end_s"] == 5e-5, "NumPy's numbers")


def errors():
    wrong = {"chain": {"beads": [{"bead": "lrge-steel"}]}}
    ok(refused(beadreel.SceneError, "there is no material `lrge-steel`; did you mean `large-steel`?", beadreel.run, wrong), "a wrong scene")
    ok(refused(ValueError, "simulate.until", beadreel.run, STEEL, simulate__until="5 kg"), "a wrong setting is a ValueError")
    try:
        beadreel.run(wrong)
    except beadreel.BeadreelError as error:
        ok(error.errors[0]["line"] > 1 and "chain.beads.0.bead" in error.errors[0]["message"], "... with its place")
    (folder / "file").write_text("")
    ok(refused(beadreel.BeadreelError, "file", beadreel.run, STEEL, out=folder / "file" / "x"), "a folder that cannot be")
    program = os.environ["BEADREEL"]
    os.environ["BEADREEL"] = "/bin/false"
    ok(refused(beadreel.BeadreelError, "status 1", beadreel.run, STEEL), "a program that says nothing")
    os.environ["BEADREEL"] = program
    with warnings.catch_warnings(record=True) as told:
        warnings.simplefilter("always")
        beadreel.run(STEEL, only="peaks.csv", simulate={"step": "20 us"})
    ok(len(told) == 1 and "step" in str(told[0].message), "warnings are Python's")
    seen = []
    beadreel.run(STEEL, only="peaks.csv", progress=seen.append, chain__beads__0__count=4000)
    ok(bool(seen) and all("done" in line for line in seen), "progress")


def many():
    """A result larger than a pipe holds (64 KiB), in a process that can be given up."""
    names = [f"a-rather-long-name-of-a-table-of-peaks-{number:04}.csv" for number in range(500)]
    code = ("import beadreel, sys; made = beadreel.run({'chain': {'beads': [{'bead': 'large-steel'}]}, "
            "'outputs': [{'table': name} for name in sys.argv[1:]]}); print(len(made.outputs))")
    try:
        said = subprocess.run([sys.executable, "-c", code, *names], capture_output=True, text=True, timeout=100).stdout
    except subprocess.TimeoutExpired:
        said = "hung"
    ok(said.strip() == str(len(names)), "a result larger than a pipe holds")


def sweeps():
    scene = {**STEEL, "outputs": [{"table": "peaks.csv", "show": "peaks"}]}
    runs = beadreel.sweep(scene, over={"chain.striker.velocity": ["0.1 m/s", "1 m/s"], "chain.beads.0.count": [5, 10]},
                          out=folder / "over")
    first = [run.peaks["peak_force_N"][0] for run in runs]
    ok(len(runs) == 4 and [len(run.peaks) for run in runs] == [5, 10, 5, 10], "a sweep over values: each combination")
    ok(abs(first[2] / first[0] / 10**1.2 - 1) < 1e-4, "... with the forces of Hertz's law")
    ok(runs[3].settings["chain.beads.0.count"] == 10, "... and its values")
    try:
        beadreel.sweep(scene, over={"chain.beads.0.count": [5, "no number", *range(6, 60)]}, out=folder / "ends", workers=1)
    except beadreel.SceneError as error:
        ok("count" in str(error) and len(list((folder / "ends").iterdir())) < 50, "... ends where one of them is wrong")
    waves = beadreel.sweep(cells=8, magnetism=[1, 0.5], configurations=3, seed=1)
    table = waves.table("force.csv")
    ok(list(table["magnetism"]) == [0.5, 1.0] and waves.result["sweep"]["computed"] > 3 and waves._repr_html_().startswith("<img"),
       "a sweep of random chains")


def documented():
    """Each public name says what it is for, and each function which types it takes."""
    public = [getattr(beadreel, name) for name in beadreel.__all__]
    methods = [item.fget if isinstance(item, property) else item for kind in (beadreel.Run, beadreel.Output)
               for name, item in vars(kind).items() if not name.startswith("__") and (callable(item) or isinstance(item, property))]
    functions = [item for item in public if inspect.isfunction(item)] + methods
    ok(all(item.__doc__ for item in public + [m for m in methods if m.__name__ != "_first"]), "a docstring each")
    ok(all("return" in item.__annotations__ and len(item.__annotations__) > item.__code__.co_argcount + item.__code__.co_kwonlyargcount
           - ("self" in item.__code__.co_varnames) for item in functions), "type hints each")
    ok((pathlib.Path(beadreel.__file__).parent / "py.typed").exists(), "... which type checkers read")


run_of_demo = demo()
trajectories(run_of_demo)
without_xarray()
scenes()
errors()
many()
sweeps()
documented()
finish()
