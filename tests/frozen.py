#!/usr/bin/env python3
"""Frozen answers: hashes of what the program computes, so that a refactoring that changes a byte is seen in minutes.

    tests/frozen.py PROGRAM --write FILE   write the hashes of all cases
    tests/frozen.py PROGRAM --check FILE   compute them again; print each case whose hash differs, and exit 1

The cases are every scene of scenes/, with methods, shadows, bounces and environments, and every plane scene, on each instruction set
that the program and this machine have, and on the first Vulkan device (Mesa's software device in a test machine); `eval` over the fuzz
corpus and over random queries; and the files of dist/. Hashes hold for one machine and one compiler: freeze before a change, check
after it. Packs are compiled with contraction, so that a merged unit may round otherwise: where that matters, build both with
-DCMAKE_CXX_FLAGS=-ffp-contract=off.
"""
import argparse
import concurrent.futures
import hashlib
import json
import math
import os
import random
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
SIZE = ("--size", "80x45")  # tiles at the picture's edge are cut

METHODS = ["series", "exact", "closed-form", "ltc", "ltc-compact", "ltc-clipless", "representative-point", "half-vector", "sampled"]
VARIANTS = {
    "plain": (),
    "open": ("--shadows", "off"),
    "exact-shadows": ("--shadows", "exact"),
    "smooth": ("--terminator", "smooth"),
    "draft": ("--quality", "draft"),
    "high": ("--quality", "high"),
    "scattering": ("--multiple-scattering",),
    "tree": ("--lights", "tree"),
    "aa": ("--aa", "4"),
    "sky": ("--environment", "sky"),
    "sun": ("--light", "sun"),
    "bounce": ("--indirect", "ltc", "--vpls", "4096", "--indirect-shadows", "2"),
    "bounce-ggx": ("--indirect", "ggx", "--vpls", "4096"),
    "path": ("--indirect", "path", "--spp", "2"),
}
PLANE_VARIANTS = {
    "auto": (),
    "exact": ("--method", "exact"),
    "par": ("--method", "par"),
    "sampled": ("--method", "sampled", "--spp", "8"),
    "marched": ("--method", "marched", "--spp", "8"),
    "bounce-1": ("--bounces", "1"),
    "bounces": ("--bounces", "all"),
    "moments": ("--moments",),
    "clear": ("--occluders", "clear"),
}
DEVICE_VARIANTS = ("plain", "open", "bounce", "smooth")
MATERIALS = [
    {"brdf": "lambert", "albedo": 0.5}, {"brdf": "phong", "exponent": 20}, {"brdf": "phong", "exponent": 351.5},
    {"brdf": "ggx", "alpha": 0.09}, {"brdf": "ggx", "alpha": 0.5, "f0": 0.04, "f90": 1}, {"brdf": "beckmann", "alpha": 0.3},
]


def queries(count=600):
    """Random lines for `eval`: lights of every shape before surfaces of every lobe."""
    r = random.Random(1)
    lines = []
    for _ in range(count):
        def vector(scale):
            return [r.gauss(0, 1) * scale for _ in range(3)]
        center, u, v = vector(2), vector(0.7), vector(0.7)
        center[1] = abs(center[1]) + 0.2
        corners = ((-1, -1), (1, -1), (1, 1), (-1, 1))
        light = r.choice([
            {"type": "polygon", "vertices": [[center[i] + s * u[i] + t * v[i] for i in range(3)] for s, t in corners], "two_sided": True},
            {"type": "rect", "center": center, "x": u, "y": v, "two_sided": True},
            {"type": "sphere", "center": center, "radius": 0.1 + r.random()},
            {"type": "disk", "center": center, "x": u, "y": v, "two_sided": True},
            {"type": "capsule", "ends": [center, [center[i] + u[i] for i in range(3)]], "radius": 0.05 + 0.2 * r.random()},
        ])
        angle = r.uniform(0, 1.5)
        lines.append(json.dumps({"light": {**light, "radiance": [1, 0.5, 0.25]}, "position": [0, 0, 0], "normal": [0, 1, 0],
                                 "view": [math.sin(angle), math.cos(angle), 0], "material": r.choice(MATERIALS)}))
    return "\n".join(lines) + "\n"


def instruction_sets(program):
    flags = Path("/proc/cpuinfo").read_text()
    built = subprocess.run([program, "info"], capture_output=True, text=True, check=True).stdout
    here = {"sse2": "sse2", "avx2": "avx2", "avx512": "avx512bw"}
    return [isa for isa, flag in here.items() if f" {flag}" in flags and isa in built]


def cases(program):
    """{name: (arguments, environment, input)}; `{out}` in the arguments is the file to hash, or else the standard output is."""
    found = {}
    spaces = sorted((ROOT / "scenes").glob("*.glb"))
    planes = sorted((ROOT / "scenes" / "plane").glob("*.svg"))
    for isa in instruction_sets(program):
        env = {"STERADIAN_SIMD": isa}
        for scene in spaces:
            for name, options in VARIANTS.items():
                found[f"{isa} {scene.name} {name}"] = (("render", scene, "-o", "{out}.exr", *SIZE, *options), env, None)
            for method in METHODS:
                found[f"{isa} {scene.name} --method {method}"] = (("render", scene, "-o", "{out}.exr", *SIZE, "--method", method), env, None)
        for scene in planes:
            for name, options in PLANE_VARIANTS.items():
                found[f"{isa} {scene.name} {name}"] = (("render", scene, "-o", "{out}.exr", *SIZE, *options), env, None)
        texts = {p.name: p.read_text(errors="replace") for p in sorted((ROOT / "tests" / "fuzz" / "corpus" / "eval").iterdir())}
        for name, text in {**texts, "random queries": queries()}.items():
            found[f"{isa} eval {name}"] = (("eval",), env, text)
    if "vulkan devices" in subprocess.run([program, "info"], capture_output=True, text=True, check=True).stdout:
        for scene in spaces:
            for name in DEVICE_VARIANTS:
                found[f"vulkan {scene.name} {name}"] = (("render", scene, "-o", "{out}.exr", *SIZE, "--backend", "vulkan", *VARIANTS[name]), {}, None)
        for scene in planes:
            found[f"vulkan {scene.name}"] = (("render", scene, "-o", "{out}.exr", *SIZE, "--backend", "vulkan"), {}, None)
    return found


def answer(program, case):
    """The hash of a case's bytes, or of its message where the program refuses it."""
    arguments, environment, text = case
    with tempfile.TemporaryDirectory() as folder:
        out = Path(folder) / "answer"
        arguments = [str(a).replace("{out}", str(out)) for a in arguments]
        if arguments[0] == "render":
            arguments += ["--threads", "1"]
        run = subprocess.run([program, *arguments], input=text, capture_output=True, text=True, env={**os.environ, **environment})
        files = sorted(Path(folder).iterdir())
        content = b"".join(p.read_bytes() for p in files) if files else (run.stdout + run.stderr).replace(folder, "").encode()
        kind = "refused" if run.returncode else "done"
        return f"{hashlib.sha256(content).hexdigest()[:20]} {kind} {run.returncode}"


def compute(program):
    table = {f"dist {p.relative_to(ROOT)}": hashlib.sha256(p.read_bytes()).hexdigest()[:20] for p in sorted((ROOT / "dist").rglob("*")) if p.is_file()}
    todo = cases(program)
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        jobs = {name: pool.submit(answer, program, case) for name, case in todo.items()}
        for n, (name, job) in enumerate(jobs.items(), 1):
            table[name] = job.result()
            if sys.stderr.isatty() or n % 100 == 0:
                print(f"frozen: {n} of {len(jobs)}", file=sys.stderr, end="\r" if sys.stderr.isatty() else "\n")
    return table


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", type=Path)
    what = parser.add_mutually_exclusive_group(required=True)
    what.add_argument("--write", type=Path, metavar="FILE")
    what.add_argument("--check", type=Path, metavar="FILE")
    args = parser.parse_args()
    program = args.program.resolve()
    if not program.is_file():
        sys.exit(f"frozen: {args.program} is not a program: build it first, e.g. ./dev build")
    before = json.loads(args.check.read_text()) if args.check else None
    table = compute(program)
    if args.write:
        args.write.write_text(json.dumps(table, indent=0) + "\n")
        refused = sum("refused" in v for v in table.values())
        print(f"frozen: {len(table)} answers in {args.write}; the program refuses {refused} of them, and their messages are frozen too")
        return
    different = [name for name in sorted(set(table) | set(before)) if table.get(name) != before.get(name)]
    for name in different:
        print(f"{name}: {'new' if name not in before else 'gone' if name not in table else f'was {before[name]}, is {table[name]}'}")
    print(f"frozen: {len(table) - len(different)} of {len(table)} answers are equal")
    sys.exit(bool(different))


if __name__ == "__main__":
    main()
