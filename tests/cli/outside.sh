#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Scenes of strangers: files stay in the output directory, unless --allow-outside is given; directories inside it are made.
source "$(dirname "$0")/../shell.bash"
cd "$T" || exit 1
chain='chain: {striker: {bead: large-steel, velocity: 0.443 m/s}, beads: [{bead: large-steel, count: 5}]}'
film='movie: film.mp4, size: [160, 120], duration: 0.2 s, fps: 10'

# scene OUTPUT... : scene.yaml with these.
scene() {
    echo "$chain"
    echo 'outputs:'
    printf '  - {%s}\n' "$@"
} >scene.yaml
refused() { # WHAT, of the second output
    rm -rf made && fails 2 "$beadreel" scene.yaml -o made && says 'scene.yaml:4:5: ' && says "\`$1\` leaves the output directory" &&
        says --allow-outside && [ ! -e made ] && fails 2 "$beadreel" scene.yaml -o made --plan
}
for path in ../evil.csv a/../../evil.csv "$T/evil.csv" a/.. ..; do
    scene 'table: peaks.csv, show: peaks' "table: $path, show: bead-peaks"
    case $path in *.csv) ok "$path is refused" refused "$path" ;; *) ok "$path is refused" fails 2 "$beadreel" scene.yaml -o made ;; esac
done
scene 'table: peaks.csv, show: peaks' "$film, poster: ../evil.png"
ok "a poster outside is refused" refused ../evil.png
scene 'table: peaks.csv, show: peaks' "$film, slides: ../evil.html"
ok "slides outside are refused" refused ../evil.html
scene 'table: peaks.csv, show: peaks' "$film, poster: ../evil.png"
ok "... for beadsim, too" fails 2 "$beadsim" scene.yaml -o made
ok "no file was made" test ! -e evil.csv -a ! -e evil.png -a ! -e evil.html

allowed() { rm -rf made && exits 0 "$beadreel" scene.yaml -o made --allow-outside && [ -s evil.png ]; }
ok "--allow-outside" allowed
scene 'trajectory: run.h5' "$film, poster: ../evil.png"
redrawn() { rm -rf made && exits 0 "$beadreel" scene.yaml -o made --allow-outside && rm evil.png && mkdir -p in &&
    (cd in && fails 2 "$beadreel" ../made/run.h5 -o film.mp4 && says evil.png) && [ ! -e evil.png ]; }
ok "a poster that a trajectory names is refused" redrawn
scene 'trajectory: run.h5' "$film, poster: poster.png"
beside() { rm -rf made && exits 0 "$beadreel" scene.yaml -o made && mkdir -p in/sub &&
    (cd in && exits 0 "$beadreel" ../made/run.h5 -o sub/film.mp4 && [ -s sub/poster.png ] && [ ! -e poster.png ]); }
ok "... and one inside goes beside the movie" beside
scene 'table: sub/deep/peaks.csv, show: peaks' 'table: ..x/..csv, show: bead-peaks' 'image: a/b/c.png, size: [160, 120]'
inside() { rm -rf made && exits 0 "$beadreel" scene.yaml -o made && [ -s made/sub/deep/peaks.csv ] && [ -s made/..x/..csv ] && [ -s made/a/b/c.png ]; }
ok "directories inside are made" inside
ok "a trajectory is drawn wherever -o says" exits 0 bash -c "'$beadsim' scene.yaml --set 'outputs=[{trajectory: run.h5}]' -o made && cd in && '$beadreel' ../made/run.h5 -o ../other/new.png"

# Links of an archive that a stranger has packed.
scene 'table: figures/peaks.csv, show: peaks'
mkdir -p home archive/inside && echo precious >home/peaks.csv && ln -s ../home archive/figures && ln -s "$PWD/home" archive/absolute && ln -s inside archive/within
ok "a directory that is a link out of -o is refused" fails 2 "$beadsim" scene.yaml -o archive
ok "... in words" says "figures/peaks.csv\` leaves the output directory by a symbolic link"
ok "... an absolute one, too" fails 2 "$beadsim" scene.yaml -o archive --set outputs.0.table=absolute/peaks.csv
ok "... and one on the way" fails 2 "$beadsim" scene.yaml -o archive --set outputs.0.table=figures/new/peaks.csv
ok "nothing was overwritten" grep -q precious home/peaks.csv
ok "... but one that stays inside is followed" exits 0 "$beadsim" scene.yaml -o archive --set outputs.0.table=within/peaks.csv
ok "... and any with --allow-outside" exits 0 "$beadsim" scene.yaml -o archive --allow-outside
echo precious >home/hard && ln home/hard archive/h.csv.part
ok "an unfinished file with other names is refused" fails 1 "$beadsim" scene.yaml -o archive --set outputs.0.table=h.csv
ok "... and kept" grep -q precious home/hard
finish
