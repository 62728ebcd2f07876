#!/usr/bin/env python3
"""Breaks the kernels one place at a time, and expects a red test each time.

usage: mutate.py [--sample N] [--seed S] [--kernels GLOB] [--jobs J] [--list]

A mutant is one of
  sign       the sign of what is added or subtracted
  factor     product and quotient exchanged
  constant   a number with a point, a tenth larger (0 becomes 1); guards below 1e-6 are left alone
  condition  the condition of a select, or of an if over lanes, negated
  extreme    min and max exchanged
of kernels/*/*.glsl (not of the parity cases). All that are drawn are written into one copy of the sources, out/mutants/tree, each
behind a number that the environment chooses, so that one build serves all. A first run of the kernels' tests finds which test
reaches which site; then each mutant runs the tests that reach it, quick ones first, until one fails or takes ten times as long.
Prints the score and the survivors; out/mutants/report.json holds all. Standard library only.
"""

import argparse
import fnmatch
import json
import os
import random
import re
import shutil
import subprocess
import sys
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
WORK = ROOT / "out" / "mutants"
TOKEN = re.compile(r"//[^\n]*|[A-Za-z_]\w*|\d+\.\d*(?:[eE][+-]?\d+)?|\d+|&&|\|\||[<>=!]=|\+=|-=|\*=|/=|\+\+|--|\s+|.", re.DOTALL)


class Source:
    """A kernel as tokens (text, offset), blanks and comments left out."""

    def __init__(self, path):
        self.path, self.text = path, path.read_text()
        self.tokens = [(m.group(), m.start()) for m in TOKEN.finditer(self.text) if not m.group().isspace() and m.group()[:2] != "//"]

    def word(self, i):
        return self.tokens[i][0] if 0 <= i < len(self.tokens) else ""

    def closing(self, i):
        """The index of the bracket that closes the one at i."""
        depth = 0
        for j in range(i, len(self.tokens)):
            depth += self.word(j) in "([{"
            depth -= self.word(j) in ")]}"
            if depth == 0:
                return j
        raise ValueError(f"{self.path}: unbalanced at {self.tokens[i]}")

    def operand_end(self, i):
        """The index of the last token of the primary expression that begins at i."""
        if self.word(i) == "-":
            return self.operand_end(i + 1)
        j = self.closing(i) if self.word(i) == "(" else i
        while self.word(j + 1) in ("(", "[", "."):
            j = j + 2 if self.word(j + 1) == "." else self.closing(j + 1)
        return j

    def end_of(self, i):
        return self.tokens[i][1] + len(self.word(i))

    def first_argument_end(self, i):
        """The index of the last token before the first comma, or the end, of the arguments that open at i."""
        depth, j = 0, i
        while True:
            j += 1
            if depth == 0 and self.word(j) in ",)":
                return j - 1
            depth += self.word(j) in "(["
            depth -= self.word(j) in ")]"


def is_number(word):
    return bool(re.fullmatch(r"\d+\.\d*(?:[eE][+-]?\d+)?", word))


def ends_operand(word):
    return bool(re.fullmatch(r"[A-Za-z_]\w*|\d.*|\)|\]", word)) and word != "return"


def sites_of(source):
    """(kind, what is inserted: (offset, text before number, text after it)...), in order. `#` stands for the site's number."""
    for i, (word, at) in enumerate(source.tokens):
        binary = ends_operand(source.word(i - 1))
        if word in "+-" and binary and source.word(i + 1) != "=":
            yield "sign", at, [(at + 1, " mutated::sign(#) *")]
        elif word in "*/" and binary:
            yield "factor", at, [(source.tokens[i + 1][1], "mutated::factor(#, "), (source.end_of(source.operand_end(i + 1)), ")")]
        elif is_number(word) and (float(word) == 0 or float(word) >= 1e-6):
            yield "constant", at, [(at, "mutated::constant(#, "), (at + len(word), ")")]
        elif word in ("select", "any_lane", "all_lanes") and source.word(i + 1) == "(":
            yield "condition", at, [(source.tokens[i + 2][1], "mutated::condition(#, "),
                                    (source.end_of(source.first_argument_end(i + 1)), ")")]
        elif word in ("min", "max") and source.word(i + 1) == "(":
            other = "max" if word == "min" else "min"
            call = source.text[source.tokens[i + 1][1]:source.end_of(source.closing(i + 1))]
            yield "extreme", at, [(at, "(mutated::on(#) ? " + other + call + " : "), (source.end_of(source.closing(i + 1)), ")")]


def draw(arguments):
    """The chosen sites: (kind, source, offset, insertions)."""
    sites = []
    for path in sorted((ROOT / "kernels").glob("*/*.glsl")):
        if path.name.endswith("_cases.glsl") or path.parent.name == "prelude":
            continue
        if not fnmatch.fnmatch(str(path.relative_to(ROOT / "kernels")), arguments.kernels):
            continue
        source = Source(path)
        sites += [(kind, source, at, insertions) for kind, at, insertions in sites_of(source)]
    total = len(sites)
    if arguments.sample and arguments.sample < total:
        sites = [sites[i] for i in sorted(random.Random(arguments.seed).sample(range(total), arguments.sample))]
    return sites, total


def place(site):
    kind, source, at, _ = site
    line = source.text.count("\n", 0, at) + 1
    return f"{source.path.relative_to(ROOT)}:{line} {kind}: {source.text.splitlines()[line - 1].strip()}"


def write_tree(sites):
    """The copy of the sources with the sites in it; files that are the same are left alone, so that little is built again."""
    tree = WORK / "tree"
    files = subprocess.run(["git", "ls-files", "-co", "--exclude-standard"], cwd=ROOT, capture_output=True, text=True, check=True).stdout
    texts = {}
    for number, (_, source, _, insertions) in enumerate(sites):
        end = insertions[-1][0]
        for offset, text in insertions:
            # At one place, what closes comes before what opens, and what opens the longer part before the shorter.
            order = (offset, -1, 0) if text == ")" else (offset, 0, -end)
            texts.setdefault(source.path, []).append((order, text.replace("#", str(number))))
    for name in files.splitlines():
        if (ROOT / name).is_symlink():  # include/steradian/kernels
            if not (tree / name).is_symlink():
                (tree / name).parent.mkdir(parents=True, exist_ok=True)
                (tree / name).symlink_to(os.readlink(ROOT / name))
            continue
        if not (ROOT / name).is_file() or name.startswith(("docs/images", "scenes/")):
            continue
        target = tree / ("CMakeLists.txt" if name == "tools/mutation/CMakeLists.txt" else name)
        if name == "CMakeLists.txt":
            continue
        data = (ROOT / name).read_bytes()
        if ROOT / name in texts:
            text = data.decode()
            for (offset, _, _), inserted in sorted(texts[ROOT / name], reverse=True):
                text = text[:offset] + inserted + text[offset:]
            data = text.encode()
        if target.exists() and target.read_bytes() == data:
            continue
        target.parent.mkdir(parents=True, exist_ok=True)
        target.write_bytes(data)
    return tree


def build(tree, count, jobs):
    folder = WORK / "build"
    flags = f"-O1 -DNDEBUG -w -DSTERADIAN_MUTANTS={count} -include {tree}/tools/mutation/mutants.h"
    launcher = ["-DCMAKE_CXX_COMPILER_LAUNCHER=ccache"] if shutil.which("ccache") else []
    subprocess.run(["cmake", "-S", tree, "-B", folder, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release", f"-DCMAKE_CXX_FLAGS_RELEASE={flags}",
                    "-DSTERADIAN_INSTRUCTION_SETS=sse2", *launcher], check=True, stdout=subprocess.DEVNULL)
    subprocess.run(["cmake", "--build", folder, "-j", str(jobs), "--target", "mutation_tests"], check=True)
    return folder / "mutation_tests"


def first_run(program):
    """What each test takes and reaches; those that fail unbroken do not count."""
    reached = WORK / "reached.txt"
    reached.unlink(missing_ok=True)
    subprocess.run([program, "--gtest_brief=1"], env=os.environ | {"STERADIAN_REACHED": str(reached)}, stdout=subprocess.DEVNULL)
    tests = []
    for line in reached.read_text().splitlines():
        name, passed, ms, *sites = line.split()
        if passed == "1":
            tests.append((name, int(ms), {int(s) for s in sites}))
        else:
            print(f"fails without a mutant, so left out: {name}", file=sys.stderr)
    return tests


def kill(program, number, tests):
    """The name of the test that fails, "time" or "crash"; None for a survivor."""
    chosen = sorted((ms, name) for name, ms, sites in tests if number in sites)
    quick = [t for t in chosen if t[0] < 100]
    for batch in (quick, [t for t in chosen if t[0] >= 100]):
        if not batch:
            continue
        command = [program, "--gtest_brief=1", "--gtest_fail_fast", "--gtest_filter=" + ":".join(name for _, name in batch)]
        try:
            done = subprocess.run(command, env=os.environ | {"STERADIAN_MUTANT": str(number)}, capture_output=True, text=True,
                                  errors="replace", timeout=20 + sum(ms for ms, _ in batch) / 100)
        except subprocess.TimeoutExpired:
            return "time"
        if done.returncode != 0:
            failed = re.search(r"\[  FAILED  \] (\S+?),? ", done.stdout + " ")
            return failed.group(1) if failed else "crash"
    return None


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0], formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--sample", type=int, default=0, metavar="N", help="draw N of all sites; 0: all")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--kernels", default="*", metavar="GLOB", help="of paths under kernels/, e.g. 'outline/*'")
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    parser.add_argument("--list", action="store_true", help="only print the sites")
    arguments = parser.parse_args()
    sites, total = draw(arguments)
    if arguments.list:
        print("\n".join(place(site) for site in sites))
        return
    program = build(write_tree(sites), len(sites), arguments.jobs)
    tests = first_run(program)
    report, start = [], time.monotonic()
    for number, site in enumerate(sites):
        by = kill(program, number, tests)
        report.append({"place": place(site), "killed_by": by, "tests": sum(number in reached for _, _, reached in tests)})
        print(f"{number + 1}/{len(sites)} {'killed by ' + by if by else 'SURVIVES'}: {place(site)}", file=sys.stderr, flush=True)
    (WORK / "report.json").write_text(json.dumps({"sites": total, "seed": arguments.seed, "mutants": report}, indent=1) + "\n")
    killed = sum(r["killed_by"] is not None for r in report)
    print(f"{killed} of {len(sites)} mutants killed, {100 * killed / max(len(sites), 1):.1f} %; drawn from {total} sites, seed "
          f"{arguments.seed}; {len(tests)} tests, {time.monotonic() - start:.0f} s")
    for r in report:
        if r["killed_by"] is None:
            print(f"survives ({r['tests']} tests reach it): {r['place']}")


if __name__ == "__main__":
    main()
