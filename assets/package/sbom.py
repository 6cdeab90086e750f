#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""What is in an archive, for those who must know (a software bill of materials, SPDX 2.3): sbom.py ARCHIVE [PACKAGE...] >FILE.spdx.json

ARCHIVE is a .tar.gz; its files are listed with their digests and licences: of a source, what its SPDX line says, else debian/copyright.
PACKAGE is a package of Debian that the archive needs; as NAME=VERSION, one whose files it contains. The date is $SOURCE_DATE_EPOCH, so
that the same archive has the same list.
"""
import datetime
import fnmatch
import hashlib
import json
import os
import pathlib
import re
import sys
import tarfile

TOP = pathlib.Path(__file__).resolve().parents[2]
SPDX_NAMES = {"Expat": "MIT"}  # where Debian's name of a licence is another
OTHERS = ("lib/beadreel/", "share/beadreel/fonts/", "share/doc/beadreel/licences/")  # of a bundle: files of the packages that it contains


def licences():
    """Patterns of files and their licences; the last that fits counts."""
    stanzas = (TOP / "debian/copyright").read_text().split("\n\n")
    for stanza in stanzas:
        found = re.search(r"^Files:(.*?)\n[A-Z].*^License: (\S+)", stanza, re.S | re.M)
        for pattern in found[1].split() if found else ():
            yield pattern, SPDX_NAMES.get(found[2], found[2])


def licence(name, content, patterns):
    if name.startswith(OTHERS):
        return "NOASSERTION"
    # In two parts: this line is no licence of this file's.
    said = re.search(rb"SPDX-License-" rb"Identifier: ([\w.+-]+)", content[:400])
    return said[1].decode() if said else [l for pattern, l in patterns if fnmatch.fnmatch(name, pattern)][-1]


def spdx_id(text):
    return "SPDXRef-" + re.sub(r"[^A-Za-z0-9.-]", "-", text)


def entries(archive):
    patterns = list(licences())
    with tarfile.open(archive) as tar:
        for member in sorted((m for m in tar if m.isfile()), key=lambda m: m.name):
            content, name = tar.extractfile(member).read(), member.name.split("/", 1)[1]
            terms = licence(name, content, patterns)
            yield {
                "SPDXID": spdx_id(f"File-{hashlib.sha256(name.encode()).hexdigest()[:16]}"),
                "fileName": "./" + name,
                "checksums": [{"algorithm": a, "checksumValue": hashlib.new(a.lower(), content).hexdigest()} for a in ("SHA1", "SHA256")],
                "licenseConcluded": terms,
                "licenseInfoInFiles": [terms],
                "copyrightText": "NOASSERTION",
            }


def other(package):
    name, _, version = package.partition("=")
    more = {"versionInfo": version} if version else {}
    return more | {
        "SPDXID": spdx_id(f"Package-{name}"), "name": name, "downloadLocation": "NOASSERTION", "filesAnalyzed": False,
        "licenseConcluded": "NOASSERTION", "licenseDeclared": "NOASSERTION", "copyrightText": "NOASSERTION",
        "externalRefs": [{"referenceCategory": "PACKAGE-MANAGER", "referenceType": "purl",
                          "referenceLocator": f"pkg:deb/debian/{name}" + (f"@{version}" if version else "")}]}


def document(archive, packages):
    version = re.search(r'BEADREEL_VERSION "(.*)"', (TOP / "include/beadreel/api.h").read_text())[1]
    citation = (TOP / "CITATION.cff").read_text()
    home = re.search(r"^repository-code: (.*)$", citation, re.M)[1]
    content = pathlib.Path(archive).read_bytes()
    digest = hashlib.sha256(content).hexdigest()
    files = list(entries(archive))
    sums = "".join(sorted(file["checksums"][0]["checksumValue"] for file in files))
    created = datetime.datetime.fromtimestamp(int(os.environ.get("SOURCE_DATE_EPOCH", 0)), datetime.timezone.utc)
    main = {
        "SPDXID": "SPDXRef-Package-beadreel", "name": "beadreel", "versionInfo": version, "packageFileName": os.path.basename(archive),
        "downloadLocation": home, "homepage": home, "supplier": "Organization: The beadreel authors", "filesAnalyzed": True,
        "packageVerificationCode": {"packageVerificationCodeValue": hashlib.sha1(sums.encode()).hexdigest()},
        "checksums": [{"algorithm": "SHA256", "checksumValue": digest}], "licenseConcluded": "GPL-3.0-or-later",
        "licenseDeclared": "GPL-3.0-or-later", "licenseInfoFromFiles": sorted({file["licenseConcluded"] for file in files}),
        "copyrightText": "2026 The beadreel authors",
    }
    others = [other(package) for package in packages]
    here = main["SPDXID"]
    related = [("SPDXRef-DOCUMENT", "DESCRIBES", here)] + [(here, "CONTAINS", file["SPDXID"]) for file in files]
    related += [(here, "CONTAINS" if "versionInfo" in o else "DEPENDS_ON", o["SPDXID"]) for o in others]
    return {
        "spdxVersion": "SPDX-2.3", "dataLicense": "CC0-1.0", "SPDXID": "SPDXRef-DOCUMENT", "name": os.path.basename(archive),
        "documentNamespace": f"{home}/sbom/{digest}",
        "creationInfo": {"created": created.strftime("%Y-%m-%dT%H:%M:%SZ"), "creators": ["Tool: beadreel-sbom"]},
        "packages": [main, *others], "files": files,
        "relationships": [{"spdxElementId": a, "relationshipType": kind, "relatedSpdxElement": b} for a, kind, b in related],
    }


if __name__ == "__main__":
    json.dump(document(sys.argv[1], sys.argv[2:]), sys.stdout, indent=1)
    print()
