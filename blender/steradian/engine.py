"""The render engine: the scene goes to the program as glTF, the picture comes back as EXR."""

import os
import signal
import sys
import tempfile
import threading
import time

import bpy

from . import pictures, program, world
from .bake import BakeOperator
from .export import export
from .viewport import Viewport


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


class Settings(bpy.types.PropertyGroup):
    """What the engine asks the program for."""

    method: bpy.props.EnumProperty(
        name="Method", description="How glossy light is computed", default="auto",
        items=[("auto", "Auto", "The most accurate in real time"), ("closed-form", "Closed form", "GGX in closed form"),
               ("ltc", "LTC", "Transformed cosines"), ("ltc-compact", "LTC, compact", "Transformed cosines by a table of 4 KB"),
               ("reference", "Reference", "Path tracing until it has converged")])
    quality: bpy.props.EnumProperty(
        name="Quality", description="Accuracy of the method, and of the light between surfaces", default="normal",
        items=[("draft", "Draft", "Faster"), ("normal", "Normal", "The default"), ("high", "High", "Slower and more accurate")])
    shadows: bpy.props.EnumProperty(
        name="Shadows", default="on",
        items=[("on", "On", "Exact, by rays where there are very many edges"), ("exact", "Exact", "Never by rays"), ("off", "Off", "None")])
    terminator: bpy.props.EnumProperty(
        name="Terminator", description="The edge of a curved mesh's shadow on itself", default="smooth",
        items=[("smooth", "Smooth", "As the curved surface of the normals"), ("strict", "Strict", "As the triangles stand")])
    environment: bpy.props.EnumProperty(
        name="Environment", description="Light from all around", default="world",
        items=[("world", "World", "Blender's world"), ("sky", "Sky", "The program's clear sky"), ("white", "White", "Radiance 1 from everywhere"),
               ("none", "None", "Black")])
    indirect: bpy.props.EnumProperty(
        name="Light", description="Light that surfaces send to each other", default="all",
        items=[("all", "All light", "Every bounce, without noise"), ("off", "Direct", "Direct light alone"),
               ("ltc", "Virtual lights", "One bounce"), ("path", "Paths", "One bounce, by sampling")])
    aa: bpy.props.IntProperty(name="Anti-aliasing", description="Primary samples a pixel: they smooth outlines", default=4, min=1, max=4096)
    viewport_pixel: bpy.props.IntProperty(name="Viewport pixel", description="Pixels of the screen a side for one of the viewport's render",
                                          default=2, min=1, max=16)


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
        if not program.path():
            self.fail("the program steradian is not found: name it in the add-on's preferences")
            return
        scene = depsgraph.scene
        percentage = scene.render.resolution_percentage / 100
        width, height = int(scene.render.resolution_x * percentage), int(scene.render.resolution_y * percentage)
        with tempfile.TemporaryDirectory() as folder:
            glb, picture, around = (os.path.join(folder, name) for name in ("scene.glb", "picture.exr", "world.exr"))
            self.update_stats("", "exporting")
            in_main_thread(lambda: export(glb))
            settings = scene.steradian
            if settings.environment != "world" or not world.write(scene.world, around):
                around = None
            if not self.run(program.render_command(glb, picture, width, height, settings, settings.aa, around)):
                return
            # Blender reads no file with more layers, such as those of all light.
            pictures.write_exr(picture, pictures.read_exr(picture))
            result = self.begin_result(0, 0, width, height)
            result.layers[0].load_from_file(picture)
            self.end_result(result)

    def fail(self, message):
        """In the window, and on the console. A Blender without a window takes it as Ctrl-C: it writes no picture, and ends with 1."""
        print(f"steradian: error: {message.removeprefix('steradian: ')}", file=sys.stderr, flush=True)
        self.error_set(message)
        if bpy.app.background:
            signal.raise_signal(signal.SIGINT)

    def run(self, command):
        """True where the program came to its end."""
        try:
            run = program.Run(command)
        except OSError as error:
            self.fail(f"{command[0]}: {error.strerror} (name the program in the add-on's preferences, or in STERADIAN_PROGRAM)")
            return False
        telling = program.Telling(time.monotonic())
        while run.is_running():
            if self.test_break():
                run.stop()
                return False
            share = run.share_done()
            line = telling.line(time.monotonic(), share)
            if line is not None:
                self.update_stats("", line)
            if share is not None:
                self.update_progress(share)
            time.sleep(0.05)
        run.close()
        if run.process.returncode != 0:
            self.fail("\n".join(run.lines()) or f"the program ended with {run.process.returncode}")
            return False
        for line in run.lines():
            if line.startswith("warning:"):
                self.report({"WARNING"}, line[9:])
        return True

    def view_update(self, context, depsgraph):
        """The scene has changed, or the viewport is new."""
        if getattr(self, "viewport", None) is None:
            self.viewport = Viewport(self)
        self.viewport.scene_has_changed()

    def view_draw(self, context, depsgraph):
        """Draws the last picture, and asks for the one of this view."""
        region = context.region
        self.viewport.look(context.region_data.view_matrix, context.region_data.window_matrix, region.width, region.height)
        self.viewport.draw(self, depsgraph.scene, region.width, region.height)

    def __del__(self):
        """The viewport is closed, or shows something else."""
        try:
            viewport = getattr(self, "viewport", None)
        except ReferenceError:  # Blender was first; the timer finds that out, too
            return
        if viewport is not None:
            viewport.free()


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
        """A row a setting. The tone curve and the exposure are Blender's, since the picture comes back linear."""
        self.layout.use_property_split = True
        for name in ("method", "quality", "shadows", "terminator", "environment", "indirect", "aa", "viewport_pixel"):
            self.layout.prop(context.scene.steradian, name)
        for name in ("view_transform", "exposure"):
            self.layout.prop(context.scene.view_settings, name)
        self.layout.operator(BakeOperator.bl_idname)


CLASSES = (Settings, Preferences, SteradianEngine, BakeOperator, SettingsPanel)


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
