"""Exports a Blender file to glTF with its area lights, which Blender's own exporter leaves out, as EXT_lights_area.

    blender -b room.blend --python export_with_area_lights.py -- room.glb

What it writes is the exporter's file with a node for each area light. An area light of power P [W] and area A shines with the radiance
P / (4 A) in Blender, whatever its shape: that is what Cycles renders (docs/lights.md says how that was measured). Light that a node tree
makes is not known to this script: it takes the light's colour and power, and says so.
"""

import json
import os
import struct
import sys

import bpy

EXTENSION = "EXT_lights_area"


def light_and_scale(light):
    """The light's definition, for a rect or disk one unit high, and the node's scale along its x and y."""
    width = light.size
    height = light.size_y if light.shape in ("RECTANGLE", "ELLIPSE") else light.size
    kind = "disk" if light.shape in ("DISK", "ELLIPSE") else "rect"
    definition = {"name": light.name, "type": kind, "color": list(light.color), "size": 1.0,
                  "extras": {"steradian": {"scale": "axes"}}}  # an addition of ours: the draft takes the largest scale alone
    if kind == "rect":
        definition["rect"] = {"aspect": 1.0}
    return definition, (width, height)


def world_columns(matrix):
    """A matrix of Blender's world (z up) as columns of glTF's (y up); the light's own axes stay, it shines along its -z in both."""
    columns = []
    for c in range(4):
        x, y, z, w = (matrix[r][c] for r in range(4))
        columns.append([x, z, -y, w])
    return columns


def length(v):
    return sum(x * x for x in v[:3]) ** 0.5


def area_lights():
    """(definition, node) of every visible area light."""
    for instance in bpy.context.evaluated_depsgraph_get().object_instances:
        source = instance.object
        if source.type != "LIGHT" or source.data.type != "AREA" or source.original.hide_render:
            continue
        light = source.data
        if light.use_nodes:
            print(f"export_with_area_lights: {source.name}: its node tree is not read, only its colour and power")
        definition, (width, height) = light_and_scale(light)
        columns = world_columns(instance.matrix_world)
        for column, size in ((columns[0], width), (columns[1], height)):
            column[:3] = [x * size for x in column[:3]]
        area = length(columns[0]) * length(columns[1])
        if definition["type"] == "disk":
            area *= 3.14159265358979324 / 4
        if area == 0:
            print(f"export_with_area_lights: {source.name} has no area and is left out")
            continue
        definition["intensity"] = light.energy / (4 * area)
        node = {"name": source.name, "matrix": [x for column in columns for x in column]}
        yield definition, node


def silence_specular(gltf):
    """Blender's Specular 0 is no reflection at all; its exporter's specularColorFactor 0 leaves the one at grazing angles."""
    for material in gltf.get("materials", []):
        specular = material.get("extensions", {}).get("KHR_materials_specular", {})
        if specular.get("specularColorFactor") == [0, 0, 0]:
            specular["specularFactor"] = 0


def tell_of_glass(gltf):
    """Blender's glass bends light; its exporter gives it no thickness, and glTF takes it for a thin wall."""
    for material in gltf.get("materials", []):
        extensions = material.get("extensions", {})
        if "KHR_materials_transmission" in extensions and "KHR_materials_volume" not in extensions:
            print(f"export_with_area_lights: {material['name']}: glass is written as a thin wall, which bends no light; the add-on writes solids")


def add_area_lights(gltf):
    silence_specular(gltf)
    tell_of_glass(gltf)
    lights = gltf.setdefault("extensions", {}).setdefault(EXTENSION, {}).setdefault("lights", [])
    for definition, node in area_lights():
        node["extensions"] = {EXTENSION: {"light": len(lights)}}
        lights.append(definition)
        gltf.setdefault("nodes", []).append(node)
        gltf["scenes"][gltf.get("scene", 0)].setdefault("nodes", []).append(len(gltf["nodes"]) - 1)
    used = gltf.setdefault("extensionsUsed", [])
    if lights and EXTENSION not in used:
        used.append(EXTENSION)
    if not lights:
        del gltf["extensions"][EXTENSION]
    return len(lights)


def rewrite_glb(path):
    """Changes the JSON chunk of a .glb in place; returns the number of area lights."""
    with open(path, "rb") as file:
        data = file.read()
    json_length = struct.unpack_from("<I", data, 12)[0]
    gltf = json.loads(data[20 : 20 + json_length])
    count = add_area_lights(gltf)
    text = json.dumps(gltf, separators=(",", ":")).encode()
    text += b" " * (-len(text) % 4)
    rest = data[20 + json_length :]
    with open(path, "wb") as file:
        file.write(b"glTF" + struct.pack("<II", 2, 20 + len(text) + len(rest)))
        file.write(struct.pack("<I", len(text)) + b"JSON" + text + rest)
    return count


def rewrite_gltf(path):
    with open(path) as file:
        gltf = json.load(file)
    count = add_area_lights(gltf)
    with open(path, "w") as file:
        json.dump(gltf, file)
    return count


def main():
    arguments = sys.argv[sys.argv.index("--") + 1 :] if "--" in sys.argv else []
    if len(arguments) != 1 or os.path.splitext(arguments[0])[1] not in (".glb", ".gltf"):
        sys.exit("usage: blender -b FILE.blend --python export_with_area_lights.py -- OUTPUT.glb (or .gltf)")
    path = os.path.abspath(arguments[0])
    binary = path.endswith(".glb")
    bpy.ops.export_scene.gltf(
        filepath=path, export_format="GLB" if binary else "GLTF_SEPARATE", export_lights=True, export_cameras=True,
        export_apply=True,  # modifiers
    )
    count = rewrite_glb(path) if binary else rewrite_gltf(path)
    print(f"export_with_area_lights: {path} with {count} area lights")


main()
