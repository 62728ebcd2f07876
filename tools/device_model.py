#!/usr/bin/env python3
"""A model of the time that a picture takes on GPUs, on a machine without a GPU. It is no measurement.

usage: device_model.py PROGRAM            prints the tables of docs/measured/device-model.md; takes some minutes
       device_model.py PROGRAM PICTURE    a row for each shader of one picture, such as gallery
       device_model.py PROGRAM edges      the table of Phong edges alone
       device_model.py --test             exit 1 when an assembly made up for the purpose is counted wrongly

A time is instructions / (lanes x clock). RADV's assembly for gfx1100 gives the instructions of each loop. A loop's turns are counts of the
software device where TURNS or parts_work says so, else one for each turn of the loop around it. Both sides of branches run. A lane ends an
instruction a cycle, and nothing waits for memory or for other lanes. Needs the package mesa-vulkan-drivers; exit 77 without it.
"""
import json
import math
import os
import random
import re
import subprocess
import sys
import tempfile
from pathlib import Path

import shader_cost
from shader_cost import DRIVER, ROOT

GROUP = 64  # threads of a work group
# Lanes and clock [Hz], from data sheets.
PARTS = [("RX 7900 XTX", 6144, 2.5e9), ("RTX 4060", 3072, 2.46e9), ("Steam Deck", 512, 1.6e9)]
# A name, the size, and arguments of both `info` and `render`. BUILT: the folder of scenes that the build makes.
PICTURES = [
    ("gallery", "1280x720", ["scenes/gallery.glb"]),
    ("room", "320x180", ["scenes/room.glb"]),
    ("arcade", "320x180", ["BUILT/arcade.glb"]),
    ("stadium without shadows", "1280x720", ["BUILT/stadium.glb", "--shadows", "off"]),
    ("ring, bounce of 262,144 virtual lights", "1280x720", ["scenes/ring.glb", "--shadows", "off", "--indirect", "ltc", "--vpls", "262144"]),
    ("plane, 1,000 lights, 2,000 occluders", "1280x720", ["FIELD"]),
]
# The literature's comparison of Phong methods, by the numbers of shaders/lobes/phong_methods.glsl. The published ms of an edge of a screen on a
# GTX 580 and a GTX 980 Ti (docs/theory/moments.md), by exponent where they depend on it.
METHODS = [("arvo", {100: "13.6 | 0.41", 500: "49 | 1.57", 5000: "476 | 9.8"}), ("lorentzian", {0: "0.25 | 0.12"}), ("pearson", {0: "0.40 | 0.125"}),
           ("ellipsoid", {0: "0.47 | 0.127"}), ("series", {0: " | "}), ("series, high", {0: " | "})]
SCREEN = 1280 * 720
KEPT_PAIRS = 48  # IndirectOptions::kept_pairs: virtual lights of a pixel, on average


def field():
    """SVG: the light field of the bench plane/frame/1000x2000, with other numbers of chance."""
    chance = random.Random(1)
    boxes = [f'<rect x="{-hx:.2f}" y="{-hy:.2f}" width="{2 * hx:.2f}" height="{2 * hy:.2f}" '
             f'transform="translate({chance.uniform(0, 1920):.2f} {chance.uniform(0, 1080):.2f}) rotate({chance.uniform(0, 360):.2f})"/>'
             for hx, hy in ((10 * chance.uniform(0.4, 1.2), 10 * chance.uniform(0.4, 1.2)) for _ in range(2000))]
    lights = [f'<circle cx="{chance.uniform(0, 1920):.2f}" cy="{chance.uniform(0, 1080):.2f}" r="6" fill="#ffffff" data-range="150"/>'
              for _ in range(1000)]
    return "\n".join(['<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 1920 1080">', '<g class="occluder">', *boxes, "</g>",
                      '<g class="light">', *lights, "</g>", "</svg>"])


class Loop:
    """A loop of an assembly: its own instructions, without those of the loops in it, and these."""

    def __init__(self, begin, end):
        self.begin, self.end, self.inner = begin, end, []
        self.head = end - begin  # instructions up to the first jump over most of a turn
        self.branches = []  # begin and end of what jumps ahead leave out, but for what stands in another such branch

    def own(self):
        return self.end - self.begin - sum(i.end - i.begin for i in self.inner)

    def once(self):
        """Instructions of a turn, with one turn of each loop in it."""
        return self.end - self.begin


def loops_of(listing):
    """The whole shader as a loop of one turn. Jumps back end a loop; two of the same begin are one."""
    at, ends, jumps, count = {}, {}, [], 0
    for line in listing:
        block = re.match(r"(BB\d+):", line)
        if block:
            at[block[1]] = count
        elif line.startswith("\t"):
            count += 1
            jump = re.match(r"\ts_c?branch\w*\s+(BB\d+)", line)
            if jump and jump[1] in at:
                ends[at[jump[1]]] = max(count, ends.get(at[jump[1]], 0))
            elif jump:
                jumps.append((count, jump[1]))
    whole = Loop(0, count)
    around = [whole]
    for begin, end in sorted(ends.items()):
        while around[-1].end <= begin:
            around.pop()
        loop = Loop(begin, end)
        around[-1].inner.append(loop)
        around.append(loop)
        over = [a for a, to in jumps if begin < a < end and begin + (end - begin) // 2 < at[to] - (a - begin) <= end]
        loop.head = min(over) - begin if over else end - begin
        for a, to in jumps:
            leaves = at[to] - a > 0.95 * (end - begin)  # what leaves out nearly all of a turn ends the loop
            if begin < a < at[to] < end and not leaves and not any(b < a < e for b, e in loop.branches):
                loop.branches.append((a, at[to]))
    return whole


def listings(text):
    """The assembly of each pipeline, in the order in which they were made."""
    return [part.split("\nshader:")[0].splitlines() for part in text.split("\ndisasm:\n")[1:]]


def full_lanes(items, points, lanes):
    """Turns of lanes that take `items` of `points` together, each point's last turn half full."""
    return items + points * (lanes - 1) / 2


def parts_work(whole, constants, counts):
    """Instructions of shadow_parts.comp for all points of a space, by what they do. A lane takes a segment, and looks at eight others a turn."""
    points, edges, triangles, segments, pairs, near, opened, looks, pushes, sorting, crossings = counts
    lanes, few = constants[1], constants[3] == 1
    first, walk = whole.inner[0], max(whole.inner, key=Loop.once)
    sets = max(walk.inner, key=Loop.once)
    pieces = walk.inner[walk.inner.index(sets) + 2]
    look, queue = sets.inner
    push = queue.inner[0]
    look_near, settle = sorted(sorted((end - begin for begin, end in queue.branches), reverse=True)[:2])
    chunks = full_lanes(segments, points, lanes)
    every = (pairs + segments * (lanes - 1) / 2) / 8 + chunks / 2  # turns of lanes, if they leave none out
    looked = every if few else lanes * looks
    # Edges that do not face both ways wait until all lanes project one of the others.
    of_edge = first.once() if few else first.own() + first.inner[0].once()
    sections = Loop(0, 0) if few else whole.inner[1]
    others = [loop.once() for loop in whole.inner if loop not in (first, sections, walk)]
    sort = 0 if few else [loop for loop in whole.inner if loop.inner and loop.begin < walk.begin][-2].inner[0].once()
    return {
        "edges": full_lanes(edges, points, lanes) * of_edge + (0 if few else chunks * first.inner[1].once()),
        "triangles": full_lanes(triangles, min(points, triangles), lanes) * sections.once(),
        "sort": lanes * sorting * sort,
        "looks": looked * look.once() + (every - looked) * look.head + (every / 4 + chunks) * sets.own(),
        "near pairs": lanes * pushes * push.once() + (every / 4 + chunks) * (queue.once() - push.once() - look_near - settle) + (near + chunks / 2) * look_near,
        "open pairs": (opened + min(lanes * opened, chunks)) * settle,
        "pieces": lanes * crossings * pieces.once() + chunks * (walk.once() - sets.once() - pieces.once()),
        "all else": points * lanes * whole.own() + max(points * lanes, chunks) * sum(others),
    }


def chain(whole, *turns):
    """Instructions for a thread whose largest loop, the largest loop in that one, and so on, turn so often in all."""
    work, loop, before = whole.once(), whole, 1
    for n in turns:
        loop = max(loop.inner, key=Loop.once)
        work += (n - before) * loop.once()
        before = n
    return work


def edge_work(whole, method, n):
    """Instructions of an edge of phong.comp: a turn of the outline with one arc of the horizon. Arvo's recurrence takes every other power."""
    outline = loop = max(whole.inner, key=Loop.once)
    while loop.inner:
        loop = max(loop.inner, key=Loop.once)
    return outline.once() + (((n - 1) // 2 - 1) * loop.once() if method == "arvo" else 0)


# Instructions of a shader for all its threads. counts: --stats of the software device, or of the CPU for the plane.
TURNS = {
    # The walk, two passes over the edges of leaves, and a sum over 64 threads between them.
    "shadow_gather.comp": lambda whole, threads, counts: threads * (whole.own() + GROUP * whole.inner[2].once()) +
    GROUP * (counts["shadow_gathered"][0] * whole.inner[0].once() + counts["shadow_gathered"][1] * (whole.inner[1].once() + whole.inner[3].once())),
    "shadow_edges.comp": lambda whole, threads, counts: threads * (whole.once() - whole.inner[0].once()) + counts["shadow_looks"] * whole.inner[0].once(),
    "bounce_cull.comp": lambda whole, threads, counts: threads * (whole.own() + 2 * (whole.inner[0].own() + 32 * whole.inner[0].inner[0].once() +
                                                                                     16 * whole.inner[0].inner[1].once())),
    "bounce_light.comp": lambda whole, threads, counts: threads * chain(whole, counts["words"], max(KEPT_PAIRS, counts["words"])),
    "plane_listed.comp": lambda whole, threads, counts: counts["tile_lights"] * 256 * (whole.inner[0].once() - whole.inner[0].inner[0].once()) +
    counts["tile_blockers"] * 256 * whole.inner[0].inner[0].once(),
}


def compiled(program, command):
    """The pipelines that `info` or `bench` lists, with their loops."""
    environment = dict(os.environ, RADV_FORCE_FAMILY="gfx1100", VK_ICD_FILENAMES=DRIVER, MESA_SHADER_CACHE_DISABLE="1", RADV_DEBUG="shaders",
                       STERADIAN_PIPELINE_CACHE="")
    made = subprocess.run([program, *command, "--pipelines", "--json"], env=environment, cwd=ROOT, capture_output=True, text=True)
    if made.returncode != 0:
        sys.exit(f"device_model: {' '.join(command)}: exit {made.returncode}: {made.stderr[-500:].strip()}")
    pipelines, assemblies = json.loads(made.stdout)["pipelines"], listings(made.stderr)
    for pipeline, listing in zip(pipelines, assemblies, strict=True):
        pipeline["whole"] = loops_of(listing)
        if pipeline["shader"].endswith(".comp") and pipeline["whole"].once() != shader_cost.number(pipeline, "instructions"):
            sys.exit(f"device_model: the assembly of {pipeline['shader']} has another number of instructions than the driver says")
    return pipelines


def counted(program, arguments, size):
    """--stats of the picture."""
    with tempfile.TemporaryDirectory() as folder:
        told = Path(folder) / "stats.json"
        device = [] if arguments[0].endswith(".svg") else ["--backend", "vulkan", "--device", "llvmpipe"]
        made = subprocess.run([program, "render", *arguments, "-o", str(Path(folder) / "picture.png"), "--size", size, *device, "--stats", str(told)],
                              cwd=ROOT, capture_output=True, text=True)
        if made.returncode != 0:
            sys.exit(f"device_model: render {' '.join(arguments)}: exit {made.returncode}: {made.stderr[-500:].strip()}")
        return json.loads(told.read_text())


def work_of(program, arguments, size):
    """Threads and instructions of each shader."""
    pipelines, counts = compiled(program, ["info", *arguments, "--size", size]), {}
    if any(p["shader"].startswith(("shadow_parts", "plane_")) for p in pipelines):
        counts = counted(program, arguments, size)
    counts["words"] = 2 * math.ceil(int(arguments[-1]) / 64 / 32) if "--vpls" in arguments else 0  # 64 sets; dull and glossy
    spaces = sorted((p for p in pipelines if p["shader"] == "shadow_parts.comp"), key=lambda p: p["constants"][0])
    work = {}
    for p in pipelines:
        threads = p["units"] or p["groups"] * GROUP
        instructions = threads * p["whole"].once()
        if p in spaces:
            space = spaces.index(p)
            of = [counts["shadow_pairs"][space + 1], *counts["shadow_work"][space][:10]]
            threads, instructions = of[0] * p["constants"][1], sum(parts_work(p["whole"], p["constants"], of).values())
        elif p["shader"] in TURNS:
            instructions = TURNS[p["shader"]](p["whole"], threads, counts) if threads else 0
        if threads:
            before = work.get(p["shader"], (0, 0))
            work[p["shader"]] = (before[0] + threads, before[1] + instructions)
    return work, counts


def times(instructions, digits=2):
    return " | ".join(f"{1e3 * instructions / (lanes * clock):.{digits}f}" for _, lanes, clock in PARTS)


def print_edges(program):
    print("| method | n | instructions an edge | " + " | ".join(f"ms, {name}" for name, _, _ in PARTS) + " | published ms, GTX 580 | GTX 980 Ti |")
    print("|---|--:|" + "--:|" * (3 + len(PARTS)))
    printed = set()
    for p in compiled(program, ["bench"]):
        (method, published), n = METHODS[p["constants"][0]], p["constants"][1]
        work = edge_work(p["whole"], method, n)
        if (method, work) not in printed:
            print(f"| {method} | {n if n in published else 'any'} | {work:,} | {times(SCREEN * work, 3)} | {published.get(n) or published[0]} |")
        printed.add((method, work))


def main():
    arguments = sys.argv[1:]
    if arguments == ["--test"]:
        sys.exit(self_test())
    names = [name for name, _, _ in PICTURES]
    if not 1 <= len(arguments) <= 2 or arguments[0].startswith("-") or not set(arguments[1:]) <= {*names, "edges"}:
        sys.exit(__doc__)
    if not Path(DRIVER).exists():
        print("no RADV here: apt-get install mesa-vulkan-drivers", file=sys.stderr)
        sys.exit(77)
    program = str(Path(arguments[0]).resolve())
    if arguments[1:] == ["edges"]:
        return print_edges(program)
    built = str(Path(program).parent.parent / "scenes")
    heads = " | ".join(f"ms, {name}" for name, _, _ in PARTS)
    with tempfile.TemporaryDirectory() as folder:
        drawn = Path(folder) / "field.svg"
        drawn.write_text(field())
        found = {name: work_of(program, [a.replace("BUILT", built).replace("FIELD", str(drawn)) for a in of], size)
                 for name, size, of in PICTURES if name in (arguments[1:] or names)}
    sizes = {name: size.replace("x", " x ") for name, size, _ in PICTURES}
    print(f"| picture | instructions [1e9] | {heads} |\n|---|" + "--:|" * (1 + len(PARTS)))
    for name, (work, _) in found.items():
        total = sum(instructions for _, instructions in work.values())
        print(f"| {name}, {sizes[name]} | {total / 1e9:.1f} | {times(total)} |")
    name = next(iter(found))
    work, counts = found[name]
    print(f"\n| {name}: shader | threads | instructions a thread, mean | {heads} |\n|---|" + "--:|" * (2 + len(PARTS)))
    for shader, (threads, instructions) in sorted(work.items()):
        print(f"| `{shader}` | {threads:,} | {instructions / threads:,.0f} | {times(instructions)} |")
    if "shadow_work" not in counts:
        return
    print("\n| space | pairs | edges | triangles | segments | pairs of segments | near pairs | open pairs | looks | turns for near pairs | for sorting | for crossings |\n|---|"
          + "--:|" * 11)
    for space, (pairs, sums) in enumerate(zip(counts["shadow_pairs"][1:], counts["shadow_work"])):
        print(f"| {space} | {pairs:,} | " + " | ".join(f"{n / max(pairs, 1):,.1f}" for n in sums[:10]) + " |")


def self_test():
    text = "shader\ndisasm:\nBB0:\n\tv_a\nBB1:\n\tv_b\nBB2:\n\tv_c\n\tv_d\n\ts_cbranch_scc1 BB2 ; x\nBB3:\n\tv_e\n\ts_branch BB1\nBB4:\n\ts_endpgm\n\nshader: b"
    whole = loops_of(listings("\n" + text)[0])
    right = whole.once() == 8 and len(whole.inner) == 1 and whole.inner[0].once() == 6 and whole.inner[0].own() == 3
    right = right and whole.inner[0].inner[0].once() == 3
    # Three turns around, ten inside: 2 + 3 x 3 + 10 x 3.
    right = right and chain(whole, 3, 10) == 41
    # A turn of the outline has one of the recurrence, whose ten steps lead to n = 21: 6 + 9 x 3.
    right = right and edge_work(whole, "arvo", 21) == 33 and edge_work(whole, "series", 21) == 6
    # A loop whose third instruction jumps over two others, of which one would jump over one.
    ahead = "BB0:\n\tv_a\n\tv_b\n\ts_cbranch_execz BB2\n\ts_cbranch_execz BB1\n\tv_c\nBB1:\nBB2:\n\tv_d\n\ts_cbranch_scc1 BB0\n\ts_endpgm"
    right = right and loops_of(ahead.splitlines()).inner[0].branches == [(3, 5)]
    print("counted as they are" if right else "WRONG")
    return 0 if right else 1


if __name__ == "__main__":
    main()
