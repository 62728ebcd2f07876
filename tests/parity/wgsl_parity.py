#!/usr/bin/env python3
"""wgsl_parity.py PARITY SCRATCH: the parity cases as WGSL, translated by naga, against scalar float on the Vulkan device.

Exit 77 (skipped) where naga cannot be had or there is no Vulkan device.
"""
import subprocess
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))
from dist_compiles import skip, wgsl_command  # noqa: E402

TRANSLATE = """
import { readFileSync, writeFileSync } from "node:fs";
import { translate } from "naga-wasm";
try {
    const words = translate({ from: "wgsl", source: readFileSync(process.argv[2], "utf8"), to: "spirv" });
    writeFileSync(process.argv[3], new Uint8Array(words.buffer, words.byteOffset, words.byteLength));
} catch (e) {
    console.log(e.formatted ?? e);
    process.exit(1);
}
"""


def run(command, **options):
    done = subprocess.run(command, capture_output=True, text=True, **options)
    if done.returncode != 0:
        sys.exit(f"{' '.join(map(str, command))}\n{done.stdout}{done.stderr}")
    return done.stdout


def main():
    program, scratch = sys.argv[1], Path(sys.argv[2])
    wgsl_command(scratch)  # fetches naga
    (scratch / "translate.mjs").write_text(TRANSLATE)
    source, spirv, folder = scratch / "parity.wgsl", scratch / "parity_wgsl.spv", scratch / "parity_wgsl"
    source.write_text(run([sys.executable, HERE / "make_cases.py", "shader", "wgsl"]))
    run(["node", scratch / "translate.mjs", source, spirv])
    run([sys.executable, HERE / "split_spirv.py", spirv, folder])
    table = run([program, "10000", "WGSL", folder])
    if "WGSL" not in table:
        skip("no Vulkan device")
    print(table)


if __name__ == "__main__":
    main()
