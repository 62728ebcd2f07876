"""Measures what Blender's watts mean: each of its lights over a white floor, rendered by Cycles.

    blender -b --factory-startup -P examples/blender/measure_lights.py

Prints, for each light of 100 W (a sun of 100 W/m2), what Cycles makes of it: the factor from watts to radiance, intensity or irradiance,
beside the formula that docs/lights.md states. The floor's pixel is irradiance over pi.
"""
import math
import os
import sys
import tempfile

import bpy

POWER, HEIGHT = 100.0, 2.0


def floor_radiance(make_light):
    bpy.ops.wm.read_factory_settings(use_empty=True)
    scene = bpy.context.scene
    scene.render.engine = "CYCLES"
    scene.cycles.samples = 1024
    scene.cycles.use_denoising = False
    scene.cycles.max_bounces = 0
    scene.view_settings.view_transform = "Standard"
    scene.render.resolution_x = scene.render.resolution_y = 4
    scene.world = bpy.data.worlds.new("dark")
    scene.world.color = (0, 0, 0)
    bpy.ops.mesh.primitive_plane_add(size=100)
    material = bpy.data.materials.new("white")
    material.use_nodes = True
    nodes = material.node_tree.nodes
    nodes.clear()
    diffuse, output = nodes.new("ShaderNodeBsdfDiffuse"), nodes.new("ShaderNodeOutputMaterial")
    diffuse.inputs["Color"].default_value = (1, 1, 1, 1)
    material.node_tree.links.new(diffuse.outputs[0], output.inputs[0])
    bpy.context.object.data.materials.append(material)
    make_light()
    camera = bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
    camera.location = (0, 0, 1)  # below the light, looking down
    camera.data.angle = math.radians(0.5)
    scene.collection.objects.link(camera)
    scene.camera = camera
    path = os.path.join(tempfile.mkdtemp(), "floor.exr")
    scene.render.image_settings.file_format = "OPEN_EXR"
    scene.render.image_settings.color_depth = "32"
    scene.render.filepath = path
    bpy.ops.render.render(write_still=True)
    pixels = bpy.data.images.load(path).pixels[:]
    return sum(pixels[0::4]) / len(pixels[0::4])


def light(kind, **settings):
    def make():
        data = bpy.data.lights.new("light", kind)
        data.energy = POWER
        for key, value in settings.items():
            setattr(data, key, value)
        lamp = bpy.data.objects.new("light", data)
        lamp.location = (0, 0, HEIGHT)
        bpy.context.scene.collection.objects.link(lamp)
    return make


# The floor's radiance below a small light of these sizes: irradiance over pi is radiance * area / (pi h^2), or intensity / (pi h^2).
SIDE, RADIUS = 0.02, 0.01
CASES = [
    ("square, radiance", light("AREA", shape="SQUARE", size=SIDE), SIDE ** 2, 1 / (4 * SIDE ** 2), "P / (4 A)"),
    ("disk, radiance", light("AREA", shape="DISK", size=2 * RADIUS), math.pi * RADIUS ** 2, 1 / (4 * math.pi * RADIUS ** 2), "P / (4 A)"),
    ("point, intensity", light("POINT", shadow_soft_size=RADIUS), 1, 1 / (4 * math.pi ** 2) * math.pi, "P / (4 pi)"),
    ("spot, intensity", light("SPOT", shadow_soft_size=RADIUS, spot_size=1.5, spot_blend=0), 1, 1 / (4 * math.pi), "P / (4 pi)"),
]

for name, make, area, factor, formula in CASES:
    seen = floor_radiance(make) * math.pi * HEIGHT ** 2 / area / POWER
    print(f"MEASURED {name}: {seen:.6g} per watt; {formula} says {factor:.6g}; ratio {seen / factor:.4f}", file=sys.stderr)
seen = floor_radiance(light("SUN", angle=0.0)) * math.pi / POWER
print(f"MEASURED sun, irradiance: {seen:.6g} per watt a square metre; E says 1; ratio {seen:.4f}", file=sys.stderr)
