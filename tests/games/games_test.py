#!/usr/bin/env python3
"""The pieces of docs/games.md.

    games_test.py PAGE PROGRAM EXAMPLE PACKAGE       runs its commands, its C++ (EXAMPLE, built from it) and its JavaScript (of PACKAGE)
    games_test.py --extract PAGE LANGUAGE FILE       writes its piece in a language

What they make is judged: alpha of the pictures, and the lit dome against a quadrature over the lamp's directions.
"""
import json
import math
import re
import shutil
import struct
import subprocess
import sys
import tempfile
from pathlib import Path


def piece(page, language):
    found = re.findall(rf"^```{language}\n(.*?)^```", page.read_text(), re.DOTALL | re.MULTILINE)
    assert len(found) == 1, f"{page}: {len(found)} pieces of {language}"
    return found[0]


def png_kind(path):
    header = path.read_bytes()[:26]
    return struct.unpack(">IIBB", header[16:26])  # width, height, bits, 6: RGB and alpha


def arriving(program, folder, points):
    lines = "".join(json.dumps({"scene": str(folder / "level.svg"), "position": p}) + "\n" for p in points)
    done = subprocess.run([program, "eval", "--plane"], input=lines, capture_output=True, text=True, check=True)
    return [json.loads(line)["mean_radiance"] for line in done.stdout.splitlines()]


def dome(x, y, torch, walls):
    """What the page's dome sends out in red at a pixel's centre: quadrature over the directions of the torch and the moon."""
    b = math.radians(50)
    at = (x + 0.5, y + 0.5)
    n = ((at[0] - 200) / 16, (at[1] - 90) / 16)
    nz = math.sqrt(1 - n[0] ** 2 - n[1] ** 2)
    linear = {"#ffb45e": 1.0, "#9fbcff": ((0x9F / 255 + 0.055) / 1.055) ** 2.4}
    sum_ = 0.0
    for center, r, radiance, reach in ((torch, 5, 12 * linear["#ffb45e"], 220), ((290, 30), 8, 4 * linear["#9fbcff"], math.inf)):
        to = (center[0] - at[0], center[1] - at[1])
        d, phi = math.hypot(*to), math.atan2(to[1], to[0])
        half, steps = math.asin(r / d), 4000
        for k in range(steps):
            f = -half + (k + 0.5) * 2 * half / steps
            u = (math.cos(phi + f), math.sin(phi + f))
            distance = d * math.cos(f) - math.sqrt(r * r - (d * math.sin(f)) ** 2)
            if any(crosses(at, u, distance, wall) for wall in walls):
                continue
            window = 0.0 if distance > reach else (1 - (distance / reach) ** 2) ** 2
            facing = math.cos(b) * (n[0] * u[0] + n[1] * u[1]) + math.sin(b) * nz
            sum_ += radiance * window * max(0.0, facing) * 2 * half / steps
    return 0.6 * sum_ / (2 * math.pi) / math.sin(b)


def crosses(p, u, length, box):
    """Whether a ray meets a box (x0, y0, x1, y1) before its length."""
    near, far = 0.0, length
    for k in range(2):
        if abs(u[k]) < 1e-15:
            if not box[k] < p[k] < box[k + 2]:
                return False
            continue
        a, b = sorted(((box[k] - p[k]) / u[k], (box[k + 2] - p[k]) / u[k]))
        near, far = max(near, a), min(far, b)
    return near < far


def check_dome(what, rows, torch):
    walls = [(100, 60, 140, 120)]
    for x, row in zip((192, 200, 208), rows):
        want = dome(x, 90, torch, walls)
        print(f"{what}: red of the dome at {x}: {row[0]:.6f}, by quadrature {want:.6f}")
        # 4000 steps cut a shadow's edge to 1e-5 of the torch, whose radiance is 12; the map is of floats.
        assert abs(row[0] - want) < 2e-5, (x, row, want)


def main():
    if sys.argv[1] == "--extract":
        Path(sys.argv[4]).write_text(piece(Path(sys.argv[2]), sys.argv[3]))
        return
    page, program, example, package = Path(sys.argv[1]), sys.argv[2], sys.argv[3], Path(sys.argv[4])
    with tempfile.TemporaryDirectory() as scratch:
        folder = Path(scratch)
        (folder / "level.svg").write_text(piece(page, "svg"))
        commands = re.findall(r"^    (steradian .*)$", page.read_text(), re.MULTILINE)
        assert len(commands) == 2, commands
        for command in commands:
            subprocess.run([program, *command.split()[1:]], cwd=folder, check=True)
        assert png_kind(folder / "light.png") == (320, 180, 8, 6), png_kind(folder / "light.png")

        done = subprocess.run([example], cwd=folder, capture_output=True, text=True, check=True)
        lines = done.stdout.splitlines()
        assert len(lines) == 14 and lines[-1] == "320 x 180", done.stdout
        assert png_kind(folder / "dome.png") == (32, 32, 8, 6), png_kind(folder / "dome.png")
        check_dome("C++", [[float(v) for v in line.split()] for line in lines[10:13]], (50, 165))
        level = (folder / "level.svg").read_text()
        (folder / "level.svg").write_text(level.replace('cx="60" cy="90"', 'cx="50" cy="165"'))
        want = arriving(program, folder, [[200.5, 90.5]])[0][0]
        assert abs(float(lines[9].split()[-1]) - want) < 0.7e-4, (lines[9], want)
        (folder / "level.svg").write_text(level)

        if not shutil.which("node") or not (package / "package.json").exists():
            print("the JavaScript was not run: the package is not built (./dev web)")
            return
        (folder / "node_modules").mkdir()
        (folder / "node_modules" / "steradian-plane").symlink_to(package)
        (folder / "game.mjs").write_text(piece(page, "js"))
        done = subprocess.run(["node", "game.mjs"], cwd=folder, capture_output=True, text=True)
        assert done.returncode == 0, done.stderr
        lines = done.stdout.splitlines()
        check_dome("JavaScript", [[float(v) for v in line.split()] for line in lines[:3]], (50, 165))
        assert lines[3].split() == ["0", "1"], lines[3]


if __name__ == "__main__":
    main()
