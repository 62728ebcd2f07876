#!/usr/bin/env python3
"""Renders every glTF file of some folders and puts the pictures on one sheet.

    tools/contact_sheet.py PROGRAM SHEET.png FOLDER_OR_FILE ... [-- OPTIONS OF RENDER ...]

Prints a line a file: its place on the sheet (row, column), the exit status, seconds, how bright the picture is, the name, and what
the program said. A file that is refused leaves a grey field; a crash (a status that is neither 0 nor 1) or a black picture of a file
with triangles ends with exit status 1. Python's standard library alone.
"""
import struct
import subprocess
import sys
import tempfile
import time
import zlib
from pathlib import Path

WIDTH, HEIGHT, COLUMNS = 160, 120, 8
GREY = bytes([90, 90, 90]) * WIDTH


def read_png(path):
    """Rows of 8-bit RGB."""
    data = Path(path).read_bytes()
    at, packed, width, height, kind = 8, b"", 0, 0, 0
    while at < len(data):
        length, name = struct.unpack_from(">I4s", data, at)
        if name == b"IHDR":
            width, height, _, kind = struct.unpack_from(">IIBB", data, at + 8)
        if name == b"IDAT":
            packed += data[at + 8 : at + 8 + length]
        at += 12 + length
    step = {2: 3, 6: 4}[kind]
    raw, rows, before = zlib.decompress(packed), [], bytearray(width * step)
    for y in range(height):
        code, line = raw[y * (width * step + 1)], bytearray(raw[y * (width * step + 1) + 1 : (y + 1) * (width * step + 1)])
        for x in range(len(line)):
            a, b = line[x - step] if x >= step else 0, before[x]
            c = before[x - step] if x >= step else 0
            nearest = min((abs(b - c), 0, a), (abs(a - c), 1, b), (abs(a + b - 2 * c), 2, c))[2]  # Paeth
            line[x] = (line[x] + (0, a, b, (a + b) // 2, nearest)[code]) & 255
        rows.append(b"".join(bytes(line[x : x + 3]) for x in range(0, len(line), step)))
        before = line
    return rows


def write_png(path, rows):
    def chunk(name, body):
        return struct.pack(">I", len(body)) + name + body + struct.pack(">I", zlib.crc32(name + body))

    header = struct.pack(">IIBBBBB", len(rows[0]) // 3, len(rows), 8, 2, 0, 0, 0)
    body = zlib.compress(b"".join(b"\0" + row for row in rows))
    Path(path).write_bytes(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", body) + chunk(b"IEND", b""))


def render(program, scene, options):
    """Exit status, seconds, what was said, and the picture's rows, or none."""
    with tempfile.TemporaryDirectory() as folder:
        picture = Path(folder) / "picture.png"
        start = time.monotonic()
        done = subprocess.run(
            [program, "render", scene, "-o", picture, "--size", f"{WIDTH}x{HEIGHT}", "--aa", "4", *options],
            capture_output=True,
            text=True,
            errors="replace",
            timeout=600,
        )
        seconds = time.monotonic() - start
        return done.returncode, seconds, done.stderr.strip(), read_png(picture) if picture.exists() else None


def main():
    arguments = sys.argv[1:]
    options = arguments[arguments.index("--") + 1 :] if "--" in arguments else []
    arguments = arguments[: arguments.index("--")] if "--" in arguments else arguments
    if len(arguments) < 3:
        sys.exit(__doc__)
    program, sheet, files = arguments[0], arguments[1], []
    for name in map(Path, arguments[2:]):
        files += sorted(f for f in name.rglob("*") if f.suffix in (".gltf", ".glb")) if name.is_dir() else [name]

    rows, wrong = [], 0
    for i, file in enumerate(files):
        status, seconds, said, picture = render(program, file, options)
        bright = max((max(row) for row in picture), default=0) if picture else 0
        black = picture is not None and bright < 8 and "has no triangles" not in said  # which is reason enough
        crashed = status not in (0, 1)
        wrong += black or crashed
        if i % COLUMNS == 0:
            rows += [b""] * HEIGHT
        for y in range(HEIGHT):
            rows[i // COLUMNS * HEIGHT + y] += picture[y] if picture else GREY
        note = " CRASH" if crashed else " BLACK" if black else ""
        said = " | ".join(line for line in said.splitlines() if "(auto)" not in line and "no camera" not in line)
        print(f"{i // COLUMNS},{i % COLUMNS}{note} status {status} {seconds:.2f} s max {bright}: {file}: {said}", flush=True)
    longest = max(map(len, rows))
    write_png(sheet, [row + b"\0" * (longest - len(row)) for row in rows])
    print(f"{len(files)} files, {wrong} black or crashed: {sheet}")
    sys.exit(1 if wrong else 0)


main()
