#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Builds the same files in two directories, without ccache, and compares: tests/twice.sh FOLDER FILE... (below BUILD; make twice: all).
# Both builds stay in FOLDER, which must be new. Exit status 1: they differ, or one failed.
set -u
cd "$(dirname "$0")/.." || exit 1
folder=$1
shift
unset MAKEFLAGS MAKELEVEL MFLAGS BUILD CFLAGS # with -g, which has most to say of places
export CC=${CC:-cc}
CC=${CC#ccache }
mkdir -p "$folder" || exit 1
folder=$(cd "$folder" && pwd)
for place in a another/place; do # both before the first build: nobody waits for that to edit
    mkdir -p "$folder/$place" && cp -r Makefile include sim render assets "$folder/$place" || exit 1
done
for place in a another/place; do
    # What may differ between two machines: time, language, order of work.
    (cd "$folder/$place" && TZ=$([ $place = a ] && echo UTC || echo Asia/Tokyo) LC_ALL=$([ $place = a ] && echo C || echo C.UTF-8) \
        make -s -j"$([ $place = a ] && nproc || echo 1)" CC="$CC" CCACHE_DISABLE=1 "${@/#/build/}") || exit 1
done
sums() { (cd "$folder/$1/build" && find . -type f ! -name '*.d' ! -path './.*' -print0 | LC_ALL=C sort -z | xargs -0 sha256sum); }
diff <(sums a) <(sums another/place) || { echo "two builds differ"; exit 1; }
! grep -rlF "$folder" "$folder/a/build" "$folder/another/place/build" --exclude='*.d' || { echo "... name the directory that they were built in"; exit 1; }
echo "$(sums a | wc -l) files are the same"
