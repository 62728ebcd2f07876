#!/usr/bin/env python3
"""Writes the page as one file that opens without a server.

Its parts: page.html, the topics of dist/es/ that the scene uses, the shader of the lights, and the scripts.
"""
import argparse
import base64
import json
import re
import struct
from pathlib import Path

HERE = Path(__file__).resolve().parent
ROOT = HERE.parent.parent
TOPICS = ("math", "polygon", "lobe", "round", "phong", "ltc", "ltc_tables", "ggx", "comparison")  # each after those that it needs
SCRIPTS = ("scene.js", "passes.js", "page.js")


def classic_table():
    """tables/ggx_classic.h as half floats."""
    text = (ROOT / "tables" / "ggx_classic.h").read_text()
    coded = {"size": int(re.search(r"ltc_ggx_size = (\d+)", text).group(1))}
    for name in ("matrix", "magnitude"):
        values = [float(x) for x in re.findall(r"[-+0-9.e]+(?=f)", re.search(rf"ltc_ggx_{name}\[\d+\] = \{{([^}}]*)\}}", text).group(1))]
        assert len(values) == 4 * coded["size"] ** 2, name
        coded[name] = base64.b64encode(struct.pack(f"<{len(values)}e", *values)).decode()
    return f"const LTC_TABLE = {json.dumps(coded)};\n"


def page():
    parts = {
        "@STERADIAN@": "\n" + "\n".join((ROOT / "dist" / "es" / f"{topic}.es.glsl").read_text() for topic in TOPICS),
        "@LIGHT@": "\n" + (HERE / "light.glsl").read_text(),
        "@SCRIPTS@": classic_table() + "\n".join((HERE / name).read_text() for name in SCRIPTS),
    }
    text = (HERE / "page.html").read_text()
    for mark, part in parts.items():
        assert "</script" not in part and text.count(mark) == 1, mark
        text = text.replace(mark, part)
    return text


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("file", type=Path, help="the page to write, e.g. out/web/webgl/index.html")
    out = parser.parse_args().file
    out.parent.mkdir(parents=True, exist_ok=True)
    out.write_text(page())


if __name__ == "__main__":
    main()
