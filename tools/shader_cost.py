#!/usr/bin/env python3
"""What compilers of GPUs make of the shaders, on a machine without a GPU.

usage: shader_cost.py PROGRAM                   prints the tables of docs/measured/shaders.md
       shader_cost.py PROGRAM --check FAMILY..  exit 1 where a pipeline exceeds the limits of tools/shader_limits.json; no family: all
       shader_cost.py PROGRAM --all             every pipeline, with the time to make it
       shader_cost.py --test                    exit 1 when a report made up for the purpose is judged wrongly

Mesa's driver RADV makes a device for an AMD GPU that is not there (RADV_FORCE_FAMILY): it compiles and runs nothing. `steradian info SCENE
--pipelines` makes all pipelines of a picture on it and prints the driver's statistics. gfx1100 is RDNA 3, navi21 RDNA 2, vega10 GCN 5.
Instructions are of the whole pipeline: each loop's body counts once, and so do both sides of a branch. Scratch is memory of a wave of 64
threads, for private arrays and spilled registers. Needs the package mesa-vulkan-drivers; exit 77 without it.
"""
import base64
import json
import os
import struct
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
DRIVER = "/usr/share/vulkan/icd.d/radeon_icd.x86_64.json"
FAMILIES = ["gfx1100", "navi21", "vega10"]
# Pictures whose pipelines are made: a name, and the arguments of `steradian info`.
PICTURES = [
    ("gallery", ["scenes/gallery.glb"]),
    ("gallery by ltc", ["scenes/gallery.glb", "--method", "ltc"]),
    ("gallery by half-vector", ["scenes/gallery.glb", "--method", "half-vector"]),
    ("sheen and coat", ["SHEEN"]),  # sheen_scene
    ("textured floor", ["scenes/textured_floor.glb", "--shadows", "off"]),
    ("room, one bounce", ["scenes/room.glb", "--indirect", "ltc"]),
    ("lamps.svg", ["scenes/plane/lamps.svg"]),
]
SIZE = "640x360"
LIMITS = ROOT / "tools" / "shader_limits.json"
# The limited numbers, by the driver's names.
LIMITED = {"instructions": "Instructions", "spills": "Spilled VGPRs", "scratch": "Scratch size"}


def sheen_scene():
    """glTF: a floor with sheen and a clear coat under a square light."""
    numbers = [v for size, y in ((4, 0), (1, 2)) for x, z in ((-size, -size), (-size, size), (size, size), (size, -size)) for v in (x, y, z)]
    data = struct.pack("<24f6H6H", *numbers, 0, 1, 2, 0, 2, 3, 0, 2, 1, 0, 3, 2)
    views = [(0, 48), (48, 48), (96, 12), (108, 12)]
    return json.dumps({
        "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0, 1, 2]}],
        "nodes": [{"mesh": 0}, {"mesh": 1}, {"camera": 0, "translation": [0, 1, 6]}],
        "cameras": [{"type": "perspective", "perspective": {"yfov": 0.8, "znear": 0.1}}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": m}, "indices": 2 + m, "material": m}]} for m in (0, 1)],
        "materials": [{"extensions": {"KHR_materials_sheen": {"sheenColorFactor": [1, 1, 1], "sheenRoughnessFactor": 0.5},
                                      "KHR_materials_clearcoat": {"clearcoatFactor": 1, "clearcoatRoughnessFactor": 0.1}}},
                      {"emissiveFactor": [1, 1, 1]}],
        "extensionsUsed": ["KHR_materials_sheen", "KHR_materials_clearcoat"],
        "accessors": [{"bufferView": v, "componentType": 5126 if v < 2 else 5123, "count": 4 if v < 2 else 6,
                       "type": "VEC3" if v < 2 else "SCALAR", "min": [[-4, 0, -4], [-1, 2, -1]][v] if v < 2 else [0],
                       "max": [[4, 0, 4], [1, 2, 1]][v] if v < 2 else [3]} for v in range(4)],
        "bufferViews": [{"buffer": 0, "byteOffset": at, "byteLength": length} for at, length in views],
        "buffers": [{"byteLength": len(data), "uri": "data:application/octet-stream;base64," + base64.b64encode(data).decode()}]})


def pipelines(program, family, arguments, size=SIZE):
    if arguments[0] == "SHEEN":
        with tempfile.TemporaryDirectory() as folder:
            scene = Path(folder) / "sheen.gltf"
            scene.write_text(sheen_scene())
            return pipelines(program, family, [str(scene)] + arguments[1:])
    environment = dict(os.environ, RADV_FORCE_FAMILY=family, VK_ICD_FILENAMES=DRIVER, MESA_SHADER_CACHE_DISABLE="1",
                       STERADIAN_PIPELINE_CACHE="")
    made = subprocess.run([program, "info", *arguments, "--pipelines", "--json", "--size", size], env=environment, cwd=ROOT, capture_output=True, text=True)
    if made.returncode != 0:
        sys.exit(f"shader_cost: {' '.join(arguments)} on {family}: exit {made.returncode}: {made.stderr.strip()}")
    return json.loads(made.stdout)["pipelines"]


def number(pipeline, name):
    return pipeline["statistics"][LIMITED.get(name, name)]


def excesses(shader, pipeline, limits):
    """Sentences for the limits that a pipeline exceeds."""
    if shader not in limits:
        return [f"{shader} has no limits in {LIMITS.name}"]
    found = []
    for name in LIMITED:
        if number(pipeline, name) > limits[shader][name]:
            found.append(f"{shader} {pipeline['constants']}: {number(pipeline, name)} {name}, more than {limits[shader][name]}")
    return found


def of_family(limits, family):
    """The limits of all families, with what a family has of its own."""
    return {shader: dict(numbers, **limits.get(family, {}).get(shader, {})) for shader, numbers in limits["all"].items()}


def check(reports):
    limits = json.loads(LIMITS.read_text())
    bad, used = [], {}
    for (family, picture), made in reports.items():
        for p in made:
            bad += [f"{family}, {picture}: {sentence}" for sentence in excesses(p["shader"], p, of_family(limits, family))]
            most = used.setdefault((family, p["shader"]), dict.fromkeys(LIMITED, 0))
            for name in LIMITED:
                most[name] = max(most[name], number(p, name))
    print("\n".join(bad) or f"{sum(map(len, reports.values()))} pipelines keep the limits; the largest numbers:")
    for (family, shader), most in sorted(used.items()):
        print(f"  {family} {json.dumps(shader)}: {json.dumps(most)}")
    return 1 if bad else 0


def self_test():
    pipeline = {"constants": [1], "statistics": {"Instructions": 100, "Spilled VGPRs": 0, "Scratch size": 64}}
    good = {"instructions": 100, "spills": 0, "scratch": 64}
    right = excesses("a.comp", pipeline, {"a.comp": good}) == []
    for name in LIMITED:
        less = dict(good, **{name: good[name] - 1})
        right = right and len(excesses("a.comp", pipeline, {"a.comp": less})) == 1
    limits = {"all": {"a.comp": good}, "navi21": {"a.comp": {"scratch": 0}}}
    right = right and not excesses("a.comp", pipeline, of_family(limits, "vega10")) and len(excesses("a.comp", pipeline, of_family(limits, "navi21"))) == 1
    right = right and len(excesses("b.comp", pipeline, {"a.comp": good})) == 1
    print("judged as they are" if right else "WRONG")
    return 0 if right else 1


def span(values):
    low, high = min(values), max(values)
    return f"{low:,}" if low == high else f"{low:,} - {high:,}"


def tables(reports):
    """Markdown: a row for each picture and shader. Rows that an earlier picture has already are left out."""
    printed = set()
    print("| picture | shader | pipelines | SPIR-V [KB] | instructions | vector registers | least waves a SIMD | most spilled | " +
          " | ".join(f"scratch on {family}" for family in FAMILIES) + " |")
    print("|---|---|" + "--:|" * (6 + len(FAMILIES)))
    for picture, _ in PICTURES:
        first = reports[FAMILIES[0], picture]
        for shader in sorted({p["shader"] for p in first}):
            of = [p for p in first if p["shader"] == shader]
            elsewhere = [[p for p in reports[family, picture] if p["shader"] == shader] for family in FAMILIES]
            scratch = [f"{max(number(p, 'scratch') for p in one):,}" for one in elsewhere]
            row = (f"`{shader}` | {len(of)} | {span([round(p['module_bytes'] / 1000) for p in of])} | "
                   f"{span([number(p, 'instructions') for p in of])} | {span([number(p, 'VGPRs') for p in of])} | "
                   f"{min(number(p, 'Subgroups per SIMD') for p in of)} | {max(number(p, 'spills') for p in of):,} | {' | '.join(scratch)} |")
            if row not in printed:
                print(f"| {picture} | {row}")
            printed.add(row)


def main():
    arguments = sys.argv[1:]
    if arguments == ["--test"]:
        sys.exit(self_test())
    families = arguments[2:] or FAMILIES
    if not arguments or arguments[0].startswith("-") or arguments[1:2] not in ([], ["--check"], ["--all"]) or not set(families) <= set(FAMILIES):
        sys.exit(__doc__)
    if not Path(DRIVER).exists():
        print("no RADV here: apt-get install mesa-vulkan-drivers", file=sys.stderr)
        sys.exit(77)
    program = str(Path(arguments[0]).resolve())
    if arguments[1:] == ["--all"]:
        for picture, of in PICTURES:
            made = pipelines(program, FAMILIES[0], of)
            print(f"{picture}: {len(made)} pipelines, {sum(p['ms'] for p in made):.0f} ms")
            for p in made:
                print(f"  {p['shader']:24} {p['module_bytes']:8} bytes {p['ms']:7.1f} ms {number(p, 'Instructions'):6} instructions "
                      f"{number(p, 'VGPRs'):4} registers {number(p, 'spills'):4} spilled {number(p, 'scratch'):7} scratch "
                      f"{p['units']:10} units {p['constants']}")
        return
    reports = {(family, picture): pipelines(program, family, of) for family in families for picture, of in PICTURES}
    if arguments[1:2] == ["--check"]:
        sys.exit(check(reports))
    tables(reports)


if __name__ == "__main__":
    main()
