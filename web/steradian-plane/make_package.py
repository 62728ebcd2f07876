#!/usr/bin/env python3
"""make_package.py BUILD OUT: builds the module by emscripten in BUILD, and writes the npm package into OUT; in it room.html, the page as one
file that works without a server.
"""
import base64
import lzma
import re
import shutil
import subprocess
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
ROOT = HERE.parent.parent
MODULES = ("plane_wasm", "plane_glsl", "unpack", "letters", "wasm", "bodies", "gl_light", "picture", "index")  # each after those that it imports


def build(folder):
    """The module's path, or what fails, on standard error."""
    commands = [["cmake", "--build", str(folder)]]
    if not (folder / "build.ninja").exists():
        commands.insert(0, ["emcmake", "cmake", "-B", str(folder), "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release", str(HERE)])
    for command in commands:
        done = subprocess.run(command, capture_output=True, text=True)
        if done.returncode != 0:
            sys.exit(f"{' '.join(command)}:\n{done.stdout[-3000:]}{done.stderr[-3000:]}")
    return folder / "plane.wasm"


def wasm_module(path):
    """Packed as src/unpack.js unpacks it."""
    module = path.read_bytes()
    packed = lzma.compress(module, format=lzma.FORMAT_RAW, filters=[{"id": lzma.FILTER_LZMA1, "preset": 9 | lzma.PRESET_EXTREME, "lc": 3, "lp": 0, "pb": 0}])
    return ("// The WebAssembly module, packed by LZMA, as base64, and its size. Made by make_package.py.\n"
            f'export const PLANE_SIZE = {len(module)};\nexport const PLANE_WASM = "{base64.b64encode(packed).decode()}";\n')


def included(path, seen):
    """A shader's text with what it includes, each file once, without comments."""
    path = path.resolve()
    if path in seen:
        return ""
    seen.add(path)
    text = re.sub(r"//[^\n]*", "", path.read_text())
    return re.sub(r'^#include "([^"]*)"$', lambda m: included(path.parent / m[1], seen), text, flags=re.M)


def closing(text, at):
    """Where the bracket that opens before `at` closes."""
    depth = 1
    while depth:
        depth += {"[": 1, "]": -1}.get(text[at], 0)
        at += 1
    return at


def as_es(path, library):
    """A shader of the back end's for Vulkan in GLSL ES 3.00: buffers become functions that read textures, kernels have the library's names."""
    text = included(path, set())
    for name in ("lists", "pairs", "masks", "vertices"):
        while found := re.search(rf"\b{name}\[", text):
            end = closing(text, found.end())
            text = f"{text[:found.start()]}{name}_at(uint({text[found.end():end - 1]})){text[end:]}"
    text = text.replace("findLSB(", "findLSB_of(")
    text = re.sub(r"\b((?:plane|trig)_\w+|inverse_two_pi|smallest_divisor)(?=\()", lambda m: "steradian_" + m[1] if f"steradian_{m[1]}(" in library else m[1], text)
    text = re.sub(r"\bPlane[A-Z]\w*", lambda m: "Steradian" + m[0] if f"struct Steradian{m[0]} " in library else m[0], text)
    return re.sub(r"\n\s*\n+", "\n", text).strip() + "\n"


def needed(library, texts):
    """What texts ask for of a library's definitions, and those of each other, in their order."""
    pieces, depth, piece = [], 0, ""
    for line in library.splitlines(keepends=True):
        piece += line
        depth += line.count("{") - line.count("}")
        if depth == 0 and line.rstrip().endswith(("}", ";")):
            pieces.append(piece)
            piece = ""
    names = lambda text: set(re.findall(r"\b[sS]teradian\w+", text))
    defines = [set(re.findall(r"\b[sS]teradian\w+", p.split("(")[0].split("{")[0].split("=")[0])[-1:]) for p in pieces]
    wanted, kept = set().union(*map(names, texts)), set()
    while more := {i for i, d in enumerate(defines) if d & wanted} - kept:
        kept |= more
        wanted |= set().union(*(names(pieces[i]) for i in more))
    return "".join(pieces[i] for i in sorted(kept))


def glsl_module():
    library = "".join(re.sub(r"//[^\n]*", "", (ROOT / "dist" / "es" / f"{topic}.es.glsl").read_text()) for topic in ("math", "plane"))
    library = re.sub(r"\n\s*\n+", "\n", library)
    texts = {re.sub(r"\W", "_", p.name).upper(): as_es(p, library) for p in sorted((HERE / "shaders").glob("*.*")) if p.suffix != ".glsl"}
    texts["LIBRARY"] = needed(library, texts.values())
    assert not any("`" in t or "${" in t for t in texts.values())
    return "// The shaders of pictures by WebGL2. Made by make_package.py.\n" + "".join(f"export const {name} = `{text}`;\n" for name, text in texts.items())


def as_block(name, text):
    """A module as a block of its own in a script: what it exports is returned, what it imports is taken from the blocks before."""
    text = re.sub(r'^import \{([^}]*)\} from "\./(\w+)\.js";$', r"const {\1} = from_\2;", text, flags=re.M)
    given = []
    for names in re.findall(r"^export \{([^}]*)\};$", text, flags=re.M):
        given += [n.strip() for n in names.split(",")]
    given += re.findall(r"^export (?:async )?(?:const|class|function) (\w+)", text, flags=re.M)
    text = re.sub(r"^export \{[^}]*\};$\n", "", text, flags=re.M)
    text = re.sub(r"^export ", "", text, flags=re.M)
    return f"const from_{name} = (() => {{\n{text}return {{ {', '.join(given)} }};\n}})();\n"


def room(modules):
    page = (HERE / "page" / "room.html").read_text()
    script = "".join(as_block(name, modules[name]) for name in MODULES)
    script += re.sub(r'^import \{([^}]*)\} from "[^"]*";$', r"const {\1} = from_index;", (HERE / "page" / "room.js").read_text(), flags=re.M)
    assert "</script" not in script
    tag = '<script type="module" src="room.js"></script>'
    assert tag in page
    return page.replace(tag, '<script type="module">\n' + script + '</script>')


def main():
    wasm, out = build(Path(sys.argv[1])), Path(sys.argv[2])
    modules = {name: (HERE / "src" / f"{name}.js").read_text() for name in MODULES if not name.startswith("plane_")}
    modules |= {"plane_wasm": wasm_module(wasm), "plane_glsl": glsl_module()}
    (out / "src").mkdir(parents=True, exist_ok=True)
    for name, text in modules.items():
        (out / "src" / f"{name}.js").write_text(text)
    shutil.copy(HERE / "src" / "index.d.ts", out / "src")
    for name in ("package.json", "README.md", "LICENSE"):
        shutil.copy(HERE / name, out)
    (out / "room.html").write_text(room(modules))


if __name__ == "__main__":
    main()
