"""The viewport's render: the scene is exported when it changes, the program renders it as the viewport looks at it, and the picture is drawn.

Coarse and with direct light at first, and once more at the size and with the light of the settings while nothing moves. Everything runs in Blender's main thread, by a timer; only the
program runs beside it.
"""

import math
import os
import tempfile
import time

import bpy
import mathutils

from . import pictures, program, world
from .export import TO_GLTF, export
from .glb import edit

INTERVAL = 0.05  # of the timer [s]
QUIET = 0.15     # how long nothing has to change before the program starts [s]
COARSER = 3      # than the settings say, while the view moves


def camera_of(view, window):
    """The viewport's camera in glTF's world: its matrix by columns, and its vertical angle. A view without perspective is one from afar."""
    height = 2 / window[1][1]
    pose = view.inverted()
    if window[3][3] == 0:
        angle = 2 * math.atan(height / 2)
    else:
        distance = 200 * height
        pose = pose @ mathutils.Matrix.Translation((0, 0, distance))
        angle = 2 * math.atan(height / 2 / distance)
    matrix = (TO_GLTF @ pose).transposed()
    return [x for column in matrix for x in column], angle


def with_camera(data, matrix, angle):
    """A .glb with this camera and no other."""
    def change(gltf):
        for node in gltf.setdefault("nodes", []):
            node.pop("camera", None)
        gltf["cameras"] = [{"type": "perspective", "perspective": {"yfov": angle, "znear": 0.01}}]
        gltf["nodes"].append({"name": "viewport", "camera": 0, "matrix": matrix})
        gltf["scenes"][gltf.get("scene", 0)].setdefault("nodes", []).append(len(gltf["nodes"]) - 1)

    return edit(data, change)


class Viewport:
    """What one viewport shows."""

    def __init__(self, engine):
        self.engine = engine
        self.folder = tempfile.TemporaryDirectory(prefix="steradian_viewport_")
        self.scene_data = None       # the exported scene
        self.around = None           # the world's map
        self.exporting = False
        self.changed_at = 0.0        # when the scene or the view last changed
        self.scene_changed = True
        self.wanted = self.shown = None  # (view, size, pixel, scene's number)
        self.scene_number = 0
        self.run = None
        self.running = None
        self.picture = None          # the last one, and its texture in the context that draws
        self.texture = None
        self.message = ""
        self.timer = self.tick
        bpy.app.timers.register(self.timer, first_interval=INTERVAL)

    def scene_has_changed(self):
        """Blender says so."""
        if not self.exporting:  # the exporter's own doing is none
            self.scene_changed, self.changed_at = True, time.monotonic()

    def look(self, view, window, width, height):
        """What is to be shown, by the viewport's matrices."""
        looks = (tuple(map(tuple, view)), tuple(map(tuple, window)), width, height)
        if self.wanted is None or self.wanted[0] != looks:
            self.wanted, self.changed_at = (looks, view.copy(), window.copy()), time.monotonic()

    def tick(self):
        """One step of the timer. None ends it."""
        try:
            return self.step()
        except ReferenceError:  # the viewport is gone
            self.free()
            return None

    def step(self):
        """Ends what is out of date, begins what is due."""
        self.engine.is_preview  # raises ReferenceError once Blender has let the engine go
        if self.wanted is None:
            return INTERVAL
        pixel = bpy.context.scene.steradian.viewport_pixel
        if self.run is not None:
            if self.scene_changed or self.running[:2] != (self.wanted[0], self.scene_number):
                self.run.stop()
                self.run = None
            elif not self.run.is_running():
                self.take()
            return INTERVAL
        if time.monotonic() - self.changed_at < QUIET:
            return INTERVAL
        if self.scene_changed:
            self.export_scene()
        fresh = self.shown is not None and self.shown[:2] == (self.wanted[0], self.scene_number)
        if not fresh:
            self.begin(pixel * COARSER)
        elif self.shown[2] > pixel:
            self.begin(pixel)
        return INTERVAL

    def export_scene(self):
        """The scene as a .glb."""
        path = os.path.join(self.folder.name, "scene.glb")
        self.exporting = True
        try:
            export(path)
            with open(path, "rb") as file:
                self.scene_data = file.read()
            around = os.path.join(self.folder.name, "world.exr")
            self.around = around if world.write(bpy.context.scene.world, around) else None
            self.scene_number += 1
            self.message = ""
        except RuntimeError as error:  # the exporter's
            self.say(f"export: {error}")
        self.scene_changed, self.exporting = False, False

    def begin(self, pixel):
        """Starts the program for a picture whose pixels are `pixel` of the screen's wide."""
        if self.scene_data is None:
            return
        looks, view, window = self.wanted
        width, height = max(looks[2] // pixel, 1), max(looks[3] // pixel, 1)
        glb = os.path.join(self.folder.name, "view.glb")
        with open(glb, "wb") as file:
            file.write(with_camera(self.scene_data, *camera_of(view, window)))
        settings = bpy.context.scene.steradian
        coarse = pixel > settings.viewport_pixel
        command = program.render_command(glb, os.path.join(self.folder.name, "view.exr"), width, height, settings, 1, self.around, coarse)
        if not command[0]:
            self.shown = (looks, self.scene_number, 0)
            return self.say("the program steradian is not found: name it in the add-on's preferences")
        try:
            self.run = program.Run(command)
        except OSError as error:
            self.shown = (looks, self.scene_number, 0)
            return self.say(f"{command[0]}: {error.strerror}")
        self.running = (looks, self.scene_number, pixel)

    def take(self):
        """The picture of a run that has ended, or what it said."""
        self.run.close()
        code, said = self.run.process.returncode, self.run.lines()
        self.run, self.shown = None, self.running
        if code != 0:
            return self.say(said[0] if said else f"the program ended with {code}")
        self.picture, self.texture = pictures.read_exr(os.path.join(self.folder.name, "view.exr")), None
        self.message = ""
        self.engine.tag_redraw()

    def say(self, message):
        """In the viewport's corner."""
        self.message = message
        print(f"steradian: {message}")
        self.engine.tag_redraw()

    def draw(self, engine, scene, width, height):
        """The picture over all of the viewport."""
        import gpu
        from gpu_extras.presets import draw_texture_2d
        import numpy

        engine.update_stats("Steradian", self.message)
        if self.picture is None:
            return
        if self.texture is None:
            h, w, _ = self.picture.shape
            pixels = self.picture[::-1].copy()
            pixels[:, :, 3] = 1
            self.texture = gpu.types.GPUTexture((w, h), format="RGBA16F", data=gpu.types.Buffer("FLOAT", w * h * 4, pixels.ravel().tolist()))
        gpu.state.blend_set("ALPHA_PREMULT")
        engine.bind_display_space_shader(scene)
        draw_texture_2d(self.texture, (0, 0), width, height)
        engine.unbind_display_space_shader()
        gpu.state.blend_set("NONE")

    def free(self):
        """Ends the program, and takes the files away."""
        if bpy.app.timers.is_registered(self.timer):
            bpy.app.timers.unregister(self.timer)
        if self.run is not None:
            self.run.stop()
            self.run = None
        self.folder.cleanup()
