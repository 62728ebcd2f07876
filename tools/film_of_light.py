#!/usr/bin/env python3
"""Renders a film of a light that moves over the scene `grille`, and prints how much any pixel changes from frame to frame.

    tools/film_of_light.py PROGRAM STRIP.png [FRAMES] [-- OPTIONS OF RENDER ...]

Prints the largest change between neighbouring frames, as a share of the pictures' white, and the largest in the steps where it is found
when the light goes there in four steps: where shadows move without a flicker, a quarter. Six of the frames become a strip. Python's
standard library alone.
"""
import json
import subprocess
import sys
import tempfile
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "scenes"))
from png_files import read_png, write_png  # noqa: E402
from make_scenes import grille  # noqa: E402

SIZE, STRIP_SIZE, FROM, TO = "192x120", "240x150", -0.6, 0.8  # the light's x


class Film:
    def __init__(self, program, folder, frames, options):
        self.program, self.folder, self.frames, self.options, self.made = program, Path(folder), frames, options, {}

    def scene(self, time):
        """A file with the light where it is at a time in frames."""
        gltf = grille()
        for node in gltf.json["nodes"]:
            if node["name"] == "panel":
                node["translation"][0] = FROM + (TO - FROM) * time / (self.frames - 1)
        path = self.folder / "scene.glb"
        gltf.write(str(path))
        return path

    def render(self, time, name, size, *options):
        command = [self.program, "render", self.scene(time), "-o", self.folder / name, "--size", size, *options, *self.options]
        subprocess.run(command, check=True, stderr=subprocess.DEVNULL)
        return self.folder / name

    def frame(self, time):
        if time not in self.made:
            self.made[time] = self.render(time, f"{time:.2f}.exr", SIZE)
        return self.made[time]

    def change(self, before, after):
        """The largest of any pixel, as a share of the later picture's white."""
        said = subprocess.run([self.program, "diff", self.frame(before), self.frame(after), "--json"], check=True, capture_output=True, text=True)
        difference = json.loads(said.stdout)
        return difference["max"] / difference["white"]


def main():
    arguments = sys.argv[1:]
    options = arguments[arguments.index("--") + 1 :] if "--" in arguments else []
    arguments = arguments[: arguments.index("--")] if "--" in arguments else arguments
    if len(arguments) not in (2, 3):
        sys.exit(__doc__)
    program, strip = arguments[:2]
    frames = int(arguments[2]) if len(arguments) == 3 else 60
    with tempfile.TemporaryDirectory() as folder:
        film = Film(program, folder, frames, options)
        steps = [(film.change(i, i + 1), i) for i in range(frames - 1)]
        largest, at = max(steps)
        middle = sorted(steps)[len(steps) // 2][0]
        print(f"{frames} frames, {(TO - FROM) / (frames - 1) * 100:.1f} cm a step: a pixel changes by {100 * largest:.2f} % of white at most (frame {at} to {at + 1}), "
              f"in the median frame by {100 * middle:.2f} %")
        quarters = max(film.change(at + i / 4, at + (i + 1) / 4) for i in range(4))
        print(f"in four steps from frame {at} to {at + 1}: {100 * quarters:.2f} % at most, {quarters / largest:.2f} of the whole step's")
        rows = None
        for i in range(6):
            picture = read_png(film.render(i * (frames - 1) / 5, "strip.png", STRIP_SIZE, "--aa", "4", "--exposure", "-0.5"))
            rows = picture if rows is None else [a + b for a, b in zip(rows, picture)]
        # Three a row.
        third = len(rows[0]) // 2
        write_png(strip, [row[:third] for row in rows] + [row[third:] for row in rows])


main()
