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
sys.path.insert(0, str(PACKAGE.parent))
sys.dont_write_bytecode = True
sys.path.insert(0, str(PACKAGE))
import browser  # noqa: E402

THREE = "three@0.187.0"
WIDTH, HEIGHT, FOV = 64, 48, 50
FLAGS = [*browser.FLAGS, "--virtual-time-budget=60000"]


def skip(why):
    print(f"skipped: {why}")
    sys.exit(77)


try:
    import numpy as np
    import steradian
    import fit_tables
    import rect_formula
except ImportError as e:
    skip(f"the Python module is not built: {e}")


def three_from_npm(scratch, version=THREE):
    if not shutil.which("npm"):
        skip("npm is not installed (apt-get install npm)")
    scratch.mkdir(parents=True, exist_ok=True)
    folder = scratch / "node_modules" / "three"
    if not (folder / "build" / "three.module.js").exists():
        (scratch / "package.json").write_text('{"private": true}\n')
        try:
            done = subprocess.run(["npm", "install", "--no-audit", "--no-fund", version], cwd=scratch, capture_output=True, text=True, timeout=100)
        except subprocess.TimeoutExpired:
            skip(f"npm install {version} took too long")
        if done.returncode != 0:
            skip(f"npm install {version} failed: {done.stderr.strip()[:300]}")
    return folder


def snippets():
    """The JavaScript of README.md, each piece as a module, with what its page would have; it ends by drawing a frame."""
    pieces = re.findall(r"```js\n(.*?)```", (PACKAGE / "README.md").read_text(), re.DOTALL)
    assert len(pieces) >= 2 and "panel.lookAt" in pieces[0], "README.md has lost its JavaScript"
    before = """
const outline = [ [ 0, 1 ], [ - 1, - 1 ], [ 1, - 1 ] ].map( ( p ) => new THREE.Vector2( ...p ) );
const scene = new THREE.Scene(), camera = new THREE.PerspectiveCamera( 50, 1, 0.1, 100 );
const otherMaterial = new THREE.MeshPhysicalMaterial(), file = JSON.stringify( %s );
camera.position.z = 3;
""" % json.dumps(gltf_of(LIGHTS_OF_A_FILE))
    after = """
if ( typeof renderer === 'undefined' ) {

	const gl = new THREE.WebGLRenderer();
	gl.debug.onShaderError = ( c, program, vertex, fragment ) => { throw new Error( c.getShaderInfoLog( fragment ) ); };
	const used = typeof material === 'undefined' ? otherMaterial : material;
	const balls = [ used, otherMaterial ].map( ( m ) => new THREE.Mesh( new THREE.SphereGeometry( 1 ), m ) );
	const pixel = new Uint8Array( 4 * 300 * 150 ), context = gl.getContext();
	for ( const ball of typeof panel === 'undefined' ? [] : balls ) { // the first example lights the origin, where a ball is

		scene.add( ball );
		gl.render( scene, camera );
		context.readPixels( 0, 0, 300, 150, context.RGBA, context.UNSIGNED_BYTE, pixel );
		if ( pixel.reduce( ( most, c, i ) => i % 4 < 3 ? Math.max( most, c ) : most, 0 ) < 30 ) throw new Error( 'the example lights nothing' );
		scene.remove( ball );

	}

	scene.add( ...balls );
	gl.render( scene, camera );

}

document.getElementById( 'answer' ).textContent = 'pixels:snippet:';
"""
    three = "import * as THREE from 'three';\n"
    return [(("" if "import * as THREE" in piece else three) + before + piece + after).encode() for piece in pieces]


class Files(http.server.SimpleHTTPRequestHandler):
    """/package/... is this package, /three/... is three, /test/... are the pages of this folder."""

    extensions_map = {".js": "text/javascript", ".html": "text/html", "": "application/octet-stream"}

    def __init__(self, *arguments, three, snippets=None, **keys):
        self.snippets = [] if snippets is None else snippets
        self.roots = {"package": PACKAGE, "three": three, "test": PACKAGE / "test"}
        super().__init__(*arguments, **keys)

    def translate_path(self, path):
        parts = [p for p in urllib.parse.urlparse(path).path.split("/") if p not in ("", "..")]
        return str(self.roots.get(parts[0] if parts else "", PACKAGE / "nothing").joinpath(*parts[1:]))

    def do_GET(self):
        found = re.match(r"/snippet/(\d+)\.(js|html)", self.path)
        if not found:
            return super().do_GET()
        i, kind = int(found.group(1)), found.group(2)
        name = "webgpu" if b"three/webgpu" in self.snippets[i] else "page"
        page = (PACKAGE / "test" / f"{name}.html").read_text().replace(f'src="{name}.js"', f'src="/snippet/{i}.js"').encode()
        body = self.snippets[i] if kind == "js" else page
        self.send_response(200)
        self.send_header("Content-Type", self.extensions_map["." + kind])
        self.end_headers()
        self.wfile.write(body)
        return None

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
TUBE = {"type": "tube", "place": placed([-0.4, 0.5, 0.2], [0, -1, 0.3]), "length": 0.9, "radius": 0.06, "radiance": [8, 8, 6]}
FRAME = {"type": "polygon", "place": placed([0.1, 1.0, -0.4], [0, -1, 0.4]), "outline": [[-0.8, -0.5], [0.8, -0.5], [0.8, 0.5], [-0.8, 0.5]],
         "holes": [[[-0.6, -0.3], [-0.1, -0.3], [-0.1, 0.3], [-0.6, 0.3]], [[0.2, -0.3], [0.6, -0.3], [0.4, 0.3]]], "radiance": [5, 5, 4]}
BEHIND = ([0.9, 0.8, -0.5], [-0.3, 1, 0.3])
AWAY = {**DISK, "place": placed(*BEHIND), "two_sided": True}  # its back to the floor
# The lights of a glTF file, with their nodes' place, rotation and scale: -z shines. What they are is said by the library's reader of the same file.
LIGHTS_OF_A_FILE = [
    ({"type": "rect", "size": 0.5, "rect": {"aspect": 2}, "color": [1, 0.8, 0.6], "intensity": 6}, [-0.7, 1, -0.4], [0.3, -1, 0.3], [1, 1, 1]),
    ({"type": "disk", "size": 0.7, "intensity": 5, "extras": {"steradian": {"two_sided": True}}}, *BEHIND, [1, 1, 1]),
    ({"type": "sphere", "size": 0.3, "color": [0.9, 0.8, 0.7], "intensity": 10}, [0.2, 0.5, 0.4], [0, -1, 0.1], [1, 1, 1]),
    ({"type": "capsule", "size": 0.12, "capsule": {"length": 0.9}, "color": [1, 1, 0.75], "intensity": 8}, [-0.4, 0.5, 0.2], [0, -1, 0.3], [1, 1, 1]),
]
SCALED_LIGHTS_OF_A_FILE = [  # the default of 1000 nits; the largest of a node's scales, or all of them; mirrored nodes
    ({"type": "rect", "size": 0.01, "rect": {"aspect": 2}, "color": [1, 0.8, 0.6]}, [-0.7, 0.9, -0.4], [0.3, -1, 0.3], [1, 0.5, 2.5]),
    ({"type": "disk", "size": 0.4, "intensity": 5}, [0.9, 0.8, -0.5], [-0.3, -1, 0.3], [0.5, -1.5, 1]),
    ({"type": "disk", "size": 0.4, "intensity": 6, "extras": {"steradian": {"scale": "axes"}}}, [0.1, 0.9, -0.9], [0, -1, 0.5], [2.5, 0.7, 1]),
    ({"type": "rect", "size": 0.4, "intensity": 6, "extras": {"steradian": {"scale": "axes"}}}, [-0.9, 0.7, 0.5], [0.5, -1, 0], [-0.4, 1.5, 1]),
    ({"type": "disk", "size": 0.3, "intensity": 7, "extras": {"steradian": {"aspect": 3}}}, [0.7, 0.5, 0.5], [-0.5, -1, 0], [1, 1, 1]),
    ({"type": "disk", "size": 0.1, "intensity": 9, "extras": {"steradian": {"type": "capsule", "capsule": {"length": 0.5}}}}, [-0.2, 0.4, 0.5], [0, -1, 0.1],
     [1.5, 0.5, 2]),
    ({"type": "disk", "size": 0.2, "intensity": 9, "extras": {"steradian": {"type": "sphere"}}}, [0.3, 0.3, 0.1], [0, -1, 0.1], [1, 1, 1]),
]
GOLD = {"color": [0.9, 0.6, 0.3], "metalness": 1}
PLASTIC = {"color": [0.5, 0.4, 0.3], "metalness": 0}
VELVET = {"color": [0.3, 0.05, 0.1], "metalness": 0, "sheen": [0.8, 0.5, 0.6], "sheenRoughness": 0.4}
BRUSHED = {"color": [0.9, 0.8, 0.7], "metalness": 1, "anisotropy": 0.6}
CASES = [  # name, lights, material, roughness
    ("panel on gold", [PANEL], GOLD, 0.25),
    ("panel on plastic", [PANEL], PLASTIC, 0.5),
    ("half below, gold", [UPRIGHT], GOLD, 0.5),
    ("polygon, gold", [ELL], GOLD, 0.3),
    ("disk and ball, gold", [DISK, BALL], GOLD, 0.4),
    ("all, plastic", [PANEL, ELL, DISK, BALL], PLASTIC, 0.3),
    ("tube, gold", [TUBE], GOLD, 0.35),
    ("polygon with two holes, gold", [FRAME], GOLD, 0.25),
    ("disk from behind, plastic", [AWAY], PLASTIC, 0.4),
    ("lights of a glTF file, plastic", LIGHTS_OF_A_FILE, PLASTIC, 0.35),
    ("lights of scaled nodes of a glTF file, plastic", SCALED_LIGHTS_OF_A_FILE, PLASTIC, 0.35),
    ("panel on velvet", [PANEL, BALL], VELVET, 0.6),
    ("panel on brushed metal", [PANEL], BRUSHED, 0.4),
]
WITH_THREE_S_OWN = ("panel on gold", "half below, gold", "panel on plastic")  # half the error is asked of the first two
# The bounds of each method: how far the mean may be off, and by how much of white the pixels that are not among the best 99.5 %.
BOUNDS = {"closed-form": (0.005, 2 / 255), "compact": (0.03, 0.06)}


def gltf_of(lights):
    def matrix(center, aim, scale):
        place = placed(center, aim)
        return matrix_of([*(axis * s for axis, s in zip(place, scale)), place[3]])

    nodes = [{"matrix": matrix(*at), "extensions": {"EXT_lights_area": {"light": i}}} for i, (_, *at) in enumerate(lights)]
    return {"asset": {"version": "2.0"}, "extensionsUsed": ["EXT_lights_area"], "extensions": {"EXT_lights_area": {"lights": [d for d, *_ in lights]}},
            "nodes": nodes, "scenes": [{"nodes": list(range(len(nodes)))}], "scene": 0}


def seen_by_library(lights):
    """What its own reader makes of the file: lights as eval has them."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "lights.gltf"
        path.write_text(json.dumps(gltf_of(lights)))
        return steradian.load_scene(str(path)).lights


def case_of(name, lights, material, roughness, methods, eye):
    """What the pages are told, and the picture that they have to make."""
    case = {"methods": methods, "eye": eye, "fov": FOV, "width": WIDTH, "height": HEIGHT, "roughness": roughness, **material, "lights": []}
    if "glTF" in name:
        return {**case, "gltf": gltf_of(lights)}, judged(seen_by_library(lights), material, roughness, eye)
    case["lights"] = [{**{k: v for k, v in light.items() if k != "place"}, "matrix": matrix_of(light["place"])} for light in lights]
    return case, judged([eval_light(light) for light in lights], material, roughness, eye)


def eval_light(light):
    x, y, z, center = light["place"]
    found = {"radiance": light["radiance"]}
    if light["type"] == "rect":  # lit along -z: x cross y is -z
        return {**found, "type": "rect", "center": center, "x": -x * light["width"] / 2, "y": y * light["height"] / 2}
    if light["type"] == "disk":
        return {**found, "type": "disk", "center": center, "x": -x * light["radius"], "y": y * light["radius"], "two_sided": light.get("two_sided", False)}
    if light["type"] == "sphere":
        return {**found, "type": "sphere", "center": center, "radius": light["radius"]}
    if light["type"] == "tube":
        half = x * light["length"] / 2
        return {**found, "type": "capsule", "ends": [(center - half).tolist(), (center + half).tolist()], "radius": light["radius"]}
    placed_at = lambda points: [(center + x * u + y * v).tolist() for u, v in reversed(points)]
    return {**found, "type": "polygon", "vertices": placed_at(light["outline"]), "holes": [placed_at(h) for h in light.get("holes", [])]}  # the outlines here run counter-clockwise


def judged(seen, material, roughness, eye):
    """The picture of these lights of eval, in double: Lambert exactly, GGX in closed form of high quality."""
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
    alpha = roughness ** 2
    wide = alpha + (1 - alpha) * material.get("anisotropy", 0) ** 2  # along the tangent: as three widens it
    lobes = [{"brdf": "ggx", "alpha_x": wide, "alpha_y": alpha, "tangent": [1, 0, 0], "f0": color * metal + 0.04 * (1 - metal), "f90": 1}]
    if metal < 1:
        lobes.append({"brdf": "lambert", "albedo": color * (1 - metal)})
    below = sum(steradian.radiance(seen, point, [0, 1, 0], -ray, lobe, quality="high") for lobe in lobes)
    if "sheen" not in material:
        return below
    cloth = {"brdf": "charlie", "alpha": material["sheenRoughness"] ** 2}
    fibres = steradian.radiance(seen, point, [0, 1, 0], -ray, cloth)
    # The reflection by fibres of colour 1 of a sky of radiance 1, all but the last degree above the horizon.
    sky = {"type": "rect", "center": [0, 1, 0], "x": [60, 0, 0], "y": [0, 0, 60], "radiance": 1}
    cosines = np.linspace(0.05, 1, 60)
    at = [steradian.radiance([sky], [0, 0, 0], [0, 1, 0], [math.sqrt(1 - c * c), c, 0], cloth).flatten()[0] for c in cosines]
    albedo = np.interp((-ray / np.linalg.norm(ray, axis=-1, keepdims=True))[..., 1], cosines, at)
    return below * (1 - max(material["sheen"]) * albedo)[..., None] + fibres * np.array(material["sheen"])


def page_words(chromium, url):
    with tempfile.TemporaryDirectory() as profile:
        done = subprocess.run([chromium, *FLAGS, f"--user-data-dir={profile}", "--dump-dom", url], capture_output=True, text=True, timeout=300)
    found = re.search(r"(pixels|failed):([^:]*(?::[^<]*)?):", done.stdout, re.DOTALL)
    if not found or found.group(1) == "failed":
        sys.exit(f"{url[:60]} gave no pixels: {found.group(2) if found else done.stdout[-500:] + done.stderr[-1500:]}")
    return found.group(2)


def browser_pixels(chromium, port, case):
    words = page_words(chromium, f"http://127.0.0.1:{port}/test/page.html?case={urllib.parse.quote(json.dumps(case))}")
    return [np.frombuffer(base64.b64decode(p), np.float32).reshape(HEIGHT, WIDTH, 4)[..., :3] for p in words.split(" ")]


def check_example(chromium, url, picture):
    """The page of example/: it draws, and says how far three's own is off what this package shows."""
    with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as profile:
        done = subprocess.run([chromium, *FLAGS, "--window-size=1000,600", f"--user-data-dir={profile}", f"--screenshot={picture}", "--dump-dom", url],
                              capture_output=True, text=True, timeout=300)
    theirs = re.search(r'id="theirs">([\d.]+) % rms<', done.stdout)
    problem = re.search(r'id="problem"[^>]*>([^<]*)<', done.stdout)
    assert theirs and problem and not problem.group(1), done.stdout[-1500:] + done.stderr[-1500:]
    print(f"example: three's own is {theirs.group(1)} % off; screenshot {picture}")
    assert 1 < float(theirs.group(1)) < 100


def arrays_of(text, *names):
    """Of three's RectAreaLightTexturesLib.js."""
    return [np.array([float(x.replace(" ", "")) for x in re.search(rf"{n} = \[(.*?)\]", text, re.DOTALL).group(1).split(",")]).reshape(64, 64, 4) for n in names]


def our_tables():
    text = (PACKAGE / "src" / "tables.js").read_text()
    coded = lambda name, each: np.frombuffer(base64.b64decode(re.search(rf"{name} = '([^']*)'", text).group(1)), "<f2").astype(float).reshape(64, 64, each)
    return coded("MATRIX", 4), coded("MAGNITUDE", 2)


def check_tables(three, count=1500):
    """three's formula with its tables and with ours, under lights, roughnesses and views that were not fitted to."""
    rng = np.random.default_rng(7)
    lights, roughness, cosine = fit_tables.random_lights(count, 8), rng.uniform(0.06, 1, count), 1 - rng.uniform(0, 0.95, count) ** 2
    corners, wanted = [], []
    for i in range(count):
        one = fit_tables.corners_of({k: v[i:i + 1] for k, v in lights.items()}, cosine[i], roughness[i] ** 2)
        corners.append(one[0])
        wanted.append(fit_tables.sent(one, cosine[i], roughness[i] ** 2)[0])
    corners, wanted = np.stack(corners), np.stack(wanted)
    cut = corners[..., 2].min(1) < 0
    theirs = arrays_of((three / "examples" / "jsm" / "lights" / "RectAreaLightTexturesLib.js").read_text(), "LTC_MAT_1", "LTC_MAT_2")
    off = {}
    for name, tables in (("three's", theirs), ("ours", our_tables())):
        got = np.stack([rect_formula.radiance(corners, roughness, cosine, tables, f0) for f0 in (fit_tables.METAL, fit_tables.PLASTIC)], -1)
        off[name] = [np.sqrt(((got - wanted)[k] ** 2).sum(0) / (wanted[k] ** 2).sum(0)) for k in (slice(None), cut)]
        print(f"{count} lights that were not fitted to, {name}: relative rms {off[name][0][0]:.4f} on metal, {off[name][0][1]:.4f} on plastic's lobe; "
              f"of the {cut.sum()} that the horizon cuts {off[name][1][0]:.4f}, {off[name][1][1]:.4f}")
    return off["ours"][0][0] < 0.6 * off["three's"][0][0]


def main():
    chromium = browser.find()
    if chromium is None:
        skip("there is no Chromium here (apt-get install chromium)")
    three = three_from_npm(Path(sys.argv[1]))
    server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), functools.partial(Files, three=three, snippets=snippets()))
    threading.Thread(target=server.serve_forever, daemon=True).start()
    for i in range(len(snippets())):
        assert page_words(chromium, f"http://127.0.0.1:{server.server_address[1]}/snippet/{i}.html") == "snippet"
    print(f"README.md: {len(snippets())} pieces run")
    check_example(chromium, f"http://127.0.0.1:{server.server_address[1]}/package/example/index.html", Path(sys.argv[1]) / "example.png")
    eye, failed, errors = [0, 1.6, 2.6], not check_tables(three), {}
    for name, lights, material, roughness in CASES:
        methods = ["compact", "closed-form"]
        if name in WITH_THREE_S_OWN:
            methods += ["tables", "three"]
        case, want = case_of(name, lights, material, roughness, methods, eye)
        white = np.quantile(want, 0.999)
        for method, got in zip(methods, browser_pixels(chromium, server.server_address[1], case)):
            off = np.abs(got - want).max(axis=-1) / white
            mean, rms = got.mean() / want.mean(), np.sqrt(((got - want) ** 2).mean()) / np.sqrt((want ** 2).mean())
            if name in WITH_THREE_S_OWN[:2]:
                errors.setdefault(method, []).append(rms)
            print(f"{name}, roughness {roughness}, {method}: mean ratio {mean:.4f}, relative rms {rms:.4f}, "
                  f"99.5 % of the pixels within {np.quantile(off, 0.995):.4f} of white", flush=True)
            if method in BOUNDS:
                failed = failed or abs(mean - 1) > BOUNDS[method][0] or not np.quantile(off, 0.995) < BOUNDS[method][1]
    ours, theirs = np.mean(errors["tables"]), np.mean(errors["three"])
    print(f"relative rms of RectAreaLight: {theirs:.4f} with three's tables, {ours:.4f} with ours")
    failed = failed or ours > theirs / 2
    sys.exit(bool(failed))


def matrix_of(place):
    """As three's Matrix4.fromArray takes it: column by column."""
    return [v for column, w in zip(place, (0, 0, 0, 1)) for v in [*map(float, column), w]]


if __name__ == "__main__":
    main()
