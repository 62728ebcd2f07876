#!/usr/bin/env python3
"""street.py HOUSES: writes a street between two rows of houses as OBJ to the standard output, HOUSES a side.

Houses have different widths, heights and distances from the road, and stand close together or 1 to 3 m apart.
"""
import random
import sys


def street(houses):
    numbers, vertices, faces = random.Random(1), [], []

    def quad(*corners):
        faces.append([len(vertices) + i + 1 for i in range(4)])
        vertices.extend(corners)

    end = 0
    for side in (0, 1):
        x1 = 0
        for _ in range(houses):
            x0 = x1
            width, height, back = numbers.uniform(8, 14), numbers.uniform(6, 20), numbers.uniform(0, 1.5)
            x1, y0 = x0 + width, -16 - back if side == 0 else 6 + back
            y1 = y0 + 10
            quad((x0, y0, height), (x1, y0, height), (x1, y1, height), (x0, y1, height))
            quad((x0, y0, 0), (x1, y0, 0), (x1, y0, height), (x0, y0, height))
            quad((x1, y0, 0), (x1, y1, 0), (x1, y1, height), (x1, y0, height))
            quad((x1, y1, 0), (x0, y1, 0), (x0, y1, height), (x1, y1, height))
            quad((x0, y1, 0), (x0, y0, 0), (x0, y0, height), (x0, y1, height))
            x1 += numbers.choice([0, 1, 3])
        end = max(end, x1)
    quad((0, -6, 0), (end, -6, 0), (end, 6, 0), (0, 6, 0))
    return vertices, faces


def main():
    if len(sys.argv) != 2 or not sys.argv[1].isdigit():
        sys.exit(__doc__)
    vertices, faces = street(int(sys.argv[1]))
    for vertex in vertices:
        print("v {:.6f} {:.6f} {:.6f}".format(*vertex))
    for face in faces:
        print("f {} {} {} {}".format(*face))


if __name__ == "__main__":
    main()
