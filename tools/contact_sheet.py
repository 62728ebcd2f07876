#!/usr/bin/env python3
"""Renders every scene of some folders, glTF and SVG, and puts the pictures on one sheet.

    tools/contact_sheet.py PROGRAM SHEET.png [--size WxH] [--most SECONDS] [--shine] FOLDER_OR_FILE ... [-- OPTIONS OF RENDER ...]

    --size WxH      of the pictures whose time is taken (160x120); the sheet shows each at 160x120
    --most SECONDS  that a picture may take
    --shine         makes every shape of an SVG a light: drawings that know nothing of us are black otherwise

Prints a line a file: its place on the sheet (row, column), the exit status, seconds, how bright the picture is, the name, and what
the program said. A file that is refused leaves a grey field. Crashes (a status that is neither 0 nor 1), pictures that took too long, and
black pictures of files with triangles, or of drawings made to shine, end with exit status 1. Python's standard library alone.
"""
import argparse
import re
import subprocess
import sys
import tempfile
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
from png_files import read_png, write_png  # noqa: E402

WIDTH, HEIGHT, COLUMNS = 160, 120, 8  # of a field of the sheet
SIZE = f"{WIDTH}x{HEIGHT}"
GREY = bytes([90, 90, 90]) * WIDTH


def shining(svg, folder):
    """A copy of a drawing whose every shape is a light."""
    text = svg.read_text(errors="replace")
    copy = Path(folder) / svg.name
    copy.write_text(re.sub(r"<svg\b", '<svg data-steradian="light"', text, count=1))
    return copy


def render(program, scene, timed_size, shine, options):
    """Exit status, seconds, what was said, and the rows of the sheet's picture, or none."""
    with tempfile.TemporaryDirectory() as folder:
        picture = Path(folder) / "picture.png"
        if scene.suffix == ".svg":
            scene = shining(scene, folder) if shine else scene
        else:
            options = ["--aa", "4", *options]

        def run(size):
            start = time.monotonic()
            done = subprocess.run(
                [program, "render", scene, "-o", picture, "--size", size, *options],
                capture_output=True,
                text=True,
                errors="replace",
                timeout=600,
            )
            return done, time.monotonic() - start

        done, seconds = run(timed_size)
        if done.returncode == 0 and timed_size != SIZE:
            run(SIZE)
        return done.returncode, seconds, done.stderr.strip(), read_png(picture) if picture.exists() else None


def arguments():
    words = sys.argv[1:]
    at = words.index("--") if "--" in words else len(words)
    parser = argparse.ArgumentParser(usage=__doc__)
    parser.add_argument("program")
    parser.add_argument("sheet")
    parser.add_argument("names", nargs="+", type=Path)
    parser.add_argument("--size", default=SIZE)
    parser.add_argument("--most", type=float, default=600)
    parser.add_argument("--shine", action="store_true")
    return parser.parse_intermixed_args(words[:at]), words[at + 1 :]


def main():
    given, options = arguments()
    files = []
    for name in given.names:
        files += sorted(f for f in name.rglob("*") if f.suffix in (".gltf", ".glb", ".svg")) if name.is_dir() else [name]

    rows, wrong, slowest = [], 0, 0
    for i, file in enumerate(files):
        status, seconds, said, picture = render(given.program, file, given.size, given.shine, options)
        bright = max((max(row) for row in picture), default=0) if picture else 0
        expected = given.shine if file.suffix == ".svg" else "has no triangles" not in said  # which is reason enough
        black = picture is not None and bright < 8 and expected
        crashed, late = status not in (0, 1), seconds > given.most
        wrong += black or crashed or late
        slowest = max(slowest, seconds)
        if i % COLUMNS == 0:
            rows += [b""] * HEIGHT
        field = picture or [GREY] * HEIGHT
        for y in range(HEIGHT):
            rows[i // COLUMNS * HEIGHT + y] += field[y]
        note = " CRASH" if crashed else " BLACK" if black else " LATE" if late else ""
        said = " | ".join(line for line in said.splitlines() if "(auto)" not in line and "no camera" not in line)
        print(f"{i // COLUMNS},{i % COLUMNS}{note} status {status} {seconds:.2f} s max {bright}: {file}: {said}", flush=True)
    longest = max(map(len, rows))
    write_png(given.sheet, [row + b"\0" * (longest - len(row)) for row in rows])
    print(f"{len(files)} files, {wrong} black, late or crashed, the slowest {slowest:.2f} s: {given.sheet}")
    sys.exit(1 if wrong else 0)


if __name__ == "__main__":
    main()
