"""Reads and writes PNG pictures of 8 bits, small ones for docs/."""

import struct
import zlib
from pathlib import Path


def read_png(path):
    """Rows of 8-bit RGB, from the top; alpha is left out."""
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
        for x in range(len(line) if code != 0 else 0):
            a, b = line[x - step] if x >= step else 0, before[x]
            if code == 4:  # Paeth
                c = before[x - step] if x >= step else 0
                near = min((abs(b - c), 0, a), (abs(a - c), 1, b), (abs(a + b - 2 * c), 2, c))[2]
            else:
                near = (0, a, b, (a + b) // 2)[code]
            line[x] = (line[x] + near) & 255
        rows.append(bytes(line) if step == 3 else b"".join(bytes(line[x : x + 3]) for x in range(0, len(line), step)))
        before = line
    return rows


def write_png(path, rows):
    """rows: bytes of red, green and blue, one string a row, from the top."""
    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
    # Each row as differences from the pixels on its left (filter 1) or from the row above (2), whichever are smaller.
    above, filtered = bytes(len(rows[0])), []
    for row in rows:
        left = bytes((a - b) & 255 for a, b in zip(row, bytes(3) + row))
        up = bytes((a - b) & 255 for a, b in zip(row, above))
        size = lambda r: sum(min(x, 256 - x) for x in r)
        filtered.append(b"\1" + left if size(left) < size(up) else b"\2" + up)
        above = row
    packed = zlib.compress(b"".join(filtered), 9)
    with open(path, "wb") as f:
        f.write(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", len(rows[0]) // 3, len(rows), 8, 2, 0, 0, 0)) +
                chunk(b"IDAT", packed) + chunk(b"IEND", b""))
