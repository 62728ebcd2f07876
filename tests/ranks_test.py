#!/usr/bin/env python3
"""ranks_test.py PROGRAM SCENES STREET: the program under mpirun has the bytes of one process, also after a rank was killed.

STREET is examples/slurm/street.py. Exit status 77 where mpirun is not installed.
"""
import os
import shutil
import signal
import subprocess
import sys
import tempfile
import time
from pathlib import Path

PROGRAM = str(Path(sys.argv[1]).resolve())
MPI = ["mpirun", "--oversubscribe", "--bind-to", "none"]
ENVIRONMENT = {**os.environ, "OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"}
WAIT = 300  # seconds for one run


def run(folder, command, ranks=1):
    start = [] if ranks == 1 else [*MPI, "-n", str(ranks)]
    return subprocess.run([*start, PROGRAM, *command], cwd=folder, env=ENVIRONMENT, capture_output=True, text=True, timeout=WAIT)


def check_same(one, many, name, files, command):
    """Runs a command in one process and on three ranks, and compares the files."""
    for folder, ranks in ((one, 1), (many, 3)):
        done = run(folder, command, ranks)
        assert done.returncode == 0, f"{name}: {done.stderr}"
    for file in files:
        assert (one / file).read_bytes() == (many / file).read_bytes(), f"{name}: {file} has other bytes"
    left = [p.name for p in many.iterdir() if p.name.endswith(".parts")]
    assert not left, f"{name}: {left} is still there"
    print(f"{name}: the same bytes on 3 ranks")


def check_verbs(one, many, scenes):
    scene = str(scenes / "cornell.glb")
    small = ["--size", "300x200"]
    street = ["viewfactor", "street.obj", "--eps", "1e-4"]
    check_same(one, many, "viewfactor", ["a.npz"], [*street, "-o", "a.npz", "--divide", "6"])
    check_same(one, many, "viewfactor by groups", ["b.mtx"], [*street, "-ob.mtx", "--by", "node", "--drop", "5"])
    check_same(one, many, "render", ["a.exr"], ["render", scene, "-o", "a.exr", *small, "--method", "sampled", "--spp", "2"])
    check_same(one, many, "reference", ["r.exr"], ["render", scene, "-o", "r.exr", "--size", "140x130", "--method", "reference",
                                                   "--target-error", "0.2"])
    check_same(one, many, "render to .png", ["a.png"], ["render", scene, "--output=a.png", *small])
    check_same(one, many, "frames", [f"f_{k}.png" for k in range(5)],
               ["render", str(scenes / "morph.glb"), "-o", "f_#.png", "--frames", "0..4", "--fps", "2", "--size", "64x36"])
    check_same(one, many, "bake", ["baked.glb", "baked.exr"], ["bake", scene, "-o", "baked.glb", "--texels", "2", "--bounces", "1"])
    check_same(one, many, "fit", ["a.json"], ["fit", "--size", "6", "-o", "a.json"])


def check_refusals(folder, scenes):
    for command, status, words in (
            (["viewfactor", "none.obj", "-o", "x.npz"], 1, "cannot find the file none.obj"),
            (["viewfactor", "street.obj", "-o", "x.txt"], 2, "choose one of these endings"),
            (["viewfactor", "street.obj", "-o", "x.npz", "--eps", "7"], 2, "--eps"),
            (["viewfactor", "street.obj"], 2, "-o: is required"),
            (["viewfactor", "street.obj", "-o", "x.npz", "--part", "1/2"], 2, "--part"),
            (["viewfactor", "verify", "x.npz"], 2, "without mpirun"),
            (["render", str(scenes / "cornell.glb"), "-o", "x.exr", "--stats", "x.json"], 2, "--stats"),
            (["bake", str(scenes / "cornell.glb"), "-o", "x.exr"], 2, ".glb or .gltf"),
            (["fit", "--layout", "compact", "-o", "x.dds"], 1, "x.dds"),
            (["eval"], 2, "without mpirun")):
        done = run(folder, command, 3)
        assert done.returncode == status and words in done.stderr, f"{command}: {done.returncode}: {done.stderr}"
        assert done.stderr.count(words) == 1, f"every rank says it: {done.stderr}"
        assert not list(folder.glob("x.*")), f"{command}: {list(folder.glob('x.*'))}"
    (folder / "x.npz.parts").mkdir()
    (folder / "x.npz.parts" / "mine").write_text("a file of the user")
    done = run(folder, ["viewfactor", "street.obj", "-o", "x.npz"], 2)
    assert done.returncode == 1 and "no folder of parts" in done.stderr, done.stderr
    assert (folder / "x.npz.parts" / "mine").exists()
    shutil.rmtree(folder / "x.npz.parts")
    print("10 refusals, each said once")


def processes_of(folder):
    """The processes of the program whose working directory is the folder: [(number, is a rank, command)]."""
    found = []
    for entry in Path("/proc").iterdir():
        try:
            if entry.name.isdigit() and os.readlink(entry / "exe") == PROGRAM and os.readlink(entry / "cwd") == str(folder):
                parent = int((entry / "stat").read_text().rsplit(")", 1)[1].split()[1])
                found.append((int(entry.name), parent))
        except OSError:
            pass
    numbers = {number for number, _ in found}
    return [(number, parent not in numbers) for number, parent in found]


def check_kill(folder, command, output, expected):
    """Kills a rank, and later a part, in the middle; then goes on."""
    parts = folder / (output + ".parts")
    finished = set()
    for victim_is_rank in (True, False):
        start = subprocess.Popen([*MPI, "-n", "3", PROGRAM, *command, "-o", output, "--resume"], cwd=folder, env=ENVIRONMENT, text=True,
                                 stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)
        end = time.monotonic() + WAIT
        while time.monotonic() < end and start.poll() is None:
            files = {p.name for p in parts.glob("*.npz")} if parts.exists() else set()
            if len(files) > len(finished):
                break
            time.sleep(0.002)
        assert start.poll() is None, f"the run ended before the kill: the scene is too small for this machine: {start.stderr.read()}"
        victims = []
        while not victims and start.poll() is None:  # a rank is between two parts for a moment
            victims = [number for number, is_rank in processes_of(folder) if is_rank == victim_is_rank]
        os.kill(victims[-1], signal.SIGKILL)
        said = start.communicate(timeout=WAIT)[1]
        assert start.returncode != 0, said
        # mpirun names the rank that died; rank 0 names a part that died, and how to go on.
        assert ("exited on signal 9" in said) if victim_is_rank else ("a part was ended by a signal: Killed" in said), said
        assert "the same command with --resume goes on" in said, said
        assert not (folder / output).exists(), "a run that was killed has written its output"
        end = time.monotonic() + 10
        while processes_of(folder) and time.monotonic() < end:
            time.sleep(0.01)
        assert not processes_of(folder), "parts of a killed rank go on"
        now = {p.name for p in parts.glob("*.npz")}
        assert now > finished, f"finished parts were lost: {finished} {now}"
        finished = now
        print(f"killed a {'rank' if victim_is_rank else 'part'} after {len(finished)} parts")
    times = {p.name: p.stat().st_mtime_ns for p in parts.glob("*.npz")}
    other = run(folder, ["viewfactor", "street.obj", "--eps", "1e-3", "-o", output, "--resume"], 3)
    assert other.returncode == 1 and "was begun with another scene, other options" in other.stderr, other.stderr
    assert times == {p.name: p.stat().st_mtime_ns for p in parts.glob("*.npz")}
    done = run(folder, [*command, "-o", output, "--resume"], 2)  # another number of ranks
    assert done.returncode == 0, done.stderr
    assert (folder / output).read_bytes() == expected, "other bytes after the kills"
    assert not parts.exists()
    # The program itself runs beside a file that was begun: without --resume it begins anew.
    parts.mkdir()
    (parts / "run").write_text("1\nanother run\n")
    (parts / "1.npz").write_text("damaged")
    done = run(folder, [*command, "-o", output], 2)
    assert done.returncode == 0 and (folder / output).read_bytes() == expected, done.stderr


def main():
    if shutil.which("mpirun") is None:
        print("mpirun is not installed: apt-get install openmpi-bin")
        return 77
    scenes = Path(sys.argv[2]).resolve()
    with tempfile.TemporaryDirectory() as name:
        one, many = Path(name).resolve() / "one", Path(name).resolve() / "many"
        for folder in (one, many):
            folder.mkdir()
            street = subprocess.run([sys.executable, sys.argv[3], "3"], check=True, capture_output=True).stdout
            (folder / "street.obj").write_bytes(street)
        check_verbs(one, many, scenes)
        check_refusals(many, scenes)
        command = ["viewfactor", "street.obj", "--eps", "1e-6", "--divide", "2.5"]
        done = run(one, [*command, "-o", "killed.npz"])
        assert done.returncode == 0, done.stderr
        check_kill(many, command, "killed.npz", (one / "killed.npz").read_bytes())
    return 0


if __name__ == "__main__":
    sys.exit(main())
