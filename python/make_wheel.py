#!/usr/bin/env python3
"""make_wheel.py PACKAGE PROGRAM OUT: the module and the program as a wheel that pip installs.

    PACKAGE   the folder `steradian` of a build, with its _core
    PROGRAM   the program of the same build: python -m steradian runs it

The libraries that both ask for go along, in steradian/lib, but for glibc: the wheel is for Linux on x86-64 with a glibc as new as the
builder's, and for the Python that the module was built for. numpy is asked for. Python's standard library alone.
"""
import base64
import hashlib
import re
import subprocess
import sys
import zipfile
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
sys.dont_write_bytecode = True
sys.path.insert(0, str(ROOT / "tools"))
import make_package  # noqa: E402

ABOUT = """Metadata-Version: 2.1
Name: steradian
Version: {version}
Summary: Light computed without sampling: area light integrals in closed form
License: MIT
Requires-Python: =={python}.*
Requires-Dist: numpy
Description-Content-Type: text/markdown

"""
WHEEL = "Wheel-Version: 1.0\nGenerator: steradian/python/make_wheel.py\nRoot-Is-Purelib: false\nTag: {tag}\n"


def contents(package, program):
    """Path in the wheel, and where its bytes are."""
    files = {f"steradian/{path.name}": path for path in package.iterdir() if path.suffix in (".py", ".pyi", ".so") or path.name == "py.typed"}
    modules = [path for path in files.values() if path.suffix == ".so"]
    assert len(modules) == 1, f"{package} has {len(modules)} modules: build steradian_python"
    files["steradian/bin/steradian"] = program
    for binary in (*modules, program):
        for name, path in make_package.libraries(binary).items():
            files[f"steradian/lib/{name}"] = path.resolve()
    return files, modules[0]


def write(package, program, out):
    files, module = contents(package, program)
    found = re.fullmatch(r"_core\.cpython-(\d)(\d+)-x86_64-linux-gnu\.so", module.name)
    assert found, f"{module.name} is of no Python on Linux and x86-64"
    version = subprocess.run([program, "--version"], capture_output=True, text=True, check=True).stdout.split()[-1]
    cp = f"cp{found[1]}{found[2]}"
    tag, about = f"{cp}-{cp}-linux_x86_64", f"steradian-{version}.dist-info"
    texts = {
        f"{about}/METADATA": ABOUT.format(version=version, python=f"{found[1]}.{found[2]}") + (ROOT / "README.md").read_text(),
        f"{about}/WHEEL": WHEEL.format(tag=tag),
        f"{about}/LICENSE": (ROOT / "LICENSE").read_text(),
    }
    record = []
    out.mkdir(parents=True, exist_ok=True)
    wheel = out / f"steradian-{version}-{tag}.whl"
    partial = wheel.with_name(wheel.name + ".part")
    with zipfile.ZipFile(partial, "w", zipfile.ZIP_DEFLATED) as archive:

        def put(name, data, mode=0o644):
            info = zipfile.ZipInfo(name, (1980, 1, 1, 0, 0, 0))  # the same bytes from the same build
            info.external_attr, info.compress_type = (0o100000 | mode) << 16, zipfile.ZIP_DEFLATED
            archive.writestr(info, data)
            digest = base64.urlsafe_b64encode(hashlib.sha256(data).digest()).rstrip(b"=").decode()
            record.append(f"{name},sha256={digest},{len(data)}")

        for name, path in sorted(files.items()):
            put(name, path.read_bytes(), 0o755 if "/bin/" in name else 0o644)
        for name, text in texts.items():
            put(name, text.encode())
        record.append(f"{about}/RECORD,,\n")
        archive.writestr(zipfile.ZipInfo(f"{about}/RECORD", (1980, 1, 1, 0, 0, 0)), "\n".join(record))
    partial.rename(wheel)
    return wheel


def main():
    if len(sys.argv) != 4:
        sys.exit(__doc__)
    wheel = write(Path(sys.argv[1]), Path(sys.argv[2]).resolve(), Path(sys.argv[3]))
    print(f"{wheel} ({wheel.stat().st_size / 1e6:.0f} MB)")


if __name__ == "__main__":
    main()
