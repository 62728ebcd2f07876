#!/usr/bin/env python3
"""Checks that the optional parts are ON or OFF, and that the program builds without them.

    optional_parts.py SOURCE FOLDER presets    every preset says ON or OFF for every part of cmake/options.cmake
    optional_parts.py SOURCE FOLDER PART       the program builds in FOLDER without PART (or ALL), and says how to get it
    optional_parts.py SOURCE FOLDER cluster    the program builds with MPI and HDF5, and their tests pass; exit status 77 where their
                                               packages are not installed
"""
import json
import os
import re
import subprocess
import sys
from pathlib import Path


def parts_of(source):
    text = (source / "cmake" / "options.cmake").read_text()
    return re.search(r"set\(STERADIAN_OPTIONAL_PARTS ([A-Z0-9 ]+)\)", text).group(1).split()


def check_presets(source):
    presets = {p["name"]: p for p in json.loads((source / "CMakePresets.json").read_text())["configurePresets"]}

    def variables(name):
        above = presets[name].get("inherits", [])
        merged = {}
        for parent in [above] if isinstance(above, str) else above:
            merged.update(variables(parent))
        return {**merged, **presets[name].get("cacheVariables", {})}

    wrong = [f"{name}: STERADIAN_{part} is {variables(name).get('STERADIAN_' + part)}" for name in presets for part in parts_of(source)
             if variables(name).get("STERADIAN_" + part) not in ("ON", "OFF")]
    print("\n".join(wrong + [f"{len(presets)} presets, {len(parts_of(source))} parts, {len(wrong)} without ON or OFF"]))
    return not wrong


# Parts that the other builds leave out: most machines have no packages for them.
RARE = ["PYTHON", "MPI", "HDF5"]

# A command that needs the part, and the words by which it says how to get it.
DRAWING = "<svg xmlns='http://www.w3.org/2000/svg' width='40' height='20'><text data-steradian='light' x='2' y='15'>A</text></svg>"
NEEDS = {
    "VULKAN": (["render", "{source}/scenes/gallery.glb", "-o", "{folder}/x.png", "--size", "16x9", "--backend", "vulkan"], "STERADIAN_VULKAN=ON"),
    "WINDOW": (["view", "{source}/scenes/gallery.glb"], "STERADIAN_WINDOW=ON"),
    "BENCH": (["bench", "--list"], "STERADIAN_BENCH=ON"),
    "ASSIMP": (["viewfactor", "{folder}/text.obj", "-o", "{folder}/x.npz"], "STERADIAN_ASSIMP=ON"),
    "HDF5": (["viewfactor", "{folder}/text.obj", "-o", "{folder}/x.h5"], "STERADIAN_HDF5=ON"),
    "MPI": (["viewfactor", "{folder}/text.obj", "-o", "{folder}/x.npz"], "STERADIAN_MPI=ON"),
    "FONTS": (["render", "{folder}/text.svg", "-o", "{folder}/x.png"], "STERADIAN_FONTS=ON"),
}


# The environment in which a command needs the part.
UNDER_MPIRUN = {"OMPI_COMM_WORLD_SIZE": "2", "OMPI_COMM_WORLD_RANK": "0"}


def build(source, folder, off):
    on = [p for p in parts_of(source) if p not in off]
    subprocess.run(["cmake", "-G", "Ninja", "-S", source, "-B", folder, "-DCMAKE_BUILD_TYPE=Release", "-DCMAKE_CXX_FLAGS_RELEASE=-O1 -DNDEBUG",
                    "-DCMAKE_CXX_COMPILER_LAUNCHER=ccache", "-DSTERADIAN_TESTS=OFF", "-DSTERADIAN_INSTRUCTION_SETS=sse2", "-DSTERADIAN_UNITY=ON",
                    "-DSTERADIAN_PACK_FLAGS=-O2"] + [f"-DSTERADIAN_{p}=OFF" for p in off] + [f"-DSTERADIAN_{p}=ON" for p in on],
                   check=True, stdout=subprocess.DEVNULL)
    subprocess.run(["cmake", "--build", folder, "--target", "steradian_program"] + (["steradian_bench_program"] if "BENCH" in on else []),
                   check=True, stdout=subprocess.DEVNULL)


def build_cluster(source, folder):
    packages = {"libopenmpi-dev": ["pkg-config", "--exists", "ompi"], "openmpi-bin": ["mpirun", "--version"],
                "libhdf5-dev": ["pkg-config", "--exists", "hdf5-serial"], "python3-h5py": ["/usr/bin/python3", "-c", "import h5py"]}
    for name, probe in packages.items():
        try:
            subprocess.run(probe, check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        except (OSError, subprocess.CalledProcessError):
            print(f"{name} is not installed: ./dev build cluster installs it")
            sys.exit(77)
    build(source, folder / "cluster", ["PYTHON"])
    program, tests = folder / "cluster" / "bin" / "steradian", source / "tests"
    done = [subprocess.run(command).returncode for command in
            ([sys.executable, tests / "ranks_test.py", program, source / "scenes", source / "examples" / "slurm" / "street.py"],
             ["/usr/bin/python3", tests / "hdf5_test.py", program])]
    return done == [0, 0]


def build_without(source, folder, part):
    folder = folder / part
    off = parts_of(source) if part == "ALL" else [part, *(p for p in RARE if p != part)]
    build(source, folder, off)
    (folder / "text.svg").write_text(DRAWING)
    right = True
    for p in off:
        if p not in NEEDS:
            continue
        command, words = NEEDS[p]
        done = subprocess.run([folder / "bin" / "steradian"] + [w.format(source=source, folder=folder) for w in command],
                              capture_output=True, text=True, env={**os.environ, **(UNDER_MPIRUN if p == "MPI" else {})})
        print(f"without {p}: exit {done.returncode}: {done.stderr.strip()}")
        right &= done.returncode in (1, 2) and words in done.stderr
    return right


def main():
    source, folder, what = Path(sys.argv[1]), Path(sys.argv[2]), sys.argv[3]
    checks = {"presets": lambda: check_presets(source), "cluster": lambda: build_cluster(source, folder)}
    sys.exit(not checks.get(what, lambda: build_without(source, folder, what))())


if __name__ == "__main__":
    main()
