#!/usr/bin/env python3
"""Tables and figure of docs/performance.md from what `steradian bench --json` printed.

usage: performance.py FIGURE.svg BENCH.json ...   (writes the figure, prints the tables)
"""
import json
import math
import sys

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


def figure(benches, path):
    points = sorted((int(n.split("/")[2]), b["passes"]["direct"]) for n, b in benches.items() if n.startswith("frame/lights/"))
    width, height, left, bottom, unit = 420, 330, 60, 280, 100  # unit: pixels a decade across; half as many up
    low = math.floor(math.log10(min(ms for _, ms in points)))
    high = math.ceil(math.log10(max(ms for _, ms in points)))
    up = (bottom - 30) / (high - low)
    x = lambda n: left + unit * math.log10(n)
    y = lambda ms: bottom - up * (math.log10(ms) - low)
    out = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}" font-family="sans-serif" font-size="12">',
           f'<rect width="{width}" height="{height}" fill="white"/>']
    for n in (1, 10, 100, 1000):
        out.append(f'<path d="M{x(n):.1f} 30V{bottom}" stroke="#ddd"/><text x="{x(n):.1f}" y="{bottom + 18}" text-anchor="middle">{n}</text>')
    for e in range(low, high + 1):
        out.append(f'<path d="M{left} {y(10.0**e):.1f}H{x(1000)}" stroke="#ddd"/>'
                   f'<text x="{left - 8}" y="{y(10.0**e) + 4:.1f}" text-anchor="end">{10.0**e:g}</text>')
    line = " ".join(f"{x(n):.1f},{y(ms):.1f}" for n, ms in points)
    out.append(f'<polyline points="{line}" fill="none" stroke="#1463a5" stroke-width="2"/>')
    out += [f'<circle cx="{x(n):.1f}" cy="{y(ms):.1f}" r="4" fill="#1463a5"/>' for n, ms in points]
    out.append(f'<text x="{left + 1.5 * unit}" y="{height - 10}" text-anchor="middle">quad lights</text>')
    out.append(f'<text x="{left}" y="18">lighting pass [ms], 320 x 180, one thread</text></svg>')
    with open(path, "w") as f:
        f.write("\n".join(out) + "\n")


def main():
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    benches = {}
    for path in sys.argv[2:]:
        with open(path) as f:
            benches.update((b["name"], b) for b in json.load(f))
    kernels(benches)
    frames(benches)
    if any(n.startswith("frame/lights/") for n in benches):
        figure(benches, sys.argv[1])


main()
