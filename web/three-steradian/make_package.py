#!/usr/bin/env python3
"""Writes src/library.js, src/library_wgsl.js and src/tables.js from dist/ and tables/.

    make_package.py            writes them
    make_package.py --check    exit 1 when what is there is not what would be written
"""
import base64
import re
import struct
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


def numbers(text, name):
    body = re.search(name + r"\[\d+\] = \{([^}]*)\}", text).group(1)
    return [float(x.rstrip("f")) for x in re.findall(r"[-+0-9.e]+f?", body)]


def tables():
    text = (ROOT / "tables" / "ggx_classic.h").read_text()
    size = int(re.search(r"ltc_ggx_size = (\d+)", text).group(1))
    coded = {}
    for name in ("matrix", "magnitude"):
        values = numbers(text, "ltc_ggx_" + name)
        assert len(values) == size * size * 4
        coded[name] = base64.b64encode(struct.pack(f"<{len(values)}e", *values)).decode()
    return ("// tables/ggx_classic.h as half floats. Made by web/three-steradian/make_package.py.\n" + LICENCE +
            "import { DataUtils } from 'three';\n\n"
            f"const MATRIX = '{coded['matrix']}';\nconst MAGNITUDE = '{coded['magnitude']}';\n\n"
            "function decoded( text ) {\n\n"
            "\tconst bytes = Uint8Array.from( atob( text ), ( c ) => c.charCodeAt( 0 ) );\n"
            "\tconst view = new DataView( bytes.buffer );\n"
            "\treturn Float32Array.from( { length: bytes.length / 2 }, ( _, i ) => DataUtils.fromHalfFloat( view.getUint16( 2 * i, true ) ) );\n\n"
            "}\n\n"
            "export function ltcTables() {\n\n"
            f"\treturn {{ size: {size}, matrix: decoded( MATRIX ), magnitude: decoded( MAGNITUDE ) }};\n\n"
            "}\n")


def main():
    for name, text in (("library.js", library("LIBRARY", "es", ".es.glsl")), ("library_wgsl.js", library("LIBRARY_WGSL", "wgsl", ".wgsl")),
                       ("tables.js", tables())):
        path = HERE / "src" / name
        if sys.argv[1:] == ["--check"]:
            if not path.exists() or path.read_text() != text:
                sys.exit(f"{path} is not what web/three-steradian/make_package.py writes: run it")
        else:
            path.write_text(text)


if __name__ == "__main__":
    main()
