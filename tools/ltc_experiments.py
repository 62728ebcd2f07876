#!/usr/bin/env python3
"""The experiments of docs/theory/ltc.md: renders them, writes their pictures, prints their tables.

usage: ltc_experiments.py [--program build/release/bin/steradian] [--images docs/images] [NAME ...]

names: lambert, roughness, horizon, textured, floor; none: all. Standard library only.
Errors are free of the reference's noise: with two references A, B of different seeds, the mean of (P - A)(P - B) is the
square of P's own error, and needs only the rmse of the three pairs.
"""

import argparse
import json
import math
import os
import subprocess
import sys
import tempfile
from functools import partial

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
sys.path.insert(0, os.path.join(ROOT, "scenes"))
sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import make_scenes  # noqa: E402
from png_files import read_png, write_png  # noqa: E402

print = partial(print, flush=True)  # a table's rows take minutes


class Bench:
    def __init__(self, program, images, folder):
        self.program, self.images, self.folder, self.made = program, images, folder, 0

    def scene(self, name, gltf):
        path = os.path.join(self.folder, name + ".glb")
        gltf.write(path)
        return path

    def render(self, scene, size, method, *more, suffix=".exr"):
        """A picture's path, and the milliseconds of its light."""
        self.made += 1
        path = os.path.join(self.folder, "%d%s" % (self.made, suffix))
        if suffix == ".png" and "--exposure" not in more:
            more = (*more, "--exposure", "0")  # the same in all parts of a sheet
        shadows = () if "--shadows" in more else ("--shadows", "off")  # the figures are of the integrals
        subprocess.run([self.program, "render", scene, "-o", path, "--size", size, "--method", method, "--stats", path + ".json",
                        *shadows, *more], check=True)
        with open(path + ".json") as f:
            times = {p["name"]: p["ms"] for p in json.load(f)["passes"]}
        return path, sum(times.get(k, 0.0) for k in ("direct", "specular", "sampling"))

    def diff(self, a, b):
        out = subprocess.run([self.program, "diff", a, b, "--json"], check=True, capture_output=True, text=True).stdout
        return json.loads(out)

    def references(self, scene, size, target, *more):
        return [self.render(scene, size, "reference", "--target-error", str(target), "--seed", s, *more)[0] for s in ("1", "2")]

    def error(self, picture, references):
        """Relative L2 without the references' noise; ratio of the means."""
        a, b = references
        pa, pb, ab = self.diff(picture, a), self.diff(picture, b), self.diff(a, b)
        square = (pa["rmse"] ** 2 + pb["rmse"] ** 2 - ab["rmse"] ** 2) / 2
        scale = ab["rmse"] / ab["relative_l2"]
        return math.sqrt(max(square, 0)) / scale, (pa["mean_ratio"] + pb["mean_ratio"]) / 2

    def sheet(self, name, rows):
        """A picture of pictures: rows of PNG paths."""
        lines = []
        for row in rows:
            parts = [read_png(path) for path in row]
            lines += [(b"\xff" * 6).join(r) for r in zip(*parts)]
            lines += [b"\xff" * len(lines[0])] * 2
        path = os.path.join(self.images, name + ".png")
        write_png(path, lines[:-2])
        print("\n%s: %d KB" % (path, os.path.getsize(path) // 1000), file=sys.stderr)


def percent(error):
    return "%.2f %% | %.4f" % (100 * error[0], error[1])


def lambert(bench):
    """Analytic Lambert against 16 pairs of samples a light (one of the light, one of the lobe)."""
    scene, size = bench.scene("diffuse", make_scenes.diffuse_floor()), "160x90"
    references = bench.references(scene, size, 0.02)
    print("| diffuse floor | relative L2 | mean ratio | light [ms], %s |\n|---|---|---|---|" % size)
    sheet = []
    for name, method, more in (("boundary integral", "exact", []), ("16 pairs", "sampled", ["--spp", "16", "--shadows", "on"])):
        picture, ms = bench.render(scene, size, method, *more)
        print("| %s | %s | %.2f |" % (name, percent(bench.error(picture, references)), ms))
        sheet.append(bench.render(scene, "320x180", method, *more, suffix=".png")[0])
    bench.sheet("ltc-lambert", [sheet])


def roughness(bench):
    """Tables and closed form against the reference over roughness."""
    values, size, methods = (0.1, 0.2, 0.3, 0.5, 0.7, 1.0), "128x72", ("ltc", "ltc-compact", "closed-form")
    print("\n| roughness | " + " | ".join("%s | mean ratio" % m for m in methods) + " |\n|" + "---|" * (1 + 2 * len(methods)))
    top, bottom = [], []
    for r in values:
        scene = bench.scene("r%g" % r, make_scenes.floor(lambda g: g.material("metal", (1.0, 1.0, 1.0), 1.0, r)))
        references = bench.references(scene, size, 0.02)
        errors = [bench.error(bench.render(scene, size, m)[0], references) for m in methods]
        print("| %.1f | %s |" % (r, " | ".join(percent(e) for e in errors)))
        top.append(bench.render(scene, "200x112", "ltc", suffix=".png")[0])
        bottom.append(bench.render(scene, "200x112", "sampled", "--spp", "128", suffix=".png")[0])
    bench.sheet("ltc-roughness", [top[:3], bottom[:3], top[3:], bottom[3:]])


def horizon(bench):
    """A light whose lower half is below the floor."""
    material = lambda g: g.material("metal", (1.0, 1.0, 1.0), 1.0, 0.35)  # noqa: E731
    scene = bench.scene("horizon", make_scenes.floor(material, (0.0, 0.0, -2.0), (0.0, 0.0, 0.0)))
    size, sheet = "160x90", []
    references = bench.references(scene, size, 0.02)
    print("\n| light half below the floor, roughness 0.35 | relative L2 | mean ratio |\n|---|---|---|")
    for method in ("ltc", "ltc-compact", "ltc-clipless", "representative-point"):
        print("| `%s` | %s |" % (method, percent(bench.error(bench.render(scene, size, method)[0], references))))
    for method in ("ltc", "ltc-clipless", "reference"):
        target = ("--target-error", "0.005") if method == "reference" else ()
        sheet.append(bench.render(scene, "240x135", method, *target, "--exposure", "-0.5", suffix=".png")[0])
    bench.sheet("ltc-horizon", [sheet])


def textured(bench):
    """A textured light over floors of rising roughness."""
    size, methods = "128x72", ("auto", "ltc", "ltc-compact")
    print("\n| textured light, roughness | " + " | ".join("%s | mean ratio" % m for m in methods) + " |\n|" + "---|" * (1 + 2 * len(methods)))
    for r in make_scenes.ROUGHNESS_OF_STRIPS:
        scene = bench.scene("t%g" % r, make_scenes.textured_floor(strips=(r,)))
        references = bench.references(scene, size, 0.03, "--camera", "floor")
        errors = [bench.error(bench.render(scene, size, m, "--camera", "floor")[0], references) for m in methods]
        print("| %.2f | %s |" % (r, " | ".join(percent(e) for e in errors)))
    scene = bench.scene("textured", make_scenes.textured_floor())
    bench.sheet("ltc-textured", [[bench.render(scene, "400x225", "ltc-compact", "--aa", "4", suffix=".png")[0],
                                  bench.render(scene, "400x225", "sampled", "--spp", "64", "--aa", "4", suffix=".png")[0]]])


def floor(bench):
    """Alpha 0.09, F = 1, camera 20 degrees up, 640 x 360."""
    scene, size = bench.scene("glossy", make_scenes.glossy_floor()), "640x360"
    references = bench.references(scene, size, 0.04)
    print("\n| alpha 0.09, F = 1, %s | relative L2 | mean ratio |\n|---|---|---|" % size)
    for method in ("ltc", "ltc-compact", "closed-form"):
        print("| `%s` | %s |" % (method, percent(bench.error(bench.render(scene, size, method)[0], references))))


EXPERIMENTS = {"lambert": lambert, "roughness": roughness, "horizon": horizon, "textured": textured, "floor": floor}


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--program", default=os.path.join(ROOT, "build/release/bin/steradian"))
    parser.add_argument("--images", default=os.path.join(ROOT, "docs/images"))
    parser.add_argument("names", nargs="*", choices=[[], *EXPERIMENTS], metavar="NAME")
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        bench = Bench(arguments.program, arguments.images, folder)
        for name in arguments.names or EXPERIMENTS:
            EXPERIMENTS[name](bench)


if __name__ == "__main__":
    main()
