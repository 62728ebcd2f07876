"""Packages as a stranger gets them: packed by npm, and installed from the tarball into an empty project."""
import json
import shutil
import subprocess
from pathlib import Path


def run(command, folder, timeout=120):
    """Standard output. RuntimeError with what the command says if it fails."""
    done = subprocess.run([str(c) for c in command], cwd=folder, capture_output=True, text=True, timeout=timeout)
    if done.returncode != 0:
        raise RuntimeError(f"{' '.join(map(str, command))}: {(done.stdout + done.stderr).strip()[-1500:]}")
    return done.stdout


def pack(package, folder):
    """(tarball, the names in it): what `npm publish` would send."""
    folder.mkdir(parents=True, exist_ok=True)
    (said,) = json.loads(run(["npm", "pack", "--json", "--pack-destination", folder.resolve(), package.resolve()], folder))
    return folder / said["filename"].replace("@", "").replace("/", "-"), {entry["path"] for entry in said["files"]}


def install(folder, *packages):
    """An empty project in the folder with these packages: tarballs, or names that npm knows."""
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    (folder / "package.json").write_text('{"private": true, "type": "module"}\n')
    run(["npm", "install", "--no-audit", "--no-fund", "--prefer-offline", *(p.resolve() if isinstance(p, Path) else p for p in packages)], folder)


def check_exports(installed, files):
    """Everything that the package names is in the tarball, and nothing that only its repository needs."""
    about = json.loads((installed / "package.json").read_text())
    named = {about["main"], about["types"], *(path for entry in about["exports"].values() for path in entry.values())}
    missing = {n.removeprefix("./") for n in named} | {"README.md", "LICENSE"}
    missing -= {str(p.relative_to(installed)) for p in installed.rglob("*") if p.is_file()}
    assert not missing, f"{about['name']}: the tarball lacks {missing}"
    more = {f for f in files if f.split("/")[0] in ("test", "example", "page", "source", "shaders") or f.endswith((".py", ".txt"))}
    assert not more, f"{about['name']}: the tarball holds {more}"


def module(folder, text):
    """What a module of the project prints, run by node."""
    (folder / "use.mjs").write_text(text)
    return run(["node", "use.mjs"], folder).strip()
