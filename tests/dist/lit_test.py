#!/usr/bin/env python3
"""lit_test.py LANGUAGE RUN_SHADER PROGRAM SCRATCH: the topic `lit` of dist/ on a Vulkan device, against `steradian eval` in double.

Random surfaces are lit by a quad, by the same quad with a hole, and by that with two lit sides. The float of a device may be off by what a few
roundings of its inputs change, which is measured: `eval` answers again for inputs that are moved by as much as one rounding.
Exit 77 (skipped) where there is no Vulkan device or no compiler.
"""
import json
import math
import random
import re
import shutil
import struct
import subprocess
import sys
import tempfile
from pathlib import Path

HERE = Path(__file__).resolve().parent
ROOT = HERE.parent.parent
sys.path[:0] = [str(HERE.parent), str(HERE.parent / "parity")]
sys.dont_write_bytecode = True
from dist_compiles import skip, wgsl_command, with_needs  # noqa: E402
from wgsl_parity import TRANSLATE  # noqa: E402

CASES, MOVES = 600, 6
ROUNDING = 2.0 ** -24
# Roundings on the way from the inputs to a corner's direction under the lobe's matrix: the frame (18), the corner in it (6), its direction (5), the
# matrix (5) and the direction under it (5). Each moves it by at most ROUNDING of its length.
ROUNDINGS = 39
HOLE = 0.5  # of the quad's size

MAIN = {
    "c": """
void main() {
    uint k = gl_GlobalInvocationID.x;
    if (8u * k >= uint(inputs.length())) return;
    vec3 p = inputs[8u * k].xyz, n = inputs[8u * k + 1u].xyz, v = inputs[8u * k + 2u].xyz, f0 = inputs[8u * k + 3u].xyz;
    float roughness = inputs[8u * k + 3u].w;
    vec3 q[4];
    for (uint i = 0u; i < 4u; i++) q[i] = inputs[8u * k + 4u + i].xyz;
    vec3 center = 0.25 * (q[0] + q[1] + q[2] + q[3]);
    SteradianGgxPolygon glossy = steradian_ggx_polygon_begin(p, n, v, roughness, q[0]);
    SteradianLambertPolygon diffuse = steradian_lambert_polygon_begin(p, n, q[0]);
    for (int i = 0; i < 4; i++) {
        vec3 a = q[i], b = q[(i + 1) & 3], c = mix(center, b, HOLE), d = mix(center, a, HOLE);
        glossy = steradian_ggx_polygon_add_edge(steradian_ggx_polygon_add_edge(glossy, a, b), c, d);
        diffuse = steradian_lambert_polygon_add_edge(steradian_lambert_polygon_add_edge(diffuse, a, b), c, d);
    }
    outputs[3u * k] = vec4(steradian_ggx_quad(p, n, v, q[0], q[1], q[2], q[3], roughness, f0), steradian_lambert_quad(p, n, q[0], q[1], q[2], q[3]));
    outputs[3u * k + 1u] = vec4(steradian_ggx_polygon_radiance(glossy, f0), steradian_lambert_polygon_radiance(diffuse));
    outputs[3u * k + 2u] = vec4(steradian_ggx_polygon_radiance_of_both_sides(glossy, f0), steradian_lambert_polygon_radiance_of_both_sides(diffuse));
}
""",
    "wgsl": """
@group(0) @binding(0) var<storage, read> inputs: array<vec4f>;
@group(0) @binding(1) var<storage, read_write> outputs: array<vec4f>;
@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3u) {
    let k = id.x;
    if (8u * k >= arrayLength(&inputs)) { return; }
    let p = inputs[8u * k].xyz;
    let n = inputs[8u * k + 1u].xyz;
    let v = inputs[8u * k + 2u].xyz;
    let f0 = inputs[8u * k + 3u].xyz;
    let roughness = inputs[8u * k + 3u].w;
    let at = 8u * k + 4u;
    let q0 = inputs[at].xyz;
    let q1 = inputs[at + 1u].xyz;
    let q2 = inputs[at + 2u].xyz;
    let q3 = inputs[at + 3u].xyz;
    let center = 0.25 * (q0 + q1 + q2 + q3);
    var glossy = steradian_ggx_polygon_begin(p, n, v, roughness, q0);
    var diffuse = steradian_lambert_polygon_begin(p, n, q0);
    for (var i = 0u; i < 4u; i++) {
        let a = inputs[at + i].xyz;
        let b = inputs[at + ((i + 1u) & 3u)].xyz;
        let c = mix(center, b, HOLE);
        let d = mix(center, a, HOLE);
        glossy = steradian_ggx_polygon_add_edge(steradian_ggx_polygon_add_edge(glossy, a, b), c, d);
        diffuse = steradian_lambert_polygon_add_edge(steradian_lambert_polygon_add_edge(diffuse, a, b), c, d);
    }
    outputs[3u * k] = vec4f(steradian_ggx_quad(p, n, v, q0, q1, q2, q3, roughness, f0), steradian_lambert_quad(p, n, q0, q1, q2, q3));
    outputs[3u * k + 1u] = vec4f(steradian_ggx_polygon_radiance(glossy, f0), steradian_lambert_polygon_radiance(diffuse));
    outputs[3u * k + 2u] = vec4f(steradian_ggx_polygon_radiance_of_both_sides(glossy, f0), steradian_lambert_polygon_radiance_of_both_sides(diffuse));
}
""",
}
BUFFERS = """
layout(local_size_x = 64) in;
layout(std430, binding = 0) readonly buffer Inputs { vec4 inputs[]; };
layout(std430, binding = 1) writeonly buffer Outputs { vec4 outputs[]; };
"""
HLSL = """
[[vk::binding(0)]] StructuredBuffer<float4> inputs : register(t0);
[[vk::binding(1)]] RWStructuredBuffer<float4> outputs : register(u1);
[numthreads(64, 1, 1)]
void main(uint3 id : SV_DispatchThreadID) {
    uint k = id.x, count, stride;
    inputs.GetDimensions(count, stride);
    if (8u * k >= count) return;
"""


def shader_text(language):
    library = with_needs(next((ROOT / "dist" / language).glob("lit.*")))
    # glslang copies a constant array wherever an index varies, which takes the software device minutes to compile: here it is a variable.
    library, tables = re.subn(r"^(static )?const (highp )?(uint steradian_ltc_\w+\[)", r"\1\2\3", library, flags=re.MULTILINE)
    assert tables == (0 if language == "wgsl" else 4), tables
    main = MAIN["wgsl" if language == "wgsl" else "c"].replace("HOLE", str(HOLE))
    if language == "wgsl":
        return library + main
    if language == "hlsl":
        body = main[main.index("    vec3 p"):]
        for old, new in (("vec3", "float3"), ("vec4", "float4"), ("mix", "lerp")):
            body = body.replace(old, new)
        return library + HLSL + body
    # Compute shaders are of ES 3.10 on: the text of ES 3.00 is a part of its language.
    return ("#version 310 es\nprecision highp float;\n" if language == "es" else "#version 450\n") + library + BUFFERS + main


def compiled(language, scratch, folder):
    """The shader as SPIR-V."""
    source, spirv = folder / "lit.comp", folder / "lit.spv"
    source.write_text(shader_text(language))
    if language == "wgsl":
        wgsl_command(scratch)  # fetches naga
        (scratch / "translate_lit.mjs").write_text(TRANSLATE)
        command = ["node", scratch / "translate_lit.mjs", source, spirv]
    elif language == "hlsl":
        command = ["glslangValidator", "-D", "-V", "-S", "comp", "-e", "main", "--quiet", source, "-o", spirv]
    else:
        command = ["glslc", source, "-o", spirv]
    if not shutil.which(command[0]):
        skip(f"{command[0]} is not installed")
    done = subprocess.run(command, capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit(f"{language}: {done.stdout}{done.stderr}")
    return spirv


def single(x):
    return struct.unpack("<f", struct.pack("<f", x))[0]


def add(a, b, scale=1.0):
    return [x + scale * y for x, y in zip(a, b)]


def unit(a):
    length = math.hypot(*a)
    return [x / length for x in a]


def direction(rng):
    return unit([rng.gauss(0, 1) for _ in range(3)])


def random_case(rng):
    """Position, normal, view, f0, roughness, and three corners; the fourth is v0 + s (v1 - v0) + t (v2 - v0)."""
    position, normal = [rng.uniform(-1, 1) for _ in range(3)], direction(rng)
    view = direction(rng)
    upwards = sum(a * b for a, b in zip(view, normal))
    if upwards < 0 and rng.random() < 0.95:  # few views are from below
        view = add(view, normal, -2 * upwards)
    towards = add(direction(rng), normal, 0.7)
    center = add(position, unit(towards), math.exp(rng.uniform(math.log(0.3), math.log(6))))
    x, y = ([math.exp(rng.uniform(math.log(0.1), math.log(2))) * c for c in direction(rng)] for _ in range(2))
    f0 = [0.04] * 3 if rng.random() < 0.5 else [rng.uniform(0.3, 1) for _ in range(3)]
    corners = [add(add(center, x, i), y, j) for i, j in ((-1, -1), (1, -1), (1, 1))]
    s, t = rng.uniform(-1.2, -0.3), rng.uniform(0.8, 1.2)  # -1 and 1: a parallelogram
    case = {"position": position, "normal": normal, "view": view, "f0": f0, "roughness": rng.uniform(0.05, 1), "corners": corners}
    case = {k: [[single(c) for c in v] for v in value] if k == "corners" else single(value) if k == "roughness" else [single(c) for c in value]
            for k, value in case.items()}
    case["fourth"] = s, t
    return case


def corners_of(case):
    v0, v1, v2 = case["corners"]
    s, t = case["fourth"]
    return [v0, v1, v2, add(add(v0, add(v1, v0, -1), s), add(v2, v0, -1), t)]


def moved(case, rng):
    """The case with every vector moved by at most one rounding of its length."""
    by = lambda length: [ROUNDING * length * rng.choice((-1, 1)) for _ in range(3)]
    return {**case, "normal": add(case["normal"], by(1)), "view": add(case["view"], by(1)),
            "corners": [add(v, by(math.dist(v, case["position"]))) for v in case["corners"]]}


def queries(case, method):
    """GGX and Lambert under the quad, the quad with a hole, and that with two lit sides."""
    quad = corners_of(case)
    center = [sum(v[i] for v in quad) / 4 for i in range(3)]
    hole = [add([c * (1 - HOLE) for c in center], v, HOLE) for v in quad]
    lights = [{"type": "polygon", "vertices": quad}, {"type": "polygon", "vertices": quad, "holes": [hole]}]
    lights.append({**lights[1], "two_sided": True})
    surface = {"position": case["position"], "normal": case["normal"], "view": case["view"]}
    for light in lights:
        yield {**surface, "light": light, "material": {"brdf": "ggx", "roughness": case["roughness"], "f0": case["f0"]}, "method": method}
        # A view from below the surface gets 0 from `eval`; the diffuse functions know no view.
        yield {k: v for k, v in surface.items() if k != "view"} | {"light": light, "material": {"brdf": "lambert"}, "method": "exact"}


def answers(program, cases, method):
    """By case: three times red, green and blue of GGX, and Lambert."""
    asked = [q for case in cases for q in queries(case, method)]
    done = subprocess.run([program, "eval"], input="".join(json.dumps(q) + "\n" for q in asked), capture_output=True, text=True)
    found = [json.loads(line) for line in done.stdout.splitlines()]
    assert len(found) == len(asked) and all("radiance" in a for a in found), next((a for a in found if "radiance" not in a), done.stderr)
    values = [a["radiance"] for a in found]
    return [[x for i in range(3) for x in (*values[6 * k + 2 * i], values[6 * k + 2 * i + 1][0])] for k in range(len(cases))]


def run(run_shader, spirv, cases):
    packed = []
    for case in cases:
        for vector in (case["position"], case["normal"], case["view"]):
            packed += [*vector, 0.0]
        packed += [*case["f0"], case["roughness"]]
        for corner in corners_of(case):
            packed += [*corner, 0.0]
    done = subprocess.run([run_shader, spirv, "32", "12"], input=struct.pack(f"<{len(packed)}f", *packed), capture_output=True)
    if done.returncode == 77:
        skip("there is no Vulkan device here")
    if done.returncode != 0:
        sys.exit(done.stderr.decode())
    print(done.stderr.decode().strip())
    found = struct.unpack(f"<{12 * len(cases)}f", done.stdout)
    return [found[12 * k:12 * k + 12] for k in range(len(cases))]


def main():
    language, run_shader, program, scratch = sys.argv[1], sys.argv[2], sys.argv[3], Path(sys.argv[4])
    rng = random.Random(20)
    cases = [random_case(rng) for _ in range(CASES)]
    with tempfile.TemporaryDirectory() as folder:
        got = run(run_shader, compiled(language, scratch, Path(folder)), cases)
    want = answers(program, cases, "ltc-compact")
    moves = [answers(program, [moved(case, rng) for case in cases], "ltc-compact") for _ in range(MOVES)]

    what = ["GGX"] * 3 + ["Lambert"]
    names = [f"{what[i % 4]}, {('quad', 'hole', 'hole, both sides')[i // 4]}" for i in range(12)]
    worst, beyond, lit = {}, [], 0
    for k, case in enumerate(cases):
        for i in range(12):
            change = max(abs(move[k][i] - want[k][i]) for move in moves)
            allowed = ROUNDINGS * (change + ROUNDING)  # and as many roundings of a sum of angles, a fraction of 1
            off = abs(got[k][i] - want[k][i])
            lit += want[k][i] > 0
            old = worst.get(names[i], (0, 0))
            worst[names[i]] = max(old[0], off), max(old[1], off / allowed)
            if not off <= allowed:
                beyond.append(f"seed 20, case {k}, {names[i]}: {got[k][i]} and not {want[k][i]}, allowed {allowed:.1e}: {case}")
    for name, (off, fraction) in worst.items():
        print(f"{language}, {name}: off by at most {off:.1e} from eval, {fraction:.2f} of what roundings allow")
    print(f"{lit} of {12 * CASES} values are not 0")
    assert lit > 6 * CASES / 3, lit

    best = answers(program, cases, "closed-form")
    off = [got[k][i] - best[k][i] for k in range(CASES) for i in range(3)]
    mean = math.sqrt(sum(x * x for x in off) / len(off))
    print(f"steradian_ggx_quad and the closed form differ by {mean:.4f} rms, {max(map(abs, off)):.4f} at most: the table's error")
    print("\n".join(beyond[:5]))
    sys.exit(bool(beyond))


if __name__ == "__main__":
    main()
