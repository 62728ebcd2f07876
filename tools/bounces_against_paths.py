#!/usr/bin/env python3
"""Compares `render --bounces all` with path tracing: the first table of docs/measured/bounces.md.

usage: bounces_against_paths.py [--program FILE] [--paths FOLDER] [SCENE ...]

FOLDER keeps the pictures by paths, which take minutes each; a picture that is there is not made again.
"""
import argparse
import re
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
BUILT = ROOT / "build/release"
SIZE = ["--size", "64x36"]

# Scene: further arguments, paths a pixel and light.
SCENES = {"cornell": ([], 8192), "furnished": ([], 8192), "room": ([], 8192), "gallery": ([], 8192),
          "colonnade": (["--environment", "sky"], 8192), "hall": ([], 2048)}


def scene_file(name):
    for folder in (ROOT / "scenes", BUILT / "scenes"):
        if (folder / f"{name}.glb").exists():
            return folder / f"{name}.glb"
    sys.exit(f"bounces_against_paths: there is no scene {name} (build the target scenes)")


def run(program, *arguments):
    done = subprocess.run([program, *arguments], capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit(f"bounces_against_paths: {' '.join(map(str, arguments))}: {done.stderr.strip()}")
    return done.stdout


def compared(program, ours, paths):
    layers = ["--covered-by", "bounce_error,bounce_bound"] if "bounces" in ours.name else []
    text = run(program, "diff", ours, paths, *layers)
    numbers = {name: float(value) for name, value in re.findall(r"^(relative L2|mean ratio|covered) +([0-9.e+-]+)", text, re.M)}
    return numbers


def sampled(program, name, kept, light, arguments=(), spp=8192):
    """The picture by sampling, made where it is not kept yet. light: ["--bounces", "all"], or nothing for direct light."""
    kept.mkdir(parents=True, exist_ok=True)
    picture = kept / f"{name}{'' if light else '_direct'}.exr"
    if not picture.exists():
        run(program, "render", scene_file(name), "-o", picture, *light, "--method", "sampled", "--spp", str(spp), *SIZE, *arguments)
    return picture


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--program", default=BUILT / "bin/steradian", help="default: %(default)s")
    parser.add_argument("--paths", type=Path, help="folder that keeps the pictures by paths; default: none")
    parser.add_argument("scenes", nargs="*", metavar="SCENE", help=f"default: {' '.join(SCENES)}")
    options = parser.parse_args()
    unknown = [s for s in options.scenes if s not in SCENES]
    if unknown:
        parser.error(f"no scene {unknown[0]}; there are {', '.join(SCENES)}")
    print("| scene | relative L2 | without bounces | ratio of the means | pixels within their error and four standard errors of the paths |")
    print("|---|--:|--:|--:|--:|", flush=True)
    with tempfile.TemporaryDirectory() as folder:
        for name in options.scenes or SCENES:
            arguments, spp = SCENES[name]
            scene, all_light = scene_file(name), ["--bounces", "all"]
            paths = sampled(options.program, name, options.paths or Path(folder), all_light, arguments, spp)
            ours, direct = Path(folder) / "bounces.exr", Path(folder) / "direct.exr"
            run(options.program, "render", scene, "-o", ours, *all_light, *SIZE, *arguments)
            run(options.program, "render", scene, "-o", direct, *SIZE, *arguments)
            with_bounces, without = compared(options.program, ours, paths), compared(options.program, direct, paths)
            shown = f"`{name}`" + "".join(f", `{' '.join(arguments)}`" for _ in arguments[:1])
            print(f"| {shown} | {100 * with_bounces['relative L2']:.2g} % | {100 * without['relative L2']:.2g} % | "
                  f"{with_bounces['mean ratio']:.4f} | {100 * with_bounces['covered']:.3g} % |", flush=True)


if __name__ == "__main__":
    main()
