#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Every source names its licence.
source "$(dirname "$0")/shell.bash"
if git -C "$top" rev-parse -q --verify HEAD >/dev/null 2>&1; then
    ok "every source has its SPDX line (tests/spdx.sh --write adds it)" "$top/tests/spdx.sh"
else
    skip "a git checkout" "every source has its SPDX line"
fi
cd "$T" || exit 1
written() { # FILE FIRST-LINE : the line comes, once, and behind a first line that must stay the first
    printf '%s\nrest\n' "$2" >"$1"
    ! "$top/tests/spdx.sh" "$1" >/dev/null && "$top/tests/spdx.sh" --write "$1" && "$top/tests/spdx.sh" --write "$1" && "$top/tests/spdx.sh" "$1" &&
        [ "$(grep -c SPDX "$1")" -eq 1 ] && [ "$(wc -l <"$1")" -eq 3 ] && [ "$(tail -n 1 "$1")" = rest ] && sed -n "$3p" "$1" | grep -q SPDX
}
ok "a C file gets it as its first line" written a.c '/* What it is for. */' 1
ok "a script behind its interpreter" written a.sh '#!/bin/bash' 2
ok "a shader behind its version" written a.frag '#version 330 core' 2
ok "a man page in a comment of its own" written a.1 '.TH A 1' 1
ok "a scene is left as it is" bash -c "echo 'title: a' >a.yaml && '$top/tests/spdx.sh' --write a.yaml && [ \"\$(cat a.yaml)\" = 'title: a' ]"
finish
