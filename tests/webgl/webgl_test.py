#!/usr/bin/env python3
"""webgl_test.py PICTURE_PROGRAM: the page of examples/webgl in headless Chromium against the library's picture.

At most 2/255 in every channel on 99.9 % of the pixels. Exit 77 (skipped) where there is no Chromium.
"""
import base64
import re
import shutil
import subprocess
import sys
import tempfile
import time
from pathlib import Path

PAGE = Path(__file__).resolve().parent.parent.parent / "examples" / "webgl" / "index.html"
WIDTH, HEIGHT = 320, 240
NAMES = ("orbit", "height", "size", "tilt", "intensity", "exposure", "roughness", "f0", "exponent", "gain")
AFAR = (0.45, 1.3, 1.6, 35, 5, 0)
HALF_BELOW = (0.2, 0.1, 2.0, 90, 8, 0.5)  # the floor cuts the upright light
CASES = [  # setup, method, the other method of a difference
    ((*AFAR, 0.3, 0.5, 60, 1), "lambert", ""),
    ((*HALF_BELOW, 0.3, 0.5, 60, 1), "lambert", ""),
    ((-0.6, 0.3, 3.0, 0, 3, 1, 0.3, 0.5, 60, 1), "lambert", ""),  # large and low, flat
    ((2.8, 1.0, 1.2, 60, 12, -1, 0.3, 0.5, 60, 1), "lambert", ""),  # from behind
    ((*AFAR, 0.25, 0.5, 60, 1), "ltc-compact", ""),
    ((*HALF_BELOW, 0.5, 0.04, 60, 1), "ltc-compact", ""),
    ((*AFAR, 0.25, 0.5, 60, 1), "closed-form-draft", ""),
    ((*AFAR, 0.25, 0.5, 60, 1), "closed-form", ""),
    ((*HALF_BELOW, 0.5, 0.04, 60, 1), "closed-form", ""),
    ((*AFAR, 0.3, 0.5, 60, 1), "series", ""),
    ((*HALF_BELOW, 0.3, 0.5, 12, 1), "series", ""),
    ((*AFAR, 0.5, 0.5, 60, 16), "ltc-compact", "closed-form"),
    ((*HALF_BELOW, 0.5, 0.04, 60, 16), "closed-form-draft", "closed-form"),
]
FLAGS = ["--headless", "--no-sandbox", "--disable-gpu", "--use-gl=angle", "--use-angle=swiftshader",
         "--enable-unsafe-swiftshader", "--disable-quic", "--no-first-run", "--disable-background-networking",
         "--disable-component-update", "--disable-sync", "--virtual-time-budget=20000"]


def browser_pixels(browser, setup, method, other):
    query = "&".join(f"{n}={v}" for n, v in zip(NAMES, setup)) + f"&method={method}&other={other}"
    with tempfile.TemporaryDirectory() as profile:
        done = subprocess.run([browser, *FLAGS, f"--user-data-dir={profile}", "--dump-dom",
                               f"file://{PAGE}?test={WIDTH}x{HEIGHT}&{query}"], capture_output=True, text=True, timeout=120)
    match = re.search(r'<pre id="pixels">([^<]*)</pre>', done.stdout)
    if not match:
        words = re.search(r'id="footer">([^<]*)<', done.stdout)
        sys.exit(f"the page gave no pixels: {words.group(1) if words else done.stderr[-2000:]}")
    return base64.b64decode(match.group(1))


def main():
    browser = next((b for b in ("chromium", "chromium-browser", "google-chrome") if shutil.which(b)), None)
    if browser is None:
        print("skipped: no Chromium here (apt-get install chromium)")
        sys.exit(77)
    failed = False
    for setup, method, other in CASES:
        begin = time.monotonic()
        got = browser_pixels(browser, setup, method, other)
        seconds = time.monotonic() - begin
        numbers = map(str, (WIDTH, HEIGHT, *setup))
        names = [n for n in (method, other) if n]
        want = subprocess.run([sys.argv[1], *numbers, *names], capture_output=True, check=True).stdout
        count = WIDTH * HEIGHT
        worst = [max(abs(got[4 * i + c] - want[3 * i + c]) for c in range(3)) for i in range(count)]
        off = sum(w > 2 for w in worst)
        lit = sum(want[3 * i] > 40 for i in range(count))
        print(f"{' minus '.join(names)}, {dict(zip(NAMES, setup))}: {off} of {count} pixels off by more than 2/255, {lit} lit, "
              f"{sum(w > 0 for w in worst)} differ at all, {seconds:.1f} s")
        failed = failed or off > count / 1000 or lit < count / 20
    sys.exit(failed)


if __name__ == "__main__":
    main()
