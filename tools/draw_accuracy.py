#!/usr/bin/env python3
"""draw_accuracy.py [docs/measured/accuracy.md [docs/images/accuracy-ggx.svg]]: the maps of GGX's errors over roughness and view as one plot.

Reads the tables that `./dev accuracy` writes below "GGX with shadowing and Fresnel": a panel for each, darker where the error is
larger, on a scale of decades. Standard library only.
"""

import math
import re
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
CELL_W, CELL_H, LEFT, TOP, RIGHT, BOTTOM, COLUMNS = 44, 24, 44, 42, 14, 20, 2
LOW, HIGH = 1e-4, 1.0


def maps_of(text):
    """(title, views, [(roughness, values)...]) of each map."""
    section = text[text.index("## GGX with shadowing and Fresnel"):]
    section = section[:section.index("\n## ", 3)]
    found = []
    for title, head, body in re.findall(r"\n([^\n|]+):\n\n\| roughness \|([^\n]*)\n\|[-:|]+\n((?:\|[^\n]*\n)+)", section):
        views = [v.strip() for v in head.strip(" |").split("|")]
        rows = []
        for line in body.splitlines():
            roughness, *values = [c.strip() for c in line.strip("|").split("|")]
            rows.append((roughness, [float(v) for v in values]))
        found.append((title, views, rows))
    return found


def shade(value):
    """White at LOW, dark at HIGH, evenly in decades: (fill, colour of the figure on it)."""
    t = min(max(math.log(max(value, LOW) / LOW) / math.log(HIGH / LOW), 0), 1)
    rgb = [round(a + (b - a) * t) for a, b in zip((255, 252, 240), (90, 20, 60))]
    return "#%02x%02x%02x" % tuple(rgb), "#fff" if t > 0.6 else "#000"


def panel(title, views, rows):
    out = ["<text x='%d' y='16' font-weight='bold'>%s</text>" % (LEFT, title.replace("`", "").replace("&", "&amp;"))]
    out += ["<text x='%.0f' y='%d' text-anchor='middle'>%s</text>" % (LEFT + (j + 0.5) * CELL_W, TOP - 6, v) for j, v in enumerate(views)]
    for i, (roughness, values) in enumerate(rows):
        y = TOP + i * CELL_H
        out.append("<text x='%d' y='%.0f' text-anchor='end'>%s</text>" % (LEFT - 5, y + CELL_H - 8, roughness))
        for j, value in enumerate(values):
            fill, ink = shade(value)
            out.append("<rect x='%d' y='%d' width='%d' height='%d' fill='%s'/><text x='%.0f' y='%d' text-anchor='middle' fill='%s'>%s</text>"
                       % (LEFT + j * CELL_W, y, CELL_W, CELL_H, fill, LEFT + (j + 0.5) * CELL_W, y + CELL_H - 8, ink, "%.2g %%" % (100 * value)))
    return "\n".join(out)


def main():
    page = Path(sys.argv[1] if len(sys.argv) > 1 else ROOT / "docs" / "measured" / "accuracy.md")
    picture = Path(sys.argv[2] if len(sys.argv) > 2 else ROOT / "docs" / "images" / "accuracy-ggx.svg")
    maps = maps_of(page.read_text())
    width = LEFT + CELL_W * len(maps[0][1]) + RIGHT
    height = TOP + CELL_H * len(maps[0][2]) + BOTTOM
    lines = -(-len(maps) // COLUMNS)
    svg = ["<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 %d %d' font-family='sans-serif' font-size='11'>" % (width * COLUMNS, height * lines),
           "<rect width='100%' height='100%' fill='white'/>"]
    for k, one in enumerate(maps):
        svg.append("<g transform='translate(%d %d)'>\n%s\n</g>" % (k % COLUMNS * width, k // COLUMNS * height, panel(*one)))
    picture.write_text("\n".join(svg) + "\n</svg>\n")
    print(picture)


if __name__ == "__main__":
    main()
