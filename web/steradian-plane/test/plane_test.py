#!/usr/bin/env python3
"""plane_test.py PROGRAM SCRATCH: the package steradian-plane in node and its page in headless Chromium, against the program.

The package is built into SCRATCH. Exit 77 (skipped) where there is no emscripten or no node; without Chromium, the page alone is skipped.
"""
import json
import re
import shutil
import subprocess
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
PACKAGE = HERE.parent
ROOT = PACKAGE.parent.parent
sys.path.insert(0, str(PACKAGE.parent))
sys.dont_write_bytecode = True
import browser  # noqa: E402
import npm_project  # noqa: E402

PROGRAM, SCRATCH = sys.argv[1], Path(sys.argv[2]).resolve()
SCENES = ["room", "lamps", "city", "bounce"]
BEHIND = [0, 0, 0.003253776, 0.009677733, 0.015683592, 0.002307676]  # disk of radius 1 behind a square: the open angle over 2 pi
FRAME = 2e-5  # a frame of a page may be off by this from the query, times what arrives where that is more than 1: as frames of the program


def skip(why):
    print(f"skipped: {why}")
    sys.exit(77)


def eval_plane(scene, points):
    lines = "".join(json.dumps({"scene": str(scene), "position": p}) + "\n" for p in points)
    done = subprocess.run([PROGRAM, "eval", "--plane"], input=lines, capture_output=True, text=True)
    return [json.loads(line)["mean_radiance"] for line in done.stdout.splitlines()]


def distance(a, b):
    return max(abs(x - y) for x, y in zip(a, b))


def display(radiance):
    """The tone curve of the program's .png, in codes."""
    c = [min(max(x, 0), 1e6) for x in radiance]
    low = min(c)
    offset = low - 6.25 * low * low if low < 0.08 else 0.04
    c = [x - offset for x in c]
    peak = max(c)
    if peak >= 0.76:
        new_peak = 1 - 0.0576 / (peak + 0.24 - 0.76)
        g = 1 - 1 / (0.15 * (peak - new_peak) + 1)
        c = [x * new_peak / peak * (1 - g) + new_peak * g for x in c]
    return [255 * (12.92 * x if x <= 0.0031308 else 1.055 * min(x, 1) ** (1 / 2.4) - 0.055) for x in c]


def check_package(package):
    scenes = [ROOT / "scenes" / "plane" / f"{s}.svg" for s in SCENES]
    done = subprocess.run(["node", "--expose-gc", HERE / "plane_test.mjs", package, *scenes], capture_output=True, text=True, timeout=300)
    assert done.returncode == 0, done.stderr
    found = json.loads(done.stdout)
    assert all(abs(a - b) < 1e-9 for a, b in zip(found["behind"], BEHIND)), found["behind"]
    # The same double code, but for the mathematical library: 1e-12 is a thousand roundings of a light.
    worst = 0.0
    for path in {q["path"] for q in found["queries"]}:
        mine = [q for q in found["queries"] if q["path"] == path]
        for q, want in zip(mine, eval_plane(path, [q["position"] for q in mine])):
            worst = max(worst, distance(q["radiance"], want) / max(1, *want))
    print(f"queries, {len(found['queries'])} points: off by at most {worst:.1e} from the program")
    assert worst < 1e-12, worst
    for frame in found["frames"]:
        want = eval_plane(frame["path"], [p["position"] for p in frame["pixels"]])
        off = max(distance(p["radiance"], w) / max(1, *w) for p, w in zip(frame["pixels"], want))
        print(f"{Path(frame['path']).name}: light map in {frame['ms']:.0f} ms, 60 pixels off by at most {off:.1e}")
        assert off < FRAME, off
    edit = found["edits"][0]
    svg = SCRATCH / "edited.svg"
    svg.write_text(edit["svg"])
    for p, want in zip(edit["points"], eval_plane(svg, [p["position"] for p in edit["points"]])):
        # The SVG has all digits of a place, but colours and ranges go through a text.
        assert distance(p["radiance"], want) < 1e-9 * max(1, *want), (p, want)
    assert distance(edit["again"], edit["points"][1]["radiance"]) < 1e-9, edit
    assert found["map"]["inside"] == 0 and found["map"]["outside"] == 1, found["map"]
    assert -found["map"]["radiance"] <= found["map"]["moment"] < -0.9 * found["map"]["radiance"], found["map"]  # all light comes from the left
    # 200,000 stratified rays of an angle: two edges, each off by less than a ray.
    assert abs(found["rays"] - BEHIND[3]) < 2 / 200000, found["rays"]
    assert len(found["warnings"]) == 2 and found["warnings"][0] == "stroke of a filled shape", found["warnings"]
    assert "lamp (in wall)" in found["warnings"][1], found["warnings"]
    for sentence in found["refused"]:
        print("refused:", sentence)
        assert not sentence.startswith("not "), sentence
    assert found["afterwards"] == [found["behind"][3]] * 3, found["afterwards"]
    assert found["refused"][0].startswith("a.svg:2: <rect>"), found["refused"][0]
    assert found["refused"][1].startswith("b.svg:2: "), found["refused"][1]


PACKED = """
import {{ readFileSync }} from "node:fs";
import {{ Plane }} from "steradian-plane";
const plane = await Plane.load(readFileSync({scene}, "utf8"), "scene.svg");
console.log(JSON.stringify({points}.map((p) => plane.query(p[0], p[1]).radiance)));
"""


def check_tarball(package):
    """The package as `npm pack` makes it, installed into an empty project, against the program."""
    tarball, files = npm_project.pack(package, SCRATCH / "packed")
    project = SCRATCH / "project"
    npm_project.install(project, tarball)
    npm_project.check_exports(project / "node_modules" / "steradian-plane", files)
    scene, points = ROOT / "scenes" / "plane" / "room.svg", [[100, 100], [200, 150], [320, 240]]
    found = json.loads(npm_project.module(project, PACKED.format(scene=json.dumps(str(scene)), points=points)))
    off = max(distance(a, b) / max(1, *b) for a, b in zip(found, eval_plane(scene, points)))
    print(f"{tarball.name}: {len(files)} files, {tarball.stat().st_size / 1000:.0f} KB; its answers are off by at most {off:.1e} from the program")
    assert off < 1e-12 and any(sum(f) > 0 for f in found), found


def check_manual(package, chromium):
    """The JavaScript of README.md, each piece as a module of its own; what wants a canvas on a page, if there is a browser."""
    pieces = re.findall(r"```js\n(.*?)```", (PACKAGE / "README.md").read_text(), re.DOTALL)
    assert len(pieces) >= 3, "README.md has lost its JavaScript"
    svg = json.dumps((ROOT / "scenes" / "plane" / "room.svg").read_text())
    head = f"const roomSvg = {svg};\n"
    for i, piece in enumerate(pieces):
        module = package / f"manual_{i}.mjs"  # beside the package, where its name is known
        text = piece if "import" in piece else 'import { Plane } from "steradian-plane";\n' + piece
        module.write_text(head + text)
        if "canvas" in piece:
            if chromium is not None:
                check_piece_on_page(package, chromium, head + piece)
            continue
        done = subprocess.run(["node", module], capture_output=True, text=True, timeout=60)
        assert done.returncode == 0, f"README.md, piece {i}: {done.stderr}"
        for line, said in zip(re.findall(r"console\.log\(.*?// (.*)", piece), done.stdout.splitlines()):
            assert line.strip() == said.strip(), f"README.md says {line}, node {said}"
    print(f"README.md: {len(pieces)} pieces")


def check_piece_on_page(package, chromium, piece):
    """Beside a canvas, over which a pointer moves: it shows something then."""
    library = re.search(r'<script type="module">\n(.*?)const \{[^}]*\} = from_index;', (package / "room.html").read_text(), re.DOTALL)[1]
    names = "const { Plane, PlaneError } = from_index;"
    page = SCRATCH / "piece.html"

    def visited(address):
        after = f"""
addEventListener("error", (e) => post(`failed: ${{e.message}}`));
const post = (body) => fetch("{address}", {{ method: "POST", mode: "no-cors", body }});
const box = canvas.getBoundingClientRect();
canvas.dispatchEvent(new PointerEvent("pointermove", {{ clientX: box.x + 100, clientY: box.y + 50 }}));
const frame = () => new Promise(requestAnimationFrame);
await frame();
const seen = Object.assign(document.createElement("canvas"), {{ width: canvas.width, height: canvas.height }}).getContext("2d");
seen.drawImage(canvas, 0, 0);
post(String(seen.getImageData(0, 0, canvas.width, canvas.height).data.reduce((sum, c, i) => sum + (i % 4 < 3 ? c : 0), 0) / (3 * canvas.width * canvas.height)));"""
        page.write_text(f'<!doctype html><canvas width="320" height="200"></canvas><script type="module">\n{library}{names}\n{piece}{after}</script>')
        return page.as_uri()

    said = browser.answer_of(chromium, visited)
    print(f"README.md, on a page: mean code {said}")
    assert 5 < float(said) < 250, said


def check_page(package, chromium):
    page = SCRATCH / "visited.html"
    visitor = (HERE / "visitor.js").read_text()
    def visited(address):
        script = f'<script type="module">const ANSWER_TO = "{address}";\n{visitor}</script>'
        page.write_text((package / "room.html").read_text().replace("</html>", script + "</html>"))
        return page.as_uri()

    results = json.loads(browser.answer_of(chromium, visited))
    picture = SCRATCH / "room.png"
    browser.picture_of(chromium, (package / "room.html").as_uri(), picture)
    assert results[-1]["what"] != "failed", results[-1]
    before = None
    for r in results:
        assert r["problem"] == "", r
        scene = SCRATCH / "seen.svg"
        scene.write_text(r["svg"])
        assert r["svg"] != before or r["what"] in ("all bounces", "half by rays"), f"{r['what']}: the scene has not changed"
        before = r["svg"]
        bounced = ["--bounces", "all"] if r["what"] == "all bounces" else []
        box = [float(x) for x in re.search(r'viewBox="([^"]*)"', r["svg"]).group(1).split()]
        # The irradiance under the pointer, with the digits that the page shows.
        place = [float(x) for x in r["at"].split(",")]
        if not bounced:
            want = eval_plane(scene, [place])[0]
            said = [float(x) for x in r["value"].split()]
            assert distance(said, want) < 0.6e-5, (r["what"], said, want)
        # The shown pixels, in codes of the display.
        s = max(box[2] / r["width"], box[3] / r["height"])  # all of the scene, in the middle
        left, top = box[0] + (box[2] - s * r["width"]) / 2, box[1] + (box[3] - s * r["height"]) / 2
        half = r["what"] == "half by rays"
        pixels = [p for p in r["shown"] if not half or p[0] < r["width"] / 2 - 1]
        where = [[left + (x + 0.5) * s, top + (y + 0.5) * s] for x, y, *_ in pixels]
        if not bounced:
            off = [distance(display(w), p[2:]) for p, w in zip(pixels, eval_plane(scene, where))]
            print(f"{r['what']}: {len(off)} pixels, off by at most {max(off):.2f} of 255; {r['tiles']}, {r['light']}")
            assert max(off) <= 1.01, max(off)  # a code is rounded, and the value may be off by FRAME
        else:
            lit = sum(sum(p[2:]) for p in pixels) / len(pixels)
            direct = sum(sum(display(w)) for w in eval_plane(scene, where)) / len(pixels)
            print(f"{r['what']}: mean code {lit / 3:.1f}, of direct light {direct / 3:.1f}; error {r['error']}")
            assert lit > direct + 3, (lit, direct)
    drawn, tiles = map(int, re.findall(r"\d+", next(r for r in results if r["what"] == "a wall is drawn")["tiles"]))
    assert 0 < drawn < tiles, "a short wall draws every tile anew"
    print(f"screenshot: {picture}")


# All kinds of light that shaders have, among all kinds of blockers.
MIXED = """<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 240 160"><defs><linearGradient id="g"><stop offset="0" stop-color="#ff4020"/>
<stop offset="1" stop-color="#2060ff"/></linearGradient></defs>
<ellipse class="light" cx="60" cy="40" rx="16" ry="7" fill="#fff0d0" data-intensity="3"/>
<rect class="light" x="180" y="30" width="30" height="12" fill="url(#g)" data-intensity="4" data-range="150"/>
<path class="light" d="M20 130 Q60 110 90 140" fill="none" stroke="#80ffc0" data-intensity="2" data-profile="lambert"/>
<circle class="light" cx="200" cy="120" r="8" fill="#ffe080" data-intensity="6" data-spot="-160 40"/>
<circle class="light" cx="120" cy="20" r="5" fill="#ffffff" data-intensity="3"/>
<g fill="#a09080"><path d="M100 60 l30 -6 l4 30 l-20 14 z"/><circle cx="150" cy="110" r="12"/><ellipse cx="60" cy="90" rx="14" ry="6"/>
<path d="M30 70 h26 v4 h-26 z M150 60 l14 10 l-10 14 l-14 -10 z"/><path d="M118 26 l10 6 l-4 6 z"/></g>
<path d="M90 120 l20 20" fill="none" stroke="#000" stroke-width="4" stroke-linecap="round"/></svg>"""


def check_gl(package, chromium):
    """The same pictures by WebGL2 and by WebAssembly, in floats."""
    scenes = [[s, (ROOT / "scenes" / "plane" / f"{s}.svg").read_text(), 0] for s in (*SCENES, "carousel")] + [["mixed", MIXED, 0], ["mixed, bounced", MIXED, 2]]
    page = SCRATCH / "gl.html"

    def visited(address):
        values = json.dumps(scenes).replace("</", "<\\/")
        script = f'<script type="module">const ANSWER_TO = "{address}";\nconst SCENES = {values};\n{(HERE / "gl_visitor.js").read_text()}</script>'
        page.write_text((package / "room.html").read_text().replace("</html>", script + "</html>"))
        return page.as_uri()

    found = json.loads(browser.answer_of(chromium, visited, timeout=600))
    assert "failed" not in found[0], found[0]["failed"]
    if found[0]["method"] is None:
        print("WebGL2 was not tried: this Chromium cannot add up floats")
        return
    for f in found:
        values = 3 * f["width"] * f["height"]
        print(f"WebGL2, {f['name']}, {f['width']} x {f['height']}: {f['beyond']} of {values} values off by more than {FRAME}, at most {f['worst']:.1e}; "
              f"{f['gpuMs']:.0f} ms by a program in the GPU's place, {f['wasmMs']:.0f} ms by WebAssembly")
        assert f["method"] == "webgl2" and f["lit"] > 0.05, f
        # A pixel that stands on a line of no thickness is on either side of it.
        assert f["beyond"] <= 3 + values / 10000, f


# Letters of a font that Debian's fonts-dejavu-core has: the program finds it by fontconfig, the page by the browser.
LETTERS = """<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 240 160"><text class="light" x="40" y="90" font-family="DejaVu Sans" font-size="48"
fill="#ffffff" data-intensity="3">Open&#233;</text><text x="30" y="130" font-family="DejaVu Sans" font-size="20">bar</text></svg>"""
LETTER_POINTS = [[120, 140], [20, 20], [220, 30], [130, 20], [45, 145], [200, 130], [120, 10]]


def check_letters(package, chromium):
    """<text> by the page's fonts, traced on a canvas, against the outlines of the font's file."""
    page, svg = SCRATCH / "letters.html", SCRATCH / "letters.svg"
    svg.write_text(LETTERS)

    def visited(address):
        script = f"""<script type="module">
const answer = (body) => fetch("{address}", {{ method: "POST", mode: "no-cors", body: JSON.stringify(body) }});
try {{
  const Plane = await new Promise((resolve) => {{
    const look = () => (globalThis.plane ? resolve(globalThis.plane.constructor) : setTimeout(look, 10));
    look();
  }});
  const start = performance.now(), plane = await Plane.load({json.dumps(LETTERS)}, "letters.svg"), ms = performance.now() - start;
  answer({{ ms, warnings: plane.warnings, lights: {json.dumps(LETTER_POINTS)}.map(([x, y]) => plane.query(x, y).radiance[0]) }});
}} catch (e) {{
  answer({{ failed: String(e.stack) }});
}}
</script>"""
        page.write_text((package / "room.html").read_text().replace("</html>", script + "</html>"))
        return page.as_uri()

    found = json.loads(browser.answer_of(chromium, visited))
    assert "failed" not in found, found["failed"]
    want = [w[0] for w in eval_plane(svg, LETTER_POINTS)]
    off = max(abs(a - b) for a, b in zip(found["lights"], want))
    print(f"letters of the page: loaded in {found['ms']:.0f} ms, off by at most {off:.1e} of lights from {min(want):.3f} to {max(want):.3f}; {found['warnings']}")
    assert found["warnings"] == [], found["warnings"]
    # An outline is off by at most a pixel of a canvas of 256 pixels an em. From ten units away, that is an angle at either end of each letter.
    em = 48
    assert 0 < off < 5 * 2 * 3 * (em / 256 / 10) / 6.283, (found["lights"], want)


def frame_times(package):
    """Of the room, by the machine's clock: the page's own stands still while it works."""
    script = f"""
import {{ Plane }} from {json.dumps((package / "src" / "index.js").as_uri())};
const text = {json.dumps((PACKAGE / "page" / "room.js").read_text())};
const plane = await Plane.load(text.match(/`(<svg[^`]*)`/)[1]);
const call = () => plane.machine.call("plane_draw", plane.handle, 1280, 800, 0, 0);
const timed = (job) => {{ const t = performance.now(); job(); return performance.now() - t; }};
const cold = timed(call), lamp = plane.lights.get("candle"), moves = [];
for (let i = 0; i < 40; ++i) {{ lamp.moveBy(0.5, i % 2 ? -0.3 : 0.2); moves.push(timed(call)); }}
moves.sort((a, b) => a - b);
console.log(`the room at 1280 x 800, one thread of WebAssembly: ${{cold.toFixed(0)}} ms cold, ${{moves[20].toFixed(1)}} ms where the candle moves`);
"""
    done = subprocess.run(["node", "--input-type=module", "-e", script], capture_output=True, text=True, timeout=120)
    assert done.returncode == 0, done.stderr
    print(done.stdout.strip())
    drawings = [ROOT / "scenes" / "plane" / f"{s}.svg" for s in (*SCENES, "curves", "logo")]
    done = subprocess.run(["node", HERE / "frame_times.mjs", package, "640x360", *drawings], capture_output=True, text=True, timeout=300)
    assert done.returncode == 0, done.stderr
    print(done.stdout.strip())


def main():
    for tool, package in (("emcmake", "emscripten"), ("node", "nodejs"), ("ninja", "ninja-build")):
        if not shutil.which(tool):
            skip(f"{tool} is not installed (./dev web, or apt-get install {package})")
    if not Path("/usr/include/rapidxml").exists():
        skip("there is no RapidXML (./dev web, or apt-get install librapidxml-dev)")
    package = SCRATCH / "steradian-plane"
    SCRATCH.mkdir(parents=True, exist_ok=True)
    subprocess.run([sys.executable, PACKAGE / "make_package.py", SCRATCH / "build", package], check=True)
    zipped = len(subprocess.run(["gzip", "-9", "-c", package / "room.html"], capture_output=True, check=True).stdout)
    print(f"room.html: {zipped / 1000:.0f} KB zipped")
    check_package(package)
    if shutil.which("npm"):
        check_tarball(package)
    chromium = browser.find()
    check_manual(package, chromium)
    frame_times(package)
    if chromium is None:
        print("the page was not tried: there is no Chromium here (apt-get install chromium)")
        return
    check_page(package, chromium)
    check_letters(package, chromium)
    check_gl(package, chromium)


if __name__ == "__main__":
    main()
