#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# What others read of the project: citation, codemeta, Zenodo, the paper. One fact, one place.
source "$(dirname "$0")/shell.bash"
cd "$top" || exit 1
paper=assets/package/paper.md bib=assets/package/paper.bib
body() { awk 'NR > 1 && /^---$/ { on = 1; next } on' "$paper"; }
length() { local words && words=$(body | wc -w) && { [ "$words" -ge 650 ] && [ "$words" -le 850 ] || { echo "$words words"; return 1; }; }; }
ok "the paper has about 750 words" length
sections() { diff <(body | sed -n 's/^# //p' | grep -xE 'Summary|Statement of need|State of the field|References') - <<<$'Summary\nStatement of need\nState of the field\nReferences'; }
ok "... the sections that JOSS asks for" sections
cited() { diff <(body | grep -oE '@[a-z]+[0-9]{4}' | tr -d @ | sort -u) <(sed -n 's/^@[a-z]*{\(.*\),$/\1/p' "$bib" | sort); }
ok "... and cites each of its references" cited
ok "... of which each has a DOI" [ "$(grep -c '^@' "$bib")" -eq "$(grep -cE '^ *doi = \{10\.[0-9]+/' "$bib")" ]

python=/usr/bin/python3
$python -c 'import yaml' 2>/dev/null || { skip python3-yaml "citation, codemeta and Zenodo agree"; finish; }
owner=$(make -s -pn help 2>/dev/null | sed -n 's/^OWNER ?\?= //p')
ok "all addresses name the owner, codemeta.json and .zenodo.json say what CITATION.cff says" "$python" assets/package/metadata.py "$owner" --check
cat >"$T/citation.py" <<'PY'
# The schema of CFF 1.2.0 asks for these, of these kinds; DOI and ORCID have their shapes.
import re, sys, yaml
cff = yaml.safe_load(open("CITATION.cff"))
assert cff["cff-version"] == "1.2.0" and cff["type"] == "software" and cff["license"] == "GPL-3.0-or-later"
for key in ("message", "title", "version", "abstract", "url", "repository-code"):
    assert isinstance(cff[key], str) and cff[key].strip(), key
assert cff["authors"] and all("name" in a or {"family-names", "given-names"} <= a.keys() for a in cff["authors"])
for author in cff["authors"]:
    assert re.fullmatch(r"https://orcid\.org/(\d{4}-){3}\d{3}[\dX]", author.get("orcid", "https://orcid.org/0000-0000-0000-0000"))
assert re.fullmatch(r"10\.\d{4,}/\S+", cff.get("doi", "10.0000/x")) and len(set(cff["keywords"])) == len(cff["keywords"]) > 3
allowed = {"cff-version", "message", "title", "type", "version", "date-released", "doi", "repository-code", "url", "license", "abstract",
           "keywords", "authors", "references", "preferred-citation", "identifiers", "contact", "commit", "repository", "repository-artifact", "license-url"}
assert cff.keys() <= allowed, cff.keys() - allowed
PY
ok "CITATION.cff has what its schema asks for" "$python" "$T/citation.py"
# In a copy: a new owner and a released version come through.
copy() {
    mkdir "$T/copy" && cp -r --parents README.md CITATION.cff codemeta.json .zenodo.json debian assets/package include/beadreel/api.h "$T/copy" &&
        sed -i 's/^# date-released: DATE/date-released: 2027-01-02/; s/^  - name: The beadreel authors/  - {family-names: Curie, given-names: Marie, orcid: "https:\/\/orcid.org\/0000-0001-2345-6789"}/' "$T/copy/CITATION.cff" &&
        sed -i 's/BEADREEL_VERSION "[^"]*"/BEADREEL_VERSION "7.8.9"/' "$T/copy/include/beadreel/api.h" && "$python" "$T/copy/assets/package/metadata.py" curie-lab
}
ok "make metadata with another owner, author and version" copy
everywhere() { ! grep -rnE "github\.com/$owner/|$owner@users" "$T/copy" && [ "$(grep -rlE 'github.com/curie-lab/beadreel' "$T/copy" | wc -l)" -ge 6 ]; }
ok "... changes every address" everywhere
says_so() {
    local file
    for file in codemeta.json:2027-01-02 codemeta.json:Curie codemeta.json:7.8.9 .zenodo.json:'Curie, Marie' .zenodo.json:0000-0001-2345-6789 .zenodo.json:7.8.9; do
        grep -qF -- "${file#*:}" "$T/copy/${file%%:*}" || { echo "$file"; return 1; }
    done
}
ok "... and says who, when and which" says_so
finish
