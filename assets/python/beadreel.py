# SPDX-License-Identifier: GPL-3.0-or-later
"""Waves in chains of beads, from Python: runs the program beadreel and reads what it makes.

    import beadreel

    run = beadreel.run("clean-vs-delocalised", simulate={"until": "1 ms"})
    run                                # in a notebook: the film, or a picture
    run.peaks["peak_force_N"].max()    # a structured array, one row a contact
    run.trajectory.bead_force          # xarray, where it is installed; else an h5py.File
    run.outputs["force.png"]           # a path, which a notebook shows

    run = beadreel.run({"chain": {"beads": [{"bead": "large-steel", "count": 50}]}})
    runs = beadreel.sweep(scene, over={"chain.striker.velocity": ["0.1 m/s", "1 m/s"]})

Scenes are described in the manual, beadreel-scene(5). A scene is the name of a ready one, a file, YAML text of several lines, or a
dictionary. The program is $BEADREEL, or the one of the source tree or installation that this file is part of, or on PATH.
"""
import base64
import csv
import html
import itertools
import json
import mimetypes
import os
import pathlib
import shutil
import signal
import subprocess
import tempfile
import warnings
import weakref

__all__ = ["run", "sweep", "Run", "Output", "BeadreelError", "SceneError"]

#: What a dictionary without `outputs` makes.
OUTPUTS = ({"image": "force.png"}, {"table": "peaks.csv", "show": "peaks"}, {"trajectory": "run.h5"})
SWEEP_OUTPUTS = ({"plot": "force.png"}, {"table": "force.csv"}, {"table": "configurations.csv", "show": "configurations"})


class BeadreelError(RuntimeError):
    """The program failed; `errors` are its messages, each a dictionary with file, line, column and message."""

    def __init__(self, errors):
        self.errors = errors
        super().__init__("\n".join(_told(error) for error in errors))


class SceneError(BeadreelError, ValueError):
    """The scene or a setting is wrong; nothing was computed."""


def _told(error):
    place = [str(error[key]) for key in ("file", "line", "column") if error.get(key) is not None]
    return ": ".join([":".join(place), error["message"]] if place else [error["message"]])


class Output(type(pathlib.Path())):
    """The path of a file that was made; a notebook shows pictures, films and tables."""

    def _repr_html_(self):
        kind = mimetypes.guess_type(self.name)[0] or ""
        title = html.escape(self.name)
        if self.suffix == ".csv":
            with open(self, encoding="utf-8") as file:
                return "<pre>" + html.escape("".join(itertools.islice(file, 10))) + "</pre>"
        if not kind.startswith(("image/", "video/")):
            return f"<code>{html.escape(str(self))}</code>"
        source = f"data:{kind};base64," + base64.b64encode(self.read_bytes()).decode()
        if kind.startswith("image/"):
            return f'<img alt="{title}" style="max-width: 100%" src="{source}">'
        return f'<video controls loop title="{title}" style="max-width: 100%" src="{source}"></video>'


class Run:
    """What a run has made: `outputs`, paths by the names of the scene (Output); `result`, the program's own account with the steps
    and errors of each chain (a dictionary); `settings`, what was set on top of the scene.
    """

    def __init__(self, result, folder, settings):
        self.result = result
        self.folder = pathlib.Path(folder)
        self.settings = settings
        self.outputs = {made["name"]: Output(made["path"]) for made in result["outputs"]}
        self._kinds = {made["name"]: made["kind"] for made in result["outputs"]}

    def _first(self, *kinds):
        return next((self.outputs[name] for kind in kinds for name in self.outputs if self._kinds[name] == kind), None)

    def table(self, name):
        """A table (CSV) as a structured array."""
        return _read_table(self.outputs[name])

    @property
    def peaks(self):
        """The largest force in every contact: a structured array with chain, contact, peak_force_N, time_s, ..."""
        for name, path in self.outputs.items():
            if self._kinds[name] == "table":
                table = _read_table(path)
                if {"contact", "peak_force_N"} <= set(table.dtype.names):
                    return table
        raise LookupError("no table of peaks was made: add {table: peaks.csv, show: peaks} to the outputs of the scene")

    @property
    def trajectory(self):
        """All samples: an xarray.Dataset with the axes time and bead, and the coordinate chain; without xarray, an h5py.File."""
        path = self._first("trajectory")
        if path is None:
            raise LookupError("no trajectory was made: add {trajectory: run.h5} to the outputs of the scene")
        return open_trajectory(path)

    def film(self, name=None, **settings):
        """The film: that of the scene, or one drawn from the trajectory to the file `name` (film.mp4) with settings of a movie."""
        made = self.outputs.get(name) if name else self._first("movie")
        if made is not None and not settings:
            return made
        path = self._first("trajectory")
        if path is None:
            raise LookupError("no film was made, nor a trajectory to draw one from: add {movie: waves.mp4} to the outputs")
        film = self.folder / (name or "film.mp4")
        outputs = [{"movie": film.name, **{_key(key): value for key, value in settings.items()}}]
        _call([path, "-o", film, *_set({"outputs": outputs})])
        return Output(film)

    def _repr_html_(self):
        shown = self._first("movie", "image", "sheet", "plot")
        names = html.escape(", ".join(self.outputs))
        return (shown._repr_html_() if shown is not None else "") + f"<p>{names} in {self.result['seconds']:.3g} s</p>"

    def __repr__(self):
        return f"<beadreel.Run: {', '.join(self.outputs)} in {self.folder}>"


def run(scene, *, out=None, only=(), threads=None, progress=None, **settings):
    """Run a scene and return what it makes, a Run.

    out       folder for the files; None: a temporary one, which goes with the Run
    only      names of the outputs to make; empty: all
    progress  called with a dictionary (what, done, elapsed_s, left_s) while it runs
    settings  keys of the scene: simulate={"until": "2 ms"} or simulate__until="2 ms"; in a name, _ stands for -
    """
    folder = tempfile.mkdtemp(prefix="beadreel-") if out is None else out
    changes = _flat(settings)
    arguments = ["-o", folder, *_set(changes)]
    for name in [only] if isinstance(only, str) else only:
        arguments += ["--only", name]
    if threads:
        arguments += ["--threads", str(threads)]
    made = None
    try:
        with tempfile.TemporaryDirectory(prefix="beadreel-") as scratch:
            made = Run(_call([_scene_file(scene, scratch), *arguments], progress), folder, changes)
    finally:
        if out is None:
            weakref.finalize(made, shutil.rmtree, folder, True) if made else shutil.rmtree(folder, True)
    return made


def sweep(scene=None, *, over=None, out=None, **settings):
    """Many runs.

    over={"chain.striker.velocity": [...], ...}: `scene` for each combination of these values: a list of Run, each with its values
    in `settings`. Without `over`: a sweep of random chains, beadreel-scene(5); without `scene`, `settings` are its keys (cells=64,
    magnetism="all", ...).
    """
    if over is None:
        if scene is None:
            outputs = settings.pop("outputs", SWEEP_OUTPUTS)
            scene, settings = {"sweep": {_key(name): value for name, value in settings.items()}, "outputs": list(outputs)}, {}
        return run(scene, out=out, **settings)
    runs = []
    for number, values in enumerate(itertools.product(*over.values())):
        folder = None if out is None else os.path.join(out, str(number))
        runs.append(run(scene, out=folder, **settings, **dict(zip(over, values))))
    return runs


def open_trajectory(path):
    """A trajectory as an xarray.Dataset, read when needed; without xarray or h5netcdf as an h5py.File."""
    import h5py

    try:
        import h5netcdf  # noqa: F401
        import xarray
    except ImportError:
        return h5py.File(path, "r")
    with h5py.File(path, "r") as file:
        groups = [f"{parent}/{name}" for parent in ("particles/chain", "contacts") if parent in file
                  for name, item in file[parent].items() if isinstance(item, h5py.Group) and "value" in item]
        names = [name.decode() for name in file["parameters/beadreel/chains/name"][:]]
        attributes = {key: file["parameters/beadreel"].attrs[key].decode() for key in ("title", "program")}
    parts = [xarray.open_dataset(path, engine="h5netcdf", group="particles/chain")]
    for group in groups:
        part = xarray.open_dataset(path, engine="h5netcdf", group=group)
        parts.append(part[["value"]].rename(value=group.rsplit("/", 1)[1]))
    data = xarray.merge(parts, join="override", compat="override", combine_attrs="drop")
    data = data.assign_coords(chain=("bead", [names[i] for i in data["chain"].values])).assign_attrs(attributes)
    return data.set_coords([name for name in ("id", "species", "mass", "radius", "rest_position") if name in data])


def _program():
    if os.environ.get("BEADREEL"):
        return os.environ["BEADREEL"]
    for folder in pathlib.Path(__file__).resolve().parents:
        for place in ("build", "bin"):
            if os.access(folder / place / "beadreel", os.X_OK):
                return str(folder / place / "beadreel")
    found = shutil.which("beadreel")
    if not found:
        raise FileNotFoundError("the program beadreel was not found: install it, or set the variable BEADREEL to its path")
    return found


def _call(arguments, progress=None):
    """Run the program; returns its result (JSON), or raises what is wrong."""
    command = [_program(), *map(str, arguments), "--progress=json" if progress else "--json"]
    words = ["no result"]
    with tempfile.TemporaryFile("w+", encoding="utf-8", errors="replace") as out:  # a pipe would fill up while the other is read
        with subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=out, stderr=subprocess.PIPE, text=True, encoding="utf-8",
                              errors="replace") as process:
            try:
                for line in process.stderr:
                    if line.startswith("{") and progress:
                        progress(json.loads(line))
                    words += [] if line.startswith("{") else [line.strip()]
            except BaseException:  # ctrl-C reaches the program, too; it ends in good order
                process.send_signal(signal.SIGINT)
                raise
        said = out.seek(0) or out.read()
    try:
        result = json.loads(said)
    except ValueError:
        raise BeadreelError([{"message": f"{command[0]}: status {process.returncode}, {': '.join(words)}"}]) from None
    if result["status"] != "done":
        raise (SceneError if result["exit"] == 2 else BeadreelError)(result["errors"] or [{"message": "the run was " + result["status"]}])
    for warning in result["warnings"]:
        warnings.warn(warning, stacklevel=3)
    return result


def _plain(value):
    """NumPy's numbers and arrays, paths."""
    return value.tolist() if hasattr(value, "tolist") else str(value)


def _yaml(value):
    """JSON is YAML; a plain word needs no quotes, so that `1 m/s` stays as it was written."""
    return value if isinstance(value, str) else json.dumps(value, default=_plain, ensure_ascii=False)


def _key(name):
    return name.replace("__", ".").replace("_", "-")


def _flat(settings):
    """{"simulate": {"until": 1}} as {"simulate.until": 1}."""
    flat = {}
    for name, value in settings.items():
        path = name if "." in name else _key(name)
        inner = _flat({f"{path}.{key}": part for key, part in value.items()}) if isinstance(value, dict) and value else {path: value}
        flat.update(inner)
    return flat


def _set(changes):
    return [word for path, value in changes.items() for word in ("--set", f"{path}={_yaml(value)}")]


def _scene_file(scene, scratch):
    if isinstance(scene, dict):
        text = json.dumps({"outputs": list(OUTPUTS), **scene}, default=_plain, ensure_ascii=False, indent=1)
    elif isinstance(scene, str) and "\n" in scene:
        text = scene
    else:
        return scene
    path = os.path.join(scratch, "scene.yaml")
    pathlib.Path(path).write_text(text, encoding="utf-8")
    return path


def _column(texts):
    import numpy

    for read in (int, lambda text: float(text) if text else float("nan")):
        try:
            return numpy.array([read(text) for text in texts])
        except ValueError:
            continue
    return numpy.array(texts)


def _read_table(path):
    import numpy

    with open(path, newline="", encoding="utf-8") as file:
        names, *rows = csv.reader(line for line in file if not line.startswith("#"))
    columns = [_column(column) for column in zip(*rows)] if rows else [numpy.array([], float) for _ in names]
    table = numpy.empty(len(rows), [(name, column.dtype) for name, column in zip(names, columns)])
    for name, column in zip(names, columns):
        table[name] = column
    return table
