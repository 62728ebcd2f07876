#!/usr/bin/env python3
"""Draws a ball of few facets under an area light with a strict and with a smooth terminator, side by side.

    tools/draw_terminator.py PROGRAM PICTURE.png

Python's standard library alone.
"""
import subprocess
import sys
import tempfile
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "scenes"))
from png_files import read_png, write_png  # noqa: E402
from gltf_writer import Gltf, looking, plate, sphere  # noqa: E402


def scene():
    g = Gltf()
    g.node("floor", mesh=g.mesh("floor", plate((-4, 0, 3), (4, 0, 3), (4, 0, -4), (-4, 0, -4)), g.diffuse("floor", (0.6, 0.57, 0.53))))
    g.node("ball", mesh=g.mesh("ball", sphere(16, 8), g.diffuse("ball", (0.75, 0.72, 0.7))), translation=[0.0, 1.0, 0.0])
    g.area_light("panel", {"type": "rect", "color": [1.0, 1.0, 1.0], "intensity": 30.0, "size": 1.2}, matrix=looking([-3.2, 3.4, 1.4], [0.0, 1.0, 0.0]))
    g.camera("main", [0.6, 1.6, 4.6], [0.0, 0.9, 0.0], 0.55)
    return g


def main():
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    rows = None
    with tempfile.TemporaryDirectory() as folder:
        scene().write(str(Path(folder) / "ball.glb"))
        for terminator in ("strict", "smooth"):
            picture = Path(folder) / "ball.png"
            subprocess.run([sys.argv[1], "render", Path(folder) / "ball.glb", "-o", picture, "--size", "360x300", "--aa", "4", "--exposure", "0",
                            "--terminator", terminator], check=True)
            half = read_png(picture)
            rows = half if rows is None else [a + b for a, b in zip(rows, half)]
    write_png(sys.argv[2], rows)


main()
