#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Slides are the finished film in one page, which stops in the middle of the frames at which the film's chapters begin.
source "$(dirname "$0")/../shell.bash"
plain_canvas
cd "$T" || exit 1
cat >talk.yaml <<'YAML'
chain: {striker: {velocity: 1 m/s}, beads: [{bead: brass, count: 8}]}
simulate: {until: 0.3 ms}
outputs: [{movie: talk.mp4, size: [320, 180], fps: 25, duration: 2 s, stops: [0.1 ms, 0.2 ms], slides: talk.html}]
YAML
ok "a film with slides" exits 0 "$beadreel" talk.yaml -o .
within() { sed -n 's/.*src="data:video\/mp4;base64,\([^"]*\)".*/\1/p' talk.html | base64 -d | cmp - talk.mp4; }
ok "the page holds the film, byte by byte" within
lacks() { ! grep -qE "$1" talk.html; }
ok "... with its sound" lacks "<video[^>]* muted"
ok "... and refers to nothing else" lacks "https?://"
stops=$(sed -n 's/^const stops = \[\([^]]*\)\].*/\1/p' talk.html)
if command -v ffprobe >/dev/null; then
    chapters=$(ffprobe -v error -show_chapters -of csv=p=0 talk.mp4 | awk -F, '$4 > 0 { printf "%s%.6f", n++ ? ", " : "", $4 + 0.02 }')
    ok "stops are half a frame behind the starts of chapters" test "$stops" = "$chapters"
    ok "... of which there are two" test "$(echo "$stops" | grep -o , | wc -l)" = 1
else
    skip "stops and chapters" "ffprobe"
fi
if find_browser; then
    run timeout 120 /usr/bin/python3 "$top/tests/slides.py" "$browser" talk.html
    relay
else
    skip "a Chromium that runs here (chromium)" "a talk is given by keys"
fi
finish
