"""Blender's world as an environment of the program: a map of directions in OpenEXR."""

import mathutils
import numpy

from . import pictures


def write(world, path):
    """The world's light as a map; False where it has none."""
    if world is None:
        return False
    picture = picture_of(world)
    if not picture.any():
        return False
    pictures.write_exr(path, picture)
    return True


def picture_of(world):
    """An array of (height, width, 3) as the program has it: above at the top, Blender's +y in the middle, +x right of it."""
    if not world.use_nodes:
        return even(world.color)
    output = world.node_tree.get_output_node("CYCLES")
    surface = output.inputs["Surface"] if output else None
    if surface is None or not surface.is_linked:
        return even((0, 0, 0))
    node = surface.links[0].from_node
    if node.type != "BACKGROUND":
        say(world, f"{node.name} is not read, only a Background is: it is black")
        return even((0, 0, 0))
    if node.inputs["Strength"].is_linked:
        say(world, "its strength is no number; the one below the link is taken")
    strength, color = node.inputs["Strength"].default_value, node.inputs["Color"]
    texture = color.links[0].from_node if color.is_linked else None
    if texture is not None and texture.type == "TEX_ENVIRONMENT" and texture.image is not None and texture.projection == "EQUIRECTANGULAR":
        return turned(values_of(texture.image), turn_of(world, texture)) * strength
    if texture is not None:
        say(world, f"{texture.name} is not read, only an equirectangular Environment Texture is; the colour below the link is taken")
    return even(color.default_value[:3]) * strength


def say(world, what):
    """On Blender's console."""
    print(f"steradian: world {world.name}: {what}")


def even(color):
    """The same radiance from everywhere."""
    return numpy.tile(numpy.array(color, numpy.float32), (8, 16, 1))


def values_of(image):
    """Linear colours from the top. Pixels of 8 bits are as they are stored."""
    width, height = image.size
    values = numpy.empty(width * height * 4, numpy.float32)
    image.pixels.foreach_get(values)
    values = values.reshape(height, width, 4)[::-1, :, :3]
    if not image.is_float and image.colorspace_settings.name == "sRGB":
        values = numpy.where(values <= 0.04045, values / 12.92, ((values + 0.055) / 1.055) ** 2.4)
    return values


def turn_of(world, texture):
    """What a Mapping node does to directions before they are looked up."""
    vector = texture.inputs["Vector"]
    node = vector.links[0].from_node if vector.is_linked else None
    if node is not None and node.type == "MAPPING":
        turn = mathutils.Euler(node.inputs["Rotation"].default_value).to_matrix()
        if node.vector_type == "TEXTURE":
            turn.invert()
        elif node.vector_type == "NORMAL":
            say(world, "a Mapping of normals is read as one of points")
        if tuple(node.inputs["Scale"].default_value) != (1, 1, 1):
            say(world, "its Mapping's scale is not read")
        return numpy.array(turn)
    if node is not None and node.type != "TEX_COORD":
        say(world, f"{node.name} before its texture is not read")
    return numpy.identity(3)


def turned(values, turn):
    """Blender's map, whose middle is +x and whose right is -y, as the program's: between its texels linearly, and at them exactly."""
    height, width, _ = values.shape
    right = 2 * numpy.pi * ((numpy.arange(width) + 0.5) / width - 0.5)  # from +y towards +x
    up = numpy.pi * (0.5 - (numpy.arange(height) + 0.5) / height)
    right, up = numpy.meshgrid(right, up)
    d = numpy.stack([numpy.sin(right) * numpy.cos(up), numpy.cos(right) * numpy.cos(up), numpy.sin(up)], -1) @ turn.T
    x = width * (0.5 - numpy.arctan2(d[..., 1], d[..., 0]) / (2 * numpy.pi)) - 0.5
    y = height * (0.5 - numpy.arctan2(d[..., 2], numpy.hypot(d[..., 0], d[..., 1])) / numpy.pi) - 0.5
    i, j = numpy.floor(x + 1e-6).astype(int), numpy.floor(y + 1e-6).astype(int)
    fx, fy = numpy.maximum(x - i, 0)[..., None], numpy.maximum(y - j, 0)[..., None]
    at = lambda i, j: values[numpy.clip(j, 0, height - 1), i % width]
    return (at(i, j) * (1 - fx) + at(i + 1, j) * fx) * (1 - fy) + (at(i, j + 1) * (1 - fx) + at(i + 1, j + 1) * fx) * fy
