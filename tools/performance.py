#!/usr/bin/env python3
"""Tables and figures of docs/measured/performance.md from what `steradian bench --json` printed.

usage: performance.py docs/images BENCH.json ...   (writes the figures of which the benches are there, prints the tables)
"""
import json
import math
import sys
from pathlib import Path

SETS = ["sse2", "avx2", "avx512"]
SHOWN = ["build", "rays", "gbuffer", "direct", "specular"]


def kernels(benches):
    """Cells are median (fastest run); the ratio is of fastest runs, which other work on the machine moves least."""
    columns = ["scalar"] + SETS
    print("| kernel, ns a pixel and light | " + " | ".join(columns) + " | avx512 over sse2 |")
    print("|---|" + "--:|" * (len(columns) + 1))
    for name in sorted(n.removesuffix("/sse2") for n in benches if n.startswith("kernel/") and n.endswith("/sse2")):
        rows = [benches.get(f"{name}/{s}") for s in columns]
        fastest = [1e6 * b["fastest_ms"] / b["items"] if b else None for b in rows]
        cells = [f"{b['ns_per_item']:.1f} ({f:.1f})" if b else "" for b, f in zip(rows, fastest)]
        ratio = f"{fastest[1] / fastest[3]:.1f}" if fastest[1] and fastest[3] else ""
        print(f"| `{name}` | " + " | ".join(cells) + f" | {ratio} |")
    print()


def frames(benches):
    print("| frame | median [ms] | fastest [ms] | " + " | ".join(SHOWN) + " |")
    print("|---|" + "--:|" * (len(SHOWN) + 2))
    for name, b in benches.items():
        if name.startswith("frame/"):
            passes = [f"{b['passes'][p]:.1f}" if p in b.get("passes", {}) else "" for p in SHOWN]
            print(f"| `{name}` | {b['median_ms']:.1f} | {b['fastest_ms']:.1f} | " + " | ".join(passes) + " |")
    print()


def decade(value):
    """A power of ten as a label."""
    return f"{value:,.0f}" if value >= 1 else f"{value:g}"


def chart(path, title, across, lines):
    """Both axes in powers of ten. lines: name, colour, points (x, y)."""
    xs = [x for _, _, points in lines for x, _ in points]
    ys = [y for _, _, points in lines for _, y in points]
    first, last = math.floor(math.log10(min(xs)) + 0.01), math.ceil(math.log10(max(xs)) - 0.01)
    low, high = math.floor(math.log10(min(ys))), math.ceil(math.log10(max(ys)))
    width, height, left, right, bottom = 450, 330, 60, 400, 280
    unit, up = (right - left) / (last - first), (bottom - 30) / (high - low)
    place_x = lambda x: left + unit * (math.log10(x) - first)
    place_y = lambda y: bottom - up * (math.log10(y) - low)
    out = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}" font-family="sans-serif" font-size="12">',
           f'<rect width="{width}" height="{height}" fill="white"/>']
    for e in range(first, last + 1):
        x = place_x(10.0**e)
        out.append(f'<path d="M{x:.1f} 30V{bottom}" stroke="#ddd"/><text x="{x:.1f}" y="{bottom + 18}" text-anchor="middle">{decade(10.0**e)}</text>')
    for e in range(low, high + 1):
        y = place_y(10.0**e)
        out.append(f'<path d="M{left} {y:.1f}H{right}" stroke="#ddd"/>'
                   f'<text x="{left - 8}" y="{y + 4:.1f}" text-anchor="end">{decade(10.0**e)}</text>')
    for row, (name, colour, points) in enumerate(lines):
        line = " ".join(f"{place_x(x):.1f},{place_y(y):.1f}" for x, y in points)
        out.append(f'<polyline points="{line}" fill="none" stroke="{colour}" stroke-width="2"/>')
        out += [f'<circle cx="{place_x(x):.1f}" cy="{place_y(y):.1f}" r="4" fill="{colour}"/>' for x, y in points]
        if len(lines) > 1:
            out.append(f'<text x="{left + 10}" y="{46 + 16 * row}" fill="{colour}">{name}</text>')
    out.append(f'<text x="{(left + right) / 2}" y="{height - 10}" text-anchor="middle">{across}</text>')
    out.append(f'<text x="{left}" y="18">{title}</text></svg>')
    with open(path, "w") as f:
        f.write("\n".join(out) + "\n")


def figures(benches, folder):
    """Those of which the benches are there."""
    def points(prefix, size, time, suffix=""):
        return sorted((size(n.split("/")[2]), time(b)) for n, b in benches.items()
                      if n.startswith(prefix) and n.endswith(suffix) and n.count("/") == 2 + suffix.count("/"))

    pixels = lambda size: math.prod(int(n) for n in size.split("x"))
    a_pass = lambda name: lambda b: b["passes"][name]
    if lights := points("frame/lights/", int, a_pass("direct")):
        one_by_one = points("frame/lights/", int, a_pass("direct"), "/all")
        chart(folder / "lights.svg", "lighting pass [ms], 320 x 180, one thread", "quad lights",
              [("together from 64 on", "#1463a5", lights)] + ([("one by one", "#a53914", one_by_one)] if one_by_one else []))
    if sizes := points("frame/pixels/", pixels, lambda b: b["median_ms"]):
        chart(folder / "pixels.svg", "frame under one quad, ltc-compact [ms], one thread", "pixels", [("", "#1463a5", sizes)])
    if points("frame/triangles/", int, a_pass("rays")):
        lines = [(name, colour, points("frame/triangles/", int, a_pass(name)))
                 for name, colour in (("build", "#a53914"), ("rays", "#1463a5"), ("gbuffer", "#3c8a2e"))]
        chart(folder / "triangles.svg", "passes [ms], 1280 x 720, one thread", "triangles", lines)


def main():
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    benches = {}
    for path in sys.argv[2:]:
        with open(path) as f:
            benches.update((b["name"], b) for b in json.load(f))
    kernels(benches)
    frames(benches)
    figures(benches, Path(sys.argv[1]))


main()
