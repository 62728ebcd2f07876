#!/usr/bin/env python3
"""Instructions of the shaders' entry points, counted in SPIR-V, and the time that a device's arithmetic rate would give.

usage: shader_counts.py          prints the tables of docs/measured/performance.md
       shader_counts.py --loops  every loop of every pipeline, to name units by
       shader_counts.py --test   exit 1 when a shader made up for the purpose is counted wrongly

A pipeline's constants are set and what they leave dead is taken out (spirv-opt), as drivers do. An operation on a vector counts as many
as it has components. Each loop's body counts once, and so do both sides of a branch: a device runs loops more often and may skip sides.
Needs glslc and spirv-opt (packages glslc, spirv-tools).
"""
import shutil
import struct
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent

# Opcodes of SPIR-V 1.5.
NAME, EXT_IMPORT, EXT_INST, TYPE_FLOAT, TYPE_VECTOR, TYPE_MATRIX, TYPE_POINTER = 5, 11, 12, 22, 23, 24, 32
LABEL, LOOP_MERGE, BRANCH, BRANCH_CONDITIONAL, SWITCH = 248, 246, 249, 250, 251
LOAD, STORE, FUNCTION, VARIABLE = 61, 62, 54, 59
FLOAT_OPS = {127, 129, 131, 133, 136, 140, 141, 142, 146}  # negate, add, subtract, multiply, divide, remainder, modulo, scalings
IMAGE_FETCH = 95  # of a buffer of texels
DOT, MATRIX_TIMES = 148, {143, 144, 145, 146, 147}
INTEGER_OPS = set(range(126, 140)) - FLOAT_OPS | set(range(194, 206))
COMPARE_OPS = set(range(164, 192)) | {169}
# GLSL.std.450: what takes a unit of its own, and what is one instruction.
SPECIAL = {13: "sin", 14: "cos", 15: "tan", 16: "asin", 17: "acos", 18: "atan", 25: "atan2", 26: "pow", 27: "exp", 28: "log", 29: "exp2",
           30: "log2", 31: "sqrt", 32: "inversesqrt", 66: "length", 67: "distance", 69: "normalize"}
STORAGE_BUFFER, UNIFORM = 12, 2

# The pipelines that are counted: shader, name of the pipeline, constants by their number, unit of work, and the loop (in the order of the text)
# whose body is one; no loop: the whole.
PIPELINES = [
    ("diffuse", "a polygon", {0: 0, 5: 0}, "a pixel and a light", 0),
    ("diffuse", "a polygon, seen whole", {0: 0, 5: 0, 16: 1}, "a pixel and a light", 0),
    ("ltc", "a polygon, compact table", {0: 0, 1: 1, 2: 1, 5: 0, 11: 4, 13: 64, 14: 32}, "a pixel and a light", 0),
    ("ltc", "a polygon, compact table, seen whole", {0: 0, 1: 1, 2: 1, 5: 0, 11: 4, 13: 64, 14: 32, 16: 1}, "a pixel and a light", 0),
    ("closed_form", "a polygon", {0: 0, 5: 0, 11: 4, 12: 4}, "a pixel and a light", 0),
    ("closed_form", "a polygon, seen whole", {0: 0, 5: 0, 11: 4, 12: 4, 16: 1}, "a pixel and a light", 0),
    ("half_vector", "a polygon", {0: 0, 5: 0, 11: 4, 12: 4}, "a pixel and a light", 0),
    ("ltc_clipless", "a polygon", {0: 0, 5: 0, 11: 4, 13: 64, 14: 64}, "a pixel and a light", 0),
    ("representative_point", "a polygon", {0: 0, 5: 0, 11: 4}, "a pixel and a light", 0),
    ("texture_means", "GGX", {0: 0, 4: 1, 13: 64}, "a pixel and a light", None),
    ("sheen", "a polygon", {0: 0, 5: 0}, "a pixel and a light", 0),
    ("phong_lobe", "a polygon, series", {0: 0, 4: 2, 5: 0, 11: 4, 21: 4}, "a pixel and a light", 0),
    ("phong_lobe", "a polygon, series, high", {0: 0, 4: 2, 5: 0, 11: 4, 21: 5}, "a pixel and a light", 0),
    ("shadow_parts", "", {0: 640, 1: 640, 2: 32}, "a point and a light", None),
    ("shadow_parts", "", {0: 640, 1: 640, 2: 32}, "four pairs of segments", 11),
    ("shadow_rays", "", {}, "a box, and a triangle in it", 1),
    ("shadow_rays", "", {}, "a triangle", 2),
    ("shadow_shares", "", {}, "a pixel and a light", 0),
    ("phong", "series", {0: 4, 1: 500, 3: 4, 4: 10}, "a point and an edge", 1),
    ("phong", "series, high", {0: 5, 1: 500, 3: 4, 4: 10}, "a point and an edge", 1),
    ("phong", "ellipsoid", {0: 3, 1: 500, 3: 4, 4: 10}, "a point and an edge", 1),
    ("phong", "lorentzian", {0: 1, 1: 500, 2: 1, 3: 4, 4: 10}, "a point and an edge", 1),
    ("phong", "pearson", {0: 2, 1: 500, 2: 1, 3: 4, 4: 10}, "a point and an edge", 1),
    ("plane_lists", "", {}, "a tile and a blocker", 0),
    ("plane_listed", "round lights", {}, "a pixel and a blocker", 2),
    ("plane_disks", "round lights, the CPU's lists", {}, "a pixel and a blocker", 1),
    ("plane_cuts", "edges", {}, "a pixel and a blocker", 27),
    ("plane_arcs", "arcs", {}, "a pixel and a blocker", 5),
    ("plane_arcs", "arcs, quadrature", {}, "a node", 21),
    ("bounce_rays", "", {}, "a ray, a box and a triangle", 1),
    ("bounce_lobes", "", {0: 64, 1: 64}, "a virtual light", None),
    ("bounce_boxes", "", {}, "a pixel or a box", 0),
    ("bounce_cull", "", {}, "a tile and a light", 1),
    ("bounce_light", "LTC, diffuse receivers", {0: 64, 1: 64, 2: 0, 3: 0, 4: 0}, "a pair", 1),
    ("bounce_light", "LTC", {0: 64, 1: 64, 2: 0, 3: 1, 4: 0}, "a pair", 1),
    ("bounce_light", "LTC, quads", {0: 64, 1: 64, 2: 0, 3: 1, 4: 1}, "a pair", 1),
    ("bounce_light", "GGX", {0: 64, 1: 64, 2: 1, 3: 1, 4: 0}, "a pair", 1),
    ("bounce_filter", "", {}, "a pixel and a tap", 0),
    ("bounce_resolve", "", {0: 64, 1: 64}, "a pixel", None),
    ("resolve", "", {}, "a pixel", None),
    ("resolve", "layers", {1: 1}, "a pixel", None),
]


# The throughput of a device, from its data sheet: lanes times clock, an operation each. A special function takes as long as eight.
DEVICES = [("H200", 132 * 128 * 1.98e9), ("96 EU Xe", 96 * 8 * 1.35e9)]
SPECIAL_COST = 8
SHARE = 0.5  # of the rate, that is assumed to be reached


class Counts(dict):
    def add(self, kind, n=1):
        self[kind] = self.get(kind, 0) + n

    def plus(self, other):
        for kind, n in other.items():
            self.add(kind, n)


def instructions(words):
    at = 5
    while at < len(words):
        size, opcode = words[at] >> 16, words[at] & 0xffff
        yield opcode, words[at + 1:at + size]
        at += size


def count(words):
    """[(loop, depth, counts)]: the whole first, then every loop in the order of the text, each with the loops in it."""
    width, pointee, type_of, imports = {}, {}, {}, set()
    total, loops, open_loops = Counts(), [], []
    header, block = None, Counts()  # the block so far: a loop's first is counted before it is known to be one
    for opcode, operands in instructions(words):
        if opcode == EXT_IMPORT:
            imports.add(operands[0])
        elif opcode == TYPE_VECTOR:
            width[operands[0]] = operands[2]
        elif opcode == TYPE_MATRIX:
            width[operands[0]] = operands[2] * width.get(operands[1], 1)
        elif opcode == TYPE_POINTER:
            pointee[operands[0]] = (operands[1], operands[2])
        elif opcode == LABEL:
            open_loops = [l for l in open_loops if l[1] != operands[0]]
            header, block = operands[0], Counts()
        elif opcode == LOOP_MERGE:
            loops.append((len(open_loops) + 1, Counts(block)))
            open_loops.append((len(loops) - 1, operands[0], header))
        if opcode in (LABEL, NAME) or opcode < 50:
            if opcode != EXT_INST:
                continue
        found = Counts()
        found.add("instructions")
        n = width.get(operands[0], 1) if operands else 1
        if len(operands) > 1:
            type_of[operands[1]] = operands[0]
        if opcode in FLOAT_OPS:
            found.add("float", n)
        elif opcode == DOT:
            found.add("float", 2 * width.get(type_of.get(operands[2]), 1) - 1)
        elif opcode in MATRIX_TIMES:
            found.add("float", 15 if n == 3 else 2 * n)
        elif opcode in COMPARE_OPS or opcode in INTEGER_OPS:
            found.add("other", n)
        elif opcode == EXT_INST and operands[2] in imports:
            found.add("special" if operands[3] in SPECIAL else "float", n)
        elif opcode == LOAD and pointee.get(type_of.get(operands[2]), (0, 0))[0] in (STORAGE_BUFFER, UNIFORM):
            found.add("loads", n)
        elif opcode == IMAGE_FETCH:
            found.add("loads", n)
        elif opcode == STORE and pointee.get(type_of.get(operands[0]), (0, 0))[0] in (STORAGE_BUFFER, UNIFORM):
            found.add("stores")
        total.plus(found)
        block.plus(found)
        for index, _, _ in open_loops:
            loops[index][1].plus(found)
    return [(None, 0, total)] + [(i, depth, counts) for i, (depth, counts) in enumerate(loops)]


def compiled(source, constants, folder):
    plain, done = Path(folder) / f"{Path(source).name}.spv", Path(folder) / "done.spv"
    if not plain.exists():  # pipelines of one shader differ in constants alone
        subprocess.run(["glslc", "--target-env=vulkan1.2", "-O", "-fshader-stage=compute", "-I", ROOT / "shaders", "-I", ROOT / "kernels", "-I", ROOT / "source", source,
                        "-o", plain], check=True)
    values = " ".join(f"{i}:{v}" for i, v in constants.items())
    subprocess.run(["spirv-opt", "--target-env=vulkan1.2"] + ([f"--set-spec-const-default-value={values}"] if values else []) +
                   ["--freeze-spec-const", "--fold-spec-const-op-composite", "-O", plain, "-o", done], check=True)
    data = done.read_bytes()
    return struct.unpack(f"<{len(data) // 4}I", data)


TINY = """#version 450
layout(local_size_x = 1) in;
layout(constant_id = 0) const int WIDE = 0;
layout(std430, binding = 0) buffer Data { vec4 data[]; };
void main() {
    vec4 sum = vec4(0.0);
    for (uint i = 0u; i < uint(data[0].x); i++) {
        sum += data[i + 1u];                                   // 4 additions, 4 words
        if (WIDE == 1) sum *= inversesqrt(sum.x);              // 1 special, 4 multiplications
    }
    data[0] = sum;
}
"""


def self_test():
    with tempfile.TemporaryDirectory() as folder:
        source = Path(folder) / "tiny.comp"
        source.write_text(TINY)
        results = {wide: count(compiled(source, {0: wide}, folder)) for wide in (0, 1)}
    narrow, wide = results[0][1][2], results[1][1][2]
    good = len(results[0]) == 2 and narrow.get("float") == 4 and narrow.get("special", 0) == 0 and wide.get("float") == 8 \
        and wide.get("special") == 1 and narrow.get("loads") == 5 and results[0][0][2].get("stores") == 1
    print("counted as they are:" if good else "WRONG:", narrow, wide)
    sys.exit(not good)


def cost(counts):
    return counts.get("float", 0) + counts.get("other", 0) + counts.get("loads", 0) + SPECIAL_COST * counts.get("special", 0)


def tables(found):
    """Markdown."""
    kinds = ["float", "other", "special", "loads"]
    names = [name for name, _ in DEVICES]
    print("| shader | pipeline | instructions | " + " | ".join(kinds) + " | a unit is | " + " | ".join(kinds) + " | " +
          " | ".join(f"estimate, us a million on {name}" for name in names) + " |")
    print("|---|---|" + "--:|" * 5 + "---|" + "--:|" * (4 + len(names)))
    for (shader, name, _, unit, loop), loops in zip(PIPELINES, found):
        whole, one = loops[0][2], loops[0 if loop is None else loop + 1][2]
        cells = [shader, name, whole["instructions"]] + [whole.get(k, 0) for k in kinds] + [unit] + [one.get(k, 0) for k in kinds]
        cells += [f"{1e12 * cost(one) / (SHARE * rate):.3g}" for _, rate in DEVICES]
        print("| " + " | ".join(f"`{c}`" if c == shader else str(c) for c in cells) + " |")
    print()


def main():
    if any(shutil.which(program) is None for program in ("glslc", "spirv-opt")):
        print("glslc or spirv-opt is not installed: apt-get install glslc spirv-tools", file=sys.stderr)
        sys.exit(77)
    if sys.argv[1:] == ["--test"]:
        self_test()
    with tempfile.TemporaryDirectory() as folder:
        found = [count(compiled(ROOT / "shaders" / f"{p[0]}.comp", p[2], folder)) for p in PIPELINES]
    if sys.argv[1:] == ["--loops"]:
        for pipeline, loops in zip(PIPELINES, found):
            print(pipeline[0], pipeline[1])
            for index, depth, counts in loops:
                print("   " + "  " * depth, "all" if index is None else index, dict(counts))
        return
    tables(found)


if __name__ == "__main__":
    main()
