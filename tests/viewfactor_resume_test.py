#!/usr/bin/env python3
"""viewfactor_resume_test.py PROGRAM JOB_SCRIPT: `steradian viewfactor --resume` after SIGKILL, and a job array's script.

A run is killed again and again as soon as it has finished more rows. The finished rows stay in the file, and the last run writes the same
bytes as a run without interruption. Rows that were cut off or damaged are computed again, and rows of other settings are not taken up.
The script for Slurm runs through bash, and joins its parts to the same bytes.
"""
import os
import subprocess
import sys
import tempfile
from pathlib import Path

from killed_runs import KilledRuns

OPTIONS = ["--eps", "1e-5", "--divide", "4"]


def check_jobs(program, script, folder, expected):
    """Runs the jobs of an array of three one after another, and the job that joins them."""
    (folder / "bin").mkdir()
    (folder / "bin" / "steradian").symlink_to(Path(program).resolve())
    environment = {**os.environ, "PATH": f"{folder / 'bin'}:{os.environ['PATH']}", "SLURM_ARRAY_TASK_COUNT": "3"}
    joined = folder / "joined.npz"

    def job(*arguments, **keys):
        return subprocess.run(["bash", script, *map(str, arguments)], env={**environment, **keys}, capture_output=True, text=True)

    for task in ("2", "1"):
        done = job(folder / "street.obj", joined, *OPTIONS, SLURM_ARRAY_TASK_ID=task)
        assert done.returncode == 0, done.stderr
    gap = job("--merge", joined)
    assert gap.returncode == 1 and "missing" in gap.stderr, f"a gap was joined: {gap.stderr}"
    assert job(folder / "street.obj", joined, *OPTIONS, SLURM_ARRAY_TASK_ID="3").returncode == 0
    done = job("--merge", joined)
    assert done.returncode == 0, done.stderr
    assert joined.read_bytes() == expected, "the jobs have other bytes than one run"
    alone = job(folder / "street.obj", joined)
    assert alone.returncode != 0 and "sbatch --array" in alone.stderr, alone.stderr


def main():
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        street = folder / "street.obj"
        street.write_bytes(subprocess.run([sys.executable, Path(sys.argv[2]).with_name("street.py"), "3"], check=True, capture_output=True).stdout)
        runs = KilledRuns([sys.argv[1], "viewfactor", str(street), *OPTIONS], folder / "killed.npz")
        expected = runs.whole(folder / "whole.npz")
        kills, rows = runs.kill_often(5)
        assert kills >= 3, f"the run ended after {kills} kills: the scene is too small for this machine"
        runs.check_damage(rows, expected)
        check_jobs(sys.argv[1], sys.argv[2], folder, expected)

        # Rows of another tolerance are not those of this run.
        runs.kept.write_bytes(rows)
        runs.command[runs.command.index("1e-5")] = "1e-4"
        assert runs.whole(runs.output, "--resume") == runs.whole(folder / "other.npz"), "rows of other settings were taken up"
    print(f"{kills} kills and three jobs, the same bytes")
    return 0


if __name__ == "__main__":
    sys.exit(main())
