"""The add-on in Blender itself: its engine against Cycles, and its lights in an export.

    test_addon.py PROGRAM              runs Blender with the add-on in a folder of its own; exit 77 (skipped) where there is no Blender
    blender -b -P test_addon.py -- FOLDER    what it runs
"""
import json
import os
import struct
import sys

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

    def pixels(path):
        image = bpy.data.images.load(path)
        image.colorspace_settings.name = "Non-Color"
        values = list(image.pixels)
        assert tuple(image.size) == (WIDTH, HEIGHT), tuple(image.size)
        return [sum(values[4 * i:4 * i + 3]) for i in range(WIDTH * HEIGHT)]

    bpy.ops.preferences.addon_enable(module="io_scene_gltf2")
    bpy.ops.preferences.addon_enable(module="steradian_render")
    assert hasattr(bpy.context.scene, "steradian"), "the add-on is not enabled"
    bpy.ops.object.select_all(action="SELECT")
    bpy.ops.object.delete()
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
    bpy.ops.object.camera_add(location=(0, -5, 4), rotation=(0.9, 0, 0))
    scene = bpy.context.scene
    scene.camera = bpy.context.object
    scene.world.use_nodes = True
    scene.world.node_tree.nodes["Background"].inputs["Strength"].default_value = 0
    scene.render.resolution_x, scene.render.resolution_y, scene.render.resolution_percentage = WIDTH, HEIGHT, 100
    scene.render.image_settings.file_format, scene.render.image_settings.color_depth = "OPEN_EXR", "32"
    scene.view_settings.view_transform = "Raw"

    def render(engine):
        scene.render.engine = engine
        scene.render.filepath = os.path.join(folder, engine + ".exr")
        bpy.ops.render.render(write_still=True)
        return pixels(scene.render.filepath)

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

    # glTF's diffuse lobe is Lambert's, Principled's is Disney's: Cycles gets Lambert's, too.
    for m in bpy.data.materials:
        if m.use_nodes and "Principled BSDF" in m.node_tree.nodes:
            diffuse = m.node_tree.nodes.new("ShaderNodeBsdfDiffuse")
            diffuse.inputs["Color"].default_value = m.node_tree.nodes["Principled BSDF"].inputs["Base Color"].default_value
            m.node_tree.links.new(diffuse.outputs["BSDF"], m.node_tree.nodes["Material Output"].inputs["Surface"])
    scene.cycles.samples, scene.cycles.use_denoising, scene.cycles.max_bounces, scene.cycles.seed = 1024, False, 0, 1
    for light in bpy.data.lights:
        light.cycles.max_bounces = 0
    cycles = render("CYCLES")

    patches = 0
    for top in range(0, HEIGHT, 12):
        for left in range(0, WIDTH, 16):
            at = [WIDTH * y + x for y in range(top, top + 12) for x in range(left, left + 16)]
            a, b = sum(ours[i] for i in at), sum(cycles[i] for i in at)
            print(f"TEST patch at {left}, {top}: {a / b:.4f} of Cycles")
            assert abs(a / b - 1) < 0.02, (left, top, a, b)  # pixel filters differ at outlines
            patches += 1
    ratio = sum(ours) / sum(cycles)
    print(f"TEST {patches} patches, mean {ratio:.4f} of Cycles")
    assert abs(ratio - 1) < 0.01
    print("TEST done")


if __name__ == "__main__":
    if "--" in sys.argv:
        inside(sys.argv[sys.argv.index("--") + 1])
    else:
        import in_blender

        in_blender.run(__file__, sys.argv[1], False, 600)
