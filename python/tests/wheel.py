#!/usr/bin/env python3
"""wheel.py PACKAGE PROGRAM: makes the wheel, installs it by pip into an empty venv, and uses it there, away from the build.

numpy, which the wheel asks for, is the machine's. Exit 77 (skipped) if there is no pip.
"""
import json
import math
import os
import subprocess
import sys
import tempfile
from pathlib import Path

USE = """
import numpy, pathlib, steradian, sys
here = pathlib.Path(steradian.__file__).resolve()
assert here.is_relative_to(pathlib.Path(sys.prefix).resolve()) and sys.prefix != sys.base_prefix, here
panel = {"type": "rect", "center": [0, 2, 0], "x": [1, 0, 0], "y": [0, 0, 1], "radiance": 1}
print(steradian.__version__, steradian.irradiance(panel, [0, 0, 0], [0, 1, 0])[0])
libraries = {line.split()[-1] for line in open("/proc/self/maps") if ".so" in line}
ours = [l for l in libraries if any(name in l for name in ("embree", "libtbb", "OpenEXR", "Imath"))]
assert ours and all(l.startswith(str(here.parent)) for l in ours), ours
"""

QUERY = {"light": {"type": "rect", "center": [0, 1, 0], "x": [0.5, 0, 0], "y": [0, 0, 0.5]}, "position": [0, 0, 0], "normal": [0, 1, 0],
         "material": {"brdf": "lambert"}}


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
        run(sys.executable, "-m", "venv", "--without-pip", "--system-site-packages", folder / "venv")
        python = folder / "venv" / "bin" / "python"
        environment = {name: value for name, value in os.environ.items() if name not in ("STERADIAN_PROGRAM", "PYTHONPATH")}
        run(sys.executable, "-m", "pip", "--python", python, "install", "--no-index", "--quiet", wheel, env=environment)  # numpy must be there
        print(run(python, "-c", USE, cwd=folder, env=environment))
        print(run(python, "-m", "steradian", "--version", cwd=folder, env=environment))
        answer = json.loads(run(python, "-m", "steradian", "eval", cwd=folder, env=environment, input=json.dumps(QUERY) + "\n"))
        # Configuration factor of a square of side 1, parallel to the surface and centred above the point at distance 1.
        factor = 4 * math.atan(0.5 / math.hypot(0.5, 1)) * 0.5 / math.hypot(0.5, 1) / math.pi
        assert all(abs(x - factor) < 1e-14 for x in answer["radiance"]), (answer, factor)
        print(f"a query from the wheel: {answer['radiance'][0]}")


if __name__ == "__main__":
    main()
