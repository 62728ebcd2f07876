"""Renders that fail in a Blender without a window: Blender says why, writes no picture, and ends with 1.

    test_failure.py              runs Blender with the add-on in a folder of its own; exit 77 (skipped) where there is no Blender
"""
import os
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

HERE = Path(__file__).resolve().parent

if not shutil.which("blender"):
    print("skipped: there is no blender here (apt-get install blender python3-numpy)")
    sys.exit(77)

with tempfile.TemporaryDirectory() as folder:
    addons = Path(folder) / "scripts" / "addons"
    addons.mkdir(parents=True)
    shutil.copytree(HERE / "steradian", addons / "steradian_render", ignore=shutil.ignore_patterns("__pycache__"))
    failing = Path(folder) / "failing"
    failing.write_text("#!/bin/sh\necho 'steradian: the scene has no light'\nexit 1\n")
    failing.chmod(0o755)
    for name, program, expected in (("none", "", "the program steradian is not found"), ("absent", "/no/steradian", "No such file"),
                                    ("failing", str(failing), "the scene has no light")):
        # Debian's Blender takes the library of the first python3 of PATH. There is no steradian in these folders.
        environment = {**os.environ, "BLENDER_USER_SCRIPTS": str(addons.parent), "STERADIAN_PROGRAM": program, "PATH": "/usr/bin:/bin"}
        if not program and shutil.which("steradian", path=environment["PATH"]):
            continue
        picture = Path(folder) / name
        done = subprocess.run(["blender", "-b", "--factory-startup", "--addons", "io_scene_gltf2,steradian_render", "-E", "STERADIAN",
                               "-o", f"{picture}#", "-F", "PNG", "-s", "1", "-e", "2", "-a"],
                              env=environment, capture_output=True, text=True, timeout=200)
        errors = [line for line in done.stderr.splitlines() if line.startswith("steradian: error: ")]
        print(f"{name}: exit {done.returncode}; {errors}")
        assert len(errors) == 1 and expected in errors[0], done.stdout + done.stderr
        assert done.returncode == 1, done.returncode
        assert not list(Path(folder).glob(f"{name}*.png")), "a picture was written"
