#!/usr/bin/env python3
"""Compares metals of several roughnesses in the furnished room with path tracing: a table of docs/measured/bounces.md.

usage: metals_against_paths.py [--program FILE] [--paths FOLDER] [--spp N] [ROUGHNESS ...]

Two balls and a box of one metal stand in the scene `furnished`. FOLDER keeps the pictures by paths, which take a minute each; a picture
that is there is not made again.
"""
import argparse
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
sys.path += [str(Path(__file__).resolve().parent), str(ROOT / "blender" / "steradian"), str(ROOT / "scenes")]
import all_light_scenes  # noqa: E402
import gltf_writer  # noqa: E402
from bounces_against_paths import BUILT, run  # noqa: E402

ROUGHNESSES = (0.05, 0.1, 0.2, 0.3, 0.5, 0.7, 1.0)
VIEW = ["--size", "48x48", "--camera", "metals"]
COLOR = (0.9, 0.7, 0.5)


def write_scene(path, metal):
    """The room with things of a material that metal(scene) adds."""
    g = all_light_scenes.furnished()
    material = metal(g)
    ball = g.mesh("ball", gltf_writer.sphere(96, 48), material)
    g.node("ball 0", mesh=ball, translation=[-0.75, 0.3, 0.35], scale=[0.3] * 3)
    g.node("ball 1", mesh=ball, translation=[-0.2, 1.1, 0.45], scale=[0.25] * 3)
    box = g.mesh("box", gltf_writer.box(-0.2, 0, -0.2, 0.2, 0.6, 0.2), material)
    g.node("box", mesh=box, **all_light_scenes.turned(30, -0.15, 0, 0.45))
    g.camera("metals", [1.3, 1.15, 1.2], [-0.35, 0.65, 0.4], 0.65)
    g.write(path)


def rendered(program, scene, path, *options):
    """Renders a scene to a file, and returns the file."""
    run(program, "render", scene, "-o", path, *VIEW, *options)
    return path


def metal_pixels(program, folder):
    """Where a picture shows the metal: it changes when the metal shines."""
    import pictures

    shown = []
    for emission in (None, (1000, 1000, 1000)):
        scene = folder / "shining.glb"
        write_scene(scene, lambda g: g.material("metal", (0, 0, 0), emission=emission))
        shown.append(pictures.read_exr(rendered(program, scene, folder / "shining.exr", "--shadows", "off"))[:, :, :3])
    return (abs(shown[1] - shown[0]) > 500).any(axis=2)


def main():
    import numpy
    import pictures

    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--program", default=BUILT / "bin/steradian", help="default: %(default)s")
    parser.add_argument("--paths", type=Path, help="folder that keeps the pictures by paths; default: none")
    parser.add_argument("--spp", type=int, default=4096, help="paths a pixel; default: %(default)s")
    parser.add_argument("roughnesses", nargs="*", type=float, metavar="ROUGHNESS", help="default: " + " ".join(map(str, ROUGHNESSES)))
    options = parser.parse_args()
    print("| roughness | rms | noise of the paths | ratio of the means | pixels off by more than 15 % of the mean |")
    print("|---|--:|--:|--:|--:|", flush=True)
    with tempfile.TemporaryDirectory() as temporary:
        folder = Path(temporary)
        kept = options.paths or folder
        kept.mkdir(parents=True, exist_ok=True)
        metal = metal_pixels(options.program, folder)
        for roughness in options.roughnesses or ROUGHNESSES:
            scene, halves = folder / "metals.glb", []
            write_scene(scene, lambda g: g.material("metal", COLOR, metallic=1.0, roughness=roughness))
            for half in range(2):  # their difference tells their noise
                path = kept / f"metal_{roughness:g}_{half}.exr"
                if not path.exists():
                    rendered(options.program, scene, path, "--bounces", "all", "--method", "sampled", "--spp", str(options.spp // 2),
                             "--seed", str(half + 1))
                halves.append(pictures.read_exr(path)[:, :, :3][metal])
            ours = pictures.read_exr(rendered(options.program, scene, folder / "ours.exr", "--bounces", "all"))[:, :, :3][metal]
            paths = (halves[0] + halves[1]) / 2
            mean, noise = float(paths.mean()), float(((halves[0] - halves[1]) ** 2).mean()) / 4
            off = float(((ours - paths) ** 2).mean()) - noise
            beyond = int((abs(ours - paths).max(axis=1) > 0.15 * mean + 4 * noise ** 0.5).sum())
            print(f"| {roughness:g} | {100 * numpy.sqrt(max(off, 0)) / mean:.2g} % | {100 * noise ** 0.5 / mean:.2g} % | "
                  f"{float(ours.mean()) / mean:.4f} | {beyond} of {len(paths)} |", flush=True)


if __name__ == "__main__":
    main()
