#!/usr/bin/env python3
"""wheel.py PACKAGE PROGRAM: makes the wheel, installs it by pip into a fresh folder, and uses it there, away from the build. 77: there is no pip."""
import os
import subprocess
import sys
import tempfile
from pathlib import Path

USE = """
import numpy, pathlib, steradian
here = pathlib.Path(steradian.__file__).resolve()
assert here.is_relative_to(pathlib.Path.cwd().resolve()), here
panel = {"type": "rect", "center": [0, 2, 0], "x": [1, 0, 0], "y": [0, 0, 1], "radiance": 1}
print(steradian.__version__, steradian.irradiance(panel, [0, 0, 0], [0, 1, 0])[0])
libraries = {line.split()[-1] for line in open("/proc/self/maps") if ".so" in line}
ours = [l for l in libraries if any(name in l for name in ("embree", "libtbb", "OpenEXR", "Imath"))]
assert ours and all(l.startswith(str(here.parent)) for l in ours), ours
"""


def run(*command, **more):
    done = subprocess.run([str(c) for c in command], capture_output=True, text=True, **more)
    assert done.returncode == 0, f"{command}: {done.stdout}{done.stderr}"
    return done.stdout.strip()


def main():
    package, program = sys.argv[1:]
    if subprocess.run([sys.executable, "-m", "pip", "--version"], capture_output=True).returncode != 0:
        print("skipped: there is no pip (apt-get install python3-pip)")
        sys.exit(77)
    with tempfile.TemporaryDirectory() as scratch:
        folder = Path(scratch)
        print(run(sys.executable, Path(__file__).resolve().parent.parent / "make_wheel.py", package, program, folder))
        (wheel,) = folder.glob("*.whl")
        run(sys.executable, "-m", "pip", "install", "--no-deps", "--no-index", "--quiet", "--target", folder / "site", wheel)
        environment = {**os.environ, "PYTHONPATH": str(folder / "site"), "PYTHONDONTWRITEBYTECODE": "1"}
        environment.pop("STERADIAN_PROGRAM", None)
        print(run(sys.executable, "-c", USE, cwd=folder, env=environment))
        print(run(sys.executable, "-m", "steradian", "--version", cwd=folder, env=environment))


if __name__ == "__main__":
    main()
