#!/usr/bin/env python3
"""run.py BUILD MACHINE...: builds the libraries `integrals` and `plane` for other machines in BUILD, and runs their tests there.

A MACHINE is arm64 (by qemu-user) or windows (by wine). Exit 77 (skipped) where a tool is not installed; then the Debian package is named.
"""
import argparse
import os
import re
import shutil
import subprocess
import sys
import time
from pathlib import Path

HERE = Path(__file__).resolve().parent
# Each machine: its compiler and what runs its programs, with their Debian packages; and the end of a program's name.
MACHINES = {
    "arm64": (("aarch64-linux-gnu-g++", "g++-aarch64-linux-gnu"), ("qemu-aarch64-static", "qemu-user-static"), ""),
    "windows": (("x86_64-w64-mingw32-g++-posix", "g++-mingw-w64-x86-64-posix"), ("wine", "wine"), ".exe"),
}
# Tests that need a font of the machine.
WITHOUT_FONTS = "-LoadSvg.TextIsOutlines:LoadSvg.NamesTheFontThatStandsInForAnother"


def skip(why):
    print(f"skipped: {why}")
    sys.exit(77)


def build(machine, folder):
    """Configures and builds, or ends with what fails."""
    configure = ["cmake", "-S", HERE, "-B", folder, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release", f"-DCMAKE_TOOLCHAIN_FILE={HERE / machine}.cmake"]
    if shutil.which("ccache"):
        configure.append("-DCMAKE_CXX_COMPILER_LAUNCHER=ccache")
    for command in (configure, ["cmake", "--build", folder]):
        done = subprocess.run([str(c) for c in command], capture_output=True, text=True)
        if done.returncode != 0:
            sys.exit(f"{' '.join(map(str, command))}:\n{(done.stdout + done.stderr)[-4000:]}")


def test(machine, folder):
    """Runs the two programs. Returns false if a test fails."""
    _, (runner, _), end = MACHINES[machine]
    passed = True
    for name in ("integrals_tests", "plane_tests"):
        start = time.monotonic()
        done = subprocess.run([runner, folder / (name + end), "--gtest_brief=1", f"--gtest_filter={WITHOUT_FONTS}"], capture_output=True, text=True,
                              errors="replace", env={**os.environ, "WINEDEBUG": "-all"}, timeout=7000)
        found = re.search(r"\[==========\] (\d+) tests? from", done.stdout)
        print(f"{machine}, {name}: {found[1] if found else 'no'} tests in {time.monotonic() - start:.0f} s, {'passed' if done.returncode == 0 else 'FAILED'}")
        if done.returncode != 0:
            print("\n".join(line for line in done.stdout.splitlines() if re.search(r"Failure|FAILED|Expected|actual|_test\.cpp", line))[-4000:])
            print(done.stderr[-1000:])
            passed = False
    return passed


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build", type=Path, help="folder for the builds, one for each machine in it")
    parser.add_argument("machines", nargs="*", metavar="MACHINE", default=list(MACHINES), help=f"any of {', '.join(MACHINES)}; all of them if there is none")
    asked = parser.parse_args()
    for machine in asked.machines:
        if machine not in MACHINES:
            parser.error(f"there is no machine '{machine}': there are {', '.join(MACHINES)}")
    for machine in asked.machines:
        for tool, package in MACHINES[machine][:2]:
            if not shutil.which(tool):
                skip(f"{tool} is not installed (apt-get install {package}, or ./dev setup --all)")
    passed = []
    for machine in asked.machines:
        folder = asked.build.resolve() / machine
        build(machine, folder)
        passed.append(test(machine, folder))
    sys.exit(0 if all(passed) else 1)


if __name__ == "__main__":
    main()
