#!/usr/bin/env python3
"""Times a million points under a quad: the table of docs/python-module.md."""
import time

import numpy as np

import steradian

PANEL = {"type": "rect", "center": [0, 2, 0], "x": [1, 0, 0], "y": [0, 0, 1]}
LOBES = [
    ("Lambert, `irradiance`", {"brdf": "lambert"}, "auto"),
    ("GGX, `ltc-compact`", {"brdf": "ggx", "roughness": 0.4, "f0": 0.04}, "ltc-compact"),
    ("GGX, `closed-form`", {"brdf": "ggx", "roughness": 0.4, "f0": 0.04}, "closed-form"),
    ("Phong, `series`", {"brdf": "phong", "exponent": 30}, "series"),
    ("sheen, `cubature`", {"brdf": "charlie", "roughness": 0.4}, "cubature"),
]


def best(run, least=7):
    times = []
    for _ in range(least):
        start = time.perf_counter()
        run()
        times.append(time.perf_counter() - start)
    return 1e3 * min(times)


def main():
    rng = np.random.default_rng(1)
    count = 1_000_000
    double = [rng.random((count, 3)) * [4, 1, 4] - [2, 0.5, 2], rng.normal(size=(count, 3)) + [0, 1.5, 0],
              rng.normal(size=(count, 3)) + [0, 1.5, 0]]
    single = [a.astype(np.float32) for a in double]
    for name, material, method in LOBES:
        cells = []
        for position, normal, view in (single, double):
            if material["brdf"] == "lambert":
                cells.append(best(lambda: steradian.irradiance(PANEL, position, normal)))
            else:
                cells.append(best(lambda: steradian.radiance(PANEL, position, normal, view, material, method), 3))
        print(f"| {name} | " + " | ".join(f"{ms:.0f} ms" for ms in cells) + " |")


if __name__ == "__main__":
    main()
