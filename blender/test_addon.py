"""The add-on in Blender itself: its engine against Cycles, and its lights in an export.

    test_addon.py PROGRAM              runs Blender with the add-on in a folder of its own; exit 77 (skipped) where there is no Blender
    blender -b -P test_addon.py -- FOLDER    what it runs
"""
import json
import os
import struct
import sys

sys.path.append(os.path.dirname(os.path.abspath(__file__)))
import in_blender  # noqa: E402

WIDTH, HEIGHT = 64, 36


def inside(folder):
    import bpy

    def material(name, color):
        m = bpy.data.materials.new(name)
        m.use_nodes = True
        shader = m.node_tree.nodes["Principled BSDF"]
        shader.inputs["Base Color"].default_value = (*color, 1)
        shader.inputs["Specular"].default_value = 0
        shader.inputs["Roughness"].default_value = 1
        bpy.context.object.data.materials.append(m)

    pictures = in_blender.Pictures(folder, 1024)
    pictures.lambertian = ["floor", "cube"]
    bpy.ops.mesh.primitive_plane_add(size=20)
    material("floor", (0.5, 0.5, 0.5))
    bpy.ops.mesh.primitive_cube_add(size=1, location=(0.5, 0.3, 0.5), rotation=(0, 0, 0.4))
    material("cube", (0.7, 0.3, 0.2))
    bpy.ops.object.light_add(type="AREA", location=(-1.5, -0.5, 2.5), rotation=(0.1, -0.5, 0.3))
    lamp = bpy.context.object
    lamp.data.shape, lamp.data.size, lamp.data.size_y, lamp.data.energy, lamp.data.color = "RECTANGLE", 1.2, 0.6, 100, (1, 0.9, 0.8)
    bpy.ops.object.light_add(type="AREA", location=(2, 1, 2), rotation=(0.3, 0.6, 0))
    lamp = bpy.context.object
    lamp.data.shape, lamp.data.size, lamp.data.energy, lamp.scale = "DISK", 0.8, 60, (1.5, 1.5, 1.5)
    bpy.ops.object.light_add(type="SUN", rotation=(0.3, 0.5, 0))
    bpy.context.object.data.angle, bpy.context.object.data.energy = 0.2, 0.7
    bpy.ops.object.camera_add(location=(0, -5, 4), rotation=(0.9, 0, 0))
    scene = pictures.scene
    scene.camera = bpy.context.object

    def render(engine):
        values = pictures.render(engine, WIDTH, HEIGHT)
        return [sum(values[4 * i:4 * i + 3]) for i in range(WIDTH * HEIGHT)]

    scene.steradian.aa = 16
    ours = render("STERADIAN")

    # Blender's own export now has the lights.
    path = os.path.join(folder, "export.glb")
    bpy.ops.export_scene.gltf(filepath=path, export_lights=True)
    with open(path, "rb") as file:
        data = file.read()
    gltf = json.loads(data[20:20 + struct.unpack_from("<I", data, 12)[0]])
    lights = gltf["extensions"]["EXT_lights_area"]["lights"]
    assert [(light["type"], round(light["intensity"], 4)) for light in lights] == [
        ("rect", round(100 / (4 * 1.2 * 0.6), 4)), ("disk", round(60 / (3.14159265 * (0.8 * 1.5) ** 2), 4))], lights

    def compare(ours, cycles, most):
        """Patches, since pixel filters differ at outlines, and the whole."""
        for top in range(0, HEIGHT, 12):
            for left in range(0, WIDTH, 16):
                at = [WIDTH * y + x for y in range(top, top + 12) for x in range(left, left + 16)]
                a, b = sum(ours[i] for i in at), sum(cycles[i] for i in at)
                print(f"TEST patch at {left}, {top}: {a / b:.4f} of Cycles")
                assert abs(a / b - 1) < 0.02, (left, top, a, b)
        ratio = sum(ours) / sum(cycles)
        print(f"TEST mean {ratio:.4f} of Cycles")
        assert abs(ratio - 1) < most

    compare(ours, render("CYCLES"), 0.01)

    # All light, the default of the engine. A wall beside the floor, so that bounces count.
    bpy.ops.mesh.primitive_plane_add(size=4, location=(1.6, 0.5, 1.5), rotation=(0, -1.4, 0))
    material("wall", (0.2, 0.6, 0.3))
    pictures.lambertian.append("wall")
    pictures.take_bounces(True)
    all_light = render("STERADIAN")
    compare(all_light, render("CYCLES"), 0.01)
    pictures.take_bounces(False)
    direct = sum(render("STERADIAN"))
    print(f"TEST the bounces are {1 - direct / sum(all_light):.3f} of the light")
    assert direct < 0.97 * sum(all_light)
    print("TEST done")


if __name__ == "__main__":
    in_blender.main(__file__, inside, False, 600)
