"""Compares two pictures of linear radiance patch by patch: what docs/blender.md's figures were found with.

    blender -b --factory-startup --python compare.py -- A.exr B.exr

A patch is 8 x 8 pixels; those darker than a hundredth of B's mean are left out. Prints the ratio of the means and the patches farthest off.
"""

import sys

import bpy

SIDE = 8


def patches(path):
    image = bpy.data.images.load(path)
    image.colorspace_settings.name = "Non-Color"
    width, height = image.size
    values = list(image.pixels)
    result = {}
    for top in range(0, height - SIDE + 1, SIDE):
        for left in range(0, width - SIDE + 1, SIDE):
            total = 0.0
            for y in range(top, top + SIDE):
                row = 4 * (y * width + left)
                for x in range(SIDE):
                    total += sum(values[row + 4 * x : row + 4 * x + 3])
            result[left, height - SIDE - top] = total / (3 * SIDE * SIDE)
    return result


def main():
    a, b = (patches(path) for path in sys.argv[sys.argv.index("--") + 1 :])
    mean = sum(b.values()) / len(b)
    ratios = {p: a[p] / b[p] for p in b if b[p] > mean / 100}
    print(f"compare: mean A / mean B {sum(a.values()) / sum(b.values()):.4f}, {len(ratios)} patches")
    worst = sorted(ratios, key=lambda p: -abs(ratios[p] - 1))
    for p in worst[:6]:
        print(f"compare: patch at {p}: {ratios[p]:.4f} (A {a[p]:.4g}, B {b[p]:.4g})")
    within = sum(abs(r - 1) < 0.03 for r in ratios.values()) / len(ratios)
    print(f"compare: {100 * within:.1f} % of the patches within 3 %")


main()
