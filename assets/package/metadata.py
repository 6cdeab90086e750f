#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""What others read of the project, from where it is said: metadata.py OWNER [--check] (make metadata OWNER=NAME).

The owner of the repository goes into the addresses of all files that have one; the version, from api.h, into CITATION.cff; and what
CITATION.cff says into codemeta.json (https://codemeta.github.io, 3.0) and .zenodo.json. With --check nothing is written: prints the
files that would change, with exit status 1 where there are some. Needs python3-yaml.
"""
import json
import pathlib
import re
import sys

import yaml

TOP = pathlib.Path(__file__).resolve().parents[2]
ADDRESSED = ["README.md", "CITATION.cff", "debian/changelog", "debian/control", "debian/copyright"]


def addressed(text, owner):
    text = re.sub(r"(github\.com/)[\w-]+(/beadreel\b)", rf"\g<1>{owner}\2", text)
    return re.sub(r"<[\w-]+(@users\.noreply\.github\.com>)", rf"<{owner}\1", text)


def person(author):
    """An author of CITATION.cff, as schema.org has people and organisations."""
    if "name" in author:
        return {"type": "Organization", "name": author["name"]}
    orcid = {"id": author["orcid"]} if "orcid" in author else {}
    place = {"affiliation": {"type": "Organization", "name": author["affiliation"]}} if "affiliation" in author else {}
    return orcid | {"type": "Person", "givenName": author["given-names"], "familyName": author["family-names"]} | place


def creator(author):
    """The same as Zenodo has them."""
    if "name" in author:
        return {"name": author["name"]}
    more = {"affiliation": author.get("affiliation"), "orcid": author.get("orcid", "").removeprefix("https://orcid.org/")}
    return {"name": f"{author['family-names']}, {author['given-names']}"} | {key: value for key, value in more.items() if value}


def codemeta(cff):
    known = {"datePublished": str(cff["date-released"])} if "date-released" in cff else {}
    return {
        "@context": "https://w3id.org/codemeta/3.0",
        "type": "SoftwareSourceCode",
        "name": "beadreel",
        "description": cff["abstract"].strip(),
        "version": cff["version"],
        **known,
        "author": [person(author) for author in cff["authors"]],
        "license": f"https://spdx.org/licenses/{cff['license']}",
        "codeRepository": cff["repository-code"],
        "issueTracker": cff["repository-code"] + "/issues",
        "continuousIntegration": cff["repository-code"] + "/actions",
        "keywords": cff["keywords"],
        "programmingLanguage": "C",
        "operatingSystem": "Linux",
        "applicationCategory": "Physics",
        "softwareRequirements": ["HDF5", "FFmpeg (libavcodec, libavformat)", "Cairo", "Pango", "LibYAML", "UDUNITS"],
    }


def zenodo(cff):
    return {
        "upload_type": "software",
        "title": cff["title"],
        "version": cff["version"],
        "description": cff["abstract"].strip(),
        "creators": [creator(author) for author in cff["authors"]],
        "access_right": "open",
        "license": cff["license"],
        "keywords": cff["keywords"],
        "related_identifiers": [{"identifier": cff["repository-code"], "relation": "isSupplementTo", "scheme": "url"}],
    }


def main(owner, check):
    version = re.search(r'BEADREEL_VERSION "(.*)"', (TOP / "include/beadreel/api.h").read_text())[1]
    texts = {name: addressed((TOP / name).read_text(), owner) for name in ADDRESSED}
    texts["CITATION.cff"] = re.sub(r"^version: .*$", f"version: {version}", texts["CITATION.cff"], flags=re.M)
    cff = yaml.safe_load(texts["CITATION.cff"])
    for name, made in (("codemeta.json", codemeta(cff)), (".zenodo.json", zenodo(cff))):
        texts[name] = json.dumps(made, indent=2, ensure_ascii=False) + "\n"
    changed = [name for name, text in texts.items() if not (TOP / name).exists() or (TOP / name).read_text() != text]
    for name in changed:
        print(name)
        if not check:
            (TOP / name).write_text(texts[name])
    return check and bool(changed)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1], sys.argv[2:] == ["--check"]))
