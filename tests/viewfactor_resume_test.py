#!/usr/bin/env python3
"""viewfactor_resume_test.py PROGRAM: `steradian viewfactor --resume` after SIGKILL.

A run is killed again and again as soon as it has finished more rows. The finished rows stay in the file, and the last run writes the same
bytes as a run without interruption. Rows that were cut off or damaged are computed again, and rows of other settings are not taken up.
"""
import signal
import subprocess
import sys
import tempfile
import time
from pathlib import Path

OPTIONS = ["--eps", "1e-5", "--divide", "1.3"]


def street():
    """OBJ text: a road between boxes, which hide parts of each other."""
    vertices, faces = [], []

    def quad(*corners):
        faces.append([len(vertices) + i + 1 for i in range(4)])
        vertices.extend(corners)

    for i in range(6):
        x0, x1, height = 4 * i, 4 * i + 3, 2 + (i * 7 % 5) / 2
        y0, y1 = (2, 5) if i % 2 == 0 else (-5, -2)
        quad((x0, y0, height), (x1, y0, height), (x1, y1, height), (x0, y1, height))
        quad((x0, y0, 0), (x1, y0, 0), (x1, y0, height), (x0, y0, height))
        quad((x1, y0, 0), (x1, y1, 0), (x1, y1, height), (x1, y0, height))
        quad((x1, y1, 0), (x0, y1, 0), (x0, y1, height), (x1, y1, height))
        quad((x0, y1, 0), (x0, y0, 0), (x0, y0, height), (x0, y1, height))
    quad((0, -2, 0), (23, -2, 0), (23, 2, 0), (0, 2, 0))
    lines = ["v {} {} {}".format(*v) for v in vertices] + ["f {} {} {} {}".format(*f) for f in faces]
    return "\n".join(lines) + "\n"


class Runs:
    def __init__(self, program, folder):
        self.command = [program, "viewfactor", str(folder / "street.obj"), *OPTIONS]
        self.output, self.rows = folder / "killed.npz", folder / "killed.npz.part"
        (folder / "street.obj").write_text(street())

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


def main():
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        runs = Runs(sys.argv[1], folder)
        expected = runs.whole(folder / "whole.npz")
        kills, kept = 0, 100
        while kills < 5 and runs.kill_after(kept):
            kills += 1
            assert not runs.output.exists(), "a killed run has written its output"
            assert runs.size() > kept, f"finished rows were lost: {kept} bytes became {runs.size()}"
            kept = runs.size()
        assert kills >= 3, f"the run ended after {kills} kills: the scene is too small for this machine"

        rows = runs.rows.read_bytes()
        for what, damaged in [("a block that was cut off", rows[:-5]), ("a damaged block", rows[:-9] + bytes([rows[-9] ^ 64]) + rows[-8:]),
                              ("a damaged head", rows[:3] + b"?" + rows[4:]), ("an empty file", b""), ("what was killed", rows)]:
            runs.rows.write_bytes(damaged)
            assert runs.whole(runs.output, "--resume") == expected, f"{what}: other bytes than without interruption"
            assert not runs.rows.exists(), f"{what}: the finished rows are still there"
            runs.output.unlink()
        # Rows of another tolerance are not those of this run.
        runs.rows.write_bytes(rows)
        runs.command[runs.command.index("1e-5")] = "1e-4"
        assert runs.whole(runs.output, "--resume") == runs.whole(folder / "other.npz"), "rows of other settings were taken up"
    print(f"{kills} kills, the same bytes")
    return 0


if __name__ == "__main__":
    sys.exit(main())
