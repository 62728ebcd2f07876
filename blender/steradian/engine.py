"""The render engine: the scene goes to the program as glTF, the picture comes back as EXR."""

import contextlib
import os
import shutil
import subprocess
import tempfile
import threading
import time

import bpy


def program():
    """The path of `steradian`: of the add-on's preferences, of STERADIAN_PROGRAM, or of PATH."""
    preferences = bpy.context.preferences.addons.get(__package__)
    given = (preferences.preferences.program if preferences else "") or os.environ.get("STERADIAN_PROGRAM", "")
    return bpy.path.abspath(given) if given else shutil.which("steradian")


def in_main_thread(work):
    """Runs work() where operators may run: renders have a thread of their own, unless Blender has no window."""
    if bpy.app.background or threading.current_thread() is threading.main_thread():
        return work()
    done, result = threading.Event(), {}

    def run():
        try:
            result["value"] = work()
        except Exception as error:  # it is raised again below, in the render's thread
            result["error"] = error
        done.set()

    bpy.app.timers.register(run)
    done.wait()
    if "error" in result:
        raise result["error"]
    return result.get("value")


def export(path):
    """Writes what is rendered to a .glb. The exporter asks for an active object, which a render from a shell has only in a window."""
    windows = bpy.context.window_manager.windows
    with bpy.context.temp_override(window=windows[0]) if windows else contextlib.nullcontext():
        bpy.ops.export_scene.gltf(filepath=path, export_format="GLB", export_lights=True, export_cameras=True, use_renderable=True,
                                  export_animations=False, export_apply=True)


class Settings(bpy.types.PropertyGroup):
    """What the engine asks the program for."""

    method: bpy.props.EnumProperty(
        name="Method", description="How glossy light is computed", default="auto",
        items=[("auto", "Auto", "The most accurate in real time"), ("closed-form", "Closed form", "GGX in closed form"),
               ("ltc", "LTC", "Transformed cosines"), ("ltc-compact", "LTC, compact", "Transformed cosines by a table of 4 KB"),
               ("reference", "Reference", "Path tracing until it has converged")])
    shadows: bpy.props.EnumProperty(
        name="Shadows", default="on",
        items=[("on", "On", "Exact, by rays where there are very many edges"), ("exact", "Exact", "Never by rays"), ("off", "Off", "None")])
    indirect: bpy.props.EnumProperty(
        name="Bounce", default="off",
        items=[("off", "Off", "Direct light alone"), ("ltc", "Virtual lights", "One bounce"), ("path", "Paths", "One bounce, by sampling")])
    aa: bpy.props.IntProperty(name="Anti-aliasing", description="Primary samples a pixel: they smooth outlines", default=4, min=1, max=4096)


class Preferences(bpy.types.AddonPreferences):
    """Where the program is."""

    bl_idname = __package__
    program: bpy.props.StringProperty(name="Program", description="The path of steradian; empty: the one in PATH", subtype="FILE_PATH")

    def draw(self, context):
        """Shows them."""
        self.layout.prop(self, "program")


class SteradianEngine(bpy.types.RenderEngine):
    """Renders by the program."""

    bl_idname = "STERADIAN"
    bl_label = "Steradian"
    bl_use_preview = False
    bl_use_postprocess = True

    def render(self, depsgraph):
        """Exports, runs the program, and takes its picture. Escape ends the program."""
        path = program()
        if not path:
            self.error_set("the program steradian is not found: name it in the add-on's preferences")
            return
        scene = depsgraph.scene
        percentage = scene.render.resolution_percentage / 100
        width, height = int(scene.render.resolution_x * percentage), int(scene.render.resolution_y * percentage)
        with tempfile.TemporaryDirectory() as folder:
            glb, picture, log = (os.path.join(folder, name) for name in ("scene.glb", "picture.exr", "log"))
            self.update_stats("", "exporting")
            in_main_thread(lambda: export(glb))
            settings = scene.steradian
            command = [path, "render", glb, "-o", picture, "--size", f"{width}x{height}", "--method", settings.method, "--shadows",
                       settings.shadows, "--indirect", settings.indirect, "--aa", str(settings.aa), "--light", "none"]
            if not self.run(command, log):
                return
            result = self.begin_result(0, 0, width, height)
            result.layers[0].load_from_file(picture)
            self.end_result(result)

    def run(self, command, log):
        """True where the program came to its end."""
        begin = time.monotonic()
        with open(log, "w") as told:
            process = subprocess.Popen(command, stdout=told, stderr=subprocess.STDOUT)
            while process.poll() is None:
                if self.test_break():
                    process.terminate()
                    process.wait()
                    return False
                self.update_stats("", f"rendering, {time.monotonic() - begin:.0f} s")
                time.sleep(0.05)
        with open(log) as told:
            words = told.read().strip()
        if process.returncode != 0:
            self.error_set(words or f"the program ended with {process.returncode}")
            return False
        for line in words.splitlines():
            if line.startswith("warning:"):
                self.report({"WARNING"}, line[9:])
        return True


class SettingsPanel(bpy.types.Panel):
    """The settings in the render tab."""

    bl_idname = "RENDER_PT_steradian"
    bl_label = "Steradian"
    bl_space_type = "PROPERTIES"
    bl_region_type = "WINDOW"
    bl_context = "render"
    COMPAT_ENGINES = {"STERADIAN"}

    @classmethod
    def poll(cls, context):
        """Only for this engine."""
        return context.scene.render.engine == "STERADIAN"

    def draw(self, context):
        """A row a setting."""
        self.layout.use_property_split = True
        for name in ("method", "shadows", "indirect", "aa"):
            self.layout.prop(context.scene.steradian, name)


CLASSES = (Settings, Preferences, SteradianEngine, SettingsPanel)


def panels_of_others():
    """Blender's panels of cameras, lights and materials, which serve here, too."""
    for panel in bpy.types.Panel.__subclasses__():
        engines = getattr(panel, "COMPAT_ENGINES", ())
        if "BLENDER_RENDER" in engines and not panel.__module__.startswith(__package__):
            yield panel


def register():
    """Makes the engine known."""
    for c in CLASSES:
        bpy.utils.register_class(c)
    bpy.types.Scene.steradian = bpy.props.PointerProperty(type=Settings)
    for panel in panels_of_others():
        panel.COMPAT_ENGINES.add("STERADIAN")


def unregister():
    """Takes all of it away again."""
    for panel in panels_of_others():
        panel.COMPAT_ENGINES.discard("STERADIAN")
    del bpy.types.Scene.steradian
    for c in reversed(CLASSES):
        bpy.utils.unregister_class(c)
