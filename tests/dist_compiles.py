#!/usr/bin/env python3
"""dist_compiles.py LANGUAGE [SCRATCH]: dist/ in one language (glsl, es, hlsl, wgsl) compiles: the whole alone and with the example
at its top, and each topic after those that its head names.

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


def with_needs(path):
    """The text of a topic after those that its head names."""
    text = path.read_text()
    before = re.search(r"^// It comes after (.*)\.$", text, re.MULTILINE)
    names = before.group(1).split(", ") if before else []
    return "\n".join([(path.parent / name).read_text() for name in names] + [text])


def main():
    language = sys.argv[1]
    before, after, suffix, command = command_for(language, Path(sys.argv[2]) if len(sys.argv) > 2 else Path("npm"))
    topics = sorted((ROOT / "dist" / language).iterdir())
    ending = topics[0].name[topics[0].name.index("."):]
    with_usage = subprocess.run([sys.executable, str(ROOT / "dist" / "make_dist.py"), "--with-usage", language],
                                capture_output=True, text=True, check=True).stdout
    texts = {"alone": (ROOT / "dist" / f"steradian{ending}").read_text(), "with its example": with_usage}
    texts |= {path.name: with_needs(path) for path in topics}
    for what, text in texts.items():
        with tempfile.TemporaryDirectory() as folder:
            source = Path(folder) / ("dist" + suffix)
            source.write_text(before + text + after)
            done = subprocess.run(command + [str(source)], capture_output=True, text=True)
        if done.returncode != 0:
            print(f"{language}, {what}: {done.stdout}{done.stderr}")
            sys.exit(1)
    print(f"{language}: {', '.join(texts)} compile")


if __name__ == "__main__":
    main()
