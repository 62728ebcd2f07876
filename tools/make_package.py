#!/usr/bin/env python3
"""The program with all that it needs but the C library, as one folder that runs from anywhere.

usage: make_package.py PROGRAM VERSION OUT      (OUT/steradian-VERSION-linux-x86_64/ and .tar.gz beside it)

    bin/steradian       the program, which finds its libraries by their place beside it
    lib/                those libraries, and the loader of Vulkan (a driver is the machine's own)
    share/man/          the manual page
    share/...           the completions of bash, zsh and fish, in the folders where these shells look
    share/steradian/    scenes, the shader files and tables of dist/, the licence and the manual's pages

The libraries are the machine's on which the program was built (ldd); glibc stays out, since it belongs to the kernel's side of a machine:
the package asks for one as new as the builder's. Python's standard library alone.
"""
import re
import shutil
import subprocess
import sys
import tarfile
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
# Libraries of glibc and the kernel; every machine that runs a program has these.
OF_THE_SYSTEM = re.compile(r"^(linux-vdso|ld-linux|libc\.so|libm\.so|libdl\.so|libpthread\.so|librt\.so)")
LOADED_WHEN_ASKED_FOR = ["libvulkan.so.1"]
TEXTS = {  # what the program prints of itself, and where `cmake --install` puts it, too (apps/steradian/CMakeLists.txt)
    "share/man/man1/steradian.1": ["man"],
    "share/bash-completion/completions/steradian": ["completion", "bash"],
    "share/zsh/site-functions/_steradian": ["completion", "zsh"],
    "share/fish/vendor_completions.d/steradian.fish": ["completion", "fish"],
}


def libraries(program):
    """Name and path of each library that the program, or a library of it, is linked to."""
    found = {}
    for line in subprocess.run(["ldd", program], capture_output=True, text=True, check=True).stdout.splitlines():
        match = re.match(r"\s*(\S+) => (\S+)", line)
        if line.strip().endswith("not found"):
            sys.exit(f"make_package: {program}: {line.strip()}")
        if match and not OF_THE_SYSTEM.match(match[1]):
            found[match[1]] = Path(match[2])
    return found


def asked_for(name):
    """The path of a library that the program opens by its name, or None."""
    for line in subprocess.run(["/sbin/ldconfig", "-p"], capture_output=True, text=True).stdout.splitlines():
        match = re.match(rf"\s*{re.escape(name)} \(.*x86-64.*\) => (\S+)", line)
        if match:
            return Path(match[1])
    return None


def make(program, folder):
    """Fills the folder; returns the names of the libraries."""
    for part in ("bin", "lib", "share/steradian"):
        (folder / part).mkdir(parents=True)
    shutil.copy2(program, folder / "bin" / "steradian")
    found = libraries(program)
    for name in LOADED_WHEN_ASKED_FOR:
        if path := asked_for(name):
            found[name] = path
    for name, path in found.items():
        shutil.copy2(path.resolve(), folder / "lib" / name)
    for name, verb in TEXTS.items():
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        (folder / name).write_text(subprocess.run([program, *verb], capture_output=True, text=True, check=True).stdout)
    share = folder / "share" / "steradian"
    scenes = [s for pattern in ("*.glb", "plane/*.svg") for s in (ROOT / "scenes").glob(pattern)]
    for scene in scenes:
        to = share / "scenes" / scene.relative_to(ROOT / "scenes")
        to.parent.mkdir(parents=True, exist_ok=True)
        shutil.copy2(scene, to)
    shutil.copytree(ROOT / "dist", share / "dist", ignore=shutil.ignore_patterns("*.py", "__pycache__", "source"))
    shutil.copytree(ROOT / "docs", share / "docs", ignore=shutil.ignore_patterns("*.py", "__pycache__"))
    for name in ("LICENSE", "README.md", "CHANGELOG.md"):
        shutil.copy2(ROOT / name, share / name)
    return sorted(found)


def main():
    if len(sys.argv) != 4:
        sys.exit(__doc__)
    program, version, out = Path(sys.argv[1]), sys.argv[2], Path(sys.argv[3])
    folder = out / f"steradian-{version}-linux-x86_64"
    if folder.exists():
        shutil.rmtree(folder)
    names = make(program, folder)
    archive = folder.with_name(folder.name + ".tar.gz")
    partial = archive.with_name(archive.name + ".part")
    with tarfile.open(partial, "w:gz", compresslevel=6) as tar:
        tar.add(folder, arcname=folder.name)
    partial.rename(archive)
    print(f"{archive} ({archive.stat().st_size / 1e6:.0f} MB, {len(names)} libraries)")


if __name__ == "__main__":
    main()
