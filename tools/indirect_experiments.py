#!/usr/bin/env python3
"""The experiments of docs/measured/indirect.md: renders them, writes their pictures, prints their tables.

usage: indirect_experiments.py [--program build/release/bin/steradian] [--images docs/images] [--runs 5] [NAME ...]

names: scenes, count, truth, pictures, modes, lights; none: all. Standard library only.
The first of the literature's experiments, one point light over a plane, is a test:
steradian_tests --gtest_filter=IndirectKernel.PointLightOverAPlane
An rmse is that of the picture at the exposure which maps the reference's 99.9th percentile to 1.
"""

import argparse
import json
import math
import os
import subprocess
import tempfile
from functools import partial

import ltc_experiments
from ltc_experiments import ROOT
from png_files import read_png, write_png

print = partial(print, flush=True)


def fair(mode):
    """Points in all modes, so that only the lobes differ; the other modes have no quads."""
    return ("--indirect", mode) + (("--indirect-quads", "off") if mode == "ltc" else ())


class Bench(ltc_experiments.Bench):
    def picture(self, scene, size, *more, suffix=".exr", runs=1):
        """A picture's path, and each pass's fastest run in milliseconds: others may share the machine."""
        self.made += 1
        path, times = os.path.join(self.folder, "%d%s" % (self.made, suffix)), {}
        for _ in range(runs):
            subprocess.run([self.program, "render", scene, "-o", path, "--size", size, "--shadows", "off", "--stats", path + ".json", *more],
                           check=True)
            with open(path + ".json") as f:
                for p in json.load(f)["passes"]:
                    times.setdefault(p["name"], []).append(p["ms"])
        return path, {name.replace("indirect: ", ""): min(t) for name, t in times.items()}

    def exposed(self, a, b):
        """The rmse at the reference's exposure, and the relative L2."""
        d = self.diff(a, b)
        return d["rmse"] / d["white"], d["relative_l2"], d["mean_ratio"]

    def named(self, name):
        for folder in (os.path.join(ROOT, "scenes"), os.path.join(os.path.dirname(os.path.dirname(self.program)), "scenes")):
            path = os.path.join(folder, name + ".glb")
            if os.path.exists(path):
                return path
        raise SystemExit("no scene " + name)


def scenes(bench):
    """Five scenes, all modes on the same lists; ltc-outgoing is algorithm 1 of the literature, ltc algorithm 2."""
    passes = ("surfaces", "shadow map", "virtual lights", "ranges", "interleave", "cull", "light", "deinterleave", "filter", "resolve")
    print("\n| scene, mode | " + " | ".join(p + " [ms]" for p in passes) + " | cull + light, gain | rmse | relative L2 |\n|" + "---|" * (len(passes) + 4))
    for name in ("ring", "gallery", "arcade", "hall", "atrium"):
        found = {}
        for mode in ("ggx", "ltc-outgoing", "ltc"):
            found[mode] = bench.picture(bench.named(name), "1920x1080", "--method", "ltc-compact", *fair(mode), runs=bench.runs)
        work = {m: found[m][1]["cull"] + found[m][1]["light"] for m in found}
        for mode in found:
            picture, times = found[mode]
            row = "| `%s`, %s | %s | %.0f" % (name, mode, " | ".join("%.1f" % times.get(p, 0.0) for p in passes), work[mode])
            if mode != "ggx":
                rmse, l2, _ = bench.exposed(picture, found["ggx"][0])
                row += ", %.2f | %.4f | %.4f |" % (work["ggx"] / work[mode], rmse, l2)
            else:
                row += " | | |"
            print(row)


def count(bench):
    """`ring` with more and more virtual lights; so few are kept that the culling is at work from 2^12 on."""
    scene, size, rows = bench.named("ring"), "1280x720", []
    print("\n| virtual lights | ltc cull + light [ms] | ggx [ms] | gain | rmse to ggx | noise of the culling |\n|---|---|---|---|---|---|")
    for bits in range(12, 19):
        all_pairs = ("--method", "ltc-compact", "--vpls", str(1 << bits))
        more = (*all_pairs, "--indirect-pairs", "8")
        picture, ltc = bench.picture(scene, size, *fair("ltc"), *more, runs=bench.runs)
        other, ggx = bench.picture(scene, size, *fair("ggx"), *more, runs=bench.runs)
        noise = bench.exposed(bench.picture(scene, "480x270", *fair("ltc"), *more)[0],
                              bench.picture(scene, "480x270", *fair("ltc"), *all_pairs, "--indirect-pairs", "0")[0])
        a, b = ltc["cull"] + ltc["light"], ggx["cull"] + ggx["light"]
        rows.append((bits, a))
        print("| 2^%d | %.0f | %.0f | %.2f | %.4f | %.4f |" % (bits, a, b, b / a, bench.exposed(picture, other)[0], noise[1]))
    for first in (12, 14):
        chosen = [r for r in rows if r[0] >= first]
        n, mx, my = len(chosen), sum(b for b, _ in chosen) / len(chosen), sum(math.log2(t) for _, t in chosen) / len(chosen)
        slope = sum((b - mx) * (math.log2(t) - my) for b, t in chosen) / sum((b - mx) ** 2 for b, _ in chosen)
        print("\nFrom 2^%d on, cull + light grows with the number of lights to the power %.2f (%d points)." % (first, slope, n))


def truth(bench):
    """The bounce against path tracing, with the visibility of its second segment by four rays a pixel."""
    scene, size = bench.named("ring"), "320x180"
    path = [bench.picture(scene, size, "--indirect", "path", "--spp", "1024", "--seed", s)[0] for s in ("1", "2")]
    print("\n| `ring`, %s, against path tracing | relative L2 | mean ratio |\n|---|---|---|" % size)
    for name, more in (("no bounce", ("--indirect", "off")), ("ltc", ("--indirect", "ltc")),
                       ("ltc, 4 shadow rays", ("--indirect", "ltc", "--indirect-shadows", "4")), ("ggx", ("--indirect", "ggx"))):
        print("| %s | %.4f | %.4f |" % ((name,) + bench.error(bench.picture(scene, size, *more)[0], path)))
    print("| path tracing against itself | %.4f | |" % bench.diff(*path)["relative_l2"])


def pictures(bench):
    """What is looked at: without the bounce, with it, by path tracing; two more scenes without and with."""
    draw = lambda name, *more: bench.picture(bench.named(name), "320x180", "--exposure", EXPOSURE[name], *more, suffix=".png")[0]  # noqa: E731
    bench.sheet("indirect-ring", [[draw("ring", "--aa", "4"), draw("ring", "--indirect", "ltc", "--indirect-shadows", "4"),
                                   draw("ring", "--indirect", "path", "--spp", "256")]])
    bench.sheet("indirect-scenes", [[draw(n), draw(n, "--indirect", "ltc")] for n in ("gallery", "arcade", "atrium")])


def modes(bench):
    """Transformed cosines and GGX side by side, and eight times their difference, for scenes with glossy things."""
    rows = []
    print("\n| scene, 640x360 | rmse | relative L2 | mean ratio |\n|---|---|---|---|")
    for name in ("ring", "hall", "arcade", "atrium"):
        more = ("--method", "ltc-compact")
        exr = {mode: bench.picture(bench.named(name), "640x360", *fair(mode), *more)[0] for mode in ("ltc", "ggx")}
        print("| `%s` | %.4f | %.4f | %.4f |" % ((name,) + bench.exposed(exr["ltc"], exr["ggx"])))
        if name == "atrium":  # a row more would make the picture too large
            continue
        row = [bench.picture(bench.named(name), "320x180", *fair(mode), *more, "--exposure", EXPOSURE[name], suffix=".png")[0]
               for mode in ("ltc", "ggx")]
        rows.append(row + [difference_of(bench, *row, 8)])
    bench.sheet("indirect-modes", rows)


EXPOSURE = {"ring": "0", "gallery": "1.5", "hall": "1", "arcade": "0", "atrium": "-1.5"}


def difference_of(bench, a, b, times):
    """A picture of the bytes' difference, enlarged, about the middle grey."""
    rows = [bytes(min(255, max(0, 128 + times * (x - y))) for x, y in zip(p, q))
            for p, q in zip(read_png(a), read_png(b))]
    bench.made += 1
    path = os.path.join(bench.folder, "%d.png" % bench.made)
    write_png(path, rows)
    return path


def lights(bench):
    """The bounce of two scenes over the number of virtual lights, as points and at the same exposure."""
    rows = []
    for name in ("ring", "hall"):
        rows.append([bench.picture(bench.named(name), "256x144", "--method", "ltc-compact", *fair("ltc"), "--vpls", str(1 << bits),
                                   "--exposure", EXPOSURE[name], suffix=".png")[0] for bits in (8, 10, 14, 18)])
    bench.sheet("indirect-lights", rows)


EXPERIMENTS = {"scenes": scenes, "count": count, "truth": truth, "pictures": pictures, "modes": modes, "lights": lights}


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--program", default=os.path.join(ROOT, "build/release/bin/steradian"))
    parser.add_argument("--images", default=os.path.join(ROOT, "docs/images"))
    parser.add_argument("--runs", type=int, default=5, help="of a picture whose passes are timed; the fastest counts (default 5)")
    parser.add_argument("names", nargs="*", choices=[[], *EXPERIMENTS], metavar="NAME")
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        bench = Bench(os.path.abspath(arguments.program), arguments.images, folder)
        bench.runs = arguments.runs
        for name in arguments.names or EXPERIMENTS:
            EXPERIMENTS[name](bench)


if __name__ == "__main__":
    main()
