#!/usr/bin/env python3
"""Times Steradian against Cycles of Blender and against its own sampling by Embree's rays, on the same scene and the same cores.

usage: against_cycles.py [--program FILE] [--size WxH] [--bounces all] [--samples N,N,...] [--pictures FOLDER] SCENE ...

SCENE is a name, such as gallery. Its lights become lamps of Blender with the same radiance, its Lambertian materials diffuse nodes.
Each program's noise is measured on its own: two pictures of different seeds, their distance over the square root of two, relative to their
norm, where no light is seen, at a quarter of the size. Times are processor seconds of all threads at the full size: Cycles' of its render
alone, ours of the whole program with its files. Those runs alternate. Needs Blender 3.4 with Cycles and Debian's python3-numpy.
"""
import argparse
import json
import math
import os
import resource
import shutil
import struct
import subprocess
import sys
import tempfile
import time
from pathlib import Path

sys.path += [str(Path(__file__).resolve().parent), str(Path(__file__).resolve().parents[1] / "blender" / "steradian")]
from bounces_against_paths import BUILT, SIZE, compared, run, sampled, scene_file  # noqa: E402

AIMS = (0.01, 0.003, 0.001)  # relative noise
TIMED, REPEATS = (2, 16), 3  # samples a pixel of the runs that are timed


def contents(path):
    """The JSON part of a .glb."""
    data = Path(path).read_bytes()
    return json.loads(data[20:20 + struct.unpack_from("<I", data, 12)[0]])


class Cycles:
    """The scene in Blender, with the file's lights. Only inside Blender."""

    def __init__(self, path, width, height, bounces, caustics=True, aa=1):
        import bpy
        import numpy

        self.bpy, self.numpy, self.scene, self.caustics, self.aa = bpy, numpy, bpy.context.scene, caustics, aa
        numpy.bool = bool  # Blender's importer asks numpy for it, and Debian's numpy no longer has it
        bpy.ops.preferences.addon_enable(module="io_scene_gltf2")
        bpy.ops.object.select_all(action="SELECT")
        bpy.ops.object.delete()
        bpy.ops.import_scene.gltf(filepath=str(path))
        gltf = contents(path)
        for thing in [o for o in bpy.data.objects if o.type == "LIGHT"]:
            bpy.data.objects.remove(thing)
        self.add_lights(gltf)
        self.make_lambertian(gltf)
        self.set_camera(gltf)
        self.set_sampler(width, height, bounces)

    def add_lights(self, gltf):
        """Rectangles, disks and spheres of one radiance, points and spots of one intensity."""
        from mathutils import Matrix, Quaternion

        upright = Matrix(((1, 0, 0, 0), (0, 0, -1, 0), (0, 1, 0, 0), (0, 0, 0, 1)))
        for node in gltf["nodes"]:
            for kind, reference in node.get("extensions", {}).items():
                if kind not in ("EXT_lights_area", "KHR_lights_punctual"):
                    continue
                light = gltf["extensions"][kind]["lights"][reference["light"]]
                if "matrix" in node:
                    m = node["matrix"]
                    place = Matrix([m[row::4] for row in range(4)])
                else:
                    x, y, z, w = node.get("rotation", (0, 0, 0, 1))
                    place = Matrix.Translation(node.get("translation", (0, 0, 0))) @ Quaternion((w, x, y, z)).to_matrix().to_4x4()
                self.add_light(light, upright @ place)

    def add_light(self, light, place):
        """Area lights of Blender have the radiance power / (4 area), points the intensity power / (4 pi)."""
        kind, size = light["type"], light.get("size", 1.0)
        new = self.bpy.data.lights.new(light.get("name", kind), {"rect": "AREA", "disk": "AREA", "spot": "SPOT"}.get(kind, "POINT"))
        intensity = light.get("intensity", 1.0)
        new.color = light.get("color", (1, 1, 1))
        new.cycles.max_bounces = 1024
        if kind == "rect":
            new.shape, new.size, new.size_y = "RECTANGLE", size * light.get("rect", {}).get("aspect", 1.0), size
            new.energy = 4 * new.size * new.size_y * intensity
        elif kind == "disk":
            new.shape, new.size, new.energy = "DISK", size, math.pi * size * size * intensity
        elif kind == "sphere":
            new.shadow_soft_size = size / 2
            new.energy = 4 * math.pi * math.pi * (size / 2) ** 2 * intensity
        elif kind in ("spot", "point"):
            new.shadow_soft_size, new.energy = 0, 4 * math.pi * intensity
            if kind == "spot":
                cone = light["spot"]
                new.spot_size = 2 * cone["outerConeAngle"]
                new.spot_blend = 1 - cone["innerConeAngle"] / cone["outerConeAngle"]
        else:
            sys.exit(f"against_cycles: a light of type {kind} has no lamp in Blender here")
        thing = self.bpy.data.objects.new(new.name, new)
        thing.matrix_world = place
        self.bpy.context.collection.objects.link(thing)

    def make_lambertian(self, gltf):
        """Materials without a specular lobe get Lambert's, which glTF means; Blender's own diffuse lobe is Disney's."""
        for source in gltf.get("materials", []):
            lobe = source.get("extensions", {}).get("KHR_materials_specular", {})
            glows = any(source.get("emissiveFactor", ()))
            material = self.bpy.data.materials.get(source.get("name", ""))
            if lobe.get("specularFactor", 1) != 0 or glows or material is None:
                continue
            nodes, links = material.node_tree.nodes, material.node_tree.links
            principled = next(n for n in nodes if n.type == "BSDF_PRINCIPLED")
            diffuse = nodes.new("ShaderNodeBsdfDiffuse")
            color = principled.inputs["Base Color"]
            diffuse.inputs["Color"].default_value = color.default_value
            if color.links:
                links.new(color.links[0].from_socket, diffuse.inputs["Color"])
            links.new(diffuse.outputs["BSDF"], next(n for n in nodes if n.type == "OUTPUT_MATERIAL").inputs["Surface"])

    def set_camera(self, gltf):
        """The file's first."""
        camera = next(o for o in self.bpy.data.objects if o.type == "CAMERA")
        camera.data.sensor_fit, camera.data.angle_y = "VERTICAL", gltf["cameras"][0]["perspective"]["yfov"]
        camera.data.clip_start, camera.data.clip_end = 1e-3, 1e5
        self.scene.camera = camera

    def set_sampler(self, width, height, bounces):
        """No clamp, no filter of glossy light, no denoiser: what converges to the light itself, in the middles of pixels or all over them."""
        scene = self.scene
        scene.world = scene.world or self.bpy.data.worlds.new("none")
        scene.world.use_nodes = True
        scene.world.node_tree.nodes["Background"].inputs["Strength"].default_value = 0
        scene.render.engine, scene.cycles.device = "CYCLES", "CPU"
        scene.render.resolution_x, scene.render.resolution_y, scene.render.resolution_percentage = width, height, 100
        scene.render.image_settings.file_format, scene.render.image_settings.color_depth = "OPEN_EXR", "32"
        scene.view_settings.view_transform = "Raw"
        cycles = scene.cycles
        cycles.use_denoising = cycles.use_adaptive_sampling = False
        cycles.sample_clamp_direct = cycles.sample_clamp_indirect = cycles.blur_glossy = 0
        cycles.caustics_reflective = cycles.caustics_refractive = self.caustics
        # Cycles' box is one pixel wide, whatever the width.
        cycles.pixel_filter_type, cycles.filter_width = "BOX" if self.aa > 1 else "GAUSSIAN", 0.01
        cycles.max_bounces = cycles.diffuse_bounces = cycles.glossy_bounces = cycles.transmission_bounces = bounces

    def render(self, samples, seed, path):
        """The picture from the top, and its processor seconds."""
        scene = self.scene
        scene.cycles.samples, scene.cycles.seed, scene.render.filepath = samples, seed, str(path)
        used = time.process_time()
        self.bpy.ops.render.render(write_still=True)
        used = time.process_time() - used
        image = self.bpy.data.images.load(str(path))
        image.colorspace_settings.name = "Non-Color"
        values = self.numpy.empty(len(image.pixels), self.numpy.float32)
        image.pixels.foreach_get(values)
        values = values.reshape(image.size[1], image.size[0], -1)[::-1, :, :3].copy()
        self.bpy.data.images.remove(image)
        return values, used


class Program:
    """Ours, in a process of its own."""

    def __init__(self, program, scene, size, bounces, folder, aa=1):
        self.command = [program, "render", scene, "--size", size, "--aa", str(aa), *(["--bounces", "all"] if bounces else [])]
        self.folder = folder

    def render(self, *options):
        """The picture from the top, and its processor seconds."""
        import pictures

        path = Path(self.folder) / "ours.exr"
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        run(*self.command, "-o", path, *options)
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        return pictures.read_exr(path)[:, :, :3], after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def radiances(gltf):
    """What the camera sees of the lights, if it does: it sees none of Blender's lamps."""
    lights = gltf.get("extensions", {}).get("EXT_lights_area", {}).get("lights", [])
    glowing = [m for m in gltf.get("materials", []) if any(m.get("emissiveFactor", ()))]
    strength = [m.get("extensions", {}).get("KHR_materials_emissive_strength", {}).get("emissiveStrength", 1) for m in glowing]
    return [[c * light.get("intensity", 1) for c in light.get("color", (1, 1, 1))] for light in lights] + [
        [c * times for c in m["emissiveFactor"]] for m, times in zip(glowing, strength)]


def without_lights(numpy, picture, gltf):
    """Where the picture shows no light."""
    kept = numpy.ones(picture.shape[:2], bool)
    for radiance in radiances(gltf):
        kept &= (abs(picture - radiance) > 1e-4 * max(radiance)).any(axis=2)
    return kept


def relative(a, b):
    """The distance of two pictures."""
    return float((((a - b) ** 2).sum() / (b ** 2).sum()) ** 0.5)


def count_to(rows, aim):
    """Samples to this noise, along a power law between the measured counts around it or through the last two, and whether it is beyond them."""
    rows = sorted(rows)
    n = next((k for k in range(1, len(rows) - 1) if rows[k][1] <= aim), len(rows) - 1)
    (n0, e0), (n1, e1) = rows[n - 1], rows[n]
    return n1 * (aim / e1) ** (math.log(n1 / n0) / math.log(e1 / e0)), aim < rows[-1][1]


def told(seconds):
    return f"{seconds:.2g}" if seconds < 100 else f"{seconds:,.0f}"


class Peer:
    """What one program takes: its time grows linearly with the samples, and a pixel's noise does not know how many pixels there are."""

    def __init__(self):
        self.noise, self.times = [], {count: [] for count in TIMED}

    def seconds(self, samples):
        """At the full size."""
        few, many = (sorted(self.times[c])[len(self.times[c]) // 2] for c in TIMED)
        slope = (many - few) / (TIMED[1] - TIMED[0])
        return few + slope * (samples - TIMED[0])


def measure(name, options, folder):
    """One scene: a line with all that was measured."""
    scene, (width, height) = scene_file(name), map(int, options.size.split("x"))
    bounces, cycles_picture = 64 if options.bounces else 0, Path(folder) / "cycles.exr"
    ours = Program(options.program, scene, options.size, options.bounces, folder)
    cycles = Cycles(scene, width, height, bounces)
    peers = {"Cycles": Peer(), "Embree": Peer()}
    mine, _ = ours.render()
    kept = without_lights(cycles.numpy, mine, contents(scene))
    own = []
    for _ in range(REPEATS):
        for count in TIMED:
            own.append(ours.render()[1])
            theirs, used = cycles.render(count, 1, cycles_picture)
            peers["Cycles"].times[count].append(used)
            own.append(ours.render()[1])
            peers["Embree"].times[count].append(ours.render("--method", "sampled", "--spp", str(count))[1])
    ratio = float(mine[kept].mean() / theirs[kept].mean())
    own = sorted(own)[len(own) // 2]
    if options.pictures:
        equal(options.pictures, name, own, peers["Cycles"], cycles, mine, kept, folder)

    small = Program(options.program, scene, f"{width // 4}x{height // 4}", options.bounces, folder)
    cycles.set_sampler(width // 4, height // 4, bounces)
    kept = without_lights(cycles.numpy, small.render()[0], contents(scene))
    for count in map(int, options.samples.split(",")):
        pairs = {"Cycles": [cycles.render(count, seed, cycles_picture)[0][kept] for seed in (1, 2)],
                 "Embree": [small.render("--method", "sampled", "--spp", str(count), "--seed", str(seed))[0][kept] for seed in (1, 2)]}
        for kind, pair in pairs.items():
            peers[kind].noise.append((count, relative(*pair) / 2 ** 0.5))
            print(f"MEASURED {name}: {kind}, {count} samples: noise {peers[kind].noise[-1][1]:.4f}, {peers[kind].seconds(count):.1f} s", flush=True)
    result = {"scene": name, "ours": own, "mean ratio": ratio, "error": error(options, name, folder)}
    for kind, peer in peers.items():
        counts = [count_to(peer.noise, aim) for aim in AIMS]
        result[kind] = [(count, peer.seconds(count), beyond) for count, beyond in counts]
    print("RESULT " + json.dumps(result), flush=True)


def error(options, name, folder):
    """Relative distance of ours from many samples, whose noise is in it, too."""
    light = ["--bounces", "all"] if options.bounces else []
    judge = sampled(options.program, name, Path(options.paths or folder), light)
    mine = Path(folder) / "small.exr"
    run(options.program, "render", scene_file(name), "-o", mine, *light, *SIZE)
    return compared(options.program, mine, judge)["relative L2"]


def shown(numpy, picture, scale):
    """Codes of 8 bits, as a screen shows them."""
    light = (picture * scale).clip(0, 1)
    return numpy.where(light > 0.0031308, 1.055 * numpy.maximum(light, 1e-9) ** (1 / 2.4) - 0.055, 12.92 * light)


def exposure(pixels):
    """What makes their mean a middle grey."""
    lit = pixels.mean(axis=1)
    return 0.25 / lit[lit > 0].mean()


def write_both(path, numpy, mine, theirs, kept):
    """Ours on the left, Cycles' on the right. Returns the relative distance of what a screen shows of both, where no light is seen."""
    import png_files

    scale = exposure(mine[kept])
    ours, others = shown(numpy, mine, scale), shown(numpy, theirs, scale)
    if path:
        middle = mine.shape[1] // 2
        codes = (numpy.concatenate([ours[:, :middle], others[:, middle:]], axis=1) * 255 + 0.5).astype("uint8")
        Path(path).parent.mkdir(parents=True, exist_ok=True)
        png_files.write_png(path, [row.tobytes() for row in codes])
    return relative(ours[kept], others[kept])


def equal(pictures, name, seconds, peer, cycles, mine, kept, folder):
    """Both pictures at equal processor time."""
    slope = (peer.seconds(TIMED[1]) - peer.seconds(TIMED[0])) / (TIMED[1] - TIMED[0])
    samples = max(1, round((seconds - peer.seconds(0)) / slope))
    theirs, used = cycles.render(samples, 3, Path(folder) / "cycles.exr")
    write_both(Path(pictures) / f"{name}.png", cycles.numpy, mine, theirs, kept)
    print(f"EQUAL {name}: {samples} samples of Cycles in {used:.2f} s, ours {seconds:.2f} s", flush=True)


def look(name, options, folder):
    """Both pictures once, with --look samples of Cycles: how much they differ. Two seeds share the samples, so their noise is known."""
    scene, (width, height) = scene_file(name), map(int, options.size.split("x"))
    mine, seconds = Program(options.program, scene, options.size, options.bounces, folder, options.aa).render()
    cycles = Cycles(scene, width, height, 64 if options.bounces else 0, options.caustics == "on", options.aa)
    numpy, kept = cycles.numpy, without_lights(cycles.numpy, mine, contents(scene))
    halves = [cycles.render(options.look // 2, seed, Path(folder) / "cycles.exr") for seed in (1, 2)]
    theirs, used = (halves[0][0] + halves[1][0]) / 2, halves[0][1] + halves[1][1]
    distance = write_both(options.pictures and Path(options.pictures) / f"{name}.png", numpy, mine, theirs, kept)
    scale = exposure(mine[kept])
    ours, *others = (shown(numpy, picture, scale)[kept] for picture in (mine, halves[0][0], halves[1][0]))
    product = ((ours - others[0]) * (ours - others[1])).sum() / (others[0] * others[1]).sum()
    print(f"LOOK {name}: caustics {options.caustics}; mean, ours / Cycles {mine[kept].mean() / theirs[kept].mean():.4f}; "
          f"relative L2 of what a screen shows {distance:.4f}, without noise {max(product, 0) ** 0.5:.4f}; "
          f"ours {seconds:.1f} s, Cycles with {options.look} samples {used:.0f} s", flush=True)


def table(results):
    """For the docs."""
    aims = [f"{100 * a:g} %" for a in AIMS]
    print(f"| scene | ours [s] | off by | mean, ours / Cycles | Cycles to {aims[0]} | {' | '.join(f'to {a} [s]' for a in aims)} | times ours | "
          f"{' | '.join(f'rays to {a} [s]' for a in aims)} |")
    print("|---|" + "--:|" * 11)
    for r in results:
        cells = {kind: [told(seconds) + (" *" if beyond else "") for _, seconds, beyond in r[kind]] for kind in ("Cycles", "Embree")}
        samples, seconds, _ = r["Cycles"][0]
        print(f"| `{r['scene']}` | {r['ours']:.2f} | {100 * r['error']:.2g} % | {r['mean ratio']:.4f} | {samples:,.0f} samples | {' | '.join(cells['Cycles'])} | "
              f"{seconds / r['ours']:,.0f} | {' | '.join(cells['Embree'])} |")
    print("\n* along the power law of the last two measured counts")


def parsed(arguments):
    parser = argparse.ArgumentParser(prog="against_cycles.py", description=__doc__.splitlines()[0])
    parser.add_argument("--program", default=str(BUILT / "bin/steradian"), help="default: %(default)s")
    parser.add_argument("--size", default="1280x720", help="default: %(default)s")
    parser.add_argument("--bounces", choices=["all"], help="all light; default: direct light")
    parser.add_argument("--samples", default="16,64,256,1024", help="a pixel, of Cycles and of our sampling; default: %(default)s")
    parser.add_argument("--pictures", help="folder for a picture of both at equal processor time; default: none")
    parser.add_argument("--look", type=int, metavar="SAMPLES", help="only compare one picture of ours with one of Cycles of so many samples")
    parser.add_argument("--aa", type=int, default=1, help="of ours, with --look: more than 1 compares whole pixels; default: their middles")
    parser.add_argument("--caustics", choices=["on", "off"], default="on", help="of Cycles, with --look; default: %(default)s")
    parser.add_argument("--paths", help="folder that keeps the references; default: none")
    parser.add_argument("scenes", nargs="+", metavar="SCENE")
    return parser.parse_args(arguments)


def main():
    if "--" in sys.argv:  # inside Blender
        options = parsed(sys.argv[sys.argv.index("--") + 1:])
        with tempfile.TemporaryDirectory() as folder:
            for name in options.scenes:
                (look if options.look else measure)(name, options, folder)
        return
    options = parsed(sys.argv[1:])
    if not shutil.which("blender"):
        sys.exit("against_cycles: there is no blender here (apt-get install blender python3-numpy)")
    # Debian's Blender takes the library of the first python3 of PATH: Debian's own has numpy.
    environment = {**os.environ, "PATH": "/usr/bin:/bin:" + os.environ.get("PATH", "")}
    command = ["blender", "-b", "--factory-startup", "--python-exit-code", "3", "-P", os.path.abspath(__file__), "--", *sys.argv[1:]]
    results = []
    with subprocess.Popen(command, env=environment, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True) as blender:
        lines = []
        for line in blender.stdout:
            lines.append(line)
            if line.startswith(("MEASURED", "EQUAL", "LOOK")):
                print(line.rstrip(), file=sys.stderr, flush=True)
            if line.startswith("RESULT"):
                results.append(json.loads(line[7:]))
    if blender.returncode != 0:
        sys.exit("".join(lines[-20:]))
    if results:
        table(results)


if __name__ == "__main__":
    main()
