#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# What stands between this checkout and a release: release-check.sh TAG VERSION. The version has one place, api.h; where others say it,
# too, they must agree; the change log must have a date; and what only the owner knows must be filled in.
set -u
cd "$(dirname "$0")/.." || exit 1
tag=$1 version=$2 status=0
open() { echo "open: $*"; status=1; }
[ -z "$tag" ] || [ "$tag" = "v$version" ] || open "the tag is $tag, the version in include/beadreel/api.h is $version"
[ "$(sed -n '1s/.*(\(.*\)).*/\1/p' debian/changelog)" = "$version" ] || open "debian/changelog begins with another version"
grep -q "^version: $version$" CITATION.cff || open "CITATION.cff has another version"
grep -q "^## \[$version\] - [0-9]\{4\}-[0-9][0-9]-[0-9][0-9]$" CHANGELOG.md || open "CHANGELOG.md has no date for $version"
grep -q '^date-released: 2' CITATION.cff || open "CITATION.cff has no date-released"
while IFS=: read -r file line text; do open "$file:$line: what only the owner knows: $text"; done < <(
    grep -nE '^OWNER += OWNER$|name: The beadreel authors' Makefile CITATION.cff assets/package/paper.md)
[ $status -ne 0 ] || echo "Nothing stands between this commit and v$version."
exit $status
