"""Principled materials and every kind of light by the add-on's engine, against Cycles: direct light, the mean of each patch.

    test_against_cycles.py PROGRAM              runs Blender; exit 77 (skipped) where there is none
    blender -b -P test_against_cycles.py -- FOLDER    what it runs
"""
import math
import os
import sys

sys.path.append(os.path.dirname(os.path.abspath(__file__)))
import in_blender  # noqa: E402

TILE = 16  # pixels a side
COLUMNS, ROWS = 4, 3
MOST = 0.01  # that a patch may be off

# The inputs that differ from a new Principled BSDF; the base colour of all is the same.
MATERIALS = {
    "diffuse": {"Specular": 0},
    "dielectric": {"Specular": 0.5, "Roughness": 0.5},
    "metal": {"Metallic": 1, "Roughness": 0.4},
    "polished metal": {"Metallic": 1, "Roughness": 0.25},
    "brushed metal": {"Metallic": 1, "Roughness": 0.4, "Anisotropic": 0.7},
    "brushed, turned": {"Metallic": 1, "Roughness": 0.4, "Anisotropic": 0.7, "Anisotropic Rotation": 0.15},
    "coated": {"Specular": 0, "Clearcoat": 1, "Clearcoat Roughness": 0.3},
    "sheen": {"Specular": 0, "Sheen": 1},
    "texture": {"Specular": 0},
    "normal map": {"Metallic": 1, "Roughness": 0.5},
    "roughness map": {"Metallic": 1},
    "half a metal": {"Metallic": 0.5, "Roughness": 0.5, "Specular": 0.2},
}


class Comparison(in_blender.Pictures):
    """The two engines, patch by patch."""

    def __init__(self, folder):
        super().__init__(folder, 512)
        self.scene.steradian.aa = 1  # the middles of pixels, here and there
        self.scene.cycles.pixel_filter_type, self.scene.cycles.filter_width = "BOX", 0.01

    def compare(self, columns, rows, name_of, least_is_mean=False):
        """Ratio of both in each tile, without its rim."""
        width = columns * TILE
        ours, cycles = (self.render(engine, width, rows * TILE) for engine in ("STERADIAN", "CYCLES"))
        patches = {}
        for row in range(rows):
            for column in range(columns):
                at = [4 * (width * (TILE * row + y) + TILE * column + x) + c for y in range(3, TILE - 3) for x in range(3, TILE - 3) for c in range(3)]
                a, b = sum(ours[i] for i in at), sum(cycles[i] for i in at)
                print(f"TEST {name_of(column, rows - 1 - row)}: {a / b:.4f} of Cycles", flush=True)
                patches[row, column] = a, b
        # Relative to the pixel, or to the picture's mean where the pixel is darker: a spot's rim differs by a sixth of nearly nothing.
        mean = sum(b for _, b in patches.values()) / len(patches)
        return max(abs(a - b) / max(b, mean if least_is_mean else 0) for a, b in patches.values())

    def area_light(self, shape, location, rotation, size, size_y, energy):
        """A new one."""
        self.bpy.ops.object.light_add(type="AREA", location=location, rotation=rotation)
        light = self.bpy.context.object.data
        light.shape, light.size, light.size_y, light.energy = shape, size, size_y, energy
        return self.bpy.context.object

    def camera_above(self, height, width):
        """Looks straight down on so much of the floor."""
        self.bpy.ops.object.camera_add(location=(0, 0, height))
        camera = self.bpy.context.object
        camera.data.sensor_width, camera.data.lens = 36, 36 * height / width
        self.scene.camera = camera

    def add_material(self, name, values):
        """To the active object."""
        material = self.bpy.data.materials.new(name)
        material.use_nodes = True
        tree, shader = material.node_tree, material.node_tree.nodes["Principled BSDF"]
        shader.inputs["Base Color"].default_value = (0.7, 0.5, 0.3, 1)
        for key, value in values.items():
            shader.inputs[key].default_value = value
        self.bpy.context.object.data.materials.append(material)

        def texture(values_at, is_color=False):
            image = self.bpy.data.images.new(name, 32, 32)
            if not is_color:
                image.colorspace_settings.name = "Non-Color"
            image.pixels[:] = [c for y in range(32) for x in range(32) for c in (*values_at(x / 31, y / 31), 1)]
            image.pack()
            node = tree.nodes.new("ShaderNodeTexImage")
            node.image = image
            return node.outputs["Color"]

        def through(kind, output, **properties):
            node = tree.nodes.new(kind)
            for key, value in properties.items():
                setattr(node, key, value)
            if output is not None:
                tree.links.new(output, node.inputs["Color"])
            return node

        if name.startswith("brushed"):  # Blender's own tangent goes around z, glTF's along the texture
            tree.links.new(through("ShaderNodeTangent", None, direction_type="UV_MAP").outputs[0], shader.inputs["Tangent"])
        if name == "texture":
            tree.links.new(texture(lambda u, v: (0.3 + 0.5 * u, 0.3 + 0.5 * v, 0.5), True), shader.inputs["Base Color"])
        if name == "normal map":
            bumps = texture(lambda u, v: (0.5 + 0.1 * math.sin(6 * u), 0.5 + 0.1 * math.cos(5 * v), 0.98))
            tree.links.new(through("ShaderNodeNormalMap", bumps).outputs[0], shader.inputs["Normal"])
        if name == "roughness map":
            tree.links.new(through("ShaderNodeSeparateColor", texture(lambda u, v: (0, 0.3 + 0.4 * u, 1))).outputs[1], shader.inputs["Roughness"])


def materials(c):
    """A tile of the floor each, under a panel that no mirrored view misses by far."""
    names = list(MATERIALS)
    for k, name in enumerate(names):
        c.bpy.ops.mesh.primitive_plane_add(size=1, location=(k % COLUMNS - COLUMNS / 2 + 0.5, ROWS / 2 - 0.5 - k // COLUMNS, 0))
        c.add_material(name, MATERIALS[name])
    lamp = c.area_light("RECTANGLE", (0.3, 2.4, 2.6), (-0.7, 0.1, 0), 2.5, 1.2, 80)
    c.camera_above(6, COLUMNS)
    worst = c.compare(COLUMNS, ROWS, lambda column, row: names[COLUMNS * row + column])
    c.bpy.data.objects.remove(lamp)
    for thing in [o for o in c.bpy.data.objects if o.type == "MESH"]:
        c.bpy.data.objects.remove(thing)
    return worst


def lights(c):
    """Each alone over a floor that is Lambert's."""
    c.bpy.ops.mesh.primitive_plane_add(size=8, location=(0, 0, 0))
    c.add_material("floor", {"Specular": 0})
    c.lambertian = ["floor"]
    c.camera_above(6, COLUMNS)
    ellipse = c.area_light("ELLIPSE", (0.4, 0.2, 1.5), (0.3, 0.2, 0.5), 1.4, 0.5, 50)
    kinds = [("ellipse", ellipse)]
    square = c.area_light("SQUARE", (0.4, 0.2, 1.5), (0.3, 0.2, 0.5), 0.6, 1, 50)
    square.scale = (2, 0.5, 1)
    kinds.append(("square, scaled unevenly", square))
    for kind, shape in (("narrow rectangle", "RECTANGLE"), ("narrow disk", "DISK")):
        lamp = c.area_light(shape, (0.4, 0.2, 1.5), (0.3, 0.2, 0.5), 0.6, 0.3, 50)
        lamp.data.spread = math.radians(70 if shape == "DISK" else 130)
        kinds.append((kind, lamp))
    for name, kind, values in (("point", "POINT", {"shadow_soft_size": 0.1}), ("spot", "SPOT", {"spot_size": 1.6, "spot_blend": 0.4, "shadow_soft_size": 0}),
                               ("wide spot", "SPOT", {"spot_size": 1.6, "spot_blend": 0.4, "shadow_soft_size": 0.15}), ("sun", "SUN", {"angle": 0}),
                               ("hazy sun", "SUN", {"angle": math.radians(20)})):
        c.bpy.ops.object.light_add(type=kind, location=(0.4, 0.2, 1.5), rotation=(0.3, 0.2, 0))
        lamp = c.bpy.context.object
        lamp.data.energy = 1 if kind == "SUN" else 50
        for key, value in values.items():
            setattr(lamp.data, key, value)
        kinds.append((name, lamp))
    c.bpy.ops.mesh.primitive_plane_add(size=0.8, location=(0.4, 0.2, 1.5), rotation=(math.pi + 0.3, 0.2, 0))
    glow = c.bpy.data.materials.new("glow")
    glow.use_nodes, glow.use_backface_culling = True, False
    shader = glow.node_tree.nodes["Principled BSDF"]
    shader.inputs["Base Color"].default_value = (0, 0, 0, 1)
    shader.inputs["Specular"].default_value = 0
    shader.inputs["Emission"].default_value, shader.inputs["Emission Strength"].default_value = (1, 0.8, 0.6, 1), 200
    mesh = c.bpy.context.object
    mesh.data.materials.append(glow)
    mesh.location = (0.4, 0.2, 7)  # behind the camera
    kinds.append(("mesh that glows", mesh))
    worst = 0
    for name, thing in kinds:
        for _, other in kinds:
            other.hide_render = other is not thing
        worst = max(worst, c.compare(2, 2, lambda column, row: f"{name}, {column} {row}", True))
    return worst


def worlds(c):
    """A pyramid's four sides below a world of one colour, and below pictures of different directions: nothing hides the world there, which would
    cast no shadow here."""
    bpy, tree = c.bpy, c.scene.world.node_tree
    for thing in list(bpy.data.objects):
        bpy.data.objects.remove(thing)
    bpy.ops.mesh.primitive_cone_add(vertices=4, radius1=4, depth=4)
    c.add_material("pyramid", {"Specular": 0})
    c.lambertian = ["pyramid"]
    c.camera_above(20, 4)
    color, strength = c.background.inputs["Color"], c.background.inputs["Strength"]
    color.default_value, strength.default_value = (0.2, 0.5, 0.9, 1), 0.7
    worst = c.compare(2, 2, lambda column, row: f"world of one colour, {column} {row}")
    turn = tree.nodes.new("ShaderNodeMapping")
    tree.links.new(tree.nodes.new("ShaderNodeTexCoord").outputs["Generated"], turn.inputs["Vector"])
    for name, is_float, rotation in (("a picture's", True, (0, 0, 0)), ("a picture's of 8 bits", False, (0, 0, 0)), ("a turned picture's", True, (0.4, -0.3, 1.1))):
        image = bpy.data.images.new(name, 64, 32, float_buffer=is_float)
        at = lambda x, y: (0.5 + 0.4 * math.sin(6.2832 * x / 64), 0.3 + 0.2 * math.cos(6.2832 * x / 64) * math.sin(3.1416 * y / 32), y / 31)
        image.pixels[:] = [value for y in range(32) for x in range(64) for value in (*at(x + 0.5, y), 1)]
        image.pack()
        node = tree.nodes.new("ShaderNodeTexEnvironment")
        node.image = image
        turn.inputs["Rotation"].default_value = rotation
        tree.links.new(turn.outputs[0], node.inputs["Vector"])
        tree.links.new(node.outputs["Color"], color)
        worst = max(worst, c.compare(2, 2, lambda column, row: f"world of {name}, {column} {row}"))
    return worst


def inside(folder):
    """All of it."""
    c = Comparison(folder)
    of_materials, of_lights, of_worlds = materials(c), lights(c), worlds(c)
    print(f"TEST farthest: materials {of_materials:.4f}, lights {of_lights:.4f}, worlds {of_worlds:.4f}")
    assert max(of_materials, of_lights, of_worlds) < MOST
    print("TEST done")


if __name__ == "__main__":
    in_blender.main(__file__, inside, False, 1200)
