#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# The manual: what its chapters say is done here, chapter by chapter, with smaller pictures; and its HTML is whole.
source "$(dirname "$0")/../shell.bash"
manual=$top/assets/manual
plain_canvas
# Debian's Python has h5py.
mkdir "$T/bin" && ln -s /usr/bin/python3 "$T/bin/python3"
export top PATH=$T/bin:$BUILD:$PATH PYTHONPATH=$top/assets/python BEADREEL=$beadreel
command -v python3 >/dev/null || { skip python3 "the chapters of the manual"; finish; }
works() { # CHAPTER
    local name
    name=$(basename "$1" .md)
    mkdir -p "$T/$name" && "$manual/make.py" script "$1" >"$T/$name.sh" && (cd "$T/$name" && bash "$T/$name.sh" >"$T/log" 2>&1) || { tail -n 5 "$T/log"; return 1; }
}
for chapter in "$manual"/*.md; do
    if [ "$(basename "$chapter")" = python.md ] && ! python3 -c 'import h5py, numpy' 2>/dev/null; then
        skip python3-h5py "the commands of python.md work"
    else
        ok "the commands of $(basename "$chapter") work" works "$chapter"
    fi
    while read -r missing; do
        skip "what the manual needs: $missing" "a command of $(basename "$chapter")"
    done < <(cat "$T/$(basename "$chapter" .md)/missing" 2>/dev/null)
done

# What two waves that pass each other gain is what the chapter says, 0.4168 (m^2/(A^2 v))^(1/5) (test_starts), and what its commands print.
ahead() {
    local stated
    stated=$(sed -n 's/^The wave is \([0-9.]*\) us ahead.*/\1/p' "$manual/ask.md")
    [ -n "$stated" ] && (cd "$T/ask" && "$beadsim" two.yaml -q -o . --set 'outputs=[{table: chain.csv, show: chain}]' &&
        awk -F, -v s="$stated" 'NR == FNR {if (FNR == 4) {m = $3; A = $7} next} FNR > 1 {for (c = 2; c < 4; c++) if ($c + 0 > F[c]) {F[c] = $c; t[c] = $1}}
            END {d = (t[3] - t[2]) * 1e6; e = 0.4168 * (m * m / A / A / 0.4) ^ 0.2 * 1e6; print d, e, s; exit !((d - e) ^ 2 < 0.03 ^ 2 && (s - e) ^ 2 < 0.006 ^ 2)}' chain.csv shift.csv)
}
ok "two waves pass as early as the manual says" ahead

short() { # FILE... : scenes of the chapters, none longer than fifteen lines
    local scene
    for scene; do [ "$(wc -l <"$T/$scene")" -le 15 ] || { wc -l "$T/$scene"; return 1; }; done
}
ok "scenes for common tasks have at most fifteen lines" short figure/figure.yaml lecture/lecture.yaml lecture/loop.yaml recipes/three.yaml \
    recipes/defect.yaml recipes/cells.yaml sweep/sweep.yaml ask/glass.yaml ask/velocity.yaml ask/mean.yaml \
    ask/two.yaml sound/heard.yaml elsewhere/wave.yaml ask/gaps.yaml ask/run.yaml ask/spreading.yaml ask/pulse.yaml ask/decay.yaml

broken() { # a chapter with a command that fails, a file that is not made, another message
    printf '```sh\n%s\n```\n%s\n' "$1" "${2:-}" >"$T/broken.md"
    ! works "$T/broken.md" >/dev/null
}
ok "a command that fails is found" broken 'beadreel nothing.yaml'
ok "a file that is not made is found" broken 'true' '<!-- makes: nothing.png -->'
ok "a test elsewhere that is none is found" broken 'true' '<!-- elsewhere: tests/run.sh: nothing of the kind -->'

if command -v pandoc >/dev/null && command -v mandoc >/dev/null; then
    ok "the manual becomes HTML" env MANUAL=small "$manual/make.py" html "$BUILD" "$T/html"
    linked() { # every link and picture leads to a file; nothing comes from elsewhere
        local page link
        for page in "$T"/html/*.html; do
            for link in $(grep -oE '(href|src)="[^"#]+' "$page" | sed 's/.*="//'); do
                [[ $link == https://* || $link == mailto:* ]] && continue
                [ -s "$T/html/$link" ] || { echo "${page##*/}: $link"; return 1; }
            done
        done
        ! grep -lE '<script[^>]|src="http|@import|url\(|fetch\(' "$T"/html/*.html "$T"/html/*.css
    }
    ok "... whose links lead to files, and which needs no network" linked
    listed() { for f in "$manual"/*.md; do f=$(basename "$f" .md); grep -q "\"$f.html\"" "$T/html/index.html" || { echo "$f"; return 1; }; done; }
    ok "... with every chapter in its contents" listed
    reference() { # the page of a scene's keys: its headings in contents, the lines of its examples one below the other
        /usr/bin/python3 - "$T/html/beadreel-scene.5.html" "$top/assets/man/beadreel-scene.5" <<'PY'
import html, re, sys
page, source = (open(name, encoding="utf-8").read() for name in sys.argv[1:])
heads = re.findall(r'<h[12] class="S[hs]" id="([^"]*)"', page)
links = re.findall(r'href="#([^"]*)"', re.search(r'<nav class="contents".*?</nav>', page, re.S)[0])
assert len(heads) > 40 and links == heads, (len(heads), len(links))
shown = [html.unescape(e).strip().count("\n") for e in re.findall(r"<pre>(.*?)</pre>", page, re.S) if e.startswith("title: My first wave")]
written = re.search(r"\.EX\n(title: My first wave.*?)\n\.EE", source, re.S)[1].count("\n")
assert shown == [written] and "<br" not in "".join(re.findall(r"<pre>.*?</pre>", page, re.S)), (shown, written)
PY
    }
    ok "... the keys of a scene with contents and whole examples" reference
    searched() { # WORD : only the entries that have it are left
        /usr/bin/python3 - "$browser" "$T/html/beadreel-scene.5.html" "$1" <<PY
import sys
sys.path.insert(0, "$top/tests")
from devtools import Browser
page = Browser(sys.argv[1])
page.open("file://" + sys.argv[2])
page.run("document.getElementById('search').focus()")
page.call("Input.insertText", text=sys.argv[3])
page.settle()
left = page.run("[...document.querySelectorAll('.man dt')].filter(e => e.offsetHeight > 0).map(e => e.textContent + ' ' + (e.nextElementSibling || e).textContent)")
every = page.run("[...document.querySelectorAll('.man dt')].length")
page.close()
assert 0 < len(left) < every and all(sys.argv[3] in text for text in left), (len(left), every)
assert not page.errors, page.errors
PY
    }
    if find_browser; then ok "... and a search" searched magnify; else skip "a Chromium that runs here (chromium)" "... and a search"; fi
else
    skip pandoc,mandoc "the manual becomes HTML"
fi
finish
