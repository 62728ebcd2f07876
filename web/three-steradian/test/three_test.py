#!/usr/bin/env python3
"""three_test.py SCRATCH: three.js with this package, in headless Chromium, against the library's own picture.

three.js comes from npm into SCRATCH. Exit 77 (skipped) where there is no npm, no Chromium or no Python module.
"""
import base64
import functools
import http.server
import json
import math
import re
import shutil
import subprocess
import sys
import tempfile
import threading
import urllib.parse
from pathlib import Path

PACKAGE = Path(__file__).resolve().parent.parent
THREE = "three@0.187.0"
WIDTH, HEIGHT, FOV = 64, 48, 50
FLAGS = ["--headless", "--no-sandbox", "--disable-gpu", "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader",
         "--disable-quic", "--no-first-run", "--disable-background-networking", "--disable-component-update", "--disable-sync",
         "--virtual-time-budget=60000"]


def skip(why):
    print(f"skipped: {why}")
    sys.exit(77)


try:
    import numpy as np
    import steradian
except ImportError as e:
    skip(f"the Python module is not built: {e}")


def three_from_npm(scratch):
    if not shutil.which("npm"):
        skip("npm is not installed (apt-get install npm)")
    scratch.mkdir(parents=True, exist_ok=True)
    folder = scratch / "node_modules" / "three"
    if not (folder / "build" / "three.module.js").exists():
        (scratch / "package.json").write_text('{"private": true}\n')
        try:
            done = subprocess.run(["npm", "install", "--no-audit", "--no-fund", THREE], cwd=scratch, capture_output=True, text=True, timeout=100)
        except subprocess.TimeoutExpired:
            skip(f"npm install {THREE} took too long")
        if done.returncode != 0:
            skip(f"npm install {THREE} failed: {done.stderr.strip()[:300]}")
    return folder


class Files(http.server.SimpleHTTPRequestHandler):
    """/package/... is this package, /three/... is three, /test/... are the pages of this folder."""

    extensions_map = {".js": "text/javascript", ".html": "text/html", "": "application/octet-stream"}

    def __init__(self, *arguments, three, **keys):
        self.roots = {"package": PACKAGE, "three": three, "test": PACKAGE / "test"}
        super().__init__(*arguments, **keys)

    def translate_path(self, path):
        parts = [p for p in urllib.parse.urlparse(path).path.split("/") if p not in ("", "..")]
        return str(self.roots.get(parts[0] if parts else "", PACKAGE / "nothing").joinpath(*parts[1:]))

    def log_message(self, *_):
        pass


# ---- What is rendered ----------------------------------------------------------------------------------------------


def placed(center, aim):
    """A matrix that puts a light somewhere and turns its -z along aim: columns x, y, z, and the place."""
    z = -np.array(aim, float) / np.linalg.norm(aim)
    x = np.cross([0.0, 1, 0.1], z)
    x /= np.linalg.norm(x)
    return np.stack([x, np.cross(z, x), z, np.array(center, float)])


def rect(center, aim, width, height, radiance):
    return {"type": "rect", "place": placed(center, aim), "width": width, "height": height, "radiance": radiance}


PANEL = rect([0, 1.2, -0.6], [0, -0.6, 0.4], 1.6, 0.9, [5, 4, 3])
UPRIGHT = rect([0, 0.2, -1], [0, 0, 1], 2, 1.2, [3, 3, 3])  # the floor cuts it
ELL = {"type": "polygon", "place": placed([-0.9, 0.9, 0], [0.5, -1, 0.2]), "outline": [[0, 0], [0.9, 0], [0.9, 0.3], [0.4, 0.3], [0.4, 0.8], [0, 0.8]],
       "radiance": [6, 5, 4]}
DISK = {"type": "disk", "place": placed([0.9, 0.8, -0.5], [-0.3, -1, 0.3]), "radius": 0.35, "radiance": [4, 5, 6]}
BALL = {"type": "sphere", "place": placed([0.2, 0.5, 0.4], [0, -1, 0.1]), "radius": 0.15, "radiance": [9, 8, 7]}
GOLD = {"color": [0.9, 0.6, 0.3], "metalness": 1}
PLASTIC = {"color": [0.5, 0.4, 0.3], "metalness": 0}
CASES = [  # name, lights, material, roughness
    ("panel on gold", [PANEL], GOLD, 0.25),
    ("panel on plastic", [PANEL], PLASTIC, 0.5),
    ("half below, gold", [UPRIGHT], GOLD, 0.5),
    ("polygon, gold", [ELL], GOLD, 0.3),
    ("disk and ball, gold", [DISK, BALL], GOLD, 0.4),
    ("all, plastic", [PANEL, ELL, DISK, BALL], PLASTIC, 0.3),
]
WITH_THREE_S_OWN = ("panel on gold", "half below, gold")
# Of each method: how far the mean may be off, and by how much of white the pixels that are not among the best 99.5 %.
BOUNDS = {"closed-form": (0.005, 2 / 255), "compact": (0.03, 0.06)}


def eval_light(light):
    x, y, z, center = light["place"]
    found = {"radiance": light["radiance"]}
    if light["type"] == "rect":  # lit along -z: x cross y is -z
        return {**found, "type": "rect", "center": center, "x": -x * light["width"] / 2, "y": y * light["height"] / 2}
    if light["type"] == "disk":
        return {**found, "type": "disk", "center": center, "x": -x * light["radius"], "y": y * light["radius"]}
    if light["type"] == "sphere":
        return {**found, "type": "sphere", "center": center, "radius": light["radius"]}
    corners = [center + x * u + y * v for u, v in light["outline"]]
    return {**found, "type": "polygon", "vertices": [c.tolist() for c in reversed(corners)]}  # the outlines here run counter-clockwise


def judged(lights, material, roughness, eye):
    """The picture, in double: Lambert exactly, GGX in closed form of high quality."""
    eye = np.array(eye, float)
    forward = -eye / np.linalg.norm(eye)
    right = np.cross(forward, [0, 1, 0])
    right /= np.linalg.norm(right)
    up = np.cross(right, forward)
    t = math.tan(math.radians(FOV) / 2)
    i, j = np.meshgrid(np.arange(WIDTH), np.arange(HEIGHT))  # the lowest row first
    ray = forward + right * ((2 * i + 1 - WIDTH) / HEIGHT * t)[..., None] + up * ((2 * j + 1) / HEIGHT - 1)[..., None] * t
    assert (ray[..., 1] < 0).all(), "the camera sees above the horizon"
    point = eye - ray * (eye[1] / ray[..., 1])[..., None]
    color, metal = np.array(material["color"]), material["metalness"]
    lobes = [{"brdf": "ggx", "roughness": roughness, "f0": color * metal + 0.04 * (1 - metal), "f90": 1}]
    if metal < 1:
        lobes.append({"brdf": "lambert", "albedo": color * (1 - metal)})
    return sum(steradian.radiance([eval_light(light) for light in lights], point, [0, 1, 0], -ray, lobe, quality="high") for lobe in lobes)


def browser_pixels(browser, port, case):
    query = urllib.parse.quote(json.dumps(case))
    with tempfile.TemporaryDirectory() as profile:
        done = subprocess.run([browser, *FLAGS, f"--user-data-dir={profile}", "--dump-dom", f"http://127.0.0.1:{port}/test/page.html?case={query}"],
                              capture_output=True, text=True, timeout=300)
    found = re.search(r"(pixels|failed):([^:]*(?::[^<]*)?):", done.stdout, re.DOTALL)
    if not found or found.group(1) == "failed":
        sys.exit(f"the page gave no pixels: {found.group(2) if found else done.stdout[-500:] + done.stderr[-1500:]}")
    return [np.frombuffer(base64.b64decode(p), np.float32).reshape(HEIGHT, WIDTH, 4)[..., :3] for p in found.group(2).split(" ")]


def main():
    browser = next((b for b in ("chromium", "chromium-browser", "google-chrome") if shutil.which(b)), None)
    if browser is None:
        skip("there is no Chromium here (apt-get install chromium)")
    three = three_from_npm(Path(sys.argv[1]))
    server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), functools.partial(Files, three=three))
    threading.Thread(target=server.serve_forever, daemon=True).start()
    eye, failed, errors = [0, 1.6, 2.6], False, {}
    for name, lights, material, roughness in CASES:
        want = judged(lights, material, roughness, eye)
        white = np.quantile(want, 0.999)
        methods = ["compact", "closed-form"]
        if name in WITH_THREE_S_OWN:
            methods += ["tables", "three"]
        case = {"methods": methods, "eye": eye, "fov": FOV, "width": WIDTH, "height": HEIGHT, "roughness": roughness, **material,
                "lights": [{**{k: v for k, v in light.items() if k != "place"}, "matrix": matrix_of(light["place"])} for light in lights]}
        for method, got in zip(methods, browser_pixels(browser, server.server_address[1], case)):
            off = np.abs(got - want).max(axis=-1) / white
            mean, rms = got.mean() / want.mean(), np.sqrt(((got - want) ** 2).mean()) / np.sqrt((want ** 2).mean())
            errors.setdefault(method, []).append(rms)
            print(f"{name}, roughness {roughness}, {method}: mean ratio {mean:.4f}, relative rms {rms:.4f}, "
                  f"99.5 % of the pixels within {np.quantile(off, 0.995):.4f} of white", flush=True)
            if method in BOUNDS:
                failed = failed or abs(mean - 1) > BOUNDS[method][0] or not np.quantile(off, 0.995) < BOUNDS[method][1]
    ours, theirs = np.mean(errors["tables"]), np.mean(errors["three"])
    print(f"relative rms of RectAreaLight: {theirs:.4f} with three's tables, {ours:.4f} with ours")
    failed = failed or ours > theirs
    sys.exit(bool(failed))


def matrix_of(place):
    """As three's Matrix4.fromArray takes it: column by column."""
    return [v for column, w in zip(place, (0, 0, 0, 1)) for v in [*map(float, column), w]]


if __name__ == "__main__":
    main()
