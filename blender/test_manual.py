"""The commands of docs/blender.md, as they stand there, in a fresh folder: test_manual.py PROGRAM; exit 77 (skipped) where there is no Blender."""

import os
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent


def blocks():
    """The page's, without what installs packages."""
    found = re.findall(r"(?:^    .*\n)+", (ROOT / "docs" / "blender.md").read_text(), re.MULTILINE)
    return [b for b in ("".join(line for line in block.splitlines(True) if "apt-get" not in line) for block in found) if b.strip()]


def main(program):
    """Runs them: those that make the scene first."""
    if not shutil.which("blender"):
        print("skipped: there is no blender here (apt-get install blender python3-numpy)")
        sys.exit(77)
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        for part in ("blender", "examples"):
            (folder / part).symlink_to(ROOT / part)
        for place in ("build/release/bin", "bin"):
            (folder / place).mkdir(parents=True)
            (folder / place / "steradian").symlink_to(os.path.abspath(program))
        # Debian's Blender takes the library of the first python3 of PATH: Debian's own has numpy.
        environment = {"HOME": name, "PATH": f"/usr/bin:/bin:{folder}/bin", "LC_ALL": "C.UTF-8"}
        pieces = blocks()
        making = next(b for b in pieces if "make_room.py" in b)
        for block in [making, "cp out/room.blend .", *(b for b in pieces if b is not making)]:
            done = subprocess.run(["bash", "-e"], input=block, cwd=folder, env=environment, capture_output=True, text=True, timeout=300)
            said = done.stdout + done.stderr
            assert done.returncode == 0 and "Traceback" not in said, f"{block}\n{said[-3000:]}"
            if block is making:
                ratio = re.search(r"mean A / mean B ([\d.]+)", said)
                print("the room's mean over that of Cycles:", ratio[1])
                assert abs(float(ratio[1]) - 1) < 0.001, ratio[0]
        pictures = [p.name for p in (folder / "picture0001.exr", folder / "room.png") if p.exists() and p.stat().st_size > 1000]
        assert len(pictures) == 2, sorted(p.name for p in folder.iterdir())
        print(f"{len(pieces)} pieces of the page ran, and made {', '.join(pictures)}")


if __name__ == "__main__":
    main(sys.argv[1])
