#!/usr/bin/env python3
"""Compares `steradian bake` with the bake of Blender's Cycles: same scene, same charts, same texels, same cores.

usage: bake_against_cycles.py [--program FILE] [--texels N] [--samples N,N,...] [--probes N] [--truth N] [--pictures FOLDER] SCENE ...

SCENE is a name, such as cornell. Our light map is baked first. Cycles bakes the same triangles to the same places of a map of the same size,
without a denoiser. Lights become surfaces of one radiance that absorb light, as ours. Surfaces are diffuse, as light maps take them.

The truth is light at probes: triangles of a millimetre above random places of the surfaces, which Cycles bakes with very many samples. None lies within
5 cm of a lamp. A map
is judged by what a graphics card shows at the probes. The noise of the truth is measured by a second seed, and its square is taken off.
Seams are the largest difference between the two sides of an edge that curves, over the mean. The scene "leak" is two rooms with a
wall of a fifth of a texel between them and a lamp in one. Leaks are the largest light in the dark room, over the mean of the lit one.
Times are processor seconds. Needs Blender 3.4 with Cycles and Debian's python3-numpy.
"""
import argparse
import json
import math
import os
import resource
import shutil
import subprocess
import sys
import tempfile
import time
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path += [str(HERE), str(HERE.parents[0] / "blender" / "steradian"), str(HERE.parents[0] / "scenes")]
from bounces_against_paths import BUILT, run, scene_file  # noqa: E402

if "--" in sys.argv:  # inside Blender, which has NumPy
    from baked_scene import Baked, largest_seam, shown_at

PROBE, LIFT, NEAR = 1e-3, 1e-4, 0.05  # size of a probe, its height above the surface, distance from a lamp below which none counts [m]


class Cycles:
    """Bakes in Blender. Only inside Blender."""

    def __init__(self, lights):
        import bpy
        import numpy

        numpy.bool = bool
        self.bpy, self.numpy, scene = bpy, numpy, bpy.context.scene
        bpy.ops.object.select_all(action="SELECT")
        bpy.ops.object.delete()
        scene.render.engine, scene.cycles.device = "CYCLES", "CPU"
        scene.world = bpy.data.worlds.new("none")
        scene.world.use_nodes = True
        scene.world.node_tree.nodes["Background"].inputs["Strength"].default_value = 0
        cycles = scene.cycles
        cycles.use_denoising = cycles.use_adaptive_sampling = False
        cycles.sample_clamp_direct = cycles.sample_clamp_indirect = cycles.blur_glossy = 0
        cycles.max_bounces = cycles.diffuse_bounces = 64
        for shape, radiance in lights:
            self.add_light(shape, radiance)

    def material(self, name, color=None, radiance=None):
        made = self.bpy.data.materials.new(name)
        made.use_nodes = True
        nodes, links = made.node_tree.nodes, made.node_tree.links
        nodes.clear()
        output = nodes.new("ShaderNodeOutputMaterial")
        if radiance is None:
            shader = nodes.new("ShaderNodeBsdfDiffuse")
            shader.inputs["Color"].default_value = (*color, 1)
            links.new(shader.outputs[0], output.inputs["Surface"])
            return made
        # The front shines. The back is black.
        shader, black, mix, side = (nodes.new("ShaderNode" + n) for n in ("Emission", "BsdfDiffuse", "MixShader", "NewGeometry"))
        shader.inputs["Color"].default_value, shader.inputs["Strength"].default_value = (*radiance, 1), 1
        black.inputs["Color"].default_value = (0, 0, 0, 1)
        links.new(side.outputs["Backfacing"], mix.inputs[0])
        links.new(shader.outputs[0], mix.inputs[1])
        links.new(black.outputs[0], mix.inputs[2])
        links.new(mix.outputs[0], output.inputs["Surface"])
        return made

    def add_object(self, name, positions, normals, places, materials, of):
        """Triangles, their vertices' normals, places in a map from 0 to 1, and the material of each."""
        numpy = self.numpy
        mesh = self.bpy.data.meshes.new(name)
        flat = positions.reshape(-1, 3)
        mesh.from_pydata(flat.tolist(), [], numpy.arange(len(flat)).reshape(-1, 3).tolist())
        for m in materials:
            mesh.materials.append(m)
        mesh.polygons.foreach_set("material_index", numpy.asarray(of, numpy.int32))
        mesh.polygons.foreach_set("use_smooth", numpy.ones(len(positions), bool))
        if places is not None:
            mesh.uv_layers.new(name="map").data.foreach_set("uv", places.reshape(-1))
        mesh.use_auto_smooth = True
        mesh.normals_split_custom_set_from_vertices(normals.reshape(-1, 3).tolist())
        mesh.update()
        thing = self.bpy.data.objects.new(name, mesh)
        self.bpy.context.collection.objects.link(thing)
        return thing

    def add_light(self, shape, radiance):
        numpy = self.numpy
        across = numpy.cross(shape[:, 1] - shape[:, 0], shape[:, 2] - shape[:, 0])
        across /= numpy.linalg.norm(across, axis=1, keepdims=True)
        self.add_object("light", shape, numpy.repeat(across[:, None], 3, 1), None, [self.material("light", radiance=radiance)],
                        [0] * len(shape))

    def bake(self, thing, width, height, samples, seed):
        """Irradiance from the top, and processor seconds."""
        bpy, numpy, scene = self.bpy, self.numpy, self.bpy.context.scene
        image = bpy.data.images.new("map", width, height, float_buffer=True)
        image.colorspace_settings.name = "Non-Color"
        for m in thing.data.materials:
            node = m.node_tree.nodes.new("ShaderNodeTexImage")
            node.image = image
            m.node_tree.nodes.active = node
        bpy.context.view_layer.update()
        for other in bpy.context.view_layer.objects:
            other.select_set(other == thing)
        bpy.context.view_layer.objects.active = thing
        scene.cycles.samples, scene.cycles.seed = samples, seed
        used = time.process_time()
        bpy.ops.object.bake(type="DIFFUSE", pass_filter={"DIRECT", "INDIRECT"}, margin=2, margin_type="EXTEND", use_clear=True)
        used = time.process_time() - used
        values = numpy.empty(len(image.pixels), numpy.float32)
        image.pixels.foreach_get(values)
        values = values.reshape(height, width, 4)[::-1, :, :3].astype(float) * math.pi
        bpy.data.images.remove(image)
        for m in thing.data.materials:
            for node in [n for n in m.node_tree.nodes if n.type == "TEX_IMAGE"]:
                m.node_tree.nodes.remove(node)
        return values, used

    def add_probes(self, probes):
        """A triangle above each probe, with a pixel of its own."""
        numpy = self.numpy
        at, across, along, normals, _ = probes
        side, count = math.ceil(math.sqrt(len(at))), len(at)
        aside = numpy.cross(across, along)
        centre = at + across * LIFT
        corners = numpy.stack([centre - along * PROBE / 2 - aside * PROBE / 3, centre + along * PROBE / 2 - aside * PROBE / 3,
                               centre + aside * PROBE * 2 / 3], 1)
        pixel = numpy.stack([numpy.arange(count) % side, numpy.arange(count) // side], 1)[:, None].astype(float)
        # A triangle whose centre of mass is the pixel's middle, and which covers it.
        places = (pixel + 0.5 + numpy.array([[-0.9, -0.6], [0.9, -0.6], [0, 1.2]]) * 0.5) / side
        thing = self.add_object("probes", corners, numpy.repeat(normals[:, None], 3, 1), places, [self.material("probe", (0.5, 0.5, 0.5))],
                                [0] * count)
        return thing, side

    def light_at_probes(self, probes, samples):
        """The mean of two seeds, and the variance of that mean."""
        thing, side = self.add_probes(probes)
        both = []
        for seed in (11, 12):
            values, used = self.bake(thing, side, side, samples, seed)
            print(f"MEASURED {len(probes[0])} probes with {samples} samples in {used:.0f} s", flush=True)
            both.append(values[::-1].reshape(-1, 3)[:len(probes[0])])
        self.bpy.data.objects.remove(thing)
        return (both[0] + both[1]) / 2, ((both[0] - both[1]) ** 2).mean(1) / 4


def in_blender(values):
    """Blender's z is up."""
    import numpy

    return numpy.stack([values[..., 0], -values[..., 2], values[..., 1]], -1)


def lights_of(baked):
    """Each light as triangles and its radiance."""
    import numpy

    result = []
    for node in baked.json["nodes"]:
        reference = node.get("extensions", {}).get("EXT_lights_area")
        if not reference:
            continue
        light = baked.json["extensions"]["EXT_lights_area"]["lights"][reference["light"]]
        m, size = baked.matrix(node), light.get("size", 1.0)
        if light["type"] == "rect":
            x, y = size * light.get("rect", {}).get("aspect", 1.0) / 2, size / 2
            a, b, c, d = [-x, -y, 0], [-x, y, 0], [x, y, 0], [x, -y, 0]  # shines along -z
            shape = numpy.array([[a, b, c], [a, c, d]], float)
        elif light["type"] == "sphere":
            shape = ball(numpy, size / 2)
        else:
            sys.exit(f"bake_against_cycles: a light of type {light['type']} has no surface here")
        radiance = [c * light.get("intensity", 1) for c in light.get("color", (1, 1, 1))]
        result.append((in_blender(shape @ m[:3, :3].T + m[:3, 3]), radiance))
    return result


def ball(numpy, radius, columns=48, rows=24):
    def at(i, j):
        theta, phi = math.pi * j / rows, 2 * math.pi * i / columns
        return [radius * math.sin(theta) * math.cos(phi), radius * math.cos(theta), radius * math.sin(theta) * math.sin(phi)]

    triangles = []
    for j in range(rows):
        for i in range(columns):
            a, b, c, d = at(i, j), at(i, j + 1), at(i + 1, j + 1), at(i + 1, j)
            triangles += [t for t, kept in (((a, d, c), j > 0), ((a, c, b), j < rows - 1)) if kept]
    return numpy.array(triangles)


def grown(baked):
    """Places of the map for Blender, from the bottom, from 0 to 1. Our charts end a 64th of a texel inside the middles of their outer texels,
    which Blender fills only where a chart covers them: so each chart grows by that."""
    import numpy

    grow = 1 / 64 + 0.01
    places, root = baked.places.copy(), {}

    def find(k):
        while root.setdefault(k, k) != k:
            root[k] = k = root[root[k]]
        return k

    keys = [[tuple(p) for p in t.round(4)] for t in places]
    lit = [t for t in range(len(places)) if numpy.isfinite(places[t]).all()]
    for t in lit:
        for k in (1, 2):
            root[find(keys[t][k])] = find(keys[t][0])
    islands = {}
    for t in lit:
        islands.setdefault(find(keys[t][0]), []).append(t)
    for triangles in islands.values():
        part = places[triangles]
        low, high = part.min((0, 1)), part.max((0, 1))
        size = numpy.maximum(high - low, 1e-6)
        places[triangles] = low - grow + (part - low) * (size + 2 * grow) / size
    places = numpy.nan_to_num(places, nan=-1.0) / [baked.width, baked.height]
    places[..., 1] = 1 - places[..., 1]
    return places


def told(value):
    return "0" if value == 0 else f"{100 * value:.2g} %"


def judged(kind, texels, baked, probes, truth, noise, seconds):
    """A line of the table."""
    import numpy

    shown, mean = shown_at(texels, probes[4]), float(truth.mean())
    rms = math.sqrt(max(float(((shown - truth) ** 2).mean() - noise.mean()), 0.0)) / mean
    line = {"kind": kind, "seconds": seconds, "rms": rms, "ratio": float(shown.mean() / truth.mean()), "seam": largest_seam(texels, baked.seams(), mean),
            "beyond": float((numpy.abs(shown - truth).max(1) > 0.05 * mean).mean())}
    print("MEASURED " + json.dumps(line), flush=True)
    return line


def our_map(options, scene, folder):
    """The baked file, its texels, and processor seconds of the program."""
    import pictures

    out = Path(folder) / "ours.glb"
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    run(options.program, "bake", scene, "-o", out, "--texels", str(options.texels))
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    texels = pictures.read_exr(out.with_suffix(".exr"))[:, :, :3].astype(float)
    return Baked(out), texels, after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def write_maps(path, numpy, maps):
    """Maps side by side, as a screen shows them."""
    import png_files

    light = numpy.concatenate([m for _, m in maps], 1)
    light = (light * (0.4 / maps[0][1][maps[0][1] > 0].mean())).clip(0, 1)
    codes = numpy.where(light > 0.0031308, 1.055 * numpy.maximum(light, 1e-9) ** (1 / 2.4) - 0.055, 12.92 * light)
    png_files.write_png(path, [row.tobytes() for row in (codes * 255 + 0.5).astype("uint8")])


def measure(name, options, folder):
    """One scene: a line for each map."""
    import numpy

    if name == "leak":
        return measure_leak(options, folder)
    baked, texels, seconds = our_map(options, scene_file(name), folder)
    cycles_lights = lights_of(baked)
    cycles = Cycles(cycles_lights)
    colors, of = numpy.unique(baked.colors.round(6), axis=0, return_inverse=True)
    materials = [cycles.material(f"surface {k}", tuple(c)) for k, c in enumerate(colors)]
    room = cycles.add_object("room", in_blender(baked.positions), in_blender(baked.normals), grown(baked), materials, of.reshape(-1))
    probes = baked.probes(options.probes)
    truth, noise = cycles.light_at_probes([*(in_blender(p) for p in probes[:4]), probes[4]], options.truth)
    # Places below things that stand on a surface get no light, and nobody sees them. Our lamps let a part of the bounced light pass.
    lit = truth.max(1) > 0
    for shape, _ in cycles_lights:
        low, high = shape.min((0, 1)) - NEAR, shape.max((0, 1)) + NEAR
        lit &= ~((in_blender(probes[0]) > low) & (in_blender(probes[0]) < high)).all(1)
    truth, noise, probes = truth[lit], noise[lit], [p[lit] for p in probes]
    print(f"MEASURED {len(truth)} probes are lit, noise of their truth {math.sqrt(noise.mean()) / truth.mean():.4f}", flush=True)
    lines = [judged("ours", texels, baked, probes, truth, noise, seconds)]
    maps = [("ours", texels)]
    for count in map(int, options.samples.split(",")):
        theirs, used = cycles.bake(room, baked.width, baked.height, count, 1)
        lines.append(judged(f"Cycles, {count} samples", theirs, baked, probes, truth, noise, used))
        maps.append((count, theirs))
    if options.pictures:
        Path(options.pictures).mkdir(parents=True, exist_ok=True)
        write_maps(Path(options.pictures) / f"{name}.png", numpy, maps)
    print("RESULT " + json.dumps({"scene": name, "size": f"{baked.width} x {baked.height}", "lines": lines}), flush=True)


def two_rooms(folder, texels):
    """The scene "leak": its file."""
    from gltf_writer import DOWN, Gltf, box, plate

    g, wall = Gltf(), 0.2 / texels
    grey = g.diffuse("grey", (0.5, 0.5, 0.5))
    for name, corners in (("floor", ((-2, 0, 1), (2, 0, 1), (2, 0, -1), (-2, 0, -1))), ("ceiling", ((-2, 2, -1), (2, 2, -1), (2, 2, 1), (-2, 2, 1))),
                          ("back", ((-2, 0, -1), (2, 0, -1), (2, 2, -1), (-2, 2, -1))), ("front", ((2, 0, 1), (-2, 0, 1), (-2, 2, 1), (2, 2, 1))),
                          ("left", ((-2, 0, 1), (-2, 0, -1), (-2, 2, -1), (-2, 2, 1))), ("right", ((2, 0, -1), (2, 0, 1), (2, 2, 1), (2, 2, -1)))):
        g.node(name, mesh=g.mesh(name, plate(*corners), grey))
    g.node("wall", mesh=g.mesh("wall", box(0.3, 0, -1, 0.3 + wall, 2, 1), grey))
    g.area_light("lamp", {"type": "rect", "color": [1.0, 1.0, 1.0], "intensity": 10.0, "size": 0.6, "rect": {"aspect": 1.0}},
                 translation=[-1.0, 1.9, 0.0], rotation=DOWN)
    g.camera("main", [-1.8, 1.0, 0.8], [0.0, 1.0, 0.0], 0.69)
    path = Path(folder) / "leak.glb"
    g.write(path)
    return path, wall


def measure_leak(options, folder):
    """Two rooms: ours on our charts, Cycles on one chart for each rectangle, as Blender's packing gives them."""
    import numpy

    scene, wall = two_rooms(folder, options.texels)
    baked, texels, seconds = our_map(options, scene, folder)
    lines = []

    def add(kind, texels, baked, seconds):
        at, _, _, _, places = baked.probes(20000)
        shown = shown_at(texels, places).max(1)
        lit, dark = shown[at[:, 0] < 0.3], shown[at[:, 0] > 0.3 + wall]
        lines.append({"kind": kind, "seconds": seconds, "leak": float(dark.max() / lit.mean())})
        print("MEASURED " + json.dumps(lines[-1]), flush=True)

    add("ours", texels, baked, seconds)
    cycles = Cycles(lights_of(baked))
    whole = one_chart_a_rectangle(Baked(scene), options.texels)
    materials = [cycles.material("surface", (0.5, 0.5, 0.5))]
    room = cycles.add_object("room", in_blender(whole.positions), in_blender(whole.normals), grown(whole), materials, [0] * len(whole.positions))
    for count in map(int, options.samples.split(",")):
        theirs, used = cycles.bake(room, whole.width, whole.height, count, 1)
        add(f"Cycles, {count} samples", theirs, whole, used)
    print("RESULT " + json.dumps({"scene": "leak", "size": f"{baked.width} x {baked.height}", "lines": lines}), flush=True)


def one_chart_a_rectangle(whole, texels):
    """The rectangles of an unbaked scene in a row, each with a border of a texel."""
    import numpy

    x = 0
    for t in range(0, len(whole.positions), 2):
        a, b, c = whole.positions[t]
        d = whole.positions[t + 1][2]
        width, height = (max(round(float(numpy.linalg.norm(e)) * texels), 1) for e in (b - a, d - a))
        corner = numpy.array([[x + 0.5, 0.5], [x + width + 0.5, 0.5], [x + width + 0.5, height + 0.5], [x + 0.5, height + 0.5]])
        whole.places[t], whole.places[t + 1] = corner[[0, 1, 2]], corner[[0, 2, 3]]
        x += width + 2
        whole.height = max(whole.height, height + 2)
    whole.width = x
    return whole


def table(results):
    """For the docs."""
    for r in results:
        print(f"\n`{r['scene']}`, {r['size']} texels\n")
        if r["scene"] == "leak":
            print("| map | CPU [s] | largest light in the dark room |\n|---|--:|--:|")
            for line in r["lines"]:
                print(f"| {line['kind']} | {line['seconds']:.1f} | {told(line['leak'])} |")
            continue
        print("| map | CPU [s] | rms against paths | probes off by over 5 % | ratio of the means | largest seam |\n|---|--:|--:|--:|--:|--:|")
        for line in r["lines"]:
            print(f"| {line['kind']} | {line['seconds']:.1f} | {told(line['rms'])} | {told(line['beyond'])} | {line['ratio']:.4f} | {told(line['seam'])} |")


def parsed(arguments):
    parser = argparse.ArgumentParser(prog="bake_against_cycles.py", description=__doc__.splitlines()[0])
    parser.add_argument("--program", default=str(BUILT / "bin/steradian"), help="default: %(default)s")
    parser.add_argument("--texels", type=float, default=16, help="a metre; default: %(default)s")
    parser.add_argument("--samples", default="64,1024", help="a texel, of Cycles; default: %(default)s")
    parser.add_argument("--probes", type=int, default=2000, help="places of the truth; default: %(default)s")
    parser.add_argument("--truth", type=int, default=8192, help="samples a probe, of each of two seeds; default: %(default)s")
    parser.add_argument("--pictures", help="folder for a picture of the maps side by side; default: none")
    parser.add_argument("scenes", nargs="+", metavar="SCENE", help='such as cornell; "leak": two rooms')
    return parser.parse_args(arguments)


def main():
    if "--" in sys.argv:  # inside Blender
        options = parsed(sys.argv[sys.argv.index("--") + 1:])
        for name in options.scenes:
            with tempfile.TemporaryDirectory() as folder:
                measure(name, options, folder)
        return
    parsed(sys.argv[1:])
    if not shutil.which("blender"):
        sys.exit("bake_against_cycles: there is no blender here (apt-get install blender python3-numpy)")
    # Debian's Blender takes the library of the first python3 of PATH: Debian's own has numpy.
    environment = {**os.environ, "PATH": "/usr/bin:/bin:" + os.environ.get("PATH", "")}
    command = ["blender", "-b", "--factory-startup", "--python-exit-code", "3", "-P", os.path.abspath(__file__), "--", *sys.argv[1:]]
    results, lines = [], []
    with subprocess.Popen(command, env=environment, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True) as blender:
        for line in blender.stdout:
            lines.append(line)
            if line.startswith("MEASURED"):
                print(line.rstrip(), file=sys.stderr, flush=True)
            if line.startswith("RESULT"):
                results.append(json.loads(line[7:]))
    if blender.returncode != 0:
        sys.exit("".join(lines[-20:]))
    table(results)


if __name__ == "__main__":
    main()
