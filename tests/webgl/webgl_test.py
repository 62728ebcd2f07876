#!/usr/bin/env python3
"""webgl_test.py PROGRAM SCRATCH: the page of examples/webgl in headless Chromium against the library.

The page tells what its G-buffer holds; `eval` then answers, in double, what every light sends from every one of those surfaces to the eye, and
what is shown may differ by 2/255 on 0.1 % of the pixels. That surfaces stand where they should is judged by themselves: balls are balls.
Exit 77 (skipped) where there is no Chromium.
"""
import base64
import html
import json
import math
import re
import struct
import subprocess
import sys
import tempfile
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent.parent
sys.path.insert(0, str(ROOT / "web"))
sys.dont_write_bytecode = True
import browser  # noqa: E402

PROGRAM, SCRATCH = sys.argv[1], Path(sys.argv[2])
WIDTH, HEIGHT = 72, 54
FLAT = {"lights": "quad,star"}  # the peak fits' errors depend on how many corners stand for a round light: 16 here, 32 in eval
CASES = [  # method of the page, of eval, its quality, more of the address
    ("lambert", None, "", {}),
    ("lambert", None, "", {"orbit": 2.9, "rise": 0.9, "size": 1.8}),  # from behind and above
    ("ltc-clipless", "ltc-clipless", "normal", FLAT),
    ("ltc", "ltc", "normal", {}),
    ("ltc-compact", "ltc-compact", "normal", {}),
    ("representative-point", "representative-point", "normal", {}),
    ("closed-form-draft", "closed-form", "draft", {}),
    ("closed-form", "closed-form", "normal", {}),
    ("closed-form", "closed-form", "normal", {"orbit": -2.2, "rise": 0.1, "gloss": 1.7}),
    ("closed-form-high", "closed-form", "high", {}),
    ("half-vector", "half-vector", "normal", FLAT),
    ("blinn-phong", "half-vector", "normal", FLAT),
    ("beckmann", "half-vector", "normal", FLAT),
    ("arvo", "arvo", "normal", {"gloss": 1.5}),
    ("lorentzian", "lorentzian", "normal", {**FLAT, "gloss": 1.5}),
    ("pearson", "pearson", "normal", {**FLAT, "gloss": 1.5}),
    ("ellipsoid", "ellipsoid", "normal", {**FLAT, "gloss": 1.5}),
    ("series", "series", "normal", {}),
    ("series-high", "series", "high", {}),
    ("phong-exact", "exact", "normal", {}),
]


def page_answer(chromium, page, address):
    query = "&".join(f"{k}={v}" for k, v in address.items())
    with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as profile:
        done = subprocess.run([chromium, *browser.FLAGS, "--virtual-time-budget=20000", f"--user-data-dir={profile}", "--dump-dom", f"{page.as_uri()}?{query}"],
                              capture_output=True, text=True, timeout=280)
    found = re.search(r'<pre id="answer">([^<]*)</pre>', done.stdout)
    if not found:
        words = re.search(r'id="errors"[^>]*>([^<]*)<', done.stdout)
        sys.exit(f"the page gave no picture: {words.group(1) if words else done.stderr[-2000:]}")
    return json.loads(html.unescape(found.group(1)))


def floats(text):
    data = base64.b64decode(text)
    return struct.unpack(f"<{len(data) // 4}f", data)


def eval_light(light):
    v, radiance = light["vertices"], light["radiance"]
    if light["kind"] == "polygon":
        return {"type": "polygon", "vertices": v, "radiance": radiance}
    if light["kind"] == "disk":
        return {"type": "disk", "center": v[0], "x": v[1], "y": v[2], "radiance": radiance}
    if light["kind"] == "ball":
        return {"type": "sphere", "center": v[0], "radius": light["radius"], "radiance": radiance}
    return {"type": "capsule", "ends": v, "radius": light["radius"], "radiance": radiance}


def display(radiance, exposure):
    def code(x):
        x = 1 - math.exp(-x * 2 ** exposure)
        return 255 * (12.92 * x if x <= 0.0031308 else 1.055 * x ** (1 / 2.4) - 0.055)
    return [code(x) for x in radiance]


def wanted(answer, name, method, quality):
    """Radiance at every surface that the page has seen: pixel and value."""
    places, normals, albedos, mirrors = (floats(answer[k]) for k in ("places", "normals", "albedos", "mirrors"))
    lights = [eval_light(light) for light in answer["lights"]]
    pixels, queries, colours = [], [], {}
    for i in range(0, len(places), 4):
        if places[i + 3] < 0.5:
            continue
        p, roughness = places[i:i + 3], normals[i + 3]
        common = {"lights": lights, "position": p, "normal": normals[i:i + 3], "view": [e - x for e, x in zip(answer["eye"], p)]}
        pixels.append(i // 4)
        # Without the view: at its rim a ball of triangles is seen from below its smooth normal, where eval says that nothing is seen.
        queries.append({**{k: v for k, v in common.items() if k != "view"}, "material": {"brdf": "lambert", "albedo": albedos[i:i + 3]}, "method": "exact"})
        if method is None:
            continue
        f0, alpha = mirrors[i:i + 3], max(roughness * roughness, 1e-4)
        lobe = {"brdf": "ggx", "alpha": alpha, "f0": f0}
        if method in ("arvo", "lorentzian", "pearson", "ellipsoid", "series", "exact"):
            lobe = {"brdf": "phong", "exponent": max(math.floor(2 / (alpha * alpha) - 1.5), 1), "albedo": f0}
        if name == "blinn-phong":
            lobe = {"brdf": "blinn-phong", "exponent": max(2 / (alpha * alpha) - 2, 0.1)}
        if name == "beckmann":
            lobe = {"brdf": "beckmann", "alpha": alpha}
        if name in ("blinn-phong", "beckmann"):  # they have no colour of their own
            colours[pixels[-1]] = f0
        queries.append({**common, "material": lobe, "method": method, "quality": quality})
    done = subprocess.run([PROGRAM, "eval"], input="".join(json.dumps(q) + "\n" for q in queries), capture_output=True, text=True)
    answers = [json.loads(line) for line in done.stdout.splitlines()]
    assert all("radiance" in a for a in answers), next(a for a in answers if "radiance" not in a)
    each = 1 if method is None else 2
    shares = lambda pixel, i: colours[pixel] if i == 1 and pixel in colours else (1, 1, 1)
    return {pixel: [sum(a["radiance"][c] * shares(pixel, i)[c] for i, a in enumerate(answers[each * k:each * k + each])) for c in range(3)] for k, pixel in enumerate(pixels)}


def check_surfaces(answer):
    """Balls stand where scene.js has them; the floor is flat."""
    places, normals = floats(answer["places"]), floats(answer["normals"])
    worst, seen = 0.0, [0, 0]
    for i in range(0, len(places), 4):
        p = places[i:i + 3]
        if places[i + 3] < 0.5:
            continue
        for k, (center, radius) in enumerate((((-1.15, 0.55, 0.35), 0.55), ((0.45, 0.4, 1.0), 0.4))):
            d = math.dist(p, center)
            if d < 1.01 * radius and p[1] > 0.01:
                seen[k] += 1
                # 96 x 48 patches: a chord is off its arc by 1 - cos(pi / 96).
                worst = max(worst, abs(d / radius - 1), math.dist(normals[i:i + 3], [(x - c) / d for x, c in zip(p, center)]))
    assert min(seen) > 10 and worst < 2.5e-3, (seen, worst)
    print(f"balls: {seen} pixels, off by at most {worst:.1e} of their radius")


# The actions of a user: appended to the page, whose state it reads.
VISITOR = """<script>
const seen = [], look = () => seen.push(JSON.parse(JSON.stringify(state)));
const point = (type, id, x, y) => canvas.dispatchEvent(new PointerEvent(type, { pointerId: id, clientX: x, clientY: y, pointerType: "touch", bubbles: true }));
const key = (k) => canvas.dispatchEvent(new KeyboardEvent("keydown", { key: k, bubbles: true }));
look();
point("pointerdown", 1, 600, 300); point("pointermove", 1, 650, 320); look();            // one finger walks around
point("pointerdown", 2, 700, 320); point("pointermove", 2, 750, 320); look();            // two come nearer: half the distance
point("pointerup", 1, 650, 320); point("pointerup", 2, 750, 320);
canvas.dispatchEvent(new WheelEvent("wheel", { deltaY: 100, cancelable: true })); look();
for (const k of ["ArrowLeft", "ArrowUp", "+", "m", "o", "c", "2"]) key(k);
look();
document.body.innerHTML = `<pre id="answer">${JSON.stringify({ seen })}</pre>`;
</script>"""


def check_hands(chromium, page):
    visited = SCRATCH / "visited.html"
    visited.write_text(page.read_text().replace("</body>", VISITOR + "</body>"))
    start, dragged, pinched, wheeled, typed = page_answer(chromium, visited, {})["seen"]
    close = lambda a, b: abs(a - b) < 1e-9
    assert close(dragged["camera"]["orbit"], start["camera"]["orbit"] - 0.3) and close(dragged["camera"]["rise"], start["camera"]["rise"] + 0.12), dragged
    assert close(pinched["camera"]["distance"], max(start["camera"]["distance"] / 2, 2.2)), pinched
    assert close(wheeled["camera"]["distance"], 1.1 * pinched["camera"]["distance"]), wheeled
    assert close(typed["camera"]["distance"], pinched["camera"]["distance"]) and typed["camera"]["orbit"] > wheeled["camera"]["orbit"], typed
    assert typed["method"] != start["method"] and typed["other"] != start["other"] and typed["mode"] == 1, typed
    assert typed["lights"] == ["quad", "disk", "ball", "tube"], typed
    print("fingers, wheel and keys do what the page says")


def main():
    chromium = browser.find()
    if chromium is None:
        print("skipped: no Chromium here (apt-get install chromium)")
        sys.exit(77)
    page = SCRATCH / "index.html"
    subprocess.run([sys.executable, ROOT / "examples" / "webgl" / "make_page.py", page], check=True)
    check_hands(chromium, page)
    failed = False
    for i, (name, method, quality, more) in enumerate(CASES):
        begin = time.monotonic()
        answer = page_answer(chromium, page, {"test": f"{WIDTH}x{HEIGHT}", "method": name, "exposure": 0.7, **more, **({"error": 1} if name == "ltc-compact" else {})})
        seconds = time.monotonic() - begin
        if i == 0:
            check_surfaces(answer)
        shown, radiance = base64.b64decode(answer["shown"]), floats(answer["radiance"])
        want = wanted(answer, name, method, quality)
        off, worst, square, sum_ = 0, 0.0, 0.0, 0.0
        for pixel, value in want.items():
            codes = display(value, 0.7)
            difference = max(abs(shown[4 * pixel + c] - codes[c]) for c in range(3))
            off += difference > 2.5  # 2/255, and half of one that rounding takes
            worst = max(worst, difference)
            square += sum((radiance[4 * pixel + c] - value[c]) ** 2 for c in range(3))
            sum_ += sum(v * v for v in value)
        rms = math.sqrt(square / sum_)
        print(f"{name} {more}: {off} of {len(want)} pixels off by more than 2/255, at most {worst:.1f}; relative rms {rms:.1e}; {seconds:.1f} s", flush=True)
        # Round lights have other corners in eval; else what is largest is the rounding of a table in half floats, 5e-4.
        failed = failed or (more.get("lights") == FLAT["lights"] and rms > 1e-3)
        failed = failed or off > len(want) / 1000 or len(want) < WIDTH * HEIGHT / 4
        if answer["error"] is not None:
            print(f"the page says of {name}: {answer['error']:.4f} rms off the best")
            assert 0.002 < answer["error"] < 0.2, answer["error"]
    sys.exit(failed)


if __name__ == "__main__":
    main()
