#!/usr/bin/env python3
"""Counts the house: lines and files by room, sizes of files, names that two types share; and holds its rules.

    tools/house.py                 print the figures
    tools/house.py --check RULE    exit 1 and print each place that breaks RULE:
                                   comments   a comment begins with Of, What, Whether, Where, Those or Who
                                   mirrors    a shader says that its text repeats a file of source/
                                   constants  a shader holds a number of four digits, zeros not counted, that a kernel holds
                                   types      two types have one name (a type within another one is named with its owner)
                                   folders    a folder of source/ holds more than 25 files
                                   pages      a page of docs/ (not of theory/ or measured/) has more than 900 words, README.md more than
                                              120 lines, or an entry of CHANGELOG.md more than 160 characters
    tools/house.py --test          exit 1 when a broken rule, made up for the purpose, is not found

Tests (x_test.cpp) count apart. Only files that git tracks are read.
"""
import argparse
import collections
import re
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
FOLDER_LIMIT = 25
PAGE_LIMIT, README_LIMIT, ENTRY_LIMIT = 900, 120, 160
TEXTS = {".h": "//", ".cpp": "//", ".glsl": "//", ".comp": "//", ".vert": "//", ".frag": "//", ".js": "//", ".py": "#", ".cmake": "#"}
FIRST_WORDS = re.compile(r"(Of|What|Whether|Where|Those|Who)\b")


def tracked():
    names = subprocess.run(["git", "ls-files"], cwd=ROOT, capture_output=True, text=True, check=True).stdout.split("\n")
    return [Path(n) for n in names if n and (ROOT / n).is_file()]


def is_test(path):
    return "_test" in path.name


def read(path):
    return (ROOT / path).read_text(errors="replace")


# Rules: each takes {path: text} and yields (path, line, words).


def comments(texts):
    for path, text in texts.items():
        mark = TEXTS.get(path.suffix)
        if mark is None:
            continue
        inside = False  # a comment of several lines
        for number, line in enumerate(text.split("\n"), 1):
            stripped = line.strip()
            alone = stripped.startswith(mark)
            words = stripped[len(mark):].strip() if alone else ""
            if alone and not inside and FIRST_WORDS.match(words):
                yield path, number, f"the comment begins with {FIRST_WORDS.match(words)[0]}: {words[:60]}"
            inside = alone


def mirrors(texts):
    for path, text in texts.items():
        if path.parts[0] == "shaders":
            for number, line in enumerate(text.split("\n"), 1):
                if re.search(r"\b(as|as in|as there|[Mm]irrors)\b.*(source/|\.h\b|\.cpp\b)", line):
                    yield path, number, line.strip()[:80]


def numbers(text):
    """(line, number) of each number that a text writes with at least four digits, zeros not counted."""
    for number, line in enumerate(text.split("\n"), 1):
        for m in re.finditer(r"(?<![\w.])\d+\.?\d*(?:[eE][-+]?\d+)?", line.split("//")[0]):
            if len(re.sub(r"[eE].*|[.0]", "", m[0])) >= 4:
                yield number, float(m[0])


def constants(texts):
    held = {value: path for path, text in texts.items() if path.parts[0] == "kernels" for _, value in numbers(text)}
    for path, text in texts.items():
        if path.parts[0] == "shaders":
            for number, value in numbers(text):
                if value in held:
                    yield path, number, f"{value} is a number of {held[value]}, too: call its function"


def type_names(texts):
    """{name: [path]} of classes, structs and enumerations that a file of the library or a program defines outside another type.

    A type within another one is named with its owner, Owner::Name, so it does not count.
    """
    token = re.compile(r"namespace\b[^;{]*\{|\b(?:enum(?:\s+class)?|class|struct)\s+(\w+)(?:\s+final)?\s*(?::(?!:)[^;{}()]*)?\{|[{}]")
    where = collections.defaultdict(list)
    for path, text in texts.items():
        if path.parts[0] in ("source", "include", "apps") and path.suffix in (".h", ".cpp") and not is_test(path):
            code = re.sub(r"//[^\n]*|/\*.*?\*/|\"(?:\\.|[^\"\\\n])*\"|'(?:\\.|[^'\\\n])'", "", text, flags=re.DOTALL)
            inside = []  # of each open brace: is it a namespace's?
            for m in token.finditer(code):
                if m[0] == "}":
                    if inside:
                        inside.pop()
                    continue
                if m[1] and all(inside):
                    where[m[1]].append(path)
                inside.append(m[0].startswith("namespace"))
    return where


def types(texts):
    for name, paths in sorted(type_names(texts).items()):
        if len(paths) > 1:
            yield paths[0], 1, f"{name} is also a type of {', '.join(str(p) for p in paths[1:])}"


def folders(texts):
    held = collections.Counter(p.parent for p in texts
                               if p.parts[0] in ("source", "apps", "kernels", "shaders") and not is_test(p) and p.suffix != ".md")
    for folder, count in sorted(held.items()):
        if count > FOLDER_LIMIT:
            yield folder, 1, f"{count} files, more than {FOLDER_LIMIT}"


def pages(texts):
    for path, text in texts.items():
        if path.parent == Path("docs") and path.suffix == ".md" and len(text.split()) > PAGE_LIMIT:
            yield path, 1, f"{len(text.split())} words, more than {PAGE_LIMIT}"
        if path == Path("README.md") and text.count("\n") > README_LIMIT:
            yield path, 1, f"{text.count(chr(10))} lines, more than {README_LIMIT}"
        if path == Path("CHANGELOG.md"):
            for number, line in enumerate(text.split("\n"), 1):
                if len(line) > ENTRY_LIMIT:
                    yield path, number, f"{len(line)} characters, more than {ENTRY_LIMIT}"


RULES = {"comments": comments, "mirrors": mirrors, "constants": constants, "types": types, "folders": folders, "pages": pages}


def room_of(path):
    if path.parts[0] == "source" and len(path.parts) > 2:
        return "/".join(path.parts[:3]) if len(path.parts) > 3 else "/".join(path.parts[:2])
    return path.parts[0] if len(path.parts) < 3 else "/".join(path.parts[:2]) if path.parts[0] in ("source", "apps") else path.parts[0]


def figures(texts):
    rooms = collections.defaultdict(list)
    for path, text in texts.items():
        if path.suffix in TEXTS or path.suffix == ".md":
            rooms[room_of(path), is_test(path)].append((text.count("\n"), path))
    print(f"{'room':34} {'files':>6} {'lines':>7} {'mean':>5} {'longest':>8}")
    for (room, test), files in sorted(rooms.items()):
        longest = max(files)
        name = room + (" (tests)" if test else "")
        lines = sum(n for n, _ in files)
        print(f"{name:34} {len(files):6} {lines:7} {lines / len(files):5.0f} {longest[0]:8}  {longest[1].name}")
    own = [(n, p) for (room, test), files in rooms.items() if not test for n, p in files if p.parts[0] == "source"]
    print()
    print(f"source without tests: {sum(n for n, _ in own)} lines in {len(own)} files")
    for top in ("shaders", "kernels", "docs"):
        print(f"{top}: {sum(n for (room, _), files in rooms.items() for n, p in files if p.parts[0] == top)} lines")
    for rule, check in RULES.items():
        print(f"{rule}: {sum(1 for _ in check(texts))} places break the rule")


def self_test():
    bad = {
        Path("source/a/a.h"): "// Of a light.\nstruct Twice {\n};\n",
        Path("source/a/b.h"): "int x;  // fine\n// Fine: a sentence\n// Of course a second line may begin so.\ntemplate <class T>\nclass Twice final : Base {\n",
        Path("shaders/a.comp"): "// The same text as source/a/a.h\nfloat a = 0.10471976;\nfloat b = 1000001.0;\n",
        Path("kernels/a.glsl"): "real part() { return 0.10471976; }\nreal b() { return 1000001.0; }\n",
    }
    bad[Path("source/a/c.h")] = "class Owner {\n  struct Twice {\n  };\n};\n"  # Owner::Twice: another name
    bad.update({Path(f"source/full/{i}.h"): "" for i in range(FOLDER_LIMIT + 1)})
    bad[Path("docs/long.md")] = "word " * (PAGE_LIMIT + 1)
    bad[Path("docs/theory/long.md")] = "word " * (PAGE_LIMIT + 1)
    bad[Path("README.md")] = "\n" * (README_LIMIT + 1)
    bad[Path("CHANGELOG.md")] = "# Changelog\n" + "-" * (ENTRY_LIMIT + 1) + "\n"
    expected = {"comments": [(Path("source/a/a.h"), 1)], "mirrors": [(Path("shaders/a.comp"), 1)], "constants": [(Path("shaders/a.comp"), 2)],
                "types": [(Path("source/a/a.h"), 1)],
                "folders": [(Path("source/full"), 1)], "pages": [(Path("docs/long.md"), 1), (Path("README.md"), 1), (Path("CHANGELOG.md"), 2)]}
    wrong = 0
    for rule, check in RULES.items():
        found = [(path, number) for path, number, _ in check(bad)]
        print(f"{rule}: found {[f'{p}:{n}' for p, n in found]}")
        wrong += found != expected[rule]
    sys.exit(wrong != 0)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--check", choices=sorted(RULES), help="rule to hold")
    parser.add_argument("--test", action="store_true", help="check the script itself")
    args = parser.parse_args()
    if args.test:
        self_test()
    texts = {p: read(p) for p in tracked() if p.suffix in TEXTS or p.suffix == ".md"}
    if args.check is None:
        figures(texts)
        return
    found = list(RULES[args.check](texts))
    for path, number, words in found:
        print(f"{path}:{number}: {words}")
    print(f"house: {len(found)} places break the rule {args.check}" if found else f"house: the rule {args.check} holds")
    sys.exit(bool(found))


if __name__ == "__main__":
    main()
