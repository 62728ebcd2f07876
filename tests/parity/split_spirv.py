#!/usr/bin/env python3
"""split_spirv.py SPIRV FOLDER: from the shader that knows every case, FOLDER/NAME.spv for each, with that case alone.

A driver compiles all that a module holds; with every case in one module the test would spend its time there. main() calls
run(), whose calls are the cases in their order (make_cases.py): each module calls its case in run()'s place, and what is
not reached from there is left out.

Every float operation is decorated NoContraction, as `precise` on every variable would do: a driver must then neither
fuse nor reorder, and results can be compared with the CPU's bit by bit.
"""
import struct
import sys
from pathlib import Path

from make_cases import cases

OP_NAME, OP_MEMBER_NAME, OP_ENTRY_POINT, OP_DECORATE, OP_MEMBER_DECORATE = 5, 6, 15, 71, 72
OP_FUNCTION, OP_FUNCTION_END, OP_FUNCTION_CALL = 54, 56, 57
OP_LINE, OP_NO_LINE = 8, 317
NO_CONTRACTION = 42
# FNegate FAdd FSub FMul FDiv FRem FMod VectorTimesScalar MatrixTimesScalar ... Dot
ARITHMETIC = {127, 129, 131, 133, 136, 140, 141, 142, 143, 144, 145, 146, 147, 148}


def opcode(instruction):
    return instruction[0] & 0xFFFF


class Module:
    def __init__(self, words):
        self.header, self.preamble, self.functions = words[:5], [], {}
        i, function = 5, None
        while i < len(words):
            instruction = words[i:i + (words[i] >> 16)]
            i += len(instruction)
            if opcode(instruction) == OP_FUNCTION:
                function = self.functions[instruction[2]] = []
            (self.preamble if function is None else function).append(instruction)
            if opcode(instruction) == OP_FUNCTION_END:
                function = None
        self.entry = next(x[2] for x in self.preamble if opcode(x) == OP_ENTRY_POINT)

    def calls(self, function):
        return [x[3] for x in self.functions[function] if opcode(x) == OP_FUNCTION_CALL]

    def reached(self, function):
        seen, todo = set(), [function]
        while todo:
            f = todo.pop()
            if f not in seen:
                seen.add(f)
                todo += self.calls(f)
        return seen

    # The function whose calls are the cases, and who calls it.
    def chooser(self, count):
        caller, function = None, self.entry
        while len(self.calls(function)) == 1:
            caller, function = function, self.calls(function)[0]
        if len(self.calls(function)) != count:
            sys.exit(f"the shader's chooser calls {len(self.calls(function))} functions, not {count} cases")
        return caller, function

    def with_case_alone(self, caller, chooser, case):
        functions = dict(self.functions)
        functions[caller] = [x[:3] + [case] + x[4:] if opcode(x) == OP_FUNCTION_CALL and x[3] == chooser else x
                             for x in functions[caller]]
        kept = {self.entry, caller} | self.reached(case)
        # main may reach run() through a wrapper
        f = self.entry
        while f != caller:
            f = self.calls(f)[0]
            kept.add(f)
        body = [x for f in functions if f in kept for x in functions[f]]
        dropped = {word for f in functions if f not in kept for x in functions[f] for word in defined(x)}
        exact = [[3 << 16 | OP_DECORATE, x[2], NO_CONTRACTION] for x in body if opcode(x) in ARITHMETIC]
        preamble = [x for x in self.preamble if not (opcode(x) in (OP_NAME, OP_DECORATE) and x[1] in dropped)]
        first = next(n for n, x in enumerate(preamble) if opcode(x) in (OP_DECORATE, OP_MEMBER_DECORATE))
        return self.header + [word for x in preamble[:first] + exact + preamble[first:] + body for word in x]


# Instructions inside functions that give no result, by opcode: those whose second word is no result.
NO_RESULT = {OP_FUNCTION_END, OP_LINE, OP_NO_LINE, 62, 63, 246, 247, 249, 250, 251, 252, 253, 254, 255}
LABEL = 248


def defined(instruction):
    code = opcode(instruction)
    if code == LABEL:
        return [instruction[1]]
    return [] if code in NO_RESULT or len(instruction) < 3 else [instruction[2]]


def main():
    data = Path(sys.argv[1]).read_bytes()
    module = Module(list(struct.unpack(f"<{len(data) // 4}I", data)))
    names, folder = [case["name"] for case in cases()], Path(sys.argv[2])
    folder.mkdir(parents=True, exist_ok=True)
    caller, chooser = module.chooser(len(names))
    for name, case in zip(names, module.calls(chooser)):
        words = module.with_case_alone(caller, chooser, case)
        (folder / f"{name}.spv").write_bytes(struct.pack(f"<{len(words)}I", *words))


if __name__ == "__main__":
    main()
