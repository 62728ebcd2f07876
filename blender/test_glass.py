"""Glass by the add-on in Blender itself: closed meshes are solids, as in Cycles, and open ones are thin walls.

    test_glass.py PROGRAM              runs Blender with the add-on in a folder of its own; exit 77 (skipped) where there is no Blender
    blender -b -P test_glass.py -- FOLDER    what it runs
"""
import json
import math
import os
import struct
import sys

sys.path.append(os.path.dirname(os.path.abspath(__file__)))
import in_blender  # noqa: E402

SIZE, IOR = 32, 1.6


def exported(path):
    """The JSON of a .glb."""
    with open(path, "rb") as file:
        data = file.read()
    return json.loads(data[20:20 + struct.unpack_from("<I", data, 12)[0]])


def inside(folder):
    import bpy

    def principled(name, **inputs):
        material = bpy.data.materials.new(name)
        material.use_nodes = True
        for key, value in inputs.items():
            material.node_tree.nodes["Principled BSDF"].inputs[key.replace("_", " ")].default_value = value
        return material

    pictures = in_blender.Pictures(folder, 256)
    scene = pictures.scene
    glass = principled("glass", Base_Color=(1, 1, 1, 1), Transmission=1, Roughness=0, IOR=IOR)
    opaque = principled("opaque")
    bpy.ops.mesh.primitive_uv_sphere_add(segments=64, ring_count=32, radius=1)
    ball = bpy.context.object
    bpy.ops.object.shade_smooth()
    ball.data.materials.append(glass)

    # Two walls behind the ball, one of them bright.
    for side, strength in ((-1, 1), (1, 0.1)):
        bpy.ops.mesh.primitive_plane_add(size=20, location=(10 * side, 6, 0), rotation=(math.pi / 2, 0, 0))
        wall = principled(f"wall {side}", Base_Color=(0, 0, 0, 1), Specular=0, Emission=(1, 1, 1, 1), Emission_Strength=strength)
        bpy.context.object.data.materials.append(wall)
    bpy.ops.object.camera_add(location=(0, -6, 0), rotation=(math.pi / 2, 0, 0))
    scene.camera = bpy.context.object
    scene.camera.data.lens = 100

    # The ball swaps left and right. Thin walls would not. The middle half of each side is free of the rim, where Cycles reflects light within.
    for all_light in (False, True):
        pictures.take_bounces(all_light)
        scene.cycles.max_bounces = scene.cycles.transmission_bounces = 8  # a ray passes two faces, whatever the light between surfaces
        halves = {}
        for engine in ("STERADIAN", "CYCLES"):
            pictures.bounces = 8 if engine == "CYCLES" else 0
            pixels = pictures.render(engine, SIZE, SIZE)
            rows = range(SIZE // 2 - 4, SIZE // 2 + 4)
            halves[engine] = [sum(pixels[4 * (SIZE * y + x)] for y in rows for x in range(x0, x0 + 4)) / 32 for x0 in (10, 18)]
            print(f"TEST {engine}, left {halves[engine][0]:.4f}, right {halves[engine][1]:.4f}", flush=True)
        ours, cycles = halves["STERADIAN"], halves["CYCLES"]
        assert ours[0] < 0.5 * ours[1], "the ball does not bend light"
        # The leaving face reflects this fraction within, and sends its square to the other side. Without bounces ours reflects none.
        reflected = ((IOR - 1) / (IOR + 1)) ** 2
        leaves = 1 if all_light else 1 - reflected
        for a, b in zip(ours, cycles):
            assert abs(a * leaves - b) < 2 * reflected**2 * max(cycles), (ours, cycles)

    # Green glass: a cube of two units absorbs in both engines what the law says. The halves are as bright as each other through a cube.
    nodes, links = glass.node_tree.nodes, glass.node_tree.links
    absorption = nodes.new("ShaderNodeVolumeAbsorption")
    absorption.inputs["Color"].default_value, absorption.inputs["Density"].default_value = (0.2, 0.8, 0.5, 1), 0.4
    bpy.ops.mesh.primitive_cube_add(size=2)
    block = bpy.context.object
    block.data.materials.append(glass)
    ball.hide_render = True
    means = {}
    for coloured in (False, True):
        if coloured:
            links.new(absorption.outputs["Volume"], nodes["Material Output"].inputs["Volume"])
        for engine in ("STERADIAN", "CYCLES"):
            pixels = pictures.render(engine, SIZE, SIZE)
            at = [4 * (SIZE * y + x) for y in range(SIZE // 2 - 4, SIZE // 2 + 4) for x in range(11, 14)]
            means[engine, coloured] = [sum(pixels[i + c] for i in at) for c in range(3)]
    for c, color in enumerate((0.2, 0.8, 0.5)):
        truth = math.exp(-0.4 * (1 - color) * 2)
        left = {engine: means[engine, True][c] / means[engine, False][c] for engine in ("STERADIAN", "CYCLES")}
        print(f"TEST channel {c}: {left['STERADIAN']:.4f} is left, in Cycles {left['CYCLES']:.4f}; by the law {truth:.4f}")
        # The rays are up to a hundredth longer than the cube is deep, beside its middle.
        assert abs(left["STERADIAN"] / truth - 1) < 0.01 and abs(left["STERADIAN"] / left["CYCLES"] - 1) < 0.02, left
    bpy.data.objects.remove(block)
    ball.hide_render = False

    # Blender's own export has the thickness as well. A pane, a ball of two materials and an instance of another scale share the glass.
    bpy.ops.mesh.primitive_plane_add(size=1)
    pane = bpy.context.object
    pane.name = pane.data.name = "pane"
    pane.data.materials.append(glass)
    bpy.ops.mesh.primitive_uv_sphere_add()
    half = bpy.context.object
    half.name = half.data.name = "half"
    half.data.materials.append(glass)
    half.data.materials.append(opaque)
    for face in half.data.polygons:
        face.material_index = int(face.center.z < 0)
    bpy.ops.mesh.primitive_cube_add(size=2)
    cube = bpy.context.object
    cube.name = cube.data.name = "cube"
    cube.data.materials.append(opaque)
    cube.data.materials.append(glass)
    for face in cube.data.polygons:
        face.material_index = 1
    path = os.path.join(folder, "export.glb")
    bpy.ops.export_scene.gltf(filepath=path)
    gltf = exported(path)
    thickness = {}
    for mesh in gltf["meshes"]:
        for primitive in mesh["primitives"]:
            material = gltf["materials"][primitive["material"]]
            if material["name"] == "glass":
                assert abs(material["extensions"]["KHR_materials_ior"]["ior"] - IOR) < 1e-6
                if "KHR_materials_volume" in material["extensions"]:
                    assert abs(material["extensions"]["KHR_materials_volume"]["attenuationDistance"] - 2.5) < 1e-5
                thickness[mesh["name"]] = material["extensions"].get("KHR_materials_volume", {}).get("thicknessFactor")
    print(f"TEST thickness {thickness}")
    assert thickness["pane"] is None and thickness["half"] is None, thickness
    assert abs(thickness["cube"] / (4 * 8 / 24) - 1) < 1e-3, thickness
    assert abs(thickness[ball.data.name] / (4 / 3) - 1) < 0.01, thickness  # the mesh is a little smaller than its ball
    assert "KHR_materials_volume" in gltf["extensionsUsed"], gltf["extensionsUsed"]
    print("TEST done")


if __name__ == "__main__":
    in_blender.main(__file__, inside, False, 600)
