#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# --crate: a run described for archives, by the rules of RO-Crate 1.1 and of its profile Process Run Crate 0.5.
source "$(dirname "$0")/../shell.bash"
cd "$T" || exit 1
cat >scene.yaml <<'YAML'
title: A crate
chain: {beads: [{bead: large-steel, count: 8}], wall: rigid}
simulate: {until: 0.2 ms}
outputs:
  - {table: peaks.csv, show: peaks}
  - {table: "inside/100 % energy.csv", show: energy}
  - {trajectory: a.h5}
YAML
ok "a run with a crate" exits 0 "$beadsim" scene.yaml -o run --crate --set simulate.until='0.25 ms'
cat >check.py <<'PY'
import datetime, json, os, sys, urllib.parse
folder, files, program = sys.argv[1], sorted(sys.argv[3:]), sys.argv[2]
crate = json.load(open(folder + "/ro-crate-metadata.json"))
assert crate["@context"] == "https://w3id.org/ro/crate/1.1/context"
by_id = {e["@id"]: e for e in crate["@graph"]}
assert len(by_id) == len(crate["@graph"])
def references(value):
    if isinstance(value, list):
        return [id for v in value for id in references(v)]
    return [value["@id"]] if isinstance(value, dict) else []
missing = {id for e in crate["@graph"] for v in e.values() for id in references(v)} - by_id.keys()
assert missing == {"https://w3id.org/ro/crate/1.1", "http://schema.org/CompletedActionStatus"}, missing # of the web
descriptor, root, action = by_id["ro-crate-metadata.json"], by_id["./"], by_id["#run"]
assert descriptor["about"] == {"@id": "./"} and descriptor["@type"] == "CreativeWork"
assert descriptor["conformsTo"] == {"@id": "https://w3id.org/ro/crate/1.1"}
assert root["@type"] == "Dataset" and root["name"] and root["description"] and root["license"]
datetime.datetime.fromisoformat(root["datePublished"].replace("Z", "+00:00"))
profile = by_id[root["conformsTo"]["@id"]]
assert profile["@id"] == "https://w3id.org/ro/wfrun/process/0.5" and profile["@type"] == "CreativeWork" and profile["version"] == "0.5"
# What the profile asks of an action, its program, and what it took and made.
assert root["mentions"] == {"@id": "#run"} and action["@type"] == "CreateAction" and action["startTime"] <= action["endTime"]
tool = by_id[action["instrument"]["@id"]]
assert tool["@type"] == "SoftwareApplication" and tool["name"] == program and tool["softwareVersion"]
assert action["object"] == {"@id": "ro-crate-scene.yaml"}
made = references(action["result"])
assert sorted(references(root["hasPart"])) == sorted(made + ["ro-crate-scene.yaml"])
assert sorted(urllib.parse.unquote(id) for id in made) == files, made
for id in made + ["ro-crate-scene.yaml"]:
    assert by_id[id]["@type"] == "File" and by_id[id]["encodingFormat"], id
    assert os.path.getsize(os.path.join(folder, urllib.parse.unquote(id))) == int(by_id[id]["contentSize"]), id
PY
ok "... which has what the profile asks for" python3 check.py run beadsim a.h5 'inside/100 % energy.csv' peaks.csv
again() { "$beadsim" run/ro-crate-scene.yaml -o again -q && cmp run/peaks.csv again/peaks.csv; }
ok "... and the scene as it was run: the same bits again" again
ok "one file: the crate is beside it" exits 0 "$beadreel" scene.yaml -o one/force.png --size 320x240 --crate
ok "... and has only this" python3 check.py one beadreel force.png
ok "where nothing is run it is refused" fails 2 "$beadsim" --plan scene.yaml --crate
ok "... with a word" says "--crate: has no effect here"
finish
