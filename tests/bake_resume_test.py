#!/usr/bin/env python3
"""bake_resume_test.py PROGRAM SCENE: `steradian bake --resume` after SIGKILL.

A run is killed again and again as soon as it has finished more charts. The last run writes the same map and the same scene as a run without
interruption. Charts that were cut off or damaged are baked again, and charts of other settings are not taken up.
"""
import sys
import tempfile
from pathlib import Path

from killed_runs import KilledRuns

# Two maps of several batches of charts each.
OPTIONS = ["--texels", "12", "--bounces", "0", "--group", "star"]


def main():
    program, scene = sys.argv[1:]
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        runs = KilledRuns([program, "bake", scene, *OPTIONS], folder / "killed" / "map.glb")
        for part in ("killed", "whole"):
            (folder / part).mkdir()
        expected = runs.whole(folder / "whole" / "map.glb")
        texels = (folder / "whole" / "map.exr").read_bytes()
        kills, kept = runs.kill_often(6)
        assert kills >= 3, f"the run ended after {kills} kills: the scene is too small for this machine"
        runs.check_damage(kept, expected)
        assert (folder / "killed" / "map.exr").read_bytes() == texels, "other texels than without interruption"

        # Charts of another number of bounces are not those of this run.
        runs.kept.write_bytes(kept)
        runs.command[runs.command.index("--bounces") + 1] = "1"
        assert runs.whole(runs.output, "--resume") == runs.whole(folder / "whole" / "map.glb"), "charts of other settings were taken up"
    print(f"{kills} kills, the same bytes")
    return 0


if __name__ == "__main__":
    sys.exit(main())
