#!/usr/bin/env python3
"""webgpu_test.py SCRATCH: the light nodes under three's WebGPURenderer, in headless Chromium by WebGPU and by its WebGL back end, against the library's picture.

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
from three_test import BALL, BOUNDS, DISK, FOV, FRAME, GOLD, HEIGHT, TUBE, UPRIGHT, WIDTH, browser, np

CASES = [  # few: a browser without a GPU takes its time to compile them
    ("panel half below and disk, gold", [UPRIGHT, DISK], GOLD, 0.4),
    ("polygon with two holes, gold", [FRAME], GOLD, 0.3),
    ("tube and ball, gold", [TUBE, BALL], GOLD, 0.35),
]
WEBGPU = ["--enable-unsafe-webgpu", "--use-webgpu-adapter=swiftshader", "--enable-features=Vulkan"]


def main():
    chromium = browser.find()
    if chromium is None:
        common.skip("there is no Chromium here (apt-get install chromium)")
    three = common.three_from_npm(Path(sys.argv[1]))
    server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), functools.partial(common.Files, three=three))
    threading.Thread(target=server.serve_forever, daemon=True).start()
    eye, failed = [0, 1.6, 2.6], False
    browser.FLAGS += WEBGPU
    for webgl in (True, False):
        for name, lights, material, roughness in CASES:
            case = {"methods": ["compact", "closed-form"], "eye": eye, "fov": FOV, "width": WIDTH, "height": HEIGHT, "roughness": roughness, "webgl": webgl, **material,
                    "lights": [{**{k: v for k, v in light.items() if k != "place"}, "matrix": common.matrix_of(light["place"])} for light in lights]}

            def page(address):
                return f"http://127.0.0.1:{server.server_address[1]}/test/webgpu.html?case={urllib.parse.quote(json.dumps({**case, 'post': address}))}"

            words = browser.answer_of(chromium, page, timeout=250)
            if words.startswith("failed"):
                sys.exit(f"{name}, {'WebGL' if webgl else 'WebGPU'}: {words}")
            if words.startswith("none"):
                print("WebGPU was not tried: this Chromium has none")
                break
            want = common.judged(lights, material, roughness, eye)
            white = np.quantile(want, 0.999)
            for method, text in zip(case["methods"], words.split(" ")):
                got = np.frombuffer(base64.b64decode(text), np.float32).reshape(HEIGHT, WIDTH, 4)[..., :3]
                off = np.quantile(np.abs(got - want).max(axis=-1) / white, 0.995)
                mean = got.mean() / want.mean()
                print(f"{'WebGL' if webgl else 'WebGPU'}, {name}, {method}: mean ratio {mean:.4f}, 99.5 % of the pixels within {off:.4f} of white", flush=True)
                failed = failed or not abs(mean - 1) < BOUNDS[method][0] or not off < BOUNDS[method][1]
    sys.exit(bool(failed))


if __name__ == "__main__":
    main()
