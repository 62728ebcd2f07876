"""Builds a room in Blender, saves it, and renders its direct light with Cycles: what docs/blender.md compares with.

    blender -b --factory-startup --python make_room.py -- FOLDER [light ...]

Writes FOLDER/room.blend and FOLDER/cycles.exr, the latter without shadows, without bounces and with Lambertian walls. Lights: any of area, disk, sphere, spot, point, sun;
all of them where none is named.
"""

import math
import os
import sys

import bpy


def material(name, color, emission=0.0):
    m = bpy.data.materials.new(name)
    m.use_nodes = True
    shader = m.node_tree.nodes["Principled BSDF"]
    shader.inputs["Base Color"].default_value = (*color, 1)
    shader.inputs["Specular"].default_value = 0
    shader.inputs["Roughness"].default_value = 1
    if emission > 0:
        shader.inputs["Base Color"].default_value = (0, 0, 0, 1)
        shader.inputs["Emission"].default_value = (*color, 1)
        shader.inputs["Emission Strength"].default_value = emission
    return m


def put(m):
    bpy.context.object.data.materials.append(m)
    # A ball's far half must not shine through its near one; everything else lets light pass.
    bpy.context.object.visible_shadow = m.name == "glow"


def make_lambertian():
    """Swaps the Principled shaders, whose diffuse lobe is Disney's, for plain diffuse ones: the lobe that glTF means."""
    for m in bpy.data.materials:
        if not m.use_nodes or m.name == "glow" or "Principled BSDF" not in m.node_tree.nodes:
            continue
        nodes, links = m.node_tree.nodes, m.node_tree.links
        diffuse = nodes.new("ShaderNodeBsdfDiffuse")
        diffuse.inputs["Color"].default_value = nodes["Principled BSDF"].inputs["Base Color"].default_value
        links.new(diffuse.outputs["BSDF"], nodes["Material Output"].inputs["Surface"])


def add_lamp(kind, energy, location, rotation=(0, 0, 0), **more):
    bpy.ops.object.light_add(type=kind, location=location, rotation=rotation)
    light = bpy.context.object.data
    light.energy = energy
    light.use_shadow = False
    light.cycles.cast_shadow = False
    for key, value in more.items():
        setattr(light, key, value)


def build(lights):
    bpy.ops.object.select_all(action="SELECT")
    bpy.ops.object.delete()
    grey = material("grey", (0.5, 0.5, 0.5))
    bpy.ops.mesh.primitive_plane_add(size=8)
    put(grey)
    bpy.ops.mesh.primitive_plane_add(size=8, location=(0, 4, 4), rotation=(math.pi / 2, 0, 0))
    put(material("red", (0.6, 0.2, 0.2)))
    bpy.ops.mesh.primitive_plane_add(size=8, location=(-4, 0, 4), rotation=(0, math.pi / 2, 0))
    put(material("green", (0.2, 0.6, 0.2)))
    bpy.ops.mesh.primitive_cube_add(size=1, location=(1, 0.5, 0.5), rotation=(0, 0, 0.5))
    put(grey)
    if "sphere" in lights:
        bpy.ops.mesh.primitive_uv_sphere_add(segments=32, ring_count=16, radius=0.4, location=(-2, 1.5, 1.5))
        bpy.ops.object.shade_smooth()
        put(material("glow", (1.0, 0.8, 0.5), 12))
    if "area" in lights:
        add_lamp("AREA", 100, (1, 0, 3.5), (0.2, 0.3, 0), shape="RECTANGLE", size=1.5, size_y=0.7, color=(1, 0.9, 0.8))
    if "disk" in lights:
        add_lamp("AREA", 60, (-1, -1, 3), (-0.3, 0, 0), shape="DISK", size=1.2)
    if "point" in lights:
        add_lamp("POINT", 80, (2.5, 2, 2), shadow_soft_size=0)
    if "spot" in lights:
        add_lamp("SPOT", 300, (-1, -2, 4), (0.3, 0, 0), shadow_soft_size=0, spot_size=1.2, spot_blend=0.4)
    if "sun" in lights:
        add_lamp("SUN", 0.8, (0, 0, 5), (0.5, 0.4, 0), angle=0)
    bpy.ops.object.camera_add(location=(4.5, -7, 4.5), rotation=(math.radians(66), 0, math.radians(30)))
    bpy.context.scene.camera = bpy.context.object


def render(path):
    scene = bpy.context.scene
    scene.world.use_nodes = True
    scene.world.node_tree.nodes["Background"].inputs["Strength"].default_value = 0
    scene.render.engine = "CYCLES"
    scene.cycles.device = "CPU"
    scene.cycles.samples = 1024
    scene.cycles.use_denoising = False
    scene.cycles.max_bounces = 0
    scene.cycles.sample_clamp_direct = 0
    scene.render.resolution_x, scene.render.resolution_y, scene.render.resolution_percentage = 128, 72, 100
    scene.render.filter_size = 0.01
    scene.cycles.pixel_filter_type = "BOX"
    scene.cycles.filter_width = 0.01
    scene.render.image_settings.file_format = "OPEN_EXR"
    scene.render.image_settings.color_depth = "32"
    scene.view_settings.view_transform = "Raw"
    scene.render.filepath = path
    bpy.ops.render.render(write_still=True)


def main():
    arguments = sys.argv[sys.argv.index("--") + 1 :] if "--" in sys.argv else []
    if not arguments:
        sys.exit("usage: blender -b --factory-startup --python make_room.py -- FOLDER [light ...]")
    folder = os.path.abspath(arguments[0])
    os.makedirs(folder, exist_ok=True)
    build(arguments[1:] or ["area", "disk", "sphere", "point", "spot", "sun"])
    bpy.ops.wm.save_as_mainfile(filepath=os.path.join(folder, "room.blend"))
    make_lambertian()
    render(os.path.join(folder, "cycles.exr"))


main()
