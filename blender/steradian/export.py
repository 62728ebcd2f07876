"""Blender's glTF export: what hooks into it, and how the engine calls it."""

import contextlib

import bpy
import mathutils

from .glb import edit
from .lights import NodeLights, finish
from .materials import Completion
from .solids import Solids

# Blender's world (z up) to glTF's (y up).
TO_GLTF = mathutils.Matrix(((1, 0, 0, 0), (0, 0, 1, 0), (0, -1, 0, 0), (0, 0, 0, 1)))


class EngineExport:
    """What an export of the engine gathers besides its nodes."""

    def __init__(self):
        self.added = []  # lights with a place in Blender's world

    def extent(self):
        """The middle of what is rendered, and how far it reaches from there."""
        corners = [o.matrix_world @ mathutils.Vector(c) for o in bpy.context.scene.objects if not o.hide_render and o.type != "LIGHT" for c in o.bound_box]
        if not corners:
            return mathutils.Vector((0, 0, 0)), 1.0
        low, high = ([f(c[k] for c in corners) for k in range(3)] for f in (min, max))
        low, high = mathutils.Vector(low), mathutils.Vector(high)
        return (low + high) / 2, (high - low).length / 2


_engine = None  # while the engine exports


class Exporter:
    """What Blender's exporter calls for each node, mesh and material."""

    def __init__(self):
        from io_scene_gltf2.io.com.gltf2_io_extensions import ChildOfRootExtension, Extension

        self.lights = NodeLights(Extension, ChildOfRootExtension, _engine)
        self.materials = Completion(Extension, _engine is not None)
        self.solids = Solids(Extension)

    def gather_node_hook(self, gltf2_node, blender_object, export_settings):
        """Puts the light on its node."""
        if getattr(blender_object, "type", "") == "LIGHT" and not blender_object.hide_render:
            self.lights.add(gltf2_node, blender_object)

    def gather_material_hook(self, gltf2_material, blender_material, export_settings):
        """Completes the material."""
        self.materials.add(gltf2_material, blender_material)
        self.solids.remember(gltf2_material, blender_material)

    def gather_mesh_hook(self, gltf2_mesh, blender_mesh, blender_object, vertex_groups, modifiers, skip_filter, materials, export_settings):
        """Makes closed meshes of glass solids."""
        self.solids.add(gltf2_mesh, blender_mesh, materials)


@contextlib.contextmanager
def among_enabled():
    """While it lasts, the add-on is among the preferences' add-ons. Blender's exporter looks for hooks there, and `--addons` does not enter it."""
    addons = bpy.context.preferences.addons
    if __package__ in addons:
        yield
        return
    entry = addons.new()
    entry.module = __package__
    try:
        yield
    finally:
        addons.remove(entry)


def export(path):
    """Writes what is rendered to a .glb. The exporter asks for an active object, which a render from a shell has only in a window."""
    global _engine
    windows = bpy.context.window_manager.windows
    _engine = gathered = EngineExport()
    try:
        with among_enabled(), bpy.context.temp_override(window=windows[0]) if windows else contextlib.nullcontext():
            bpy.ops.export_scene.gltf(filepath=path, export_format="GLB", export_lights=True, export_cameras=True, use_renderable=True,
                                      export_animations=False, export_apply=True, export_tangents=True,
                                      convert_lighting_mode="COMPAT")
    finally:
        _engine = None
    with open(path, "rb") as file:
        data = edit(file.read(), lambda gltf: finish(gltf, gathered.added, TO_GLTF))
    with open(path, "wb") as file:
        file.write(data)
