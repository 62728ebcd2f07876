#!/usr/bin/env python3
"""Makes the moving picture of the manual: a lamp of `gallery` carried through the room in the window, as an APNG.

    tools/film_of_window.py PROGRAM OUT.png [FRAMES]

The window is opened under Xvfb (xvfb-run) and driven by a script. Python's standard library alone.
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
SIZE, FRAMES_A_SECOND = "320x180", 12


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


def apng(pictures, rate):
    """Pictures of one size as one that moves, for ever: their pixels stay packed as they are."""
    out, number = b"", 0
    for i, path in enumerate(pictures):
        header, packed = parts(path)
        if i == 0:
            out += b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"acTL", struct.pack(">II", len(pictures), 0))
        width, height = struct.unpack_from(">II", header)
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
    program, out, frames = Path(sys.argv[1]).resolve(), Path(sys.argv[2]), int(sys.argv[3]) if len(sys.argv) == 4 else 32
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
