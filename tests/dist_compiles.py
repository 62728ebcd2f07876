#!/usr/bin/env python3
"""dist_compiles.py LANGUAGE [SCRATCH]: dist/ in one language (glsl, es, hlsl, wgsl) compiles: the whole alone, the example at its
top as it stands there, each topic after those that its head names, and the shaders of docs/engines.md for engines of this language.

WGSL is checked by naga (naga-wasm from npm, kept in the folder SCRATCH). Exit 77 (skipped) where that cannot be had.
"""
import os
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
NAGA = "naga-wasm@30.1.0"
LONGEST_EXAMPLE = 25  # lines
CHECK = """
import { readFileSync } from "node:fs";
import { parseWgsl, validate } from "naga-wasm";
try {
    validate(parseWgsl(readFileSync(process.argv[2], "utf8")));
} catch (e) {
    console.log(e.formatted ?? e);
    process.exit(1);
}
"""


def skip(why):
    print(f"skipped: {why}")
    sys.exit(77)


def wgsl_command(scratch):
    for tool in ("node", "npm"):
        if not shutil.which(tool):
            skip(f"{tool} is not installed, so there is no naga to check WGSL with")
    scratch.mkdir(parents=True, exist_ok=True)
    if not (scratch / "node_modules" / "naga-wasm" / "dist").exists():
        (scratch / "package.json").write_text('{"private": true, "type": "module"}\n')
        try:
            done = subprocess.run(["npm", "install", "--no-audit", "--no-fund", NAGA], cwd=scratch, capture_output=True,
                                  text=True, timeout=60)
        except subprocess.TimeoutExpired:
            skip(f"npm install {NAGA} took more than a minute")
        if done.returncode != 0:
            skip(f"npm install {NAGA} failed: {done.stderr.strip()[:300]}")
    (scratch / "check.mjs").write_text(CHECK)
    return ["node", str(scratch / "check.mjs")]


def command_for(language, scratch):
    """(text before, text after, suffix, compiler)"""
    if language == "es":
        return ("#version 300 es\nprecision highp float;\n", "out vec4 colour;\nvoid main() { colour = vec4(0.0); }\n",
                ".frag", ["glslangValidator"])
    if language == "glsl":
        return "#version 450\n", "void main() {}\n", ".comp", ["glslc", "-Werror", "-fshader-stage=compute", "-o", os.devnull]
    if language == "hlsl":
        return ("", "[numthreads(1, 1, 1)] void main() {}\n", ".hlsl",
                ["glslangValidator", "-D", "-V", "-S", "comp", "-e", "main", "-o", os.devnull])
    return "", "", ".wgsl", wgsl_command(scratch)


def example_of(text):
    """The first example at the top of a whole file, as a reader copies it."""
    lines = re.search(r"^((?://     [^\n]*\n|//\n(?=//     ))+)", text, re.MULTILINE).group(1).splitlines()
    return "".join(line[len("//     "):] + "\n" for line in lines)


def example_command(language, whole, scratch):
    """(the example's shader, suffix, compiler): what the file's head says that it is."""
    example = example_of(whole.read_text())
    if language == "glsl":
        return example, ".frag", ["glslc", "-Werror", f"-I{whole.parent}", "-o", os.devnull]
    if language == "hlsl":
        return example, ".hlsl", ["glslangValidator", "-D", "-V", "-S", "frag", "-e", "main", f"-I{whole.parent}", "-o", os.devnull]
    if language == "es":
        return f"#version 300 es\nprecision highp float;\n{whole.read_text()}{example}", ".frag", ["glslangValidator"]
    return whole.read_text() + example, ".wgsl", wgsl_command(scratch)


ENGINES = {  # language: what an engine puts around a shader of docs/engines.md, by a word of it
    "hlsl": {"QuadLight_float": ("", "float4 main() : SV_Target { return 0; }\n"),
             "float Diffuse": ('#include "steradian.hlsl"\nfloat3 Custom(float3 Position, float3 Normal, float3 View, float3 A, float3 B, float3 C, '
                               "float3 D, float3 Radiance, float3 Albedo, float Roughness, float3 F0) {\n",
                               "}\nfloat4 main() : SV_Target { return 0; }\n")},
    "es": {"shader_type spatial;": ("#version 300 es\nprecision highp float;\nuniform mat4 VIEW_MATRIX;\nin vec3 VERTEX, NORMAL, VIEW;\nout vec3 EMISSION;\n", "")},
}


def shaders_of_engines(language, whole):
    """{word: shader} of docs/engines.md, with what the engine puts around it."""
    pieces = re.findall(r"```(?:hlsl|glsl)\n(.*?)```", (ROOT / "docs" / "engines.md").read_text(), re.DOTALL)
    found = {}
    for word, (before, after) in ENGINES.get(language, {}).items():
        (piece,) = [p for p in pieces if word in p]
        if language == "es":  # Godot's language has other first lines and another name of main
            piece = piece.replace("shader_type spatial;", "").replace("void fragment()", "void main()")
            piece = piece.replace('#include "res://steradian.gdshaderinc"', whole.read_text())
        found[word] = before + piece + after
    return found


def with_needs(path):
    """The text of a topic after those that its head names."""
    text = path.read_text()
    before = re.search(r"^// It needs these files before it, in this order: (.*)\.$", text, re.MULTILINE)
    assert before or "// It needs no other file." in text, path
    names = before.group(1).split(", ") if before else []
    return "\n".join([(path.parent / name).read_text() for name in names] + [text])


def main():
    language, scratch = sys.argv[1], Path(sys.argv[2]) if len(sys.argv) > 2 else Path("npm")
    before, after, suffix, command = command_for(language, scratch)
    topics = sorted((ROOT / "dist" / language).iterdir())
    whole = ROOT / "dist" / f"steradian{topics[0].name[topics[0].name.index('.'):]}"
    example, example_suffix, example_compiler = example_command(language, whole, scratch)
    lines = example_of(whole.read_text()).count("\n")
    if lines > LONGEST_EXAMPLE or "steradian_ggx_quad(" not in example_of(whole.read_text()):
        sys.exit(f"{language}: the example has {lines} lines, more than {LONGEST_EXAMPLE}, or lights no GGX surface by a quad")
    jobs = {"alone": (before + whole.read_text() + after, suffix, command), f"the example ({lines} lines)": (example, example_suffix, example_compiler)}
    jobs |= {path.name: (before + with_needs(path) + after, suffix, command) for path in topics}
    jobs |= {f"'{word}' of docs/engines.md": (text, example_suffix, example_compiler)
             for word, text in shaders_of_engines(language, whole).items()}
    for what, (text, ending, compiler) in jobs.items():
        with tempfile.TemporaryDirectory() as folder:
            source = Path(folder) / ("dist" + ending)
            source.write_text(text)
            done = subprocess.run(compiler + [str(source)], capture_output=True, text=True)
        if done.returncode != 0:
            print(f"{language}, {what}: {done.stdout}{done.stderr}")
            sys.exit(1)
    print(f"{language}: {', '.join(jobs)} compile")


if __name__ == "__main__":
    main()
