#!/usr/bin/env python3
"""lightmap_test.py SCRATCH PROGRAM [PICTURE]: a room that PROGRAM bakes, drawn by three.js with the plug-in, against the picture that PROGRAM renders.

PICTURE: writes both side by side as PNG, three.js on the left. Exit 77 (skipped) as three_test.py.
"""
import base64
import functools
import json
import struct
import subprocess
import sys
import tempfile
import threading
import urllib.parse
from http.server import ThreadingHTTPServer
from pathlib import Path

import three_test as common
from three_test import browser, np

sys.path.insert(0, str(Path(__file__).resolve().parents[3] / "tools"))
from png_files import read_png, write_png  # noqa: E402

WIDTH, HEIGHT = 320, 240  # of lightmap.js
SHARE, STEPS = 0.99, 2  # of the pixels are within so many 255ths of white


def room():
    """A room of 4 x 2.5 x 4.5 m with two boxes, and a lamp above the picture; everything is diffuse."""
    data, views, accessors, primitives = b"", [], [], []

    def add(values, kind, count, code, component):
        nonlocal data
        raw = struct.pack(f"<{len(values)}{code}", *values)
        views.append({"buffer": 0, "byteOffset": len(data), "byteLength": len(raw)})
        data += raw
        accessors.append({"bufferView": len(views) - 1, "componentType": component, "count": count, "type": kind})
        return len(accessors) - 1

    def quad(a, b, c, d, material):
        positions = add([x for p in (a, b, c, d) for x in p], "VEC3", 4, "f", 5126)
        accessors[positions].update(min=[min(p[i] for p in (a, b, c, d)) for i in range(3)], max=[max(p[i] for p in (a, b, c, d)) for i in range(3)])
        normal = np.cross(np.subtract(b, a), np.subtract(c, a))
        normals = add(list(normal / np.linalg.norm(normal)) * 4, "VEC3", 4, "f", 5126)
        primitives.append({"attributes": {"POSITION": positions, "NORMAL": normals}, "indices": add([0, 1, 2, 0, 2, 3], "SCALAR", 6, "I", 5125), "material": material})

    def box(low, high, material, inside):
        (x0, y0, z0), (x1, y1, z1) = low, high
        for a, b, c, d in [((x0, y0, z1), (x1, y0, z1), (x1, y1, z1), (x0, y1, z1)), ((x1, y0, z0), (x0, y0, z0), (x0, y1, z0), (x1, y1, z0)),
                           ((x1, y0, z1), (x1, y0, z0), (x1, y1, z0), (x1, y1, z1)), ((x0, y0, z0), (x0, y0, z1), (x0, y1, z1), (x0, y1, z0)),
                           ((x0, y1, z1), (x1, y1, z1), (x1, y1, z0), (x0, y1, z0)), ((x0, y0, z0), (x1, y0, z0), (x1, y0, z1), (x0, y0, z1))]:
            quad(*((d, c, b, a) if inside else (a, b, c, d)), material)

    box((-2, 0, -1.5), (2, 2.5, 3), 0, True)
    box((-1.1, 0, -1.0), (-0.4, 1.3, -0.3), 1, False)
    box((0.2, 0, -0.4), (0.9, 0.6, 0.3), 2, False)
    plain = {"KHR_materials_specular": {"specularFactor": 0}}
    materials = [{"pbrMetallicRoughness": {"baseColorFactor": [*c, 1], "metallicFactor": 0, "roughnessFactor": 1}, "extensions": plain}
                 for c in ([0.7, 0.7, 0.7], [0.8, 0.3, 0.2], [0.2, 0.4, 0.8])]
    down = [-0.7071067811865476, 0, 0, 0.7071067811865476]
    return {"asset": {"version": "2.0"}, "extensionsUsed": ["EXT_lights_area", "KHR_materials_specular"],
            "extensions": {"EXT_lights_area": {"lights": [{"type": "rect", "size": 0.8, "rect": {"aspect": 1.5}, "color": [1, 0.95, 0.9], "intensity": 14}]}},
            "buffers": [{"byteLength": len(data), "uri": "data:application/octet-stream;base64," + base64.b64encode(data).decode()}],
            "bufferViews": views, "accessors": accessors, "materials": materials, "meshes": [{"primitives": primitives, "name": "room"}],
            "cameras": [{"type": "perspective", "perspective": {"yfov": 0.75, "znear": 0.05, "zfar": 50}}],
            "nodes": [{"mesh": 0}, {"camera": 0, "translation": [0, 1.5, 2.9], "rotation": [-0.0995, 0, 0, 0.995]}, {"translation": [-1.1, 2.4, 1.0], "rotation": down, "extensions": {"EXT_lights_area": {"light": 0}}}],
            "scenes": [{"nodes": [0, 1, 2]}], "scene": 0}


class Files(common.Files):
    """/scratch/... is the folder of the baked scene."""

    def __init__(self, *arguments, scratch, **keys):
        self.scratch = scratch
        super().__init__(*arguments, **keys)

    def translate_path(self, path):
        parts = [p for p in urllib.parse.urlparse(path).path.split("/") if p not in ("", "..")]
        return str(self.scratch / parts[1]) if parts[:1] == ["scratch"] else super().translate_path(path)


def srgb(linear):
    x = np.clip(linear, 0, 1)
    return np.where(x <= 0.0031308, 12.92 * x, 1.055 * x ** (1 / 2.4) - 0.055)


def drawn(program, encoding, scratch, chromium, address):
    """The pixels that three.js draws of the room with a map of this encoding."""
    subprocess.run([program, "bake", scratch / "room.gltf", "-o", scratch / "baked.glb", "--texels", "24", "--encoding", encoding], check=True)
    words = common.page_words(chromium, f"{address}/test/lightmap.html")
    return np.frombuffer(base64.b64decode(words), np.float32).reshape(HEIGHT, WIDTH, 4)[::-1, :, :3]


def main():
    program = sys.argv[2]
    chromium = browser.find()
    if chromium is None:
        common.skip("there is no Chromium here (apt-get install chromium)")
    three = common.three_from_npm(Path(sys.argv[1]))
    with tempfile.TemporaryDirectory() as folder:
        scratch = Path(folder)
        (scratch / "room.gltf").write_text(json.dumps(room()))
        subprocess.run([program, "render", scratch / "room.gltf", "-o", scratch / "want.png", "--size", f"{WIDTH}x{HEIGHT}", "--bounces", "all", "--quality", "high",
                        "--exposure", "0", "--tone", "clip"], check=True)
        server = ThreadingHTTPServer(("127.0.0.1", 0), functools.partial(Files, three=three, scratch=scratch))
        threading.Thread(target=server.serve_forever, daemon=True).start()
        rgb16, got = (drawn(program, encoding, scratch, chromium, f"http://127.0.0.1:{server.server_address[1]}") for encoding in ("rgb16", "rgbm"))
        apart = np.abs(rgb16 - got).max() / got.max()
        assert 0 < apart < 1 / 255, f"maps of 8 and 16 bits differ by {apart:.5f} of the brightest pixel"
        want = np.array([np.frombuffer(row, np.uint8).reshape(-1, 3) for row in read_png(scratch / "want.png")]).astype(int)
        off = np.abs(np.round(255 * srgb(got)) - want).max(axis=-1)
        within = (off <= STEPS).mean()
        if len(sys.argv) > 3:
            write_png(sys.argv[3], [row.tobytes() for row in np.concatenate([np.round(255 * srgb(got)), want], axis=1).astype(np.uint8)])
        print(f"{100 * within:.2f} % of the pixels are within {STEPS}/255, the mean is off by {off.mean():.2f}/255, the last hundredth by {np.quantile(off, 0.99):.0f}/255; "
              f"the picture's mean is {want.mean():.0f}/255")
        assert 30 < want.mean() < 225, "the picture is too dark or too bright to judge"
        sys.exit(bool(within < SHARE))


if __name__ == "__main__":
    main()
