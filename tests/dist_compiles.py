#!/usr/bin/env python3
"""dist_compiles.py FILE [SCRATCH]: one file of dist/ compiles alone, and so does the example at its top.

WGSL is checked by naga (naga-wasm from npm, kept in the folder SCRATCH). Exit 77 (skipped) where that cannot be had.
"""
import os
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
NAGA = "naga-wasm@30.1.0"
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


def command_for(name, scratch):
    """(text before, text after, suffix, compiler)"""
    if name.endswith(".es.glsl"):
        return ("#version 300 es\nprecision highp float;\n", "out vec4 colour;\nvoid main() { colour = vec4(0.0); }\n",
                ".frag", ["glslangValidator"])
    if name.endswith(".glsl"):
        return "#version 450\n", "void main() {}\n", ".comp", ["glslc", "-Werror", "-fshader-stage=compute", "-o", os.devnull]
    if name.endswith(".hlsl"):
        return ("", "[numthreads(1, 1, 1)] void main() {}\n", ".hlsl",
                ["glslangValidator", "-D", "-V", "-S", "comp", "-e", "main", "-o", os.devnull])
    return "", "", ".wgsl", wgsl_command(scratch)


def main():
    name = sys.argv[1]
    before, after, suffix, command = command_for(name, Path(sys.argv[2]) if len(sys.argv) > 2 else Path("npm"))
    alone = (ROOT / "dist" / name).read_text()
    with_usage = subprocess.run([sys.executable, str(ROOT / "dist" / "make_dist.py"), "--with-usage", name],
                                capture_output=True, text=True, check=True).stdout
    for what, text in (("alone", alone), ("with its example", with_usage)):
        with tempfile.TemporaryDirectory() as folder:
            source = Path(folder) / ("dist" + suffix)
            source.write_text(before + text + after)
            done = subprocess.run(command + [str(source)], capture_output=True, text=True)
        if done.returncode != 0:
            print(f"{name} {what}: {done.stdout}{done.stderr}")
            sys.exit(1)
        print(f"{name} compiles {what}")


if __name__ == "__main__":
    main()
