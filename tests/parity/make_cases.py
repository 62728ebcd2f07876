#!/usr/bin/env python3
"""Reads the kernels' x_cases.glsl and writes what the parity harness is built from.

    make_cases.py table                  the C++ table: name, title, domains, measure
    make_cases.py includes               #include lines for every file of cases, for C++
    make_cases.py shader glsl|hlsl|wgsl  a compute shader whose run() calls every case, for split_spirv.py to take apart
    make_cases.py broken-shader glsl     the same with a mistake in the prelude, which the parity test must find
    make_cases.py reached                exit 1 when a kernel function is called by no case, even indirectly
"""
import re
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent.parent
sys.path[:0] = [str(ROOT / "tools"), str(ROOT / "dist")]
import make_dist  # noqa: E402
from kernel_text import CASE, KERNELS, calls, case_files, functions, in_order, is_cases, kernel_files  # noqa: E402

MEMBERS = {f"{v}.{c}": 4 * "abcd".index(v) + "xyzw".index(c) for v in "abcd" for c in "xyzw"}
MEMBERS.update({f"{v}.xyz": 4 * "abcd".index(v) for v in "abcd"})
WIDE = ("direction", "upper_direction", "vector")


def cases():
    """[dict] in the order of the files and in them."""
    return [case for path in in_order(case_files()) if is_cases(path) for case in cases_of(path)]


def cases_of(path):
    text = path.read_text()
    found = []
    for match in re.finditer(r"((?:^//.*\n)+)vec4 case_(\w+)\(CaseInput i\)", text, re.MULTILINE):
        comment = [line[2:].strip() for line in match.group(1).splitlines()]
        case = {"name": match.group(2), "title": comment[0], "inputs": [], "measure": "absolute", "values": 1, "bound": "running"}
        for line in comment[1:]:
            words = re.match(r"([abcd]\.\w+)\s+(\w+)(?:\(([^,]+),([^)]+)\))?$", line)
            if words:
                member, domain, low, high = words.groups()
                if member not in MEMBERS or (member.endswith("xyz") != (domain in WIDE)):
                    sys.exit(f"{path}: case {case['name']}: '{line}': {domain} does not fit {member}")
                case["inputs"].append((MEMBERS[member], domain, low or "0", high or "0"))
            elif line.startswith("Error:"):
                case["measure"] = line.split(":")[1].strip()
            elif line.startswith("Values:"):
                case["values"] = int(line.split(":")[1])
            elif line.startswith("Bound:"):
                case["bound"] = line.split(":")[1].strip()
            elif line:
                sys.exit(f"{path}: case {case['name']}: '{line}' is neither an input nor Error:, Values: or Bound:")
        found.append(case)
    return found


def call_graph():
    graph = {}
    for part in in_order(case_files()):
        graph.update({name: calls(body) for name, body in functions(part.read_text())})
    return graph


def reached_from(graph, names):
    seen, todo = set(), list(names)
    while todo:
        name = todo.pop()
        if name not in seen:
            seen.add(name)
            todo += graph.get(name, ())
    return seen


def table():
    graph = call_graph()
    print("// Written by make_cases.py: PARITY_CASE(name, title, measure, values, arithmetic only, bound, inputs)")
    for case in cases():
        arithmetic = not reached_from(graph, ["case_" + case["name"]]) & {"exp", "log"}
        inputs = ", ".join(f"{{{first}, Domain::{domain}, {low}, {high}}}" for first, domain, low, high in case["inputs"])
        print(f"PARITY_CASE({case['name']}, \"{case['title']}\", Measure::{case['measure']}, {case['values']}, "
              f"{'true' if arithmetic else 'false'}, Bound::{case['bound']}, ({{{inputs}}}))")


def includes():
    for path in in_order(case_files()):
        if path == CASE or is_cases(path):
            print(f'#include "{path.relative_to(CASE.parent if path == CASE else KERNELS)}"')


GLSL = """
layout(local_size_x = 64) in;
layout(std430, binding = 0) readonly buffer Inputs { vec4 inputs[]; };
layout(std430, binding = 1) writeonly buffer Outputs { vec4 outputs[]; };

vec4 run(CaseInput i) {
    vec4 r;
CALLS    return r;
}

void main() {
    uint n = gl_GlobalInvocationID.x;
    if (n < uint(outputs.length())) {
        CaseInput i;
        i.a = inputs[4u * n];
        i.b = inputs[4u * n + 1u];
        i.c = inputs[4u * n + 2u];
        i.d = inputs[4u * n + 3u];
        outputs[n] = run(i);
    }
}
"""

HLSL = """
[[vk::binding(0)]] StructuredBuffer<float4> inputs : register(t0);
[[vk::binding(1)]] RWStructuredBuffer<float4> outputs : register(u1);

float4 run(CaseInput i) {
    float4 r;
CALLS    return r;
}

[numthreads(64, 1, 1)]
void main(uint3 id : SV_DispatchThreadID) {
    uint n = id.x, count, stride;
    outputs.GetDimensions(count, stride);
    if (n < count) {
        CaseInput i;
        i.a = inputs[4 * n];
        i.b = inputs[4 * n + 1];
        i.c = inputs[4 * n + 2];
        i.d = inputs[4 * n + 3];
        outputs[n] = run(i);
    }
}
"""


WGSL = """
@group(0) @binding(0) var<storage, read> inputs: array<vec4f>;
@group(0) @binding(1) var<storage, read_write> outputs: array<vec4f>;

fn run(i: CaseInput) -> vec4f {
    var r: vec4f;
CALLS    return r;
}

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3u) {
    let n = id.x;
    if (n < arrayLength(&outputs)) {
        let i = CaseInput(inputs[4u * n], inputs[4u * n + 1u], inputs[4u * n + 2u], inputs[4u * n + 3u]);
        outputs[n] = run(i);
    }
}
"""


def calls_of_every_case():
    return "".join(f"    r = case_{case['name']}(i);\n" for case in cases())


def wgsl_shader():
    printer = make_dist.Wgsl()
    print(make_dist.WGSL_HELPERS)
    for part in in_order(case_files()):
        print(printer(make_dist.without_double(part.read_text())))
    print(WGSL.replace("CALLS", calls_of_every_case()))


def shader(language, broken=False):
    if language == "wgsl":
        return wgsl_shader()
    prelude = (KERNELS / "prelude" / f"prelude.{language}").read_text()
    if broken:  # a select that mixes up its sides
        right = "float select(bool m, float a, float b) { return m ? a : b; }"
        assert right in prelude
        prelude = prelude.replace(right, right.replace("a : b", "b : a"))
    print("#version 450" if language == "glsl" else "")
    print(prelude)
    for part in in_order(case_files()):
        print(part.read_text())
    print((GLSL if language == "glsl" else HLSL).replace("CALLS", calls_of_every_case()))


def reached():
    graph = call_graph()
    seen = reached_from(graph, ["case_" + case["name"] for case in cases()])
    wrong = 0
    for part in kernel_files():
        for name, _ in functions(part.read_text()):
            if name not in seen:
                wrong += 1
                print(f"{part.name}: {name} is reached by no parity case: add one to {part.stem}_cases.glsl")
    print(f"{len(cases())} cases; {wrong} kernel functions without one")
    sys.exit(wrong > 0)


def main():
    job, *rest = sys.argv[1:]
    {"table": table, "includes": includes, "shader": shader, "reached": reached,
     "broken-shader": lambda language: shader(language, broken=True)}[job](*rest)


if __name__ == "__main__":
    main()
