# SPDX-License-Identifier: GPL-3.0-or-later
"""Give a talk with a page of slides in a headless Chromium: slides.py CHROMIUM PAGE. Prints TAP."""
import os
import sys
import time

from devtools import Browser
from tap import finish, ok

browser = Browser(sys.argv[1])
browser.open("file://" + os.path.abspath(sys.argv[2]))


def wait(script):
    """What the script says, as soon as it is true; at most 20 s."""
    until, said = time.time() + 20, None
    while not said and time.time() < until:
        said = browser.run(script)
        time.sleep(0.02)
    return said


def halt():
    """Where the film halts."""
    wait("video.paused && !video.seeking")
    return browser.run("video.currentTime")


def play(key):
    browser.press(key)
    wait("!video.paused || video.ended")
    return halt()


wait("video.readyState > 1")
stops, end = browser.run("stops"), browser.run("video.duration")
ok(halt() == 0, "slides wait at their start")
for index, key in enumerate(["ArrowRight", "PageDown", "Enter"]):
    place, wanted = play(key), (stops + [end])[index]
    ok(abs(place - wanted) < 0.02, "%s plays on, up to %.2f s" % (key, wanted), "it halts at %s" % place)
browser.press("ArrowLeft")
place = halt()
ok(abs(place - stops[-1]) < 0.02, "ArrowLeft goes back to the last stop", place)
browser.press("ArrowRight")
wait("!video.paused")
browser.press("Home")
ok(halt() == 0, "Home goes back to the start and waits there, also while the film plays")
place = play("ArrowDown")
ok(abs(place - stops[0]) < 0.02, "... and from there to the first stop", "it halts at %s" % place)
browser.close()
finish()
