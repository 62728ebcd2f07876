#!/usr/bin/env python3
"""viewfactor_resume_test.py PROGRAM JOB_SCRIPT: `steradian viewfactor --resume` after SIGKILL, and a job array's script.

A run is killed again and again as soon as it has finished more rows. The finished rows stay in the file, and the last run writes the same
bytes as a run without interruption. Rows that were cut off or damaged are computed again, and rows of other settings are not taken up.
The script for Slurm runs through bash, and joins its parts to the same bytes.
"""
import os
import signal
import struct
import subprocess
import sys
import tempfile
import time
from pathlib import Path

OPTIONS = ["--eps", "1e-5", "--divide", "4"]


def finished_blocks(rows):
    """The bytes of `rows` up to the end of its last whole block."""
    end = 16
    while end + 24 <= len(rows):
        _, size, _ = struct.unpack_from("<3Q", rows, end)
        if end + 24 + size > len(rows):
            break
        end += 24 + size
    return rows[:end]


class Runs:
    def __init__(self, program, street, folder):
        self.command = [program, "viewfactor", str(folder / "street.obj"), *OPTIONS]
        self.output, self.rows = folder / "killed.npz", folder / "killed.npz.part"
        (folder / "street.obj").write_bytes(subprocess.run([sys.executable, street, "3"], check=True, capture_output=True).stdout)

    def whole(self, output, *options):
        subprocess.run([*self.command, "-o", str(output), *options], check=True, capture_output=True)
        return output.read_bytes()

    def size(self):
        return self.rows.stat().st_size if self.rows.exists() else 0

    def kill_after(self, size):
        """Starts the run and kills it when its finished rows take more than `size` bytes. False if it ends before that."""
        run = subprocess.Popen([*self.command, "-o", str(self.output), "--resume"], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        end = time.monotonic() + 120
        while run.poll() is None and time.monotonic() < end:
            if self.size() > size:
                run.send_signal(signal.SIGKILL)
                run.wait()
                return True
            time.sleep(0.001)
        assert run.poll() == 0, f"the run did not end well: {run.poll()}"
        return False


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
        runs = Runs(sys.argv[1], Path(sys.argv[2]).with_name("street.py"), folder)
        expected = runs.whole(folder / "whole.npz")
        kills, kept, finished = 0, 100, b""
        while kills < 5 and runs.kill_after(kept):
            kills += 1
            assert not runs.output.exists(), "a killed run has written its output"
            rows = runs.rows.read_bytes()
            assert rows.startswith(finished), "finished rows were lost"
            kept, finished = len(rows), finished_blocks(rows)
        assert kills >= 3, f"the run ended after {kills} kills: the scene is too small for this machine"

        rows = runs.rows.read_bytes()
        for what, damaged in [("a block that was cut off", rows[:-5]), ("a damaged block", rows[:-9] + bytes([rows[-9] ^ 64]) + rows[-8:]),
                              ("a damaged head", rows[:3] + b"?" + rows[4:]), ("an empty file", b""), ("what was killed", rows)]:
            runs.rows.write_bytes(damaged)
            assert runs.whole(runs.output, "--resume") == expected, f"{what}: other bytes than without interruption"
            assert not runs.rows.exists(), f"{what}: the finished rows are still there"
            runs.output.unlink()
        check_jobs(sys.argv[1], sys.argv[2], folder, expected)

        # Rows of another tolerance are not those of this run.
        runs.rows.write_bytes(rows)
        runs.command[runs.command.index("1e-5")] = "1e-4"
        assert runs.whole(runs.output, "--resume") == runs.whole(folder / "other.npz"), "rows of other settings were taken up"
    print(f"{kills} kills and three jobs, the same bytes")
    return 0


if __name__ == "__main__":
    sys.exit(main())
