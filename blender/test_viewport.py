"""The add-on's viewport in Blender's window: rendered shading shows the picture of the view, and that of a changed scene.

    test_viewport.py PROGRAM [SCREENSHOT.png]   opens Blender under Xvfb; exit 77 (skipped) where there is no Blender, or no xvfb-run
    blender -P test_viewport.py -- FOLDER       what it runs
"""
import os
import sys
import time

sys.path.append(os.path.dirname(os.path.abspath(__file__)))
import in_blender  # noqa: E402

SECONDS = 240  # on software OpenGL, beside other work


class Steps:
    """What happens in the window, by a timer."""

    def __init__(self, folder):
        import bpy

        self.bpy, self.folder, self.begin, self.found = bpy, folder, time.monotonic(), []
        bpy.context.preferences.view.show_splash = False
        in_blender.enable()
        from steradian_render import engine

        viewport, found = engine.Viewport, self.found
        engine.Viewport = lambda owner: found.append(viewport(owner)) or found[-1]
        for thing in list(bpy.data.objects):
            if thing.type != "MESH":
                bpy.data.objects.remove(thing)
        bpy.ops.mesh.primitive_plane_add(size=40, location=(0, 0, -1))
        bpy.ops.object.light_add(type="AREA", location=(2, -4, 6), rotation=(0.6, 0.3, 0))
        bpy.context.object.data.size, bpy.context.object.data.energy = 4, 1200
        bpy.context.object.select_set(False)
        scene = bpy.context.scene
        scene.view_settings.view_transform = "Standard"
        scene.render.engine = "STERADIAN"
        self.first = None

    def area(self):
        return next(a for a in self.bpy.context.window_manager.windows[0].screen.areas if a.type == "VIEW_3D")

    def is_shown(self, number):
        """Whether the fine picture of the scene's export `number` or a later one is drawn."""
        v = self.found[-1] if self.found else None
        return v is not None and v.shown is not None and v.shown[1] >= number and v.shown[2] == 2 and v.texture is not None

    def look(self, name):
        """The screenshot, and how far its viewport is from the picture it should show, in patches of 32 x 32."""
        import numpy

        path = os.path.join(self.folder, name)
        with self.bpy.context.temp_override(window=self.bpy.context.window_manager.windows[0]):
            self.bpy.ops.screen.screenshot(filepath=path)
        image = self.bpy.data.images.load(path)
        screen = numpy.array(image.pixels[:]).reshape(image.size[1], image.size[0], 4)[:, :, :3]
        region = next(r for r in self.area().regions if r.type == "WINDOW")
        shown = screen[region.y:region.y + region.height, region.x:region.x + region.width]
        picture = self.found[-1].picture[::-1, :, :3]
        srgb = numpy.where(picture > 0.0031308, 1.055 * numpy.maximum(picture, 1e-9) ** (1 / 2.4) - 0.055, 12.92 * picture).clip(0, 1)
        far = []
        for y in range(0, region.height - 32, 32):
            for x in range(0, region.width - 32, 32):
                a = shown[y:y + 32, x:x + 32].mean(axis=(0, 1))
                b = srgb[y // 2:y // 2 + 16, x // 2:x // 2 + 16].mean(axis=(0, 1))
                far.append(float(abs(a - b).max()))
        far.sort()
        print(f"TEST {name}: {srgb.shape[1]} x {srgb.shape[0]}, mean {srgb.mean():.4f}, half of the patches within {far[len(far) // 2]:.4f}", flush=True)
        assert 0.05 < srgb.mean() < 0.95
        assert far[len(far) // 2] < 0.02  # the grid, names and buttons are drawn over the others
        return picture.copy()

    def step(self):
        """One step; what goes wrong ends Blender."""
        try:
            return self.unsafe_step()
        except Exception as error:
            print("TEST failed:", type(error).__name__, error, flush=True)
            self.bpy.ops.wm.quit_blender()
            return None

    def unsafe_step(self):
        import numpy

        assert time.monotonic() - self.begin < SECONDS, f"nothing after {SECONDS} s: {self.found and self.found[-1].message}"
        if not self.found:
            self.area().spaces.active.overlay.show_overlays = False
            self.area().spaces.active.shading.type = "RENDERED"
            self.area().tag_redraw()
        elif self.first is None and self.is_shown(1):
            self.first = self.look("first.png")
            self.number = self.found[-1].scene_number
            self.bpy.data.objects["Cube"].location.x = -2
        elif self.first is not None and self.is_shown(self.number + 1):
            second = self.look("second.png")
            changed = (numpy.abs(second - self.first).max(axis=2) > 0.01).mean()
            print(f"TEST the cube has moved: {100 * changed:.1f} % of the pixels have changed", flush=True)
            assert 0.01 < changed < 0.9
            print("TEST done", flush=True)
            self.bpy.ops.wm.quit_blender()
            return None
        return 0.3


def inside(folder):
    """Its steps, one after the other, by Blender's timer."""
    import bpy

    bpy.app.timers.register(Steps(folder).step, first_interval=1)


if __name__ == "__main__":
    in_blender.main(__file__, inside, True, SECONDS + 60, lambda arguments: [("second.png", path) for path in arguments[:1]])
