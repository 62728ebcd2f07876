"""What the add-on's tests share. Outside of Blender: runs a test's script in it, with the add-on in a folder of its own; ends with 77 (skipped)
where a program is missing. Inside: an empty scene, and its pictures by either engine."""

import os
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

HERE = Path(__file__).resolve().parent


def run(script, program, window, seconds, keep=()):
    """The script's folder comes after `--`; it prints lines that begin with TEST, the last of them "TEST done". keep: (name, path) of files
    that are copied from the folder at the end. window: a screen by Xvfb, else Blender runs without."""
    for name in ("blender", "xvfb-run") if window else ("blender",):
        if not shutil.which(name):
            print(f"skipped: there is no {name} here (apt-get install blender python3-numpy xvfb)")
            sys.exit(77)
    with tempfile.TemporaryDirectory() as folder:
        addons = Path(folder) / "scripts" / "addons"
        addons.mkdir(parents=True)
        shutil.copytree(HERE / "steradian", addons / "steradian_render", ignore=shutil.ignore_patterns("__pycache__"))
        screen = ["xvfb-run", "-a", "-s", "-screen 0 1024x640x24"] if window else []
        command = [*screen, "blender", *([] if window else ["-b"]), "--factory-startup", "--python-exit-code", "3", "-P", script, "--", folder]
        # Debian's Blender takes the library of the first python3 of PATH: Debian's own has numpy.
        environment = {**os.environ, "BLENDER_USER_SCRIPTS": str(addons.parent), "STERADIAN_PROGRAM": os.path.abspath(program),
                       "PATH": "/usr/bin:/bin:" + os.environ.get("PATH", "")}
        done = subprocess.run(command, env=environment, capture_output=True, text=True, timeout=seconds)
        told = [line for line in done.stdout.splitlines() if line.startswith("TEST")]
        print("\n".join(told))
        for name, path in keep:
            if (Path(folder) / name).exists():
                shutil.copy(Path(folder) / name, path)
        if done.returncode != 0 or not told or told[-1] != "TEST done":
            sys.exit(done.stdout[-2000:] + done.stderr[-4000:])


def main(script, inside, window, seconds, keep=lambda arguments: ()):
    """The whole of a test's script: `script PROGRAM ...` runs inside(folder) in Blender. keep(the arguments after the program): as run()'s."""
    if "--" in sys.argv:
        inside(sys.argv[sys.argv.index("--") + 1])
    else:
        run(script, sys.argv[1], window, seconds, keep(sys.argv[2:]))


def enable():
    """The add-on, and the exporter that it hooks into."""
    import bpy

    for name in ("io_scene_gltf2", "steradian_render"):
        bpy.ops.preferences.addon_enable(module=name)
    assert hasattr(bpy.context.scene, "steradian"), "the add-on is not enabled"


class Pictures:
    """An empty, dark scene, and what both engines make of it: direct light or all light, in floats."""

    def __init__(self, folder, samples):
        import bpy

        enable()
        self.bpy, self.folder, self.scene = bpy, folder, bpy.context.scene
        scene = self.scene
        bpy.ops.object.select_all(action="SELECT")
        bpy.ops.object.delete()
        scene.world.use_nodes = True
        self.background = scene.world.node_tree.nodes["Background"]
        self.background.inputs["Strength"].default_value = 0
        scene.render.image_settings.file_format, scene.render.image_settings.color_depth = "OPEN_EXR", "32"
        scene.render.resolution_percentage = 100
        scene.view_settings.view_transform = "Raw"
        scene.cycles.samples, scene.cycles.use_denoising, scene.cycles.seed = samples, False, 1
        scene.cycles.sample_clamp_indirect, scene.cycles.diffuse_bounces = 0, 64
        self.take_bounces(False)
        self.lambertian = []  # materials whose diffuse lobe is Lambert's for Cycles, too, which is glTF's; Principled's is Disney's

    def take_bounces(self, all_light):
        """All light of diffuse surfaces, or direct light alone."""
        self.bounces = 64 if all_light else 0
        self.scene.steradian.indirect = "all" if all_light else "off"
        self.scene.cycles.max_bounces = self.scene.world.cycles.max_bounces = self.bounces

    def render(self, engine, width, height):
        """Its pixels, four numbers each, from below."""
        bpy, scene = self.bpy, self.scene
        scene.render.resolution_x, scene.render.resolution_y = width, height
        for light in bpy.data.lights:
            light.cycles.max_bounces = self.bounces
        for name in self.lambertian:
            self.shade_by(bpy.data.materials[name], "Diffuse BSDF" if engine == "CYCLES" else "Principled BSDF")
        scene.render.engine = engine
        scene.render.filepath = os.path.join(self.folder, engine + ".exr")
        bpy.ops.render.render(write_still=True)
        image = bpy.data.images.load(scene.render.filepath)
        image.colorspace_settings.name = "Non-Color"
        pixels, size = list(image.pixels), tuple(image.size)
        bpy.data.images.remove(image)
        assert size == (width, height), size
        return pixels

    @staticmethod
    def shade_by(material, name):
        """Has the material send what this node sends; the diffuse one is of the other's colour."""
        nodes = material.node_tree.nodes
        if name not in nodes:
            nodes.new("ShaderNodeBsdfDiffuse").inputs["Color"].default_value = nodes["Principled BSDF"].inputs["Base Color"].default_value
        material.node_tree.links.new(nodes[name].outputs["BSDF"], nodes["Material Output"].inputs["Surface"])
