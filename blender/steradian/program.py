"""The program `steradian`: where it is, what it is asked for, and how it runs beside Blender."""

import os
import re
import shutil
import subprocess
import threading

import bpy


def path():
    """Of the add-on's preferences, of STERADIAN_PROGRAM, or of PATH; empty where it is nowhere."""
    preferences = bpy.context.preferences.addons.get(__package__)
    given = (preferences.preferences.program if preferences else "") or os.environ.get("STERADIAN_PROGRAM", "")
    return bpy.path.abspath(given) if given else shutil.which("steradian") or ""


def render_command(glb, picture, width, height, settings, aa, world, direct_only=False):
    """What renders a file of the add-on's export. Its lights are in watts, whatever the exporter's name is in it. world: a map, or None."""
    indirect = "off" if direct_only else settings.indirect
    background = "off" if bpy.context.scene.render.film_transparent else "on"
    environment = {"world": world, "none": None}.get(settings.environment, settings.environment)
    around = ["--environment", environment, "--background", background] if environment else []
    # The program refuses an option that changes nothing.
    terminator = ["--terminator", settings.terminator] if settings.shadows != "off" else []
    bounces = ["--bounces", "all"] if indirect == "all" else ["--indirect", indirect]
    return [path(), "render", glb, "-o", picture, "--size", f"{width}x{height}", "--method", settings.method,
            "--quality", settings.quality, "--shadows", settings.shadows,
            *terminator, *bounces, "--aa", str(aa), "--light", "none", "--light-units", "candela", *around]


def bake_command(glb, output, settings, texels, bounces, target, world):
    """What bakes a file of the add-on's export. world: a map, or None."""
    environment = {"world": world, "none": None}.get(settings.environment, settings.environment)
    around = ["--environment", environment] if environment else []
    return [path(), "bake", glb, "-o", output, "--texels", f"{texels:g}", "--bounces", bounces, "--target", target,
            "--quality", settings.quality, "--shadows", settings.shadows, "--light-units", "candela", *around]


PROGRESS = re.compile(r"^(?:render|bake) +(\d+\.\d) %  .* left$")  # a line of the program's, one a second


class Run:
    """A run of the program. A thread of its own reads what it says."""

    def __init__(self, command):
        self.process = subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                                        errors="replace")
        self.said, self.share = [], None
        self.reader = threading.Thread(target=self.listen, daemon=True)
        self.reader.start()

    def listen(self):
        """Until the program closes its end."""
        for line in self.process.stdout:
            progress = PROGRESS.match(line.rstrip())
            if progress:
                self.share = float(progress[1]) / 100
            elif line.strip():
                self.said.append(line.rstrip())

    def is_running(self):
        """Whether it still runs."""
        return self.process.poll() is None

    def share_done(self):
        """From 0 to 1; None before the program tells it, after a second."""
        return self.share

    def lines(self):
        """What it said, without progress; all of it after close()."""
        return list(self.said)

    def stop(self):
        """Ends it, and gives back what it holds."""
        if self.is_running():
            self.process.terminate()
            self.process.wait()
        self.close()

    def close(self):
        """After its end."""
        self.reader.join()
        self.process.stdout.close()


class Telling:
    """A line for Blender's status, at most once a second: without a window Blender prints each as a line of its own."""

    def __init__(self, now, doing="rendering"):
        self.begin, self.next, self.doing = now, now, doing

    def line(self, now, share):
        """None where the last is not a second old."""
        if now < self.next:
            return None
        self.next = now + 1
        return f"{self.doing}, {now - self.begin:.0f} s" + ("" if share is None else f", {100 * share:.0f} %")
