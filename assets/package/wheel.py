# SPDX-License-Identifier: GPL-3.0-or-later
"""Makes wheels for pip (PEP 517; named in pyproject.toml). A wheel is the bundle of bundle.sh and the Python module: its programs go
into bin of the environment, its libraries and assets into lib and share beside that. Needs nothing but Python; BUILD is the directory
that is built in. The same bundle makes the same bytes. `--config-settings level=1` compresses fast and less.
"""
import base64
import hashlib
import os
import pathlib
import platform
import re
import shutil
import subprocess
import tarfile
import tomllib
import zipfile

TOP = pathlib.Path(__file__).resolve().parents[2]


def get_requires_for_build_wheel(config_settings=None):
    return []


def get_requires_for_build_sdist(config_settings=None):
    return []


def build_wheel(wheel_directory, config_settings=None, metadata_directory=None):
    """Build the programs and put them into a wheel; returns its name."""
    build = TOP / os.environ.get("BUILD", "build")
    bundle = build / "wheel-bundle"
    shutil.rmtree(bundle, ignore_errors=True)
    prefix = build / ".prefix"  # another one would be compiled in
    _run("make", f"BUILD={build}", *([f"PREFIX={prefix.read_text().strip()}"] if prefix.exists() else []), "all", cwd=TOP)
    _run(TOP / "assets/package/bundle.sh", build, bundle)
    try:
        return _write(bundle, pathlib.Path(wheel_directory), int((config_settings or {}).get("level", 6)))
    finally:
        shutil.rmtree(bundle)


def build_sdist(sdist_directory, config_settings=None):
    """The sources of the last commit."""
    name = f"beadreel-{_version()}"
    path = pathlib.Path(sdist_directory, name + ".tar.gz")
    _run("git", "archive", f"--prefix={name}/", "--add-virtual-file", f"{name}/PKG-INFO:{_metadata()}", "-o", path, "HEAD", cwd=TOP)
    assert tarfile.is_tarfile(path)
    return path.name


def _run(*command, **options):
    environment = {key: value for key, value in os.environ.items() if key not in ("MAKEFLAGS", "MAKELEVEL", "MFLAGS")}
    subprocess.run([str(word) for word in command], check=True, env=environment, **options)


def _version():
    return re.search(r'BEADREEL_VERSION "(.*)"', (TOP / "include/beadreel/api.h").read_text())[1]


def _metadata():
    project = tomllib.loads((TOP / "pyproject.toml").read_text())["project"]
    lines = ["Metadata-Version: 2.1", f"Name: {project['name']}", f"Version: {_version()}", f"Summary: {project['description']}",
             f"License: {project['license']['text']}", f"Requires-Python: {project['requires-python']}"]
    lines += [f"Requires-Dist: {needed}" for needed in project["dependencies"]]
    for extra, needs in project["optional-dependencies"].items():
        lines += [f"Provides-Extra: {extra}", *(f"Requires-Dist: {needed}; extra == '{extra}'" for needed in needs)]
    return "\n".join([*lines, "Description-Content-Type: text/markdown", "", (TOP / "README.md").read_text()])


def _platform(bundle):
    """manylinux_2_36_x86_64: by the newest version of glibc that a program or library of the bundle asks for."""
    files = [*(bundle / "bin").iterdir(), *(bundle / "lib/beadreel").iterdir()]
    said = subprocess.run(["readelf", "--version-info", "--wide", *files], check=True, capture_output=True, text=True).stdout
    newest = max(int(minor) for minor in re.findall(r"Name: GLIBC_2\.(\d+)", said))
    return f"manylinux_2_{newest}_{platform.machine()}"


def _write(bundle, folder, level):
    version, tag = _version(), f"py3-none-{_platform(bundle)}"
    info, data = f"beadreel-{version}.dist-info", f"beadreel-{version}.data"
    homes = {"lib/python": "", "bin": f"{data}/scripts/", "": f"{data}/data/"}
    path = folder / f"beadreel-{version}-{tag}.whl"
    record = []
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED, compresslevel=level) as wheel:
        def add(name, content, mode=0o644):
            digest = base64.urlsafe_b64encode(hashlib.sha256(content).digest()).rstrip(b"=").decode()
            record.append(f"{name},sha256={digest},{len(content)}")
            entry = zipfile.ZipInfo(name, (1980, 1, 1, 0, 0, 0))
            entry.external_attr, entry.compress_type = (0o100000 | mode) << 16, zipfile.ZIP_DEFLATED
            wheel.writestr(entry, content, compresslevel=level)  # an entry of its own does not take that of the file

        for file in sorted(file for file in bundle.rglob("*") if file.is_file()):
            place = file.relative_to(bundle).as_posix()
            home = next(home for home in homes if home == "" or place.startswith(home + "/"))
            add(homes[home] + place[len(home):].lstrip("/"), file.read_bytes(), 0o755 if home == "bin" else 0o644)
        add(f"{info}/METADATA", _metadata().encode())
        add(f"{info}/WHEEL", f"Wheel-Version: 1.0\nGenerator: beadreel\nRoot-Is-Purelib: false\nTag: {tag}\n".encode())
        record.append(f"{info}/RECORD,,")
        wheel.writestr(zipfile.ZipInfo(f"{info}/RECORD", (1980, 1, 1, 0, 0, 0)), "\n".join(record) + "\n")
    return path.name
