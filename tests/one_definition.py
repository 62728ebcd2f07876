#!/usr/bin/env python3
"""No name is defined twice in one namespace: one_definition.py [COMPILER INCLUDE...]

The linker merges what two files define under one name, silently, and keeps whichever copy comes first. Two checks find that before:
types, templates' types and inline constants of all files of source/ and apps/ are collected by namespace (what stands in an unnamed
namespace, or in a namespace named after an instruction set, is a file's own); and with a COMPILER, one unit that includes every header must compile.
Exit 1 when a name has two definitions. With --test: exit 1 when one made up for the purpose is not found.
"""
import re
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
TOKEN = re.compile(r"//[^\n]*|/\*.*?\*/|R\"\((?:.|\n)*?\)\"|\"(?:\\.|[^\"\\\n])*\"|'(?:\\.|[^'\\\n])'|^[ \t]*#(?:\\\n|[^\n])*|\w+|::|[^\s\w]",
                   re.DOTALL | re.MULTILINE)


def definitions(text):
    """{(namespace, name)} of the types and inline constants that a file defines for others to merge."""
    tokens = [t for t in TOKEN.findall(text) if not t.startswith(("//", "/*", "#")) and t.strip()[:1] != "#"]
    found, stack, i = set(), [], 0  # stack: a namespace's name, None for an unnamed one, "" for any other brace
    while i < len(tokens):
        t = tokens[i]
        inside = all(s not in (None, "") for s in stack)
        if t == "STERADIAN_BEGIN_ISA":
            return found  # compiled per instruction set: the test of the packs' symbols holds these apart
        if t == "namespace" and inside | (None in stack):
            j = i + 1
            while tokens[j] not in ("{", ";", "="):
                j += 1
            if tokens[j] == "{":
                stack.append("".join(tokens[i + 1:j]) or None)
                i = j + 1
                continue
        elif t in ("struct", "class", "union", "enum") and inside and (i == 0 or tokens[i - 1] not in ("<", ",", "enum", "friend")):
            j = i + 1 + (tokens[i + 1] in ("class", "struct"))
            name, k = tokens[j], j + 1
            if tokens[k] in ("{", ":", "final") and tokens[i - 1] != ">":
                found.add(("::".join(stack), name))
        elif t == "constexpr" and inside and i > 0 and tokens[i - 1] == "inline":
            j = i + 1
            while tokens[j] not in ("=", "{", "(", ";"):
                j += 1
            if tokens[j] != "(":
                found.add(("::".join(stack), tokens[j - 1] if tokens[j - 1] != "]" else tokens[j - 4]))
        if t == "{":
            stack.append("")
        elif t == "}" and stack:
            stack.pop()
        i += 1
    return found


def doubles(texts):
    owner, words = {}, []
    for path, text in texts.items():
        for what in sorted(definitions(text)):
            if what in owner:
                words.append(f"{what[0]}::{what[1]} is defined in {owner[what]} and in {path}")
            owner.setdefault(what, path)
    return words, len(owner)


def main():
    if sys.argv[1:] == ["--test"]:
        text = "namespace steradian {\ninline constexpr int kSide = 16;\nstruct Tile { int x; };\n}\n"
        hidden = "namespace steradian {\nnamespace {\nstruct Tile { int y; };\n}\n}\n"
        found = [len(doubles({"a.h": text, "b.h": text})[0]) == 2, not doubles({"a.h": text, "b.cpp": hidden})[0]]
        print(f"two definitions found, an unnamed namespace's left alone: {found}")
        sys.exit(not all(found))
    files = [p for top in ("include", "source", "apps") for p in sorted((ROOT / top).rglob("*"))
             if p.suffix in (".h", ".cpp") and "_test" not in p.name and not p.name.startswith("without_")]
    words, count = doubles({p.relative_to(ROOT): p.read_text() for p in files})
    print("\n".join(words + [f"{count} names in {len(files)} files, {len(words)} with two definitions"]))
    if sys.argv[1:]:
        headers = [p for p in files if p.suffix == ".h" and not re.search(r"_pack\.h$|core/pack\.h$|/test_", str(p))]
        with tempfile.TemporaryDirectory() as folder:
            unit = Path(folder) / "every_header.cpp"
            unit.write_text("".join(f'#include "{p}"\n' for p in headers))
            done = subprocess.run([*sys.argv[1:], "-std=c++20", "-fsyntax-only", str(unit)], capture_output=True, text=True)
        print(done.stderr[:4000] + f"{len(headers)} headers in one unit: {'they stand together' if done.returncode == 0 else 'refused'}")
        words += [done.stderr] if done.returncode else []
    sys.exit(bool(words))


if __name__ == "__main__":
    main()
