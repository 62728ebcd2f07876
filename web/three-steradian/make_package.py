#!/usr/bin/env python3
"""Writes src/library.js and src/library_wgsl.js from dist/; src/tables.js is fit_tables.py's.

    make_package.py            writes them
    make_package.py --check    exit 1 when what is there is not what would be written
"""
import re
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
ROOT = HERE.parent.parent
TOPICS = ("math", "polygon", "lobe", "round", "phong", "ltc", "ltc_tables", "ggx")  # each after those that it needs
LICENCE = "// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.\n"


def library(name, folder, ending):
    texts = []
    for topic in TOPICS:
        text = (ROOT / "dist" / folder / f"{topic}{ending}").read_text()
        text = re.sub(r"//[^\n]*", "", text)  # a page loads code; the comments are in dist/
        texts.append(re.sub(r"\n\s*\n+", "\n", text).strip())
    body = "\n".join(texts)
    assert "`" not in body and "${" not in body
    return ("// The topics " + ", ".join(TOPICS) + f" of dist/{folder}, without their comments.\n// Made by web/three-steradian/make_package.py.\n" +
            LICENCE + f"export const {name} = `\n" + body + "\n`;\n")


def main():
    for name, text in (("library.js", library("LIBRARY", "es", ".es.glsl")), ("library_wgsl.js", library("LIBRARY_WGSL", "wgsl", ".wgsl"))):
        path = HERE / "src" / name
        if sys.argv[1:] == ["--check"]:
            if not path.exists() or path.read_text() != text:
                sys.exit(f"{path} is not what web/three-steradian/make_package.py writes: run it")
        else:
            path.write_text(text)


if __name__ == "__main__":
    main()
