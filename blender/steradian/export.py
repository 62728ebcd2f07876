"""Blender's glTF export: what hooks into it, and how the engine calls it."""

import contextlib

import bpy

from .lights import NodeLights
from .materials import Completion

_for_engine = False  # while the engine exports


class Exporter:
    """What Blender's exporter calls for each node and material."""

    def __init__(self):
        from io_scene_gltf2.io.com.gltf2_io_extensions import ChildOfRootExtension, Extension

        self.lights = NodeLights(Extension, ChildOfRootExtension, _for_engine)
        self.materials = Completion(Extension, _for_engine)

    def gather_node_hook(self, gltf2_node, blender_object, export_settings):
        """Puts the light on its node."""
        if getattr(blender_object, "type", "") == "LIGHT" and not blender_object.hide_render:
            self.lights.add(gltf2_node, blender_object)

    def gather_material_hook(self, gltf2_material, blender_material, export_settings):
        """Completes the material."""
        self.materials.add(gltf2_material, blender_material)


def export(path):
    """Writes what is rendered to a .glb. The exporter asks for an active object, which a render from a shell has only in a window."""
    global _for_engine
    windows = bpy.context.window_manager.windows
    _for_engine = True
    try:
        with bpy.context.temp_override(window=windows[0]) if windows else contextlib.nullcontext():
            bpy.ops.export_scene.gltf(filepath=path, export_format="GLB", export_lights=True, export_cameras=True, use_renderable=True,
                                      export_animations=False, export_apply=True, export_tangents=True,
                                      convert_lighting_mode="COMPAT")
    finally:
        _for_engine = False
