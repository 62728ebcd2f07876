#!/usr/bin/env python3
"""Writes index.html: page.html with its parts in it, so that it opens from a file without a server.

The parts: the topics of dist/es/ that the scene uses, the scene's shader, and the script.

    make_page.py            writes it
    make_page.py --check    exit 1 when what is there is not what would be written
"""
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
ROOT = HERE.parent.parent


# The topics of dist/ that the scene uses, each after those that it needs.
TOPICS = ("math", "polygon", "lobe", "round", "phong", "ltc", "ltc_tables", "ggx")


def main():
    library = "\n".join((ROOT / "dist" / "es" / f"{topic}.es.glsl").read_text() for topic in TOPICS)
    parts = {"@STERADIAN@": "\n" + library, "@SCENE@": (HERE / "scene.glsl").read_text(), "@PAGE@": (HERE / "page.js").read_text()}
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
