"""The button that bakes: the scene goes to the program as glTF, and comes back as a file with a light map."""

import os
import tempfile
import time

import bpy

from . import program, world
from .export import export


class BakeOperator(bpy.types.Operator):
    """Bake the light of the scene into a glTF file with a light map"""

    bl_idname = "steradian.bake"
    bl_label = "Bake Light Map"

    filepath: bpy.props.StringProperty(name="File", description="The baked scene; the map stands beside it as .exr", subtype="FILE_PATH",
                                       default="//baked.glb")
    texels: bpy.props.FloatProperty(name="Texels a metre", default=16, min=0.001, max=10000)
    bounces: bpy.props.StringProperty(name="Bounces", description="Number of bounces, or all", default="all")
    target: bpy.props.EnumProperty(
        name="Target", default="texture",
        items=[("texture", "Texture", "A light map"), ("vertex", "Vertices", "Light at the vertices")])

    def invoke(self, context, event):
        """Asks for the file."""
        context.window_manager.fileselect_add(self)
        return {"RUNNING_MODAL"}

    def execute(self, context):
        """Exports, and starts the program."""
        if not program.path():
            self.report({"ERROR"}, "the program steradian is not found: name it in the add-on's preferences")
            return {"CANCELLED"}
        self.folder = tempfile.TemporaryDirectory()
        glb, around = (os.path.join(self.folder.name, name) for name in ("scene.glb", "world.exr"))
        export(glb)
        settings = context.scene.steradian
        if settings.environment != "world" or not world.write(context.scene.world, around):
            around = None
        output = bpy.path.abspath(self.filepath)
        if not output.endswith((".glb", ".gltf")):
            output += ".glb"
        self.run = program.Run(program.bake_command(glb, output, settings, self.texels, self.bounces, self.target, around))
        self.telling = program.Telling(time.monotonic(), "baking")
        if bpy.app.background:  # no window sends events
            while self.run.is_running():
                time.sleep(0.05)
            return self.ended(context)
        manager = context.window_manager
        manager.progress_begin(0, 1)
        self.timer = manager.event_timer_add(0.2, window=context.window)
        manager.modal_handler_add(self)
        return {"RUNNING_MODAL"}

    def modal(self, context, event):
        """Tells the progress. Escape ends the program."""
        if event.type == "ESC":
            self.run.stop()
            self.folder.cleanup()
            self.tidy(context)
            self.report({"INFO"}, "baking was stopped; no file was written")
            return {"CANCELLED"}
        if event.type != "TIMER":
            return {"PASS_THROUGH"}
        if not self.run.is_running():
            self.tidy(context)
            return self.ended(context)
        share = self.run.share_done()
        if share is not None:
            context.window_manager.progress_update(share)
        line = self.telling.line(time.monotonic(), share)
        if line is not None:
            context.workspace.status_text_set(line)
        return {"RUNNING_MODAL"}

    def tidy(self, context):
        """Takes the timer and the progress away."""
        context.window_manager.event_timer_remove(self.timer)
        context.window_manager.progress_end()
        context.workspace.status_text_set(None)

    def ended(self, context):
        """Tells what the program said."""
        self.run.close()
        self.folder.cleanup()
        lines = self.run.lines()
        if self.run.process.returncode != 0:
            self.report({"ERROR"}, "\n".join(lines) or f"the program ended with {self.run.process.returncode}")
            return {"CANCELLED"}
        for line in lines:
            if line.startswith("warning:"):
                self.report({"WARNING"}, line[9:])
        self.report({"INFO"}, f"the light map is in {self.filepath}")
        return {"FINISHED"}
