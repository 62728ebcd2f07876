#!/usr/bin/env python3
"""Holds kernels, their parity cases and dist/source/ to the dialect of docs/dialect.md.

Works on tokens, without types: what only a type checker can see is left to the compilers, which read the same files.
Exit 1 when a file breaks a rule; each finding names file, line and rule.
"""
import re
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent))
sys.path.insert(0, str(Path(__file__).parent.parent / "tools"))
from kernel_text import CASE, FOLDERS, KERNELS, ROOT, case_files, kernel_files, needs, tokenize, topics, with_needs  # noqa: E402
from reserved_words import RESERVED  # noqa: E402

DIST_SOURCE = ROOT / "dist" / "source"
LOOK_UPS = {"ltc_ggx_shape": ("vec4", ["vec2"]), "ltc_ggx_magnitude": ("vec2", ["vec2"])}  # tables, which dist/ alone has
VECTORS = {"vec2": 2, "vec3": 3, "vec4": 4, "mat3": 3}
TYPES = {"real", "mask", "int"} | set(VECTORS)
BUILT_IN = {"abs", "min", "max", "clamp", "floor", "sqrt", "inversesqrt", "exp", "log", "dot", "cross", "transform",
            "transform_transposed", "xy", "select", "any_lane", "all_lanes", "real_digits"}
STATEMENTS = {"if", "else", "for", "return", "struct", "break", "continue", "true", "false"}
ASSIGNMENTS = {"=", "+=", "-=", "*=", "/="}
ALLOWED_OPERATORS = set("+-*/<>!=:;,.(){}[]") | ASSIGNMENTS | {"<=", ">=", "==", "!=", "&&", "||", "++", "--"}
NAMED = {"3.14159265358979324": "pi()", "0.318309886183790672": "inverse_pi()", "0.159154943091895336": "inverse_two_pi()",
         "1.0e-36": "smallest_square()", "1.0e-18": "smallest_length()", "1.0e-30": "smallest_divisor()"}
LITERAL = re.compile(r"\d+\.\d+(?:[eE][+-]?\d+)?")


class Lint:
    def __init__(self, path, text, known):
        self.path, self.text = path, text
        self.lines = text.splitlines()
        self.findings = []
        self.functions = dict(known["functions"])  # name -> (return type, [parameter types])
        self.structs = dict(known["structs"])      # name -> {member: (type, is array)}
        self.new_functions, self.new_structs = {}, {}
        self.topics = topics(path, text)

    def say(self, token, rule):
        self.findings.append((token.line, rule))

    def run(self):
        tokens = tokenize(self.text)
        for t in tokens:
            self.check_token(t)
        self.tokens = [t for t in tokens if t.kind not in ("comment", "directive")]
        i = 0
        while i < len(self.tokens):
            i = self.file_scope(i)
        self.findings.sort()
        return self.findings

    # ---- single tokens -------------------------------------------------------------------------------------------

    def check_token(self, t):
        if t.kind == "directive":
            self.say(t, "no preprocessor: a kernel is the same text in every language")
        elif t.kind == "error" or (t.kind == "op" and t.text not in ALLOWED_OPERATORS):
            self.say(t, f"'{t.text}' is not in the dialect" + (": use select" if t.text == "?" else ""))
        elif t.kind == "number" and not LITERAL.fullmatch(t.text) and not t.text.isdigit():
            self.say(t, f"'{t.text}': write a plain decimal with digits on both sides of the point and no suffix")
        elif t.kind == "number" and t.text in NAMED and Path(self.path).stem != "constants":
            self.say(t, f"'{t.text}' has a name: {NAMED[t.text]} (math/constants.glsl)")
        elif t.kind == "name" and t.text in RESERVED and t.text not in STATEMENTS | TYPES:
            self.say(t, f"'{t.text}' is a reserved word of {RESERVED[t.text]}")
        elif t.kind == "comment" and t.text.startswith("/*"):
            self.say(t, "comments are //")

    # ---- the file ------------------------------------------------------------------------------------------------

    def at(self, i):
        return self.tokens[i] if i < len(self.tokens) else self.tokens[-1]._replace(kind="end", text="")

    def closing(self, i):
        """Index of the bracket that closes the one at i."""
        pairs = {"(": ")", "{": "}", "[": "]"}
        depth, opening = 0, self.at(i).text
        for j in range(i, len(self.tokens)):
            depth += (self.tokens[j].text == opening) - (self.tokens[j].text == pairs[opening])
            if depth == 0:
                return j
        self.say(self.at(i), f"'{opening}' is not closed")
        return len(self.tokens)

    def file_scope(self, i):
        t = self.at(i)
        if t.text == "struct":
            return self.struct(i)
        is_function = self.at(i + 1).kind == "name" and self.at(i + 2).text == "("
        if is_function:
            return self.function(i)
        self.say(t, "only structs and functions at the top of a file: a constant is a function, there are no globals")
        while i < len(self.tokens) and self.at(i).text != ";":
            i = self.closing(i) if self.at(i).text in ("(", "{") else i
            i += 1
        return i + 1

    def commented(self, t):
        return t.line >= 2 and self.lines[t.line - 2].startswith("//")

    def has_topic(self, name):
        return any(name == topic or name.startswith(topic + "_") for topic in self.topics)

    def struct(self, i):
        name = self.at(i + 1)
        if not self.commented(self.at(i)):
            self.say(name, f"struct {name.text} has no comment above it")
        if not any(name.text.startswith(topic.title().replace("_", "")) for topic in self.topics):
            self.say(name, f"struct {name.text} does not begin with a topic of this file ({', '.join(self.topics)})")
        end = self.closing(i + 2)
        members, j = {}, i + 3
        while j < end:
            kind, member = self.at(j), self.at(j + 1)
            if kind.text not in TYPES and kind.text not in self.structs:
                self.say(kind, f"'{kind.text}' is not a type of the dialect")
            members[member.text] = (kind.text, self.at(j + 2).text == "[")
            k = j + 2
            while k < end and self.at(k).text != ";":
                if self.at(k).text == ",":
                    self.say(self.at(k), "one declaration a statement")
                k += 1
            j = k + 1
        if name.text in self.structs:
            self.say(name, f"struct {name.text} is defined twice")
        self.structs[name.text] = self.new_structs[name.text] = members
        return end + 2  # the brace and its semicolon

    def function(self, i):
        kind, name = self.at(i), self.at(i + 1)
        if kind.text not in TYPES and kind.text not in self.structs:
            self.say(kind, f"'{kind.text}' is not a type of the dialect")
        if not self.commented(kind):
            self.say(name, f"{name.text} has no comment above it")
        if not self.has_topic(name.text):
            self.say(name, f"{name.text} does not begin with a topic of this file ({', '.join(self.topics)})")
        if name.text in self.functions or name.text in BUILT_IN:
            self.say(name, f"{name.text} is defined twice: no overloading")
        close = self.closing(i + 2)
        variables, parameters = {}, []
        for part in self.split(i + 3, close):
            if not part:
                continue
            words = [t.text for t in part]
            if len(words) != 2 or (words[0] not in TYPES and words[0] not in self.structs):
                self.say(part[0], f"parameter '{' '.join(words)}': a type and a name; no out, inout, const, reference")
            variables[words[-1]] = words[0]
            parameters.append(words[-1])
        if self.at(close + 1).text != "{":
            self.say(name, "no declaration without a body: a function is defined before its use")
            return close + 2
        end = self.closing(close + 1)
        Body(self, kind.text, name.text, variables, set(parameters)).check(close + 2, end)
        signature = (kind.text, [variables[p] for p in parameters])
        self.functions[name.text] = self.new_functions[name.text] = signature
        return end + 1

    def split(self, begin, end):
        """The tokens between commas that no bracket hides."""
        parts, depth = [[]], 0
        for t in self.tokens[begin:end]:
            depth += (t.text in "([{") - (t.text in ")]}") if t.kind == "op" and len(t.text) == 1 else 0
            if t.text == "," and depth == 0:
                parts.append([])
            else:
                parts[-1].append(t)
        return parts


class Body:
    """The checks inside one function."""

    def __init__(self, lint, kind, name, variables, parameters):
        self.lint, self.kind, self.name = lint, kind, name
        self.variables, self.parameters = variables, parameters
        self.at, self.closing, self.say = lint.at, lint.closing, lint.say

    def check(self, begin, end):
        self.block(begin, end, uniform=True, outermost=True)

    def block(self, i, end, uniform, outermost=False):
        while i < end:
            t = self.at(i)
            if t.text == "{":
                close = self.closing(i)
                self.block(i + 1, close, uniform)
                i = close + 1
            elif t.text == "if":
                close = self.closing(i + 1)
                by_int = self.condition(i + 2, close)
                i = self.branch(close + 1, uniform and by_int)
            elif t.text == "else":
                i = self.branch(i + 1, uniform) if self.at(i + 1).text != "if" else i + 1
            elif t.text == "for":
                close = self.closing(i + 1)
                self.for_header(i + 2, close)
                i = self.branch(close + 1, uniform)
            else:
                stop = i
                while stop < end and self.at(stop).text != ";":
                    stop += 1
                if t.text == "return" and not (uniform and (outermost is False or stop + 1 >= end)):
                    self.say(t, "no early return on data: select, and return at the end")
                self.statement(i, stop)
                i = stop + 1

    def branch(self, i, uniform):
        if self.at(i).text != "{":
            self.say(self.at(i), "a branch and a loop have braces")
            stop = i
            while self.at(stop).text not in (";", ""):
                stop += 1
            self.block(i, stop + 1, uniform)
            return stop + 1
        close = self.closing(i)
        self.block(i + 1, close, uniform)
        return close + 1

    def is_int(self, t):
        return (t.kind == "number" and t.text.isdigit()) or self.variables.get(t.text) == "int" or (
            t.text == "real_digits" or self.lint.functions.get(t.text, ("",))[0] == "int")

    def condition(self, i, end):
        """True when only ints decide; False when any_lane or all_lanes does. Anything else is a finding."""
        by_int = True
        first = i
        while i < end:
            t = self.at(i)
            if t.text in ("any_lane", "all_lanes"):
                by_int = False
                i = self.closing(i + 1)
            elif t.text == "." or (t.kind in ("name", "number") and not self.is_int(t)
                                   and not self.is_int_member(i)):
                self.say(t, f"'{t.text}' decides a branch: only ints, any_lane(m) and all_lanes(m) may; else select")
                return False
            i += 1
        self.expression(first, end, int_context=True)
        return by_int

    def is_int_member(self, i):
        return any(members.get(self.at(i).text, ("",))[0] == "int" for members in self.lint.structs.values())

    def for_header(self, i, end):
        if self.at(i).text == "int":
            self.declare(i)
        if "int" != self.variables.get(self.at(i + 1).text) or not any(
                self.at(j).text == "<" or self.at(j).text == "<=" for j in range(i, end)):
            self.say(self.at(i), "a loop counts: for (int i = 0; i < n; i++)")
        parts, j = [[]], i
        while j < end:
            if self.at(j).text == ";":
                parts.append([])
            else:
                parts[-1].append(j)
            j += 1
        if len(parts) == 3 and parts[1]:
            self.condition(parts[1][0], parts[1][-1] + 1)

    def declare(self, i):
        kind, name = self.at(i).text, self.at(i + 1)
        if name.text in self.variables:
            self.say(name, f"'{name.text}' hides another variable")
        self.variables[name.text] = kind

    def statement(self, i, end):
        first = self.at(i)
        int_context = False
        if first.text in TYPES | set(self.lint.structs) and self.at(i + 1).kind == "name":
            self.declare(i)
            int_context = first.text == "int"
            if len(self.lint.split(i, end)) > 1:
                self.say(first, "one declaration a statement")
            if self.at(i + 2).text == "[":
                self.say(first, "arrays only inside structs")
        elif first.text == "return":
            int_context = self.kind == "int"
        elif first.kind == "name":
            if first.text in self.parameters and any(self.at(j).text in ASSIGNMENTS | {"++", "--"}
                                                     for j in range(i, end)):
                self.say(first, f"parameter '{first.text}' is assigned to: copy it")
            int_context = self.variables.get(first.text) == "int"
            if not any(self.at(j).text in ASSIGNMENTS | {"++", "--"} for j in range(i, end)) and first.text not in (
                    "break", "continue"):
                self.say(first, f"'{first.text}': unknown type, or a statement without effect")
        self.expression(i, end, int_context)

    def expression(self, i, end, int_context):
        logic = [set()]
        for j in range(i, end):
            t = self.at(j)
            before, after = self.at(j - 1), self.at(j + 1)
            if t.text in ("(", "["):
                logic.append(set())
            elif t.text in (")", "]") and len(logic) > 1:
                logic.pop()
            elif t.text == ",":
                logic[-1].clear()
            elif t.text in ("&&", "||"):
                logic[-1].add(t.text)
                if len(logic[-1]) == 2:
                    self.say(t, "&& beside || needs parentheses (WGSL)")
            if t.kind == "number" and t.text.isdigit() and not int_context and not self.int_place(j):
                self.say(t, f"'{t.text}' in real arithmetic: write {t.text}.0")
            if t.kind == "name" and before.text == ".":
                self.member(t)
            elif t.kind == "name" and after.text == "(":
                self.call(j)
            if t.text == "[" and not any(m.get(before.text, ("", False))[1] for m in self.lint.structs.values()):
                self.say(t, f"'{before.text}[': only arrays inside structs have an index; vectors have x y z w")
            if t.text == "*" and "mat3" in (self.variables.get(before.text), self.variables.get(after.text)) and (
                    self.at(j + 2).text != "."):
                self.say(t, "matrix products differ between languages: transform(m, v) or transform_transposed(m, v)")

    def int_place(self, j):
        """An int literal that is an index, an argument for an int, or beside an int."""
        before, after = self.at(j - 1), self.at(j + 1)
        if before.text == "[" or after.text == "]":
            return True
        if before.kind == "op" and before.text not in "(,=" and (self.is_int(self.at(j - 2)) or (
                self.at(j - 2).text == ")" and self.at(j - 4).text == "real_digits") or self.is_int_member(j - 2)):
            return True
        if after.kind == "op" and after.text not in "),;" and self.is_int(self.at(j + 2)):
            return True
        return self.argument_is_int(j)

    def argument_is_int(self, j):
        depth, position, k = 0, 0, j - 1
        while k > 0 and self.at(k).text not in (";", "{", "}"):
            text = self.at(k).text
            depth += (text == ")") - (text == "(")
            if depth < 0:
                signature = self.lint.functions.get(self.at(k - 1).text)
                return bool(signature) and position < len(signature[1]) and signature[1][position] == "int"
            position += text == "," and depth == 0
            k -= 1
        return False

    def member(self, t):
        if t.text in ("x", "y", "z", "w") or any(t.text in m for m in self.lint.structs.values()):
            return
        self.say(t, f"'.{t.text}': members are x, y, z, w and those of structs; no swizzles, xy(v) for the first two")

    def call(self, j):
        t = self.at(j)
        if t.text in ("if", "for", "return"):
            return
        arguments = len([p for p in self.lint.split(j + 2, self.closing(j + 1)) if p])
        if t.text in VECTORS:
            if arguments != VECTORS[t.text]:
                self.say(t, f"{t.text} takes {VECTORS[t.text]} values, here are {arguments}: no splat, no packing")
        elif t.text in self.lint.structs:
            self.say(t, f"{t.text}(...): structs are filled field by field")
        elif t.text not in BUILT_IN and t.text != "real" and t.text not in self.lint.functions:
            self.say(t, f"{t.text} is not defined above (in this file, or in one that the head's Needs: line names)")


def lint_text(path, text, known=None):
    known = known or {"functions": {}, "structs": {}}
    lint = Lint(path, text, known)
    findings = lint.run()
    return findings, lint


def lint_file(path, cache):
    """Findings of one file; what it defines is kept for the files that need it."""
    path = Path(path)
    known = {"functions": dict(LOOK_UPS) if path.parent == DIST_SOURCE else {}, "structs": {}}
    for needed in with_needs(path)[:-1]:
        if needed not in cache:
            lint_file(needed, cache)
        known["functions"].update(cache[needed][1].new_functions)
        known["structs"].update(cache[needed][1].new_structs)
    if path not in cache:
        cache[path] = lint_text(path, path.read_text(), known)
    return cache[path][0]


def upward_needs(path):
    """What a file needs of folders after its own."""
    place = {folder: n for n, folder in enumerate(FOLDERS)}
    return [p for p in needs(path, path.read_text()) if place.get(p.parent.name, -1) > place.get(path.parent.name, len(FOLDERS))]


def main():
    cache, bad = {}, 0
    files = kernel_files() + [CASE] + case_files() + [DIST_SOURCE / "lit.glsl"]
    owner = {}
    for path in files:
        for needed in upward_needs(path):
            bad += 1
            print(f"{path}: needs {needed}: a folder may need those before it ({', '.join(FOLDERS)})")
        for line, rule in lint_file(path, cache):
            bad += 1
            print(f"{path}:{line}: {rule}")
        for name in list(cache[path][1].new_functions) + list(cache[path][1].new_structs):
            if name in owner:
                bad += 1
                print(f"{path}: {name} is also defined in {owner[name]}: all kernels share one scope")
            owner[name] = path
    listed = re.findall(r'#include "kernels/(\w+/\w+\.glsl)"', (ROOT / "include" / "steradian" / "kernels.h").read_text())
    for path in {str(p.relative_to(KERNELS)) for p in kernel_files()} ^ set(listed):
        bad += 1
        print(f"include/steradian/kernels.h: {path} is a kernel or is included, and not both")
    print(f"{len(files)} files, {len(owner)} functions and structs, {bad} findings")
    sys.exit(bad > 0 or not files)


if __name__ == "__main__":
    main()
