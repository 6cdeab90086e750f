#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Validates scenes against the JSON Schema: schema.py SCHEMA. python3-jsonschema and python3-yaml are needed. Prints TAP.

Ready scenes, golden scenes and the examples of the manual must pass. Of tests/bad, those that are wrong in their structure must not:
unknown keys, keys of another kind, what is missing, maps and lists and words in place of others. The rest is nothing that a schema
sees: units and what numbers with units are; names of materials, chains, sensors, files; values that do not go with others or with the
length of the chain; keys given twice or characters, which the YAML parser judges, and what needs the run.
"""
import glob
import json
import os
import re
import sys

import jsonschema
import yaml

from tap import finish, ok

# What messages about the structure say.
STRUCTURE = re.compile(
    r"unknown key|is a key of|is a map|is a list;|must be a map|must be a list|is an empty list|must be true or false|is not whole"
    r"|`(chain|outputs)` is missing|(chain|outputs|text|modulus|length|start|alpha|coefficient|at|beads|[a-z.0-9]*text): is missing")
# Structure that depends on the value of another key (which equation, what is shown), or on units.
UNSEEN = {"equation-start-of-another", "panels-beside-field", "profiles-without-times", "table-of-profiles-without-times",
          "sensitivities-of-half-a-contact"}


def wrong(validator, path):
    """What is wrong with the scene, the first of it; None: nothing. What is no YAML is wrong."""
    try:
        with open(path, encoding="utf-8") as file:
            scene = yaml.safe_load(file)
    except (yaml.YAMLError, RecursionError, ValueError) as error:
        return str(error)
    for error in validator.iter_errors(scene):
        return f"{path}: {'.'.join(map(str, error.absolute_path))}: {error.message[:200]}"
    return None


def names_schema(path):
    """Does the first line say where the schema is?"""
    with open(path, encoding="utf-8") as file:
        mark, _, place = file.readline().strip().partition("$schema=")
    place = os.path.join(os.path.dirname(path), place)
    return mark == "# yaml-language-server: " and os.path.exists(place) and os.path.samefile(place, "assets/scene.schema.json")


def main():
    with open(sys.argv[1], encoding="utf-8") as file:
        schema = json.load(file)
    jsonschema.Draft7Validator.check_schema(schema)
    validator = jsonschema.Draft7Validator(schema)
    ok(schema["additionalProperties"] is False, "it is a JSON Schema")
    for folder in ("assets/scenes/**", "tests/golden"):
        scenes = sorted(glob.glob(folder + "/*.yaml", recursive=True))
        told = [error for error in (wrong(validator, path) for path in scenes) if error]
        ok(len(scenes) > 10 and not told, f"{len(scenes)} scenes of {folder.rstrip('/*')} pass", *told)
    unnamed = [path for path in glob.glob("assets/scenes/**/*.yaml", recursive=True) if not names_schema(path)]
    ok(not unnamed, "ready scenes name it to editors", *unnamed)
    bad = sorted(glob.glob("tests/bad/*.yaml"))
    refused, missed = 0, []
    for path in bad:
        found = wrong(validator, path)
        with open(path, encoding="utf-8", errors="replace") as file:
            expected = file.readline()
        refused += found is not None
        if found is None and STRUCTURE.search(expected) and os.path.basename(path)[:-5] not in UNSEEN:
            missed.append(f"{path} {expected.strip()}")
    ok(len(bad) > 200 and not missed, "wrong structures are refused", *missed)
    ok(refused >= 80, f"{refused} of {len(bad)} wrong scenes are refused")
    finish()


main()
