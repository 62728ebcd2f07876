"""Runs with --resume that are killed as soon as they have finished more blocks. Used by viewfactor_resume_test.py and bake_resume_test.py."""
import signal
import struct
import subprocess
import time


def finished_blocks(kept):
    """The bytes of a file of finished blocks up to the end of its last whole block (source/core/unfinished_file.h)."""
    end = 16
    while end + 24 <= len(kept):
        size = 24 + struct.unpack_from("<3Q", kept, end)[1]
        if end + size > len(kept):
            break
        end += size
    return kept[:end]


class KilledRuns:
    """command: the program and its arguments without an output. output: of the runs that are killed; their blocks are in the .part beside it."""

    def __init__(self, command, output):
        self.command, self.output = command, output
        self.kept = output.with_name(output.name + ".part")

    def whole(self, output, *options):
        """Runs to the end, and returns the bytes of the output."""
        subprocess.run([*self.command, "-o", str(output), *options], check=True, capture_output=True)
        return output.read_bytes()

    def kill_after(self, size):
        """Starts the run and kills it when its finished blocks take more than `size` bytes. False if it ends before that."""
        run = subprocess.Popen([*self.command, "-o", str(self.output), "--resume"], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        end = time.monotonic() + 120
        while run.poll() is None and time.monotonic() < end:
            if self.kept.exists() and self.kept.stat().st_size > size:
                run.send_signal(signal.SIGKILL)
                run.wait()
                return True
            time.sleep(0.001)
        assert run.poll() == 0, f"the run did not end well: {run.poll()}"
        return False

    def kill_often(self, most):
        """Kills up to `most` runs one after another. Returns their number, and the bytes that they kept."""
        kills, size, kept, finished = 0, 100, b"", b""
        while kills < most and self.kill_after(size):
            kills += 1
            assert not self.output.exists(), "a killed run has written its output"
            kept = self.kept.read_bytes()
            assert kept.startswith(finished), "finished blocks were lost"
            size, finished = len(kept), finished_blocks(kept)
        return kills, kept

    def check_damage(self, kept, expected):
        """Runs that take up damaged blocks have the same bytes."""
        for what, damaged in [("a block that was cut off", kept[:-5]), ("a damaged block", kept[:-9] + bytes([kept[-9] ^ 64]) + kept[-8:]),
                              ("a damaged head", kept[:3] + b"?" + kept[4:]), ("an empty file", b""), ("what was killed", kept)]:
            self.kept.write_bytes(damaged)
            assert self.whole(self.output, "--resume") == expected, f"{what}: other bytes than without interruption"
            assert not self.kept.exists(), f"{what}: the finished blocks are still there"
            self.output.unlink()
