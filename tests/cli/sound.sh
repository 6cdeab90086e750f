#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Sound of movies as a user asks for it: what is refused, which tracks a file has, and whether what is heard is the force of the table.
source "$(dirname "$0")/../shell.bash"
plain_canvas
cd "$T" || exit 1
cat >scene.yaml <<'YAML'
chains:
  - name: left
    striker: {bead: large-steel, velocity: 0.443 m/s}
    beads: [{bead: large-steel, count: 6}, {bead: large-steel, sensor: near}, {bead: large-steel, count: 5}]
    wall: brass
  - name: right
    striker: {bead: large-steel, velocity: 0.443 m/s}
    beads: [{bead: large-steel, count: 12}]
simulate: {until: 0.4 ms}
outputs:
  - {movie: film.mp4, sound: sensor near, from: 0.05 ms, until: 0.3 ms, views: [beads], size: [160, 90], fps: 25, card: 0.4 s,
     speed: [{at: 0.1 ms, factor: 1/4000}, {at: 0.2 ms, factor: 1/16000}]}
  - {table: near.csv, show: sensors, every: 0.1 us}
  - {trajectory: run.h5, fields: [force], every: 0.2 us}
YAML
refused() { "$beadreel" scene.yaml --plan --set "outputs=[{movie: $1}]" >out 2>&1; [ $? = 2 ] && grep -qF -- "$2" out || { cat out; return 1; }; }
ok "a format without sound is refused" refused 'a.gif, sound: wall' 'a.gif: gif files cannot have sound (`sound`); mp4, mov, mkv and webm files can'
ok "... APNG, too" refused 'a.apng, sound: contact 2' 'apng files cannot have sound'
ok "a contact that no chain has" refused 'a.mp4, sound: contact 13' 'sound: is 13, but the last contact is 12'
ok "a sensor that no chain has" refused 'a.mp4, sound: sensor far' 'sound: no chain has a sensor `far`'
ok "no number of a contact" refused 'a.mp4, sound: contact two' 'sound: `two` is not a number; must be a whole number'
ok "a sensor without a name" refused 'a.mp4, sound: sensor' 'must be off, wall, contact NUMBER, contact last or sensor NAME'
ok "a negative contact" refused 'a.mp4, sound: contact -1' 'sound: `-1` is out of range'
ok "a film of hours" refused 'a.mp4, sound: wall, fps: 1, duration: 4000 s' 'sound: a movie with sound lasts at most 3600 s'
ok "... of an hour is not" exits 0 "$beadreel" scene.yaml --plan --set 'outputs=[{movie: a.mp4, sound: wall, fps: 1, duration: 3600 s}]'
ok "the last contact may be heard" exits 0 "$beadreel" scene.yaml --plan --set 'outputs=[{movie: a.mp4, sound: contact 12}]'
ok "a transparent mp4 is refused" refused 'a.mp4, background: none' 'mp4 files cannot be transparent (`background: none`); mov, webm, webp, apng and png files can'

ok "a film with sound" exits 0 "$beadreel" scene.yaml -o .
for name in film.mov film.mkv film.webm; do
    ok "... $name" exits 0 "$beadreel" scene.yaml -o . --only "$name" --set outputs.0.movie="$name"
done
ok "the same from a trajectory" exits 0 "$beadreel" run.h5 -o again.mp4 --set outputs.0.sound='sensor near' --set 'outputs.0.views=[profile]' \
    --set 'outputs.0.size=[160, 90]'
if command -v ffprobe >/dev/null && command -v ffmpeg >/dev/null; then
    tracks() { ffprobe -v error -show_entries stream=codec_name,channels,r_frame_rate -of csv=p=0 "$1" | tr '\n' ';'; }
    rates() { ffprobe -v error -select_streams v -show_entries packet=duration_time,pts_time -of csv=p=0 "$1" | awk -F, 'NR > 1 && ($1 - last - 0.04 > 0.0011 || last + 0.04 - $1 > 0.0011) {bad = 1; print last, $1} {last = $1} END {exit bad || NR < 50}'; }
    for pair in mp4:h264:aac mov:prores:aac mkv:h264:opus webm:vp9:opus; do
        IFS=: read -r name video sound <<<"$pair"
        ok "film.$name has $video and $sound, two channels" [ "$(tracks "film.$name")" = "$video,25/1;$sound,2,0/0;" ]
        ok "... at a constant rate of pictures" rates "film.$name"
        ok "... and is not damaged" [ -z "$(ffmpeg -v error -i "film.$name" -f null - 2>&1)" ]
    done
    hear() { ffmpeg -v error -y -i "$1" -map 0:a -f f32le sound.raw; }
    # The film's clock: speed even on a logarithmic scale between the points, constant beyond them.
    heard() {
        hear film.mp4 && /usr/bin/python3 - <<'PYTHON'
import bisect, csv, math, struct
rows = [r for r in csv.reader(open("near.csv")) if not r[0].startswith("#")]
at = [float(r[0]) for r in rows[1:]]
force = [float(r[1]) for r in rows[1:]]
def interpolate(t):
    i = min(max(bisect.bisect(at, t), 1), len(at) - 1)
    return force[i - 1] + (force[i] - force[i - 1]) * (t - at[i - 1]) / (at[i] - at[i - 1])
begin, a, b, end = 0.05e-3, 0.1e-3, 0.2e-3, 0.3e-3
slow, slower = 1 / 4000, 1 / 16000
bend = math.log(slower / slow)
first, second = (a - begin) / slow, (b - a) / slow * -math.expm1(-bend) / bend
length = first + second + (end - b) / slower
def motion(film):
    if film < first:
        return begin + film * slow
    if film < first + second:
        return a - (b - a) / bend * math.log1p(-(film - first) * slow * bend / (b - a))
    return min(end, b + (film - first - second) * slower)
data = open("sound.raw", "rb").read()
both = struct.unpack("<%df" % (len(data) // 4), data)
left, right = both[0::2], both[1::2]
frames = round(length * 25)
assert abs(len(left) / 48000 - 0.4 - frames / 25) < 0.03, len(left)
stretch = length / ((frames - 1) / 25)
wanted = [0 if n < 19200 else interpolate(motion((n / 48000 - 0.4) * stretch)) for n in range(int((0.4 + (frames - 1) / 25) * 48000))]
scale = 0.89 / max(wanted)
error = math.sqrt(sum((left[n] - scale * w) ** 2 for n, w in enumerate(wanted)) / sum((scale * w) ** 2 for w in wanted))
arrives = next(n for n, w in enumerate(wanted) if w * scale > 0.05) / 48000
onset = next(n for n, v in enumerate(left) if v > 0.05) / 48000
assert error < 0.02, "differs by %g" % error
assert abs(onset - arrives) < 0.04, "begins at %g s of the film; the force arrives at %g s" % (onset, arrives)
assert 0.85 < max(left) < 0.93, "largest %g" % max(left)
assert max(map(abs, right)) < 1e-3, "the other chain, without the sensor, is heard"
PYTHON
    }
    ok "what is heard is the force of the table, at the speed of the film" heard
    loud() { hear again.mp4 && od -An -tf4 -w4 -v sound.raw | awk '$1 > 0.8 {found = 1} END {exit !found}'; }
    ok "a film from a trajectory is heard" loud
else
    skip "ffmpeg" "tracks and what is heard"
fi
finish
