#!/usr/bin/env python3
"""Writes index.html: page.html with dist/steradian.es.glsl in it, so that it opens from a file without a server.

    make_page.py            writes it
    make_page.py --check    exit 1 when what is there is not what would be written
"""
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent


def main():
    library = (HERE.parent.parent / "dist" / "steradian.es.glsl").read_text()
    assert "</script" not in library
    page = (HERE / "page.html").read_text().replace("@STERADIAN@", "\n" + library)
    path = HERE / "index.html"
    if sys.argv[1:] == ["--check"]:
        if not path.exists() or path.read_text() != page:
            sys.exit(f"{path} is not what examples/webgl/make_page.py writes: run it")
    else:
        path.write_text(page)


if __name__ == "__main__":
    main()
