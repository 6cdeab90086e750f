# SPDX-License-Identifier: GPL-3.0-or-later
"""Waves in chains of beads, from Python: runs the program beadreel and reads what it makes.

    import beadreel

    run = beadreel.run("clean-vs-delocalised", simulate={"until": "1 ms"})
    run                                # in a notebook: the film, or a picture
    run.peaks["peak_force_N"].max()    # a structured array, one row a contact
    run.outputs["force.png"]           # a path, which a notebook shows

    t = run.trajectory                 # xarray, where it is installed; else an h5py.File
    t.sel(chain="Clean").bead_force.plot()

    run = beadreel.run({"chain": {"beads": [{"bead": "large-steel", "count": 50}]}})
    runs = beadreel.sweep(scene, over={"chain.striker.velocity": ["0.1 m/s", "1 m/s"]})
    beadreel.run("run.h5", outputs=[{"movie": "waves.mp4"}])       # draws a trajectory again

Scenes are described in the manual, beadreel-scene(5). A scene is the name of a ready one, a file, YAML text of several lines, or a
dictionary. The program is $BEADREEL, or the one of the source tree or installation that this file is part of, or on PATH.
"""
from __future__ import annotations

import base64
import concurrent.futures
import csv
import html
import itertools
import mimetypes
import os
import pathlib
import shutil
import tempfile
import weakref
from collections.abc import Iterable, Mapping
from typing import TYPE_CHECKING, Any

from ._program import BeadreelError, Progress, Scene, SceneError, call, flat, key, scene_file, set_options
from ._trajectory import open_trajectory

if TYPE_CHECKING:
    import h5py
    import numpy
    import xarray

__all__ = ["run", "sweep", "open_trajectory", "Run", "Output", "BeadreelError", "SceneError"]

#: What a sweep of random chains makes, unless told.
SWEEP_OUTPUTS = ({"plot": "force.png"}, {"table": "force.csv"}, {"table": "configurations.csv", "show": "configurations"})
#: What is drawn of a trajectory, unless told.
DRAWN = ({"image": "force.png"},)


class Output(type(pathlib.Path())):  # type: ignore[misc]
    """The path of a file that was made; a notebook shows pictures, films, tables and reports."""

    def _repr_html_(self) -> str:
        """What a notebook shows; it contains all that it needs."""
        kind = mimetypes.guess_type(self.name)[0] or ""
        title = html.escape(self.name)
        if self.suffix == ".csv":
            with open(self, encoding="utf-8") as file:
                return "<pre>" + html.escape("".join(itertools.islice(file, 10))) + "</pre>"
        if self.suffix == ".html":
            page = html.escape(self.read_text(encoding="utf-8"))
            return f'<iframe title="{title}" sandbox="allow-scripts" style="width: 100%; height: 640px; border: 0" srcdoc="{page}"></iframe>'
        if not kind.startswith(("image/", "video/")):
            return f"<code>{html.escape(str(self))}</code>"
        source = f"data:{kind};base64," + base64.b64encode(self.read_bytes()).decode()
        if kind.startswith("image/"):
            return f'<img alt="{title}" style="max-width: 100%" src="{source}">'
        return f'<video controls loop title="{title}" style="max-width: 100%" src="{source}"></video>'


class Run:
    """What a run has made: `outputs`, paths by the names of the scene (Output); `result`, the program's own account with the steps
    and errors of each chain (a dictionary); `settings`, what was set on top of the scene; `folder`, where the files are.
    """

    def __init__(self, result: dict[str, Any], folder: str | os.PathLike[str], settings: dict[str, Any]) -> None:
        self.result = result
        self.folder = pathlib.Path(folder)
        self.settings = settings
        self.outputs = {made["name"]: Output(made["path"]) for made in result["outputs"]}
        self._kinds = {made["name"]: made["kind"] for made in result["outputs"]}

    def _first(self, *kinds: str) -> Output | None:
        return next((self.outputs[name] for kind in kinds for name in self.outputs if self._kinds[name] == kind), None)

    def table(self, name: str) -> numpy.ndarray:
        """A table (CSV) as a structured array."""
        return _read_table(self.outputs[name])

    @property
    def peaks(self) -> numpy.ndarray:
        """The largest force in every contact: a structured array with chain, contact, peak_force_N, time_s, ..."""
        for name, path in self.outputs.items():
            if self._kinds[name] == "table":
                table = _read_table(path)
                if {"contact", "peak_force_N"} <= set(table.dtype.names or ()):
                    return table
        raise LookupError("no table of peaks was made: add {table: peaks.csv, show: peaks} to the outputs of the scene")

    @property
    def trajectory(self) -> xarray.Dataset | h5py.File:
        """All samples, as open_trajectory reads them."""
        path = self._first("trajectory")
        if path is None:
            raise LookupError("no trajectory was made: add {trajectory: run.h5} to the outputs of the scene")
        return open_trajectory(path)

    def film(self, name: str | None = None, **settings: Any) -> Output:
        """The film: that of the scene, or one drawn from the trajectory to the file `name` (film.mp4) with settings of a movie."""
        made = self.outputs.get(name) if name else self._first("movie")
        if made is not None and not settings:
            return made
        path = self._first("trajectory")
        if path is None:
            raise LookupError("no film was made, nor a trajectory to draw one from: add {movie: waves.mp4} to the outputs")
        movie = {"movie": name or "film.mp4", **{key(word): value for word, value in settings.items()}}
        return Output(_draw(path, self.folder, [movie], [])["outputs"][0]["path"])

    def _repr_html_(self) -> str:
        """What a notebook shows: the first film, picture or report, and the names of all files."""
        shown = self._first("movie", "image", "sheet", "plot", "report")
        names = html.escape(", ".join(self.outputs))
        return (shown._repr_html_() if shown is not None else "") + f"<p>{names} in {self.result['seconds']:.3g} s</p>"

    def __repr__(self) -> str:
        return f"<beadreel.Run: {', '.join(self.outputs)} in {self.folder}>"


def run(scene: Scene, *, out: str | os.PathLike[str] | None = None, only: str | Iterable[str] = (), threads: int | None = None,
        progress: Progress | None = None, **settings: Any) -> Run:
    """Run a scene, or draw a trajectory (a file *.h5) again, and return what is made, a Run.

    out       folder for the files; None: a temporary one, removed with the Run
    only      names of the outputs to make; empty: all
    progress  called with a dictionary (what, done, elapsed_s, left_s) while it runs
    settings  keys of the scene: simulate={"until": "2 ms"} or simulate__until="2 ms"; in a name, _ means -. For a trajectory,
              outputs=[...] says what to draw, an image by default
    """
    folder = tempfile.mkdtemp(prefix="beadreel-") if out is None else out
    names = [only] if isinstance(only, str) else list(only)
    changes = flat(settings)
    options: list[Any] = ["--threads", threads] if threads else []
    made = None
    try:
        if isinstance(scene, (str, os.PathLike)) and os.fspath(scene).endswith(".h5"):
            wanted = [output for output in changes.pop("outputs", DRAWN) if not names or set(names) & set(map(str, output.values()))]
            made = Run(_draw(scene, folder, wanted, [*options, *set_options(changes)], progress), folder, flat(settings))
        else:
            options += [*set_options(changes), *(word for name in names for word in ("--only", name))]
            with tempfile.TemporaryDirectory(prefix="beadreel-") as scratch:
                made = Run(call([scene_file(scene, scratch), "-o", folder, *options], progress), folder, changes)
    finally:
        if out is None:
            weakref.finalize(made, shutil.rmtree, folder, True) if made else shutil.rmtree(folder, True)
    return made


def sweep(scene: Scene | None = None, *, over: Mapping[str, Iterable[Any]] | None = None, out: str | os.PathLike[str] | None = None,
          workers: int | None = None, **settings: Any) -> Run | list[Run]:
    """Many runs.

    over={"chain.striker.velocity": [...], ...}: `scene` for each combination of these values, `workers` at a time (as many as there
    are cores): a list of Run, each with its values in `settings`. Without `over`: a sweep of random chains, beadreel-scene(5);
    without `scene`, `settings` are its keys (cells=64, magnetism="all", ...).
    """
    if over is None:
        if scene is None:
            outputs = settings.pop("outputs", SWEEP_OUTPUTS)
            scene, settings = {"sweep": {key(name): value for name, value in settings.items()}, "outputs": list(outputs)}, {}
        return run(scene, out=out, **settings)
    assert scene is not None, "over needs a scene"
    workers = workers or len(os.sched_getaffinity(0))
    settings = {"threads": 1 if workers > 1 else None, **settings}
    combinations = [dict(zip(over, values)) for values in itertools.product(*over.values())]
    with concurrent.futures.ThreadPoolExecutor(workers) as pool:
        runs = [pool.submit(run, scene, out=None if out is None else os.path.join(out, str(number)), **settings, **values)
                for number, values in enumerate(combinations)]
        try:
            return [made.result() for made in runs]
        finally:  # what has not begun when one fails never does
            pool.shutdown(wait=False, cancel_futures=True)


def _draw(path: str | os.PathLike[str], folder: str | os.PathLike[str], outputs: Iterable[Mapping[str, Any]], options: list[Any],
          progress: Progress | None = None) -> dict[str, Any]:
    """Draw these outputs from a trajectory: the program's results as one."""
    whole: dict[str, Any] = {}
    for output in outputs:
        name = next(iter(output.values()))
        made = call([path, "-o", os.path.join(folder, name), *options, *set_options({"outputs": [output]})], progress)
        for file in made["outputs"]:
            file["name"] = os.path.relpath(file["path"], folder)
        whole = {**made, "seconds": whole.get("seconds", 0) + made["seconds"], "outputs": whole.get("outputs", []) + made["outputs"]}
    if not whole:
        raise SceneError([{"message": "nothing to draw: outputs is empty, or has none of the names of only"}])
    return whole


# Columns of words: empty ones would be read as numbers that are missing, spins as whole numbers.
WORDS = {"chain", "curve", "material", "note", "sensor", "spins", "state", "unit"}


def _column(name: str, texts: tuple[str, ...]) -> numpy.ndarray:
    import numpy

    for read in () if name in WORDS else (int, lambda text: float(text) if text else float("nan")):
        try:
            return numpy.array([read(text) for text in texts])
        except ValueError:
            continue
    return numpy.array(texts)


def _read_table(path: str | os.PathLike[str]) -> numpy.ndarray:
    import numpy

    with open(path, newline="", encoding="utf-8") as file:
        names, *rows = csv.reader(line for line in file if not line.startswith("#"))
    columns = [_column(name, column) for name, column in zip(names, zip(*rows))] if rows else [numpy.array([], float) for _ in names]
    table = numpy.empty(len(rows), [(name, column.dtype) for name, column in zip(names, columns)])
    for name, column in zip(names, columns):
        table[name] = column
    return table
