#!/usr/bin/env python3
"""Makes the pictures and tables of docs/ again, and compares them with those that are stored: ./dev figures.

    tools/figures.py [NAME ...]     make the figures whose files or command contain NAME (none: all but the slow ones) and compare them;
                                    exit 1 when one differs by more than its bound
    tools/figures.py --all          the slow ones, too
    tools/figures.py --write        also put what differs in place of what is stored
    tools/figures.py --list         print the manifest
    tools/figures.py --manifest     exit 1 when a picture of docs/, or a page with a measured table, is not in the manifest
    tools/figures.py --test         exit 1 when a difference or a gap, made up for the purpose, is not found

    --bin DIR                       programs (build/release/bin)

The manifest is tools/figures.json, a list. An entry has

    files    pictures, made by the command in the folder OUT; or
    tables   pages whose tables the command prints: a table is found by its heading row
    command  run in the root by the shell; BIN, OUT and SCENES (of the build) are replaced
    bound    of pictures: a measure of `steradian diff` (default rmse=0.002); of an .svg: relative, a number.
             Of tables: relative, a number for all cells. Columns whose heading names a time are not compared: they are the machine's
    slow     true: more than two minutes
    some_rows  true: the page leaves out rows that the command prints; they are found by their first cell, and --write leaves the page alone
    some_columns  true: a machine or a build prints fewer columns than the page has, such as those of instruction sets; the others are
             compared, and --write leaves the page alone where one is missing
    by_hand  why nothing is compared: a film of the window, a drawing by hand, times of a quiet machine

Some commands need Xvfb, Chromium or node: ./dev setup --all installs them.
"""
import argparse
import json
import re
import shutil
import subprocess
import sys
import tempfile
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
MANIFEST = ROOT / "tools" / "figures.json"
PICTURE_BOUND = "rmse=0.002"  # rays of another instruction set may fall on the other side of an outline (./dev demo)
MOST_BYTES = 300_000
MOST_SENTENCES = 20  # printed of a figure
NUMBER = re.compile(r"(?<![#\w.])[-+]?\d[\d,]*\.?\d*(?:[eE][-+]?\d+)?(?!\w)")
TIMES = re.compile(r"\b(ns|us|ms|s|time|times|gain|light)\b")
RULE = re.compile(r"\|[-:| ]+\|$")


def tables_of(text):
    """{heading row: [row, ...]} of the Markdown tables of a text; of two with one heading, the rows follow each other."""
    tables, lines = {}, text.split("\n")
    for i, line in enumerate(lines):
        if i == 0 or not RULE.match(line.strip()) or not lines[i - 1].startswith("|"):
            continue
        rows = tables.setdefault(lines[i - 1].strip(), [])
        for row in lines[i + 1 :]:
            if not row.startswith("|"):
                break
            rows.append(row.strip())
    return tables


def cells(row):
    return [c.strip() for c in row.strip().strip("|").split("|")]


def times_of(heading):
    """For each column, True if it holds times. A heading that is a bare number stands for the words on its left."""
    times = []
    for name in cells(heading):
        times.append(times[-1] if times and NUMBER.fullmatch(name) else bool(TIMES.search(name)))
    return times


def last_place(number):
    """The value of the last digit that a number shows."""
    mantissa, _, exponent = number.replace(",", "").lower().partition("e")
    return 10.0 ** (int(exponent or 0) - len(mantissa.partition(".")[2]))


def numbers_differ(made, stored, bound):
    """True when two texts differ in their words, or in a number by more than a fraction of it and a step of its last digit."""
    a, b = NUMBER.findall(made), NUMBER.findall(stored)
    if NUMBER.sub("#", made).split() != NUMBER.sub("#", stored).split() or len(a) != len(b):
        return True
    for x, y in zip(a, b):
        u, v = float(x.replace(",", "")), float(y.replace(",", ""))
        if abs(u - v) > bound * max(abs(u), abs(v)) + 1.01 * max(last_place(x), last_place(y)):
            return True
    return False


def rows_in(printed, stored):
    """The printed rows that the page has, by their first cells in the page's order."""
    found, at = [], 0
    for row in stored:
        while at < len(printed) and cells(printed[at])[0] != cells(row)[0]:
            at += 1
        found += printed[at : at + 1]
        at += 1
    return found


def with_columns_of(heading, tables):
    """The heading among those of the tables that has all columns of this one, in order; None without one."""
    for other in tables:
        rest = iter(cells(other))
        if all(name in rest for name in cells(heading)):
            return other
    return None


def columns_in(heading, row, other):
    """The cells of another table's row that stand under the columns of this heading."""
    by_name = dict(zip(cells(other), cells(row)))
    return "| " + " | ".join(by_name[name] for name in cells(heading)) + " |"


def compare_tables(made, stored, bound, some_rows=False, some_columns=False):
    """Sentences about the tables of a printed text that a page does not have, or has with other numbers."""
    wrong, page = [], tables_of(stored)
    printed = tables_of(made)
    if not printed:
        return ["the command printed no table"]
    for heading, rows in printed.items():
        wider = with_columns_of(heading, page) if some_columns and heading not in page else None
        if wider is not None:
            page[heading] = [columns_in(heading, row, wider) for row in page[wider]]
        if heading not in page:
            wrong.append(f"the page has no table '{heading[:80]}'")
            continue
        timed = times_of(heading)
        if len(rows) != len(page[heading]) and not some_rows:
            wrong.append(f"'{heading[:60]}' has {len(page[heading])} rows, made were {len(rows)}")
        found = rows_in(rows, page[heading])
        if len(found) != len(page[heading]):
            wrong.append(f"'{heading[:60]}': the command printed no row '{cells(page[heading][len(found)])[0]}'")
        for new, old in zip(found, page[heading]):
            for name, is_time, x, y in zip(cells(heading), timed, cells(new), cells(old)):
                if not is_time and numbers_differ(x, y, bound):
                    wrong.append(f"{cells(new)[0]}, {name}: made {x}, stored {y}")
    return wrong


def with_tables(page, made):
    """The page with the rows of the printed tables in the place of its own."""
    lines, printed = page.split("\n"), tables_of(made)
    result, i = [], 0
    while i < len(lines):
        result.append(lines[i])
        heading = lines[i - 1].strip() if i > 0 else ""
        i += 1
        if RULE.match(lines[i - 1].strip()) and heading in printed:
            while i < len(lines) and lines[i].startswith("|"):
                i += 1
            result += printed[heading]
    return "\n".join(result)


class Figures:
    def __init__(self, arguments):
        self.bin, self.write = Path(arguments.bin).resolve(), arguments.write

    def command(self, entry, out):
        words = {"BIN": self.bin, "OUT": out, "SCENES": self.bin.parent / "scenes"}
        return re.sub(r"\b(BIN|OUT|SCENES)\b", lambda m: str(words[m[1]]), entry["command"])

    def picture_differs(self, made, stored, bound):
        if made.suffix == ".svg":
            return ["its numbers differ"] if numbers_differ(made.read_text(), stored.read_text(), float(bound or 0.01)) else []
        diff = subprocess.run([self.bin / "steradian", "diff", made, stored, "--fail-above", bound or PICTURE_BOUND], capture_output=True, text=True)
        return [] if diff.returncode == 0 else [" ".join((diff.stdout + diff.stderr).split())[:200]]

    def check(self, entry):
        """Sentences about the differences of an entry's figures from the stored ones."""
        wrong = []
        with tempfile.TemporaryDirectory() as folder:
            run = subprocess.run(self.command(entry, folder), shell=True, cwd=ROOT, capture_output=True, text=True)
            if run.returncode != 0:
                return [f"the command failed with {run.returncode}: {(run.stderr.strip() or run.stdout.strip())[-300:]}"]
            for name in entry.get("files", []):
                made, stored = Path(folder) / Path(name).name, ROOT / name
                if not made.is_file():
                    wrong.append(f"{name}: the command wrote no such file")
                    continue
                if made.stat().st_size > MOST_BYTES:
                    wrong.append(f"{name}: {made.stat().st_size} bytes, more than {MOST_BYTES}")
                differs = self.picture_differs(made, stored, entry.get("bound")) if stored.is_file() else ["it is not stored"]
                wrong += [f"{name}: {d}" for d in differs]
                if differs and self.write:
                    shutil.copyfile(made, stored)
            for name in entry.get("tables", []):
                page, written = ROOT / name, Path(folder) / Path(name).name
                made = written.read_text() if written.is_file() else run.stdout
                some_rows, some_columns = entry.get("some_rows", False), entry.get("some_columns", False)
                differs = compare_tables(made, page.read_text(), float(entry.get("bound", 0.05)), some_rows, some_columns)
                wrong += [f"{name}: {d}" for d in differs]
                lacks = some_columns and not set(tables_of(made)) <= set(tables_of(page.read_text()))
                if differs and self.write and not some_rows and not lacks:
                    page.write_text(made if written.is_file() else with_tables(page.read_text(), made))
        return wrong


def gaps(entries, root):
    """Pictures and pages with measured tables that no entry has, and entries without their file."""
    held = [name for e in entries for name in e.get("files", []) + e.get("tables", [])]
    pictures = [p for p in (root / "docs").rglob("*") if p.suffix in (".png", ".svg")]
    pages = list((root / "docs" / "measured").glob("*.md"))
    wrong = [f"{p.relative_to(root)}: not in the manifest" for p in sorted(pictures + pages) if str(p.relative_to(root)) not in held]
    wrong += [f"{name}: there is no such file" for name in held if not (root / name).is_file()]
    wrong += [f"{p.relative_to(root)}: {p.stat().st_size} bytes, more than {MOST_BYTES}" for p in pictures if p.stat().st_size > MOST_BYTES]
    for name in sorted({n for n in held if held.count(n) > 1 and not n.endswith(".md")}):
        wrong.append(f"{name}: two entries make it")
    return wrong + [f"{e}: an entry has files or tables, and a command" for e in entries if not (e.get("files") or e.get("tables")) or "command" not in e]


def self_test():
    page = "text\n| a | rms | time [ms] |\n|---|--:|---|\n| x | 1.00 % | 5 |\n| y | 2e-3 | 7 |\n\nmore\n"
    same, other = page.replace("| 5 |", "| 9 |"), page.replace("1.00 %", "1.10 %")
    assert compare_tables(same, page, 0.05) == [], "a time is not compared"
    assert compare_tables(page.replace("1.00 %", "1.01 %"), page, 0.0) == [], "a step of the last digit is no difference"
    assert len(compare_tables(other, page, 0.05)) == 1, "a number that differs is found"
    assert compare_tables(page.replace("| y | 2e-3 | 7 |\n", ""), page, 0.05), "a missing row is found"
    assert compare_tables(page.replace("| a |", "| b |"), page, 0.05), "a missing table is found"
    assert times_of("| rms 100 | 500 | ns scalar 100 | 500 | rest |") == [False, False, True, True, False], "times of several columns"
    more = page.replace("| y |", "| w | 3 | 3 |\n| y |")
    assert compare_tables(more, page, 0.05) and compare_tables(more, page, 0.05, True) == [], "rows that the page leaves out"
    assert compare_tables(other, page, 0.05, True), "a number that differs is found among some rows, too"
    less = "| a | rms |\n|---|--:|\n| x | 1.00 % |\n| y | 2e-3 |\n"
    assert compare_tables(less, page, 0.05), "a missing column is found"
    assert compare_tables(less, page, 0.05, False, True) == [], "columns that a machine does not print"
    assert len(compare_tables(less.replace("1.00 %", "1.10 %"), page, 0.05, False, True)) == 1, "a number that differs is found among some columns, too"
    assert compare_tables("", page, 0.05), "a command without a table is found"
    assert with_tables(page, other) == other, "the rows are put in place"
    with tempfile.TemporaryDirectory() as folder:
        root = Path(folder)
        (root / "docs" / "measured").mkdir(parents=True)
        for name in ("docs/a.png", "docs/measured/b.md"):
            (root / name).write_text("")
        entry = {"files": ["docs/a.png"], "tables": ["docs/measured/b.md"], "command": "true"}
        assert gaps([entry], root) == [], "all is in the manifest"
        assert len(gaps([{**entry, "files": []}], root)) == 1, "a picture that no entry has is found"
        assert len(gaps([{**entry, "tables": []}], root)) == 1, "a page that no entry has is found"
        assert len(gaps([{**entry, "files": ["docs/a.png", "docs/c.png"]}], root)) == 1, "a file that is not there is found"


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("names", nargs="*", metavar="NAME")
    parser.add_argument("--bin", default=ROOT / "build/release/bin")
    for flag in ("all", "write", "list", "manifest", "test"):
        parser.add_argument("--" + flag, action="store_true")
    arguments = parser.parse_args()
    if arguments.test:
        return self_test()
    entries = json.loads(MANIFEST.read_text())
    if arguments.manifest:
        wrong = gaps(entries, ROOT)
        print("\n".join(wrong))
        return 1 if wrong else 0
    figures, failed = Figures(arguments), 0
    for entry in entries:
        title = ", ".join(entry.get("files", []) + entry.get("tables", []))
        if arguments.names and not any(n in title + " " + entry["command"] for n in arguments.names):
            continue
        if arguments.list or "by_hand" in entry:
            print(f"{title}\n    {entry['command']}" + (f"\n    not compared: {entry['by_hand']}" if "by_hand" in entry else ""))
            continue
        if entry.get("slow") and not (arguments.all or arguments.names):
            print(f"{title}: slow, only with --all")
            continue
        start = time.time()
        wrong = figures.check(entry)
        failed += bool(wrong)
        print(f"{title}: {'differs' if wrong else 'as stored'} ({time.time() - start:.0f} s)", flush=True)
        for sentence in wrong[:MOST_SENTENCES]:
            print("    " + sentence, flush=True)
        if len(wrong) > MOST_SENTENCES:
            print(f"    and {len(wrong) - MOST_SENTENCES} more", flush=True)
    if failed:
        print(f"{failed} figures differ from those that are stored; --write puts the new ones in place", file=sys.stderr)
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
