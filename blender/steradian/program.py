"""The program `steradian`: where it is, what it is asked for, and how it runs beside Blender."""

import os
import re
import shutil
import subprocess

import bpy


def path():
    """Of the add-on's preferences, of STERADIAN_PROGRAM, or of PATH; empty where it is nowhere."""
    preferences = bpy.context.preferences.addons.get(__package__)
    given = (preferences.preferences.program if preferences else "") or os.environ.get("STERADIAN_PROGRAM", "")
    return bpy.path.abspath(given) if given else shutil.which("steradian") or ""


def render_command(glb, picture, width, height, settings, aa, world):
    """What renders a file of the add-on's export. Its lights are in watts, whatever the exporter's name is in it. world: a map, or None."""
    background = "off" if bpy.context.scene.render.film_transparent else "on"
    around = ["--environment", world, "--background", background] if world else []
    return [path(), "render", glb, "-o", picture, "--size", f"{width}x{height}", "--method", settings.method, "--shadows", settings.shadows,
            "--indirect", settings.indirect, "--aa", str(aa), "--light", "none", "--light-units", "candela", *around]


class Run:
    """A run of the program. What it says goes through a terminal of its own, since it tells its progress to terminals alone."""

    def __init__(self, command):
        try:
            import pty
            self.terminal, other = pty.openpty()
            os.set_blocking(self.terminal, False)
        except ImportError:  # no such thing on Windows: no progress there
            self.terminal, other = None, subprocess.PIPE
        self.process = subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=other, stderr=subprocess.STDOUT)
        if self.terminal is not None:
            os.close(other)
        self.said = ""

    def listen(self):
        """Reads what there is; at the end, all of it."""
        if self.terminal is None:
            if self.process.poll() is not None and not self.process.stdout.closed:
                self.said += self.process.stdout.read().decode(errors="replace")
                self.process.stdout.close()
            return
        try:
            while True:
                part = os.read(self.terminal, 65536)
                if not part:
                    break
                self.said += part.decode(errors="replace")
        except OSError:  # nothing now, or the other end is closed
            pass

    def is_running(self):
        """Whether it still runs."""
        running = self.process.poll() is None
        self.listen()
        return running

    def share_done(self):
        """From 0 to 1; None before the program tells it."""
        found = re.findall(r"(\d+\.\d) %", self.said[-400:])
        return float(found[-1]) / 100 if found else None

    def lines(self):
        """What it said, without progress."""
        text = re.sub(r"\r[^\r\n]*\x1b\[K", "", self.said.replace("\r\n", "\n"))
        return [line for line in text.splitlines() if line.strip()]

    def stop(self):
        """Ends it, and gives back what it holds."""
        if self.process.poll() is None:
            self.process.terminate()
            self.process.wait()
        self.close()

    def close(self):
        """After its end."""
        self.listen()
        if self.terminal is not None:
            os.close(self.terminal)
            self.terminal = None
        elif self.process.stdout and not self.process.stdout.closed:
            self.process.stdout.close()
