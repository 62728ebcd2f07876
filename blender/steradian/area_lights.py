"""Area lights in Blender's glTF export, which leaves them out: EXT_lights_area, by the exporter's hooks.

An area light of power P [W] and area A shines with the radiance P / (4 A) in Blender, whatever its shape (docs/lights.md).
"""

EXTENSION = "EXT_lights_area"


def definition_of(light, scale):
    """The extension's light, in the units of a node with this scale; None where it has no area."""
    width = light.size
    height = light.size_y if light.shape in ("RECTANGLE", "ELLIPSE") else light.size
    kind = "disk" if light.shape in ("DISK", "ELLIPSE") else "rect"
    area = abs(width * scale[0] * height * scale[1]) * (3.14159265358979324 / 4 if kind == "disk" else 1)
    if area == 0:
        return None
    if kind == "disk" and width != height:
        return None  # a node of its own scale is asked for: see examples/blender/export_with_area_lights.py
    definition = {"name": light.name, "type": kind, "color": list(light.color), "size": height, "intensity": light.energy / (4 * area)}
    if kind == "rect":
        definition["rect"] = {"aspect": width / height}
    return definition


class Exporter:
    """What Blender's exporter calls for each node and material."""

    def __init__(self):
        from io_scene_gltf2.io.com.gltf2_io_extensions import ChildOfRootExtension, Extension

        self.extension, self.child_of_root = Extension, ChildOfRootExtension

    def gather_node_hook(self, gltf2_node, blender_object, export_settings):
        """Puts the light on its node."""
        light = getattr(blender_object, "data", None)
        if getattr(blender_object, "type", "") != "LIGHT" or light.type != "AREA" or blender_object.hide_render:
            return
        definition = definition_of(light, blender_object.matrix_world.to_scale())
        if definition is None:
            print(f"steradian: {blender_object.name}: an ellipse or a light without area is not exported")
            return
        root = self.child_of_root(path=["lights"], name=EXTENSION, extension=definition, required=False)
        if gltf2_node.extensions is None:
            gltf2_node.extensions = {}
        gltf2_node.extensions[EXTENSION] = self.extension(name=EXTENSION, extension={"light": root}, required=False)

    def gather_material_hook(self, gltf2_material, blender_material, export_settings):
        """Blender's Specular 0 is no reflection at all; its exporter leaves the one at grazing angles."""
        specular = (gltf2_material.extensions or {}).get("KHR_materials_specular")
        if specular is not None and list(specular.extension.get("specularColorFactor", [1])) == [0, 0, 0]:
            specular.extension["specularFactor"] = 0
