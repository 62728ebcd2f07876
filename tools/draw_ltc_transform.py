#!/usr/bin/env python3
"""draw_ltc_transform.py PICTURE.png: a lobe and a light, and both under M^-1 (docs/theory/ltc.md).

Left the lobe with the outline of a rectangle of light. Right the same directions under M^-1: the lobe is the cosine, and the light is another
polygon with the same integral, which is printed for both. Spheres as in draw_ltc_elements.py. Standard library only.
"""

import math
import sys

from draw_ltc_elements import colour, density
from png_files import write_png

SIDE, GAP, LINE = 260, 12, 0.018
M = (0.45, 0.6, -0.1, 0.9)  # a, b, c, d
LIGHT = ((0.35, -0.55, 0.75), (1.1, -0.45, 0.6), (1.15, 0.25, 0.7), (0.4, 0.15, 0.85))
COSINE = (1.0, 0.0, 0.0, 1.0)


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def unit(v):
    length = math.sqrt(dot(v, v))
    return tuple(x / length for x in v)


def under(elements, v):
    """M^-1 v."""
    a, b, c, d = elements
    determinant = a * d - b * c
    return ((d * v[0] - b * v[2]) / determinant, v[1], (a * v[2] - c * v[0]) / determinant)


def distance_inside(light, w):
    """Sine of the angle to the nearest edge; below 0 outside of a convex polygon."""
    inside = unit(tuple(sum(c) for c in zip(*(unit(v) for v in light))))
    edges = [unit(cross(light[k], light[(k + 1) % len(light)])) for k in range(len(light))]
    return min(dot(n, w) * (1 if dot(n, inside) > 0 else -1) for n in edges)


def integral(elements, light, steps=400):
    """The lobe's integral over a polygon by midpoints of its two triangles."""
    total = 0.0
    for a, b, c in ((light[0], light[1], light[2]), (light[0], light[2], light[3])):
        normal = cross(tuple(q - p for p, q in zip(a, b)), tuple(q - p for p, q in zip(a, c)))
        for i in range(steps):
            for j in range(steps - i):
                for third in ((1 / 3, 1 / 3), (2 / 3, 2 / 3))[: 1 if i + j == steps - 1 else 2]:
                    u, v = (i + third[0]) / steps, (j + third[1]) / steps
                    p = tuple(x + u * (y - x) + v * (z - x) for x, y, z in zip(a, b, c))
                    square = dot(p, p)
                    w = unit(p)
                    if w[2] > 0 or elements == COSINE:
                        total += density(*elements, w) * abs(dot(normal, w)) / square / (2 * steps * steps)
    return total


def sphere(elements, light):
    """SIDE rows of colours."""
    up, low = math.sin(math.radians(30)), math.cos(math.radians(30))
    values, rows = [], []
    for j in range(SIDE):
        for i in range(SIDE):
            x, y = (2 * i + 1) / SIDE - 1, 1 - (2 * j + 1) / SIDE
            if x * x + y * y > 1:
                values.append((None, False))
                continue
            depth = math.sqrt(1 - x * x - y * y)
            w = (x, y * up - depth * low, y * low + depth * up)
            if abs(distance_inside(light, w)) < LINE and min(dot(w, unit(v)) for v in light) > 0:
                values.append(("line", True))
            else:
                values.append((None if abs(w[2]) < 0.008 else density(*elements, w), True))
    most = max(v for v, _ in values if isinstance(v, float))
    for j in range(SIDE):
        row = b""
        for v, inside in values[j * SIDE : (j + 1) * SIDE]:
            row += bytes((90, 220, 120) if v == "line" else colour(None if v is None else math.sqrt(v / most), inside))
        rows.append(row)
    return rows


def main():
    light = tuple(unit(v) for v in LIGHT)
    other = tuple(unit(under(M, v)) for v in LIGHT)
    left, right = sphere(M, light), sphere(COSINE, other)
    write_png(sys.argv[1], [a + b"\xff" * 3 * GAP + b for a, b in zip(left, right)])
    print("integral of the lobe over the light      %.4f" % integral(M, LIGHT))
    print("integral of the cosine under M^-1        %.4f" % integral(COSINE, tuple(under(M, v) for v in LIGHT)))


if __name__ == "__main__":
    main()
