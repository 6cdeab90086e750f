#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Make the README's gallery: make.sh BEADREEL DIRECTORY. Runs the commands that the README shows, as they stand there, and copies
# the pictures that it shows. They are small, since they are kept with the sources. Beside the directory comes readme.png, a frame of
# the demo.
set -eu
program=$(realpath "$1") to=$(realpath "$2")
cd "$(dirname "$0")/../.."
T=$(mktemp -d)
trap 'rm -rf "$T"' EXIT
beadreel() { "$program" "$@" --no-config --progress none -o "$T"; }
while IFS= read -r line; do
    eval "$line" </dev/null
done < <(sed -n '/^## Gallery/,/^## /p' README.md | grep '^beadreel ')
sed -n 's,.*(assets/gallery/\([^)]*\)).*,\1,p' <(grep -o '(assets/gallery/[^)]*)' README.md) | while read -r picture; do
    cp "$T/$picture" "$to"
done
"$program" clean-vs-delocalised --frame 2ms --size 1280x720 --canvas plain --progress none -o "$(dirname "$to")/readme.png"
