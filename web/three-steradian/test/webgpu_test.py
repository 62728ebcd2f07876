#!/usr/bin/env python3
"""webgpu_test.py SCRATCH: the light nodes under three's WebGPURenderer, in headless Chromium by WebGPU and by its WebGL back end, against the library's picture.

Both forms of three's plug-in interface: a light's class knows its node (three 0.187 on), or renderer.library does (before; the version is OLDER's).
Exit 77 (skipped) as three_test.py; where Chromium has no WebGPU, only the WebGL back end is tried, and the test says so.
"""
import base64
import functools
import http.server
import json
import sys
import threading
import urllib.parse
from pathlib import Path

import three_test as common
from three_test import (AWAY, BALL, BOUNDS, BRUSHED, DISK, FRAME, GOLD, HEIGHT, LIGHTS_OF_A_FILE, PANEL, PLASTIC, SCALED_LIGHTS_OF_A_FILE, TUBE, UPRIGHT, VELVET, WIDTH,
                        browser, np)

OLDER = "three@0.186.1"

CASES = [  # few: a browser without a GPU takes its time to compile them
    ("panel half below and disk, gold", [UPRIGHT, DISK], GOLD, 0.4),
    ("polygon with two holes, gold", [FRAME], GOLD, 0.3),
    ("tube and ball, gold", [TUBE, BALL], GOLD, 0.35),
    ("panel on velvet", [PANEL, BALL], VELVET, 0.6),
    ("panel on brushed metal", [PANEL], BRUSHED, 0.4),
    ("lights of a glTF file, plastic", LIGHTS_OF_A_FILE, PLASTIC, 0.35),
    ("lights of scaled nodes of a glTF file, plastic", SCALED_LIGHTS_OF_A_FILE, PLASTIC, 0.35),
]
BY_LIBRARY = ("panel and disk by renderer.library, gold", [UPRIGHT, AWAY], GOLD, 0.4)
WEBGPU = ["--enable-unsafe-webgpu", "--use-webgpu-adapter=swiftshader", "--enable-features=Vulkan"]


def pictures(chromium, port, case, what):
    """By method; None where there is no WebGPU."""
    def page(address):
        return f"http://127.0.0.1:{port}/test/webgpu.html?case={urllib.parse.quote(json.dumps({**case, 'post': address}))}"

    words = browser.answer_of(chromium, page, timeout=250)
    if words.startswith("failed"):
        sys.exit(f"{what}: {words}")
    if words.startswith("none"):
        return None
    return {m: np.frombuffer(base64.b64decode(text), np.float32).reshape(HEIGHT, WIDTH, 4)[..., :3] for m, text in zip(case["methods"], words.split(" "))}


def agrees(chromium, three, tried, webgl, **more):
    """Whether all is within the bounds; None where there is no WebGPU."""
    name, lights, material, roughness = tried
    eye, good = [0, 1.6, 2.6], True
    server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), functools.partial(common.Files, three=three))
    threading.Thread(target=server.serve_forever, daemon=True).start()
    case, want = common.case_of(name, lights, material, roughness, ["compact", "closed-form"], eye)
    case |= {"webgl": webgl, **more}
    found = pictures(chromium, server.server_address[1], case, name)
    server.shutdown()
    if found is None:
        return None
    white = np.quantile(want, 0.999)
    for method, got in found.items():
        off = np.quantile(np.abs(got - want).max(axis=-1) / white, 0.995)
        mean = got.mean() / want.mean()
        print(f"{'WebGL' if webgl else 'WebGPU'}, {name}, {method}: mean ratio {mean:.4f}, 99.5 % of the pixels within {off:.4f} of white", flush=True)
        good = good and abs(mean - 1) < BOUNDS[method][0] and off < BOUNDS[method][1]
    return good


def main():
    chromium = browser.find()
    if chromium is None:
        common.skip("there is no Chromium here (apt-get install chromium)")
    scratch = Path(sys.argv[1])
    three, older = common.three_from_npm(scratch), common.three_from_npm(scratch / "older", OLDER)
    browser.FLAGS += WEBGPU
    good = []
    for webgl in (True, False):
        for tried in CASES:
            good.append(agrees(chromium, three, tried, webgl))
            if good[-1] is None:
                print("WebGPU was not tried: this Chromium has none")
                good.pop()
                break
    good.append(agrees(chromium, three, BY_LIBRARY, True, byLibrary=True))
    good.append(agrees(chromium, older, (f"panel and disk under {OLDER}, gold", *BY_LIBRARY[1:]), True))
    sys.exit(not all(good))


if __name__ == "__main__":
    main()
