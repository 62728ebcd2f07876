"""Runs a test's script in Blender, with the add-on in a folder of its own; ends with 77 (skipped) where a program is missing."""

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
