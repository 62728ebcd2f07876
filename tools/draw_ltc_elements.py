#!/usr/bin/env python3
"""draw_ltc_elements.py PICTURE.png: what each element of M does to the cosine lobe (docs/theory/ltc.md).

M = [a 0 b; 0 1 0; c 0 d]. A row for each element, five values in a row, the third of them the cosine itself; spheres seen from the
front, 30 degrees up, x to the right, the horizon drawn. Brightness is the density's square root, as a share of the largest of its
sphere. Standard library only.
"""

import math
import sys

from png_files import write_png

SIDE, GAP = 120, 6
ROWS = (("a", (0.25, 0.5, 1.0, 2.0, 4.0)), ("b", (-0.8, -0.4, 0.0, 0.4, 0.8)), ("c", (-0.8, -0.4, 0.0, 0.4, 0.8)),
        ("d", (0.25, 0.5, 1.0, 2.0, 4.0)))


def density(a, b, c, d, w):
    """D(w) = max(u_z, 0) |M^-1| / (pi |u|^4), u = M^-1 w."""
    determinant = a * d - b * c
    u = ((d * w[0] - b * w[2]) / determinant, w[1], (a * w[2] - c * w[0]) / determinant)
    return max(u[2], 0) / (abs(determinant) * math.pi * (u[0] ** 2 + u[1] ** 2 + u[2] ** 2) ** 2)


def sphere(elements):
    """SIDE rows of SIDE brightnesses in [0, 1]; None off the sphere, and on the horizon."""
    up, low = math.sin(math.radians(30)), math.cos(math.radians(30))
    picture = []
    for j in range(SIDE):
        row = []
        for i in range(SIDE):
            x, y = (2 * i + 1) / SIDE - 1, 1 - (2 * j + 1) / SIDE
            if x * x + y * y > 1:
                row.append(None)
                continue
            depth = math.sqrt(1 - x * x - y * y)
            # The camera looks along (0, low, -up): right is x, upwards (0, up, low).
            w = (x, y * up - depth * low, y * low + depth * up)
            row.append(None if abs(w[2]) < 0.012 else density(*elements, w))
        picture.append(row)
    most = max(v for row in picture for v in row if v is not None)
    return [[None if v is None else math.sqrt(v / most) for v in row] for row in picture]


def colour(v, inside):
    if v is None:
        return (120, 120, 120) if inside else (255, 255, 255)
    # From dark blue over orange to white.
    return tuple(int(255 * min(1.0, max(0.0, k))) for k in (0.12 + 1.5 * v, 0.15 + 0.85 * v * v, 0.30 - 0.25 * v + 0.95 * v ** 4))


def main():
    lines = []
    for name, values in ROWS:
        tiles = []
        for value in values:
            elements = dict(a=1.0, b=0.0, c=0.0, d=1.0) | {name: value}
            tiles.append(sphere([elements[k] for k in "abcd"]))
        for j in range(SIDE):
            row = b""
            for tile in tiles:
                for i in range(SIDE):
                    x, y = (2 * i + 1) / SIDE - 1, 1 - (2 * j + 1) / SIDE
                    row += bytes(colour(tile[j][i], x * x + y * y <= 1))
                row += b"\xff" * 3 * GAP
            lines.append(row[:-3 * GAP])
        lines += [b"\xff" * len(lines[0])] * GAP
    write_png(sys.argv[1], lines[:-GAP])


if __name__ == "__main__":
    main()
