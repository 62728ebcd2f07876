#!/usr/bin/env python3
"""viewfactor_files_test.py PROGRAM: the formats of `steradian viewfactor -o` hold the same numbers.

The .npz file is read by NumPy, .vf as View3D's own reader does: words between white space behind the first line.
"""
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np

from compare_test import browser_report

# Six faces of a closed box, and a screen on the floor with two sides. One name is not ASCII.
ROOM = """T room
F 3
V 1 0 0 0
V 2 4 0 0
V 3 4 5 0
V 4 0 5 0
V 5 0 0 3
V 6 4 0 3
V 7 4 5 3
V 8 0 5 3
V 9 1 2 0
V 10 3 2 0
V 11 3 2 1.5
V 12 1 2 1.5
S 1 1 2 3 4 0 0 0.5 floor
S 2 8 7 6 5 0 0 0.5 Dach-Fläche
S 3 1 5 6 2 0 0 0.5 south
S 4 2 6 7 3 0 0 0.5 east
S 5 3 7 8 4 0 0 0.5 north
S 6 4 8 5 1 0 0 0.5 west
S 7 9 10 11 12 0 0 0.5 screen
S 8 12 11 10 9 0 0 0.5 back
"""


def check_page(page, stored, exchange):
    """The page in a headless browser: its factors, its colours, and a click on a face."""
    text = page.read_text()
    assert "http" not in text.replace("http://www.w3.org", ""), "the page loads something"
    browser = shutil.which("chromium") or shutil.which("chromium-browser")
    if browser is None:
        return
    got = browser_report(browser, page)
    factors = exchange[1] / stored["areas"]
    assert np.allclose(got["factors"], factors, rtol=1e-4, atol=0), (got["factors"], factors)
    assert got["chosen"] == str(stored["names"][1]) and got["clicked"], got
    # A closed box shows the inner sides of three walls, and the screen one of its two.
    assert got["drawn"] == 4, got["drawn"]
    assert got["by_error"] and got["by_factor"] and got["by_error"] != got["by_factor"], got
    print(f"the page has {len(text)} bytes")


def main():
    program = sys.argv[1]
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        (folder / "room.vs3").write_text(ROOM)

        def make(output, *options):
            return subprocess.run([program, "viewfactor", folder / "room.vs3", "-o", folder / output, *options], capture_output=True, text=True)

        for output in ("room.npz", "room.vf"):
            done = make(output)
            assert done.returncode == 0, done.stderr
        stored = np.load(folder / "room.npz")
        areas, n = stored["areas"], len(stored["areas"])
        exchange = np.zeros((n, n))
        for i in range(n):
            row = slice(stored["indptr"][i], stored["indptr"][i + 1])
            exchange[i, stored["indices"][row]] = stored["data"][row]
        exchange += exchange.T

        head, *words = (folder / "room.vf").read_text().split("\n", 1)
        numbers = np.array(words[0].split(), dtype=float)
        assert head.split()[:1] + head.split()[2:] == ["steradian", "0", "0", "0", str(n)] and len(head) == 30, head
        assert len(numbers) == n + n * n + n, len(numbers)
        assert np.array_equal(numbers[:n], areas)
        assert np.array_equal(numbers[n:-n].reshape(n, n), exchange / areas[:, None]), "the factors of .vf differ"
        assert np.all(numbers[-n:] == 1)

        done = make("again.npz", "--report", folder / "room.html")
        assert done.returncode == 0, done.stderr
        check_page(folder / "room.html", stored, exchange)

        # A closed room: small factors are left out, and the rows' errors say it.
        done = make("less.npz", "--drop", "1.2e5")
        assert done.returncode == 0, done.stderr
        less = np.load(folder / "less.npz")
        assert 0 < len(less["data"]) < len(stored["data"]), (len(less["data"]), len(stored["data"]))
        assert np.all(np.abs(less["row_sums"] - 1) <= less["row_errors"] + 1e-12), less["row_sums"]
        verified = subprocess.run([program, "viewfactor", "verify", folder / "less.npz", "--pairs", "100"], capture_output=True, text=True)
        assert verified.returncode == 0, verified.stdout
        refused = make("part.npz", "--drop", "1.2e5", "--part", "1/2")
        assert refused.returncode == 2 and "steradian merge" in refused.stderr, refused.stderr
        for k in "12":
            assert make(f"part{k}.npz", "--part", f"{k}/2").returncode == 0
        merged = subprocess.run([program, "merge", folder / "part1.npz", folder / "part2.npz", "-o", folder / "merged.npz", "--drop", "1.2e5"])
        assert merged.returncode == 0
        assert (folder / "merged.npz").read_bytes() == (folder / "less.npz").read_bytes(), "parts and one run drop other entries"

        # A wrong entry: `verify` names its pair.
        wrong = dict(stored)
        wrong["data"] = stored["data"].copy()
        wrong["data"][0] *= 1.01
        np.savez(folder / "wrong.npz", **wrong)
        verified = subprocess.run([program, "viewfactor", "verify", folder / "wrong.npz", "--pairs", "200"], capture_output=True, text=True)
        pair = {str(stored["names"][1]), str(stored["names"][int(stored["indices"][0])])}
        line = verified.stdout.split("most of all ")[1] if "most of all " in verified.stdout else ""
        assert verified.returncode == 1 and all(name in line for name in pair), verified.stdout
        print(f"{n} rows: the same numbers in both files")
    return 0


if __name__ == "__main__":
    sys.exit(main())
