#!/usr/bin/env python3
"""embed_spirv.py SPIRV OUTPUT: writes a shader with contraction forbidden everywhere, as a C++ list of words; where OUTPUT
ends in .spv, as SPIR-V again.

Every float operation is decorated NoContraction, as `precise` on every variable would do: a driver must then neither
fuse nor reorder, and results can be compared with the CPU's bit by bit.
"""
import struct
import sys
from pathlib import Path

OP_DECORATE, OP_MEMBER_DECORATE, NO_CONTRACTION = 71, 72, 42
# FNegate FAdd FSub FMul FDiv FRem FMod VectorTimesScalar MatrixTimesScalar ... Dot
ARITHMETIC = {127, 129, 131, 133, 136, 140, 141, 142, 143, 144, 145, 146, 147, 148}


def without_contraction(words):
    header, body = words[:5], words[5:]
    results, first_decoration, i = [], None, 0
    while i < len(body):
        opcode, length = body[i] & 0xFFFF, body[i] >> 16
        if opcode in ARITHMETIC:
            results.append(body[i + 2])
        if first_decoration is None and opcode in (OP_DECORATE, OP_MEMBER_DECORATE):
            first_decoration = i
        i += length
    decorations = [w for r in results for w in (3 << 16 | OP_DECORATE, r, NO_CONTRACTION)]
    return header + body[:first_decoration] + decorations + body[first_decoration:]


def main():
    data = Path(sys.argv[1]).read_bytes()
    words = without_contraction(list(struct.unpack(f"<{len(data) // 4}I", data)))
    if sys.argv[2].endswith(".spv"):
        Path(sys.argv[2]).write_bytes(struct.pack(f"<{len(words)}I", *words))
        return
    lines = [", ".join(f"0x{w:08x}" for w in words[i:i + 10]) for i in range(0, len(words), 10)]
    Path(sys.argv[2]).write_text(",\n".join(lines) + "\n")


if __name__ == "__main__":
    main()
