# SPDX-License-Identifier: GPL-3.0-or-later
"""Calls the program beadreel: its command line, its result, its errors."""
from __future__ import annotations

import json
import os
import pathlib
import re
import shutil
import signal
import subprocess
import tempfile
import warnings
from collections.abc import Callable, Mapping
from typing import Any, Union

#: What describes a scene: the name of a ready one, a file, YAML text of several lines, or a dictionary.
Scene = Union[str, "os.PathLike[str]", Mapping[str, Any]]
#: What a program says while it runs.
Progress = Callable[[dict[str, Any]], None]

#: What a dictionary without `outputs` makes.
OUTPUTS = ({"image": "force.png"}, {"table": "peaks.csv", "show": "peaks"}, {"trajectory": "run.h5"})


class BeadreelError(RuntimeError):
    """The program failed; `errors` are its messages, each a dictionary with file, line, column and message."""

    def __init__(self, errors: list[dict[str, Any]]) -> None:
        self.errors = errors
        super().__init__("\n".join(_told(error) for error in errors))


class SceneError(BeadreelError, ValueError):
    """The scene or a setting is wrong; nothing was computed."""


def _told(error: Mapping[str, Any]) -> str:
    place = [str(error[key]) for key in ("file", "line", "column") if error.get(key) is not None]
    return ": ".join([":".join(place), error["message"]] if place else [error["message"]])


def program() -> str:
    """The path of the program: $BEADREEL, that of the source tree or installation that this file is part of, or that on PATH."""
    if os.environ.get("BEADREEL"):
        return os.environ["BEADREEL"]
    for folder in pathlib.Path(__file__).resolve().parents:
        for place in ("build", "bin"):
            if (folder / place / "beadreel").is_file() and os.access(folder / place / "beadreel", os.X_OK):
                return str(folder / place / "beadreel")
    found = shutil.which("beadreel")
    if not found:
        raise FileNotFoundError("the program beadreel was not found: install it, or set the variable BEADREEL to its path")
    return found


def call(arguments: list[Any], progress: Progress | None = None) -> dict[str, Any]:
    """Run the program; returns its result (JSON), or raises what is wrong."""
    command = [program(), *map(str, arguments), "--progress=json" if progress else "--json"]
    words = ["no result"]
    with tempfile.TemporaryFile("w+", encoding="utf-8", errors="replace") as out:  # a pipe would fill up while the other is read
        with subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=out, stderr=subprocess.PIPE, text=True, encoding="utf-8",
                              errors="replace") as process:
            try:
                assert process.stderr is not None
                for line in process.stderr:
                    if line.startswith("{") and progress:
                        progress(json.loads(line))
                    words += [] if line.startswith("{") else [line.strip()]
            except BaseException:  # ctrl-C reaches the program, too; it ends in good order
                process.send_signal(signal.SIGINT)
                raise
        out.seek(0)
        said = out.read()
    try:
        result: dict[str, Any] = json.loads(said)
    except ValueError:
        raise BeadreelError([{"message": f"{command[0]}: status {process.returncode}, {': '.join(words)}"}]) from None
    if result["status"] != "done":
        raise (SceneError if result["exit"] == 2 else BeadreelError)(result["errors"] or [{"message": "the run was " + result["status"]}])
    for warning in result["warnings"]:
        warnings.warn(warning, stacklevel=3)
    return result


# What YAML would take for a map, a list, a comment or an alias.
NOT_PLAIN = re.compile(r"^[#&*!|>%@`]|^[-?] |:( |$)| #")


def _plain(value: Any) -> Any:
    """NumPy's numbers and arrays, paths."""
    return value.tolist() if hasattr(value, "tolist") else str(value)


def _yaml(value: Any) -> str:
    """JSON is YAML; a plain word needs no quotes, so that `1 m/s` stays as it was written. Lists and maps may be given as YAML."""
    plain = isinstance(value, str) and (value[:1] in tuple("[{\"'") or not NOT_PLAIN.search(value))
    return value if plain else json.dumps(value, default=_plain, ensure_ascii=False)


def key(name: str) -> str:
    """The key of a scene that a Python keyword stands for."""
    return name.replace("__", ".").replace("_", "-")


def flat(settings: Mapping[str, Any]) -> dict[str, Any]:
    """{"simulate": {"until": 1}} as {"simulate.until": 1}."""
    all_of_it: dict[str, Any] = {}
    for name, value in settings.items():
        path = name if "." in name else key(name)
        inner = flat({f"{path}.{part}": inside for part, inside in value.items()}) if isinstance(value, dict) and value else {path: value}
        all_of_it.update(inner)
    return all_of_it


def set_options(changes: Mapping[str, Any]) -> list[str]:
    """These changes of a scene as options of the program."""
    return [word for path, value in changes.items() for word in ("--set", f"{path}={_yaml(value)}")]


def scene_file(scene: Scene, scratch: str) -> str | os.PathLike[str]:
    """What the program is given: a name or a file; text and dictionaries go to a file in `scratch`."""
    if isinstance(scene, Mapping):
        text = json.dumps({"outputs": list(OUTPUTS), **scene}, default=_plain, ensure_ascii=False, indent=1)
    elif isinstance(scene, str) and "\n" in scene:
        text = scene
    else:
        return scene
    path = os.path.join(scratch, "scene.yaml")
    pathlib.Path(path).write_text(text, encoding="utf-8")
    return path
