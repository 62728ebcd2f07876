#!/usr/bin/env python3
"""Holds the inclusions of one folder by another to the order of the layers, and draws them.

    layers.py               exit 1 when a file includes one of a layer above its own, or folders include each other in a circle
    layers.py --draw FILE   the picture of the dependencies as SVG
    layers.py --check FILE  exit 1 when that picture is not the one in FILE
    layers.py --test        exit 1 when an inclusion upward or a circle, made up for the purpose, is not found

Tests (x_test.cpp and what is named *_test*) may include anything and are left out.
"""
import re
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent

# From the top to the bottom. A folder may include those of the rows below its own, and of its own row where no circle results.
ROWS = [
    ["apps/steradian"],
    ["apps/bench"],
    ["tests"],
    ["apps/steradian/eval", "apps/viewer", "apps/command_line"],
    ["source/device/plane", "source/bake", "source/solve"],
    ["source/device"],
    ["source/device/frame"],
    ["source/device/surface", "source/device/bounce"],
    ["source/device/shadow"],
    ["source/device/direct"],
    ["source/device/vulkan"],
    ["source/render/frame"],
    ["source/render/bounce", "source/render/certificate", "source/render/shadow", "source/render/many", "source/render/batch"],
    ["source/render/sampled", "source/render/direct", "source/render/radiosity"],
    ["source/render/environment", "source/render/lights"],
    ["source/render/surface"],
    ["source/render/tile"],
    ["source/plane", "source/fit", "source/exchange"],
    ["source/scene", "source/shadow"],
    ["source/integrals", "source/image"],
    ["source/reference"],
    ["source/shapes", "source/lobes"],
    ["source/core"],
    ["include"],
    ["tables", "kernels", "shaders"],
]
ROW = {folder: n for n, row in enumerate(ROWS) for folder in row}

def folder_of(path):
    """The folder of ROWS that a path relative to the root counts for."""
    return next((str(Path(*path.parts[:n])) for n in (3, 2, 1) if str(Path(*path.parts[:n])) in ROW), None)


def included(path):
    """The project's files that a file includes, relative to the root."""
    for name in re.findall(r'^\s*#\s*include\s+["<]([^">]+)[">]', path.read_text(), re.MULTILINE):
        for base in (path.parent, ROOT / "source", ROOT / "include", ROOT / "kernels", ROOT / "apps" / "steradian", ROOT / "apps" / "command_line",
                     ROOT / "apps" / "viewer", ROOT / "apps", ROOT / "tests", ROOT):
            if (base / name).is_file():
                yield (base / name).resolve().relative_to(ROOT)
                break


def inclusions():
    """[(including file, included file)] over all folders, relative to the root."""
    found = []
    for top in ("apps", "source", "include", "tables"):
        for path in sorted((ROOT / top).rglob("*")):
            if path.suffix in (".h", ".cpp") and "_test" not in path.name:
                found += [(path.relative_to(ROOT), other) for other in included(path)]
    return found


def wrong(pairs):
    """What is wrong with a list of inclusions, in words."""
    words, edges = [], {}
    for a, b in pairs:
        for path in (a, b):
            if folder_of(path) is None:
                words.append(f"{path}: its folder stands in no layer (tests/layers.py)")
        from_folder, to_folder = folder_of(a), folder_of(b)
        if None in (from_folder, to_folder) or from_folder == to_folder:
            continue
        if ROW[to_folder] < ROW[from_folder]:
            words.append(f"{a} includes {b}: {to_folder} is above {from_folder}")
        edges.setdefault(from_folder, {})[to_folder] = f"{a} includes {b}"
    for a in edges:
        for b in edges[a]:
            if ROW[a] == ROW[b] and a in edges.get(b, {}) and a < b:
                words.append(f"{a} and {b} include each other: {edges[a][b]}, {edges[b][a]}")
    return sorted(set(words))


def edges_of(pairs):
    return sorted({(folder_of(a), folder_of(b)) for a, b in pairs if folder_of(a) and folder_of(b)} -
                  {(f, f) for f in ROW})


def without_detours(edges):
    """The edges that no longer way through other folders replaces."""
    below = {}
    for a, b in edges:
        below.setdefault(a, set()).add(b)

    def reaches(a, b):
        return any(c == b or reaches(c, b) for c in below.get(a, ()))

    return [(a, b) for a, b in edges if not any(c != b and reaches(c, b) for c in below[a])]


WIDTH, BOX, HEIGHT, STEP, COLUMN = 960, 200, 30, 66, 225


def picture(pairs):
    edges = edges_of(pairs)
    shown = [[f for f in row if any(f in e for e in edges)] for row in ROWS]
    shown = [row for row in shown if row]
    at = {f: (WIDTH / 2 + (i - (len(row) - 1) / 2) * COLUMN, 20 + n * STEP) for n, row in enumerate(shown) for i, f in enumerate(row)}
    height = 20 + (len(shown) - 1) * STEP + HEIGHT + 20
    out = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {height}" font-family="sans-serif" font-size="14">',
           "<!-- Drawn by tests/layers.py: an arrow runs from a folder to one that it includes; what follows from other arrows is left out. -->",
           '<defs><marker id="tip" viewBox="0 0 8 8" refX="8" refY="4" markerWidth="7" markerHeight="7" orient="auto">'
           '<path d="M0 0 8 4 0 8z" fill="#567"/></marker></defs>', f'<rect width="{WIDTH}" height="{height}" fill="#fff"/>']
    for a, b in without_detours(edges):
        (x0, y0), (x1, y1) = at[a], at[b]
        rows = round((y1 - y0) / STEP)
        if rows == 0:  # beside each other
            side = 1 if x1 > x0 else -1
            path = f"M{x0 + side * BOX / 2:g} {y0 + HEIGHT / 2:g}H{x1 - side * BOX / 2:g}"
        elif rows == 1:
            path = f"M{x0:g} {y0 + HEIGHT}L{x1 + (x0 - x1) * 0.25:g} {y1}"
        else:  # around the rows between
            side = 1 if x0 + x1 >= WIDTH else -1
            lane = WIDTH / 2 + side * (COLUMN / 2 + BOX / 2 + 14 + 9 * (rows - 2))
            path = (f"M{x0 + side * BOX / 4:g} {y0 + HEIGHT}C{lane:g} {y0 + HEIGHT + 20} {lane:g} {y0 + HEIGHT + 20} {lane:g} {y0 + STEP}"
                    f"V{y1 - STEP + HEIGHT}C{lane:g} {y1 - 20} {lane:g} {y1 - 20} {x1 + side * BOX / 4:g} {y1}")
        out.append(f'<path d="{path}" fill="none" stroke="#567" stroke-width="1.5" marker-end="url(#tip)"/>')
    for folder, (x, y) in at.items():
        out.append(f'<rect x="{x - BOX / 2:g}" y="{y}" width="{BOX}" height="{HEIGHT}" rx="5" fill="#e8eef4" stroke="#567"/>')
        out.append(f'<text x="{x:g}" y="{y + 20}" text-anchor="middle">{folder}/</text>')
    return "\n".join(out + ["</svg>"]) + "\n"


def self_test():
    up = (Path("source/core/a.h"), Path("source/render/frame/b.h"))
    circle = [(Path("source/plane/a.h"), Path("source/fit/b.h")), (Path("source/fit/c.h"), Path("source/plane/d.h"))]
    nowhere = (Path("source/core/a.h"), Path("source/attic/b.h"))
    down = (Path("source/render/frame/b.h"), Path("source/core/a.h"))
    found = [bool(wrong([up])), bool(wrong(circle)), bool(wrong([nowhere])), not wrong([down])]
    print(f"upward, circle, unknown folder found, downward allowed: {found}")
    sys.exit(not all(found))


def main():
    if sys.argv[1:] == ["--test"]:
        self_test()
    pairs = inclusions()
    if sys.argv[1:2] == ["--draw"]:
        Path(sys.argv[2]).write_text(picture(pairs))
    elif sys.argv[1:2] == ["--check"]:
        if Path(sys.argv[2]).read_text() != picture(pairs):
            sys.exit(f"{sys.argv[2]} is out of date: tests/layers.py --draw {sys.argv[2]}")
    else:
        words = wrong(pairs)
        print("\n".join(words + [f"{len(pairs)} inclusions, {len(edges_of(pairs))} between folders, {len(words)} wrong"]))
        sys.exit(bool(words))


if __name__ == "__main__":
    main()
