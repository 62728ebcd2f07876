#!/usr/bin/env python3
"""Reads cases.glsl and writes what the parity harness is built from.

    make_cases.py table CASES                 the C++ table: name, title, domains, measure
    make_cases.py shader glsl|hlsl CASES      a compute shader that runs the case its specialisation constant names
    make_cases.py shader wgsl CASES           the same, with the case's number behind the inputs instead of a constant
    make_cases.py broken-shader glsl CASES    the same with a mistake in the prelude, which the parity test must find
    make_cases.py reached CASES               exit 1 when a kernel function is called by no case, even indirectly
"""
import re
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent.parent
sys.path[:0] = [str(ROOT / "tools"), str(ROOT / "dist")]
import make_dist  # noqa: E402
from kernel_text import KERNELS, calls, functions, kernel_files, with_needs  # noqa: E402

MEMBERS = {f"{v}.{c}": 4 * "abcd".index(v) + "xyzw".index(c) for v in "abcd" for c in "xyzw"}
MEMBERS.update({f"{v}.xyz": 4 * "abcd".index(v) for v in "abcd"})
WIDE = ("direction", "upper_direction", "vector")


def cases(path):
    """[dict] in file order."""
    text = Path(path).read_text()
    found = []
    for match in re.finditer(r"((?:^//.*\n)+)vec4 case_(\w+)\(CaseInput i\)", text, re.MULTILINE):
        comment = [line[2:].strip() for line in match.group(1).splitlines()]
        case = {"name": match.group(2), "title": comment[0], "inputs": [], "measure": "absolute", "values": 1}
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
            elif line:
                sys.exit(f"{path}: case {case['name']}: '{line}' is neither an input nor Error: nor Values:")
        found.append(case)
    return found


def call_graph(path):
    graph = {}
    for part in with_needs(path):
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


def table(path):
    graph = call_graph(path)
    print("// Written by make_cases.py from cases.glsl: PARITY_CASE(name, title, measure, values, arithmetic only, inputs)")
    for case in cases(path):
        arithmetic = not reached_from(graph, ["case_" + case["name"]]) & {"exp", "log"}
        inputs = ", ".join(f"{{{first}, Domain::{domain}, {low}, {high}}}" for first, domain, low, high in case["inputs"])
        print(f"PARITY_CASE({case['name']}, \"{case['title']}\", Measure::{case['measure']}, {case['values']}, "
              f"{'true' if arithmetic else 'false'}, ({{{inputs}}}))")


GLSL = """
layout(local_size_x = 64) in;
layout(constant_id = 0) const int case_index = 0;
layout(std430, binding = 0) readonly buffer Inputs { vec4 inputs[]; };
layout(std430, binding = 1) writeonly buffer Outputs { vec4 outputs[]; };

vec4 run(CaseInput i) {
CHOICES    return vec4(0.0, 0.0, 0.0, 0.0);
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
[[vk::constant_id(0)]] const int case_index = 0;
[[vk::binding(0)]] StructuredBuffer<float4> inputs : register(t0);
[[vk::binding(1)]] RWStructuredBuffer<float4> outputs : register(u1);

float4 run(CaseInput i) {
CHOICES    return float4(0.0, 0.0, 0.0, 0.0);
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

fn run(which: u32, i: CaseInput) -> vec4f {
CHOICES    return vec4f();
}

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3u) {
    let n = id.x;
    let count = arrayLength(&outputs);
    if (n < count) {
        let i = CaseInput(inputs[4u * n], inputs[4u * n + 1u], inputs[4u * n + 2u], inputs[4u * n + 3u]);
        outputs[n] = run(u32(inputs[4u * count].x), i);
    }
}
"""


def wgsl_shader(path):
    printer = make_dist.Wgsl()
    print(make_dist.WGSL_HELPERS)
    for part in with_needs(path):
        print(printer(make_dist.without_double(part.read_text())))
    print(WGSL.replace("CHOICES", "".join(f"    if (which == {n}u) {{ return case_{case['name']}(i); }}\n"
                                          for n, case in enumerate(cases(path)))))


def shader(language, path, broken=False):
    if language == "wgsl":
        return wgsl_shader(path)
    prelude = (KERNELS / "prelude" / f"prelude.{language}").read_text()
    if broken:  # a select that mixes up its sides
        right = "float select(bool m, float a, float b) { return m ? a : b; }"
        assert right in prelude
        prelude = prelude.replace(right, right.replace("a : b", "b : a"))
    print("#version 450" if language == "glsl" else "")
    print(prelude)
    for part in with_needs(path):
        print(part.read_text())
    choices = "".join(f"    if (case_index == {n}) return case_{case['name']}(i);\n"
                      for n, case in enumerate(cases(path)))
    print((GLSL if language == "glsl" else HLSL).replace("CHOICES", choices))


def reached(path):
    graph = call_graph(path)
    seen = reached_from(graph, ["case_" + case["name"] for case in cases(path)])
    missing = [f"{part.name}: {name}" for part in kernel_files(KERNELS) for name, _ in functions(part.read_text())
               if name not in seen]
    for name in missing:
        print(f"{name} is reached by no parity case: add one to {path}")
    print(f"{len(cases(path))} cases, {len(missing)} kernel functions that none of them reaches")
    sys.exit(bool(missing))


def main():
    job, *rest = sys.argv[1:]
    {"table": table, "shader": shader, "reached": reached,
     "broken-shader": lambda language, path: shader(language, path, broken=True)}[job](*rest)


if __name__ == "__main__":
    main()
