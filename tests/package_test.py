"""The package in an empty root: the program runs with glibc and nothing else of the machine's.

usage: package_test.py PROGRAM
"""
import json
import os
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "tools"))
import make_package  # noqa: E402

QUERY = {"light": {"type": "rect", "center": [0, 0, 1], "x": [0.5, 0, 0], "y": [0, -0.5, 0]}, "position": [0, 0, 0],
         "normal": [0, 0, 1], "material": {"brdf": "lambert"}}
SKIPPED = 77


def glibc(root):
    """The C library and its loader, where the program looks for them."""
    for path in ("/lib64/ld-linux-x86-64.so.2", *(f"/lib/x86_64-linux-gnu/{n}" for n in
                 ("libc.so.6", "libm.so.6", "libdl.so.2", "libpthread.so.0", "librt.so.1"))):
        if Path(path).exists():
            to = root / path[1:]
            to.parent.mkdir(parents=True, exist_ok=True)
            shutil.copy2(Path(path).resolve(), to)


def inside(root, *command, text=None):
    """Runs a command in the root, in name spaces of its own: with /proc, by which a program knows its own place, and nothing left behind."""
    own = [] if os.geteuid() == 0 else ["--user", "--map-root-user"]
    enter = ["unshare", *own, "--mount", "--pid", "--fork", "sh", "-c", 'mount -t proc proc "$0/proc" && exec chroot "$0" "$@"', str(root)]
    return subprocess.run([*enter, *command], input=text, capture_output=True, text=True, env={"PATH": "/usr/sbin:/usr/bin:/sbin:/bin"},
                          timeout=120)


def check_texts(root, package):
    """The manual page and the completions are those that the program in the package prints; the shader files come without their makers."""
    texts = {"man/man1/steradian.1": ("man", ".TH"), "bash-completion/completions/steradian": ("completion bash", "complete "),
             "zsh/site-functions/_steradian": ("completion zsh", "#compdef steradian"),
             "fish/vendor_completions.d/steradian.fish": ("completion fish", "complete -c steradian")}
    for name, (verb, mark) in texts.items():
        said = inside(root, "/opt/steradian/bin/steradian", *verb.split())
        assert said.returncode == 0 and mark in said.stdout, f"{verb}: {said.stdout[:200]}{said.stderr}"
        assert (package / "share" / name).read_text() == said.stdout, f"share/{name} is not what `steradian {verb}` prints"
    shaders = package / "share" / "steradian" / "dist"
    assert (shaders / "steradian.glsl").exists() and not list(shaders.rglob("*.py")) and not (shaders / "source").exists(), shaders


def main():
    with tempfile.TemporaryDirectory() as folder:
        root = Path(folder)
        package = root / "opt" / "steradian"
        names = make_package.make(Path(sys.argv[1]), package)
        assert not any(make_package.OF_THE_SYSTEM.match(n) for n in names), names
        glibc(root)
        (root / "tmp").mkdir()
        (root / "proc").mkdir()
        program = "/opt/steradian/bin/steradian"
        version = inside(root, program, "--version")
        if "unshare:" in version.stderr or "mount:" in version.stderr:
            print("no root of its own is to be had here:", version.stderr)
            sys.exit(SKIPPED)
        assert version.returncode == 0, version.stderr

        answer = inside(root, program, "eval", text=json.dumps(QUERY) + "\n")
        radiance = json.loads(answer.stdout)["radiance"][0]
        assert abs(radiance - 0.2394564705) < 1e-9, answer.stdout  # a unit square over its own centre: the form factor

        scenes = "/opt/steradian/share/steradian/scenes"
        for scene in ("gallery.glb", "plane/lamps.svg"):
            size = ["--size", "64x36"] if scene.endswith("glb") else []
            made = inside(root, program, "render", f"{scenes}/{scene}", *size, "-o", "/tmp/picture.png")
            assert made.returncode == 0, made.stderr
            assert (root / "tmp" / "picture.png").stat().st_size > 500
        check_texts(root, package)
        info = inside(root, program, "info")
        assert info.returncode == 0, info.stderr


main()
