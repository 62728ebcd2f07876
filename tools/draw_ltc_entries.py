#!/usr/bin/env python3
"""draw_ltc_entries.py PICTURE.png: the entries of M^-1 for GGX by both normalisations (docs/theory/ltc.md).

Two rows of four maps of tables/ggx_classic.h. Roughness is to the right from 0 to 1, and the view downwards from the normal to the horizon.
Above, the middle element is 1: column 0 row 0, column 0 row 2, column 2 row 0, column 2 row 2. Below, the last element is 1, and the fourth
map is the middle one. White is 0, red positive, blue negative, full colour at 2 and beyond. Standard library only.
"""

import re
import sys
from pathlib import Path

from png_files import write_png

ROOT = Path(__file__).resolve().parent.parent
SCALE, GAP, MOST = 2, 8, 2.0


def nodes():
    text = (ROOT / "tables" / "ggx_classic.h").read_text()
    body = re.search(r"ltc_ggx_matrix\[\d+\] = \{(.*?)\}", text, re.DOTALL)[1]
    numbers = [float(x.rstrip("f")) for x in re.findall(r"[-+0-9.eE]+f", body)]
    size = int(re.search(r"ltc_ggx_size = (\d+)", text)[1])
    return size, [numbers[i : i + 4] for i in range(0, len(numbers), 4)]


def colour(x):
    t = max(-1.0, min(1.0, x / MOST))
    fade = int(255 * (1 - abs(t)))
    return (255, fade, fade) if t > 0 else (fade, fade, 255)


def main():
    size, middle = nodes()
    last = [(m[0] / m[3], m[1] / m[3], m[2] / m[3], 1 / m[3]) if m[3] != 0 else (0, 0, 0, 0) for m in middle]
    lines = []
    for table in (middle, last):
        for j in range(size):
            row = b""
            for entry in range(4):
                row += b"".join(bytes(colour(table[j * size + i][entry])) * SCALE for i in range(size)) + b"\xff" * 3 * GAP
            lines += [row[: -3 * GAP]] * SCALE
        lines += [b"\xff" * len(lines[0])] * GAP
    write_png(sys.argv[1], lines[:-GAP])


if __name__ == "__main__":
    main()
