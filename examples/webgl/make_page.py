#!/usr/bin/env python3
"""Writes index.html: page.html with its parts in it, so that it opens from a file without a server.

The parts: dist/steradian.es.glsl, the scene's shader, the script, and the compact GGX table that the library ships.

    make_page.py            writes it
    make_page.py --check    exit 1 when what is there is not what would be written
"""
import json
import re
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent


ROOT = HERE.parent.parent


def ltc_compact():
    """The shipped table's words: shapes, then magnitudes, as the uniform block of scene.glsl has them."""
    text = (ROOT / "source" / "ltc" / "ggx_compact.h").read_text()
    arrays = [re.findall(r"0x[0-9a-f]{8}", body) for body in re.findall(r"unsigned int \w+\[\d+\] = {(.*?)}", text, re.S)]
    assert [len(a) for a in arrays] == [512, 484], "scene.glsl is written for 16 x 16 shapes and 22 x 22 magnitudes"
    return json.dumps([int(word, 16) for a in arrays for word in a], separators=(",", ":"))


def main():
    parts = {"@STERADIAN@": "\n" + (ROOT / "dist" / "steradian.es.glsl").read_text(), "@LTC_COMPACT@": ltc_compact(),
             "@SCENE@": (HERE / "scene.glsl").read_text(), "@PAGE@": (HERE / "page.js").read_text()}
    page = (HERE / "page.html").read_text()
    for mark, part in parts.items():
        assert "</script" not in part and page.count(mark) == 1, mark
        page = page.replace(mark, part)
    path = HERE / "index.html"
    if sys.argv[1:] == ["--check"]:
        if not path.exists() or path.read_text() != page:
            sys.exit(f"{path} is not what examples/webgl/make_page.py writes: run it")
    else:
        path.write_text(page)


if __name__ == "__main__":
    main()
