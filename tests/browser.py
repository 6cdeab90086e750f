# SPDX-License-Identifier: GPL-3.0-or-later
"""Open pictures and movies in a headless Chromium: browser.py CHROMIUM DIRECTORY FILE...

A server on localhost gives the files to a page that plays and draws them, and takes its findings. Prints TAP.
"""
import http.server
import json
import os
import subprocess
import sys
import tempfile
import threading

from tap import finish, ok

PAGE = r"""<!DOCTYPE html><meta charset="utf-8"><body><script>
const files = %s, found = [];
const wait = s => new Promise(done => setTimeout(done, 1000 * s));
const tell = (good, what) => found.push([good, what]);
/* Pixels of what is shown: colours (to 32 levels), and all of them, for comparison. */
function look(source, width, height) {
    const canvas = document.createElement('canvas');
    canvas.width = width, canvas.height = height;
    const context = canvas.getContext('2d');
    context.drawImage(source, 0, 0, width, height);
    const data = context.getImageData(0, 0, width, height).data, colours = new Set();
    let brightest = 0, clear = 0, opaque = 0;
    for (let i = 0; i < data.length; i += 4) {
        clear += data[i + 3] == 0;
        opaque += data[i + 3] == 255;
        colours.add((data[i] >> 3) << 10 | (data[i + 1] >> 3) << 5 | data[i + 2] >> 3);
        brightest = Math.max(brightest, data[i], data[i + 1], data[i + 2]);
    }
    return {data, colours: colours.size, brightest, clear, opaque};
}
/* Files named so have nothing behind what they show; the corner is empty, to the one level that VP9's lossy alpha may leave. */
function transparent(name, shown) {
    if (/^clear/.test(name))
        tell(shown.data[3] <= (name.endsWith('.webm') ? 1 : 0) && shown.clear > 100 && shown.opaque > 100, `${name} is transparent: ${shown.clear} pixels are, ${shown.opaque} are opaque`);
    else
        tell(shown.opaque > 0.98 * shown.data.length / 4, `${name} is opaque`); /* the edges of drawings may lie within pixels */
}
function differ(a, b) {
    let count = 0;
    for (let i = 0; i < a.data.length; i += 4)
        count += Math.abs(a.data[i] - b.data[i]) + Math.abs(a.data[i + 1] - b.data[i + 1]) > 48;
    return count;
}
async function film(name) {
    const video = document.createElement('video'), times = [];
    video.muted = true;
    video.src = name;
    document.body.append(video);
    const ended = new Promise((done, failed) => {
        video.onended = () => done(true);
        video.onerror = () => failed(new Error('error ' + video.error.code + ': ' + video.error.message));
    });
    await video.play();
    const first = look(video, video.videoWidth, video.videoHeight);
    const watch = setInterval(() => times.push(video.currentTime), 50);
    const whole = await Promise.race([ended, wait(video.duration + 20).then(() => false)]);
    clearInterval(watch);
    const last = look(video, video.videoWidth, video.videoHeight);
    const steps = times.filter((t, i) => i > 0 && t > times[i - 1]).length;
    tell(steps > 5, `${name} plays: its time advanced ${steps} times`);
    tell(whole && Math.abs(video.currentTime - video.duration) < 0.1,
         `${name} reaches its end, ${video.currentTime.toFixed(2)} of ${video.duration.toFixed(2)} s`);
    tell(last.brightest > 200 && last.colours > 50, `${name} is not black: ${last.colours} colours, up to ${last.brightest}`);
    tell(differ(first, last) > 100, `${name} moves: ${differ(first, last)} pixels differ between its ends`);
    transparent(name, last);
    video.remove();
}
async function animation(name, type) {
    const image = new Image();
    image.src = name;
    document.body.append(image);
    await image.decode();
    const shown = [look(image, image.naturalWidth, image.naturalHeight)];
    tell(shown[0].colours > 20 && shown[0].brightest > 200, `${name} shows: ${shown[0].colours} colours`);
    const data = await (await fetch(name)).arrayBuffer(), decoder = new ImageDecoder({data, type});
    await decoder.tracks.ready;
    await decoder.completed;
    const track = decoder.tracks.selectedTrack, half = Math.floor(track.frameCount / 2);
    const frames = [];
    for (const frameIndex of [0, half])
        frames.push((await decoder.decode({frameIndex})).image);
    const [a, b] = frames.map(f => look(f, f.displayWidth, f.displayHeight));
    tell(track.animated && track.frameCount > 5, `${name} is an animation of ${track.frameCount} frames`);
    tell(track.repetitionCount === Infinity, `${name} loops for ever`);
    tell(differ(a, b) > 100, `${name} moves: ${differ(a, b)} pixels differ between its frames 0 and ${half}`);
    tell(b.colours > 20 && b.brightest > 200, `${name} is not black half way`);
    transparent(name, b);
    image.remove();
}
async function still(name) {
    const image = new Image();
    image.src = name;
    await image.decode();
    const shown = look(image, image.naturalWidth, image.naturalHeight);
    transparent(name, shown);
    tell(image.naturalWidth > 100 && shown.colours > 50, `${name} opens: ${image.naturalWidth} x ${image.naturalHeight}, ${shown.colours} colours`);
}
(async () => {
    for (const name of files) {
        try {
            if (/\.(mp4|webm)$/.test(name))
                await film(name);
            else if (/\.gif$/.test(name))
                await animation(name, 'image/gif');
            else if (/\.a?png$/.test(name))
                await animation(name, 'image/png');
            else
                await still(name);
        } catch (e) {
            tell(false, `${name}: ${e}`);
        }
    }
    await fetch('/found', {method: 'POST', body: JSON.stringify(found)});
})();
</script>"""


def main():
    chromium, directory, files = sys.argv[1], sys.argv[2], sys.argv[3:]
    done, findings = threading.Event(), []

    class Handler(http.server.SimpleHTTPRequestHandler):
        extensions_map = {".svg": "image/svg+xml", ".png": "image/png", ".apng": "image/png", ".gif": "image/gif", ".mp4": "video/mp4",
                          ".webm": "video/webm"}

        def __init__(self, *args):
            super().__init__(*args, directory=directory)

        def do_GET(self):
            if self.path != "/":
                return super().do_GET()
            page = (PAGE % json.dumps(files)).encode()
            self.send_response(200)
            self.send_header("Content-Type", "text/html")
            self.send_header("Content-Length", str(len(page)))
            self.end_headers()
            self.wfile.write(page)

        def do_POST(self):
            findings.append(self.rfile.read(int(self.headers["Content-Length"])).decode())
            self.send_response(204)
            self.end_headers()
            done.set()

        def log_message(self, *args):
            pass

    server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), Handler)
    threading.Thread(target=server.serve_forever, daemon=True).start()
    with tempfile.TemporaryDirectory() as profile:
        browser = subprocess.Popen(
            [chromium, "--headless", "--no-sandbox", "--disable-gpu", "--mute-audio", "--autoplay-policy=no-user-gesture-required",
             "--user-data-dir=" + profile, "--remote-debugging-port=0", "http://127.0.0.1:%d/" % server.server_port],
            stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, start_new_session=True)
        came = done.wait(180)
        os.killpg(browser.pid, 15)
        browser.wait()
    if not came:
        ok(False, "the browser said something in 180 s")
    for good, what in json.loads(findings[0]) if came else ():
        ok(good, what)
    finish()


main()
