"""The engine's export with a stub of Blender: its hook is called although the add-on is in no preferences. Says nothing of Blender itself."""

import importlib
import json
import struct
import sys
import tempfile
import types
from pathlib import Path

HERE = Path(__file__).resolve().parent


class AddOns(dict):
    """Blender's preferences.addons: entries by module."""

    def new(self):
        entry = types.SimpleNamespace(module="")
        self.entries = getattr(self, "entries", []) + [entry]
        return entry

    def remove(self, entry):
        self.entries.remove(entry)

    def keys(self):
        return [*super().keys(), *(e.module for e in getattr(self, "entries", []))]

    def __contains__(self, name):
        return name in self.keys()


def stub(addons, called):
    """Modules bpy, mathutils and io_scene_gltf2. The export calls the hooks of the add-ons in the preferences, as Blender's does."""
    bpy, mathutils = types.ModuleType("bpy"), types.ModuleType("mathutils")
    mathutils.Matrix = mathutils.Vector = lambda values: values

    def gltf(filepath, **options):
        hooks = [sys.modules[name].glTF2ExportUserExtension() for name in addons.keys() if hasattr(sys.modules.get(name), "glTF2ExportUserExtension")]
        called.append(hooks)
        text = json.dumps({"asset": {"version": "2.0"}, "scenes": [{"nodes": []}], "nodes": []}).encode()
        Path(filepath).write_bytes(struct.pack("<4sIIII", b"glTF", 2, 20 + len(text), len(text), 0x4E4F534A) + text)

    bpy.context = types.SimpleNamespace(window_manager=types.SimpleNamespace(windows=[]), preferences=types.SimpleNamespace(addons=addons))
    bpy.ops = types.SimpleNamespace(export_scene=types.SimpleNamespace(gltf=gltf))
    extensions = types.ModuleType("io_scene_gltf2.io.com.gltf2_io_extensions")
    extensions.ChildOfRootExtension = extensions.Extension = object
    sys.modules.update({"bpy": bpy, "mathutils": mathutils})
    for name in ("io_scene_gltf2", "io_scene_gltf2.io", "io_scene_gltf2.io.com"):
        sys.modules[name] = types.ModuleType(name)
    sys.modules["io_scene_gltf2.io.com.gltf2_io_extensions"] = extensions


def add_on():
    """The add-on's package with its export alone, as Blender names it."""
    package = types.ModuleType("steradian_render")
    package.__path__ = [str(HERE / "steradian")]
    sys.modules["steradian_render"] = package
    export = importlib.import_module("steradian_render.export")
    package.glTF2ExportUserExtension = export.Exporter
    return export


def main():
    addons, called = AddOns(), []
    stub(addons, called)
    export = add_on()
    with tempfile.TemporaryDirectory() as folder:
        export.export(folder + "/scene.glb")
        assert len(called[-1]) == 1, "the hook is handed to the exporter"
        assert addons.keys() == [], "the preferences are as before"
        addons["steradian_render"] = None
        export.export(folder + "/scene.glb")
        assert len(called[-1]) == 1, "an enabled add-on is not entered twice"
        assert addons.keys() == ["steradian_render"]
    print("the hook was called in both exports")


main()
