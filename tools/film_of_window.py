#!/usr/bin/env python3
"""Makes the moving picture of the manual: a lamp of `gallery` carried through the room in the window, as an APNG.

    tools/film_of_window.py PROGRAM OUT.png [FRAMES]

The window is opened under Xvfb (xvfb-run) and driven by a script. Python's standard library alone. Colours are rounded to 64 levels, with
which the film takes half the room.
"""
import json
import math
import struct
import subprocess
import sys
import tempfile
import zlib
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
SIZE, FRAMES, FRAMES_A_SECOND = "256x144", 14, 8


def chunk(kind, data):
    return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))


def parts(path):
    """The header of a PNG and its packed pixels."""
    data, at, header, packed = path.read_bytes(), 8, b"", b""
    while at < len(data):
        size, kind = struct.unpack_from(">I4s", data, at)
        if kind == b"IHDR":
            header = data[at + 8:at + 8 + size]
        if kind == b"IDAT":
            packed += data[at + 8:at + 8 + size]
        at += 12 + size
    return header, packed


def predictions(left, above, corner):
    """What PNG's five filters expect of a byte."""
    paeth = min((left, above, corner), key=lambda q: abs(left + above - corner - q))
    return 0, left, above, (left + above) // 2, paeth


def rows_of(packed, width, height):
    """The bytes of a picture of 8-bit RGB, row by row; before the first pixel of each and before the first row stand zeros."""
    data, rows = zlib.decompress(packed), [bytes(3 + 3 * width)]
    for y in range(height):
        kind, *row = data[y * (3 * width + 1):(y + 1) * (3 * width + 1)]
        row, above = [0, 0, 0] + row, rows[-1]
        for i in range(3, len(row)):
            row[i] = (row[i] + predictions(row[i - 3], above[i], above[i - 3])[kind]) & 255
        rows.append(bytes(row))
    return rows


def rounded(packed, width, height):
    """The same pixels in 64 levels, packed anew: of each row the filter that leaves least."""
    level = bytes(min(255, (v + 2) // 4 * 4) for v in range(256))
    rows, out = [row.translate(level) for row in rows_of(packed, width, height)], b""
    for above, row in zip(rows, rows[1:]):
        filtered = zip(*[[(row[i] - p) & 255 for p in predictions(row[i - 3], above[i], above[i - 3])] for i in range(3, len(row))])
        out += min((bytes([kind, *left]) for kind, left in enumerate(filtered)), key=lambda line: sum(min(v, 256 - v) for v in line[1:]))
    return zlib.compress(out, 9)


def apng(pictures, rate):
    """Pictures of one size as one that moves, for ever."""
    out, number = b"", 0
    for i, path in enumerate(pictures):
        header, packed = parts(path)
        if i == 0:
            out += b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"acTL", struct.pack(">II", len(pictures), 0))
        width, height = struct.unpack_from(">II", header)
        packed = rounded(packed, width, height)
        out += chunk(b"fcTL", struct.pack(">IIIIIHHBB", number, width, height, 0, 0, 1, rate, 0, 0))
        number += 1
        if i == 0:
            out += chunk(b"IDAT", packed)
        else:
            out += chunk(b"fdAT", struct.pack(">I", number) + packed)
            number += 1
    return out + chunk(b"IEND", b"")


def main():
    if len(sys.argv) not in (3, 4):
        sys.exit(__doc__)
    program, out, frames = Path(sys.argv[1]).resolve(), Path(sys.argv[2]), int(sys.argv[3]) if len(sys.argv) == 4 else FRAMES
    with tempfile.TemporaryDirectory() as folder:
        events = [{"wait": "settled"}, {"select": "lamp"}]
        shots = [Path(folder) / f"{i:03}.png" for i in range(frames)]
        for i, shot in enumerate(shots):
            a = 2 * math.pi * i / frames
            events += [{"set": "position", "value": [1.3 + 1.15 * math.cos(a), 0.75 - 0.35 * math.cos(2 * a), 0.6 + 1.2 * math.sin(a)]},
                       {"wait": "settled"}, {"shot": str(shot)}]
        script = Path(folder) / "script.jsonl"
        script.write_text("".join(json.dumps(e) + "\n" for e in events + [{"quit": True}]))
        subprocess.run(["xvfb-run", "-a", "-s", "-screen 0 640x480x24", program, "view", ROOT / "scenes" / "gallery.glb", "--size", SIZE,
                        "--exposure", "1.5", "--panel", "off", "--script", script], check=True)
        out.write_bytes(apng(shots, FRAMES_A_SECOND))
    print(f"{out}: {frames} frames, {out.stat().st_size / 1e6:.2f} MB")


main()
