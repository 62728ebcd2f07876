#!/usr/bin/env python3
"""compare_test.py PROGRAM SCENES: `steradian compare` from the command line to the page in a headless browser.

Two scenes, one of each kind: the folder's files, the numbers of report.json against `steradian diff`, the page's pixels against
the program's PNG, and every control of the page once. Exit 77 (skipped) where there is no Chromium.
"""
import json
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "tools"))
from png_files import read_png  # noqa: E402

FLAGS = ["--headless", "--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run", "--disable-background-networking",
         "--disable-component-update", "--disable-sync", "--virtual-time-budget=30000", "--window-size=1200,900"]


def run(program, *arguments, code=0):
    done = subprocess.run([program, *map(str, arguments)], capture_output=True, text=True)
    assert done.returncode == code, (arguments, done.returncode, done.stderr)
    return done


def check_numbers(program, folder, methods):
    report = json.loads((folder / "report.json").read_text())
    assert [m["name"] for m in report["methods"]] == methods, report["methods"]
    for m in report["methods"]:
        diff = json.loads(run(program, "diff", folder / m["picture"], folder / "reference.exr", "--json").stdout)
        for key in ("rmse", "relative_l2", "max", "mean_ratio"):  # the files hold floats
            assert abs(m[key] - diff[key]) <= 1e-6 * abs(diff[key]) + 1e-12, (m["name"], key, m[key], diff[key])
        assert 0 <= m["flip"] <= 1 and m["ms"] > 0 and m["passes"], m
    return report


def browser_report(browser, page):
    with tempfile.TemporaryDirectory() as profile:
        done = subprocess.run([browser, *FLAGS, f"--user-data-dir={profile}", "--dump-dom", f"file://{page}#test"], capture_output=True,
                              text=True, timeout=180)
    match = re.search(r'<pre id="test"[^>]*>([^<]*)</pre>', done.stdout)
    assert match, done.stderr[-2000:]
    return json.loads(match.group(1))


def check_page(browser, program, folder, scene, report, size):
    got = browser_report(browser, folder / "index.html")
    assert got["split"][1:] == [0, 1], got
    assert got["all_a"] != got["all_b"], "both sides of the bar show one picture"
    # The reference at the report's exposure, as `render` writes a PNG: two codes, since the page's pictures are rounded to 1/2048 stop.
    if scene.suffix == ".svg":  # whose reference `render` gives at once
        png = folder / "reference.png"
        run(program, "render", scene, "-o", png, "--exposure", report["exposure"], *size)
        rows = read_png(png)
        for x, y, *rgb in got["pixels"]:
            want = rows[y][3 * x:3 * x + 3]
            assert max(abs(a - b) for a, b in zip(rgb, want)) <= 2, (x, y, rgb, list(want))
    assert got["darker"] < got["all_a"], "exposure"
    assert got["error"] > 0 and got["flip"] > 0, got
    assert got["zoom"] == 2 and got["reset"] == [1, 0.5], got
    by_error = [m["name"] for m in sorted(report["methods"], key=lambda m: m["relative_l2"])]
    assert got["ascending"] == by_error and got["descending"] == by_error[::-1], (got, by_error)
    assert got["dots"] == len([p for p in report["over_time"] if p["relative_l2"] > 0]), got
    print(f"{folder.name}: {by_error}, page {(folder / 'index.html').stat().st_size / 1e6:.1f} MB")


def check_times(program, scene, folder):
    """The same method under two names takes the same time: no name pays for the first threads and pages of memory. The first took 2.6 to 9
    times as long. The least of some ratios counts, since other programs run beside the test."""
    ratios = []
    for i in range(4):
        run(program, "compare", scene, "-o", folder / "times", "--methods", "auto,closed-form", "--one-setting", "--size", "96x54",
            "--target-error", 0.5)
        first, second = (m["ms"] for m in json.loads((folder / "times" / "report.json").read_text())["methods"])
        ratios.append(first / second)
    print(f"first over second time: {sorted(ratios)}")
    assert min(ratios) < 2, ratios


def check_seeds(program, scene, folder):
    """`sampled` has random numbers of its own: with those of the reference, which are the seed's, the errors of both would be alike."""
    for seed, same in ((1, False), (2, True)):
        run(program, "render", scene, "-o", folder / "sampled.exr", "--method", "sampled", "--spp", 16, "--seed", seed, "--size", "96x54",
            "--shadows", "off")
        diff = json.loads(run(program, "diff", folder / "space" / "sampled.exr", folder / "sampled.exr", "--json").stdout)
        assert (diff["max"] == 0) == same, (seed, diff)


def main():
    program, scenes = sys.argv[1], Path(sys.argv[2])
    browser = next((b for b in ("chromium", "chromium-browser", "google-chrome") if shutil.which(b)), None)
    with tempfile.TemporaryDirectory() as temporary:
        folder = Path(temporary)
        scene, plane = scenes / "glossy_floor.glb", scenes / "plane" / "room.svg"
        run(program, "compare", scene, "-o", folder / "space", "--methods", "closed-form,ltc,sampled", "--size", "96x54", "--spp", 16,
            "--target-error", 0.05)
        run(program, "compare", plane, "-o", folder / "plane", "--methods", "exact,sampled", "--size", "95x53", "--spp", 16)
        space = check_numbers(program, folder / "space", ["closed-form", "ltc", "sampled"])
        flat = check_numbers(program, folder / "plane", ["exact", "sampled"])
        check_seeds(program, scene, folder)
        check_times(program, scene, folder)
        settings = [p["setting"] for p in space["over_time"] if p["method"] == "sampled"]
        assert settings == ["1 spp", "4 spp", "16 spp"], settings
        errors = [p["relative_l2"] for p in space["over_time"] if p["method"] == "sampled"]
        assert errors[0] > errors[1] > errors[2], errors
        assert flat["methods"][0]["relative_l2"] < 1e-4 < flat["methods"][1]["relative_l2"], flat["methods"]

        for wrong in (["--methods", "ltc,ltc"], ["--methods", "unknown"], ["--methods", "reference"], ["--size", "0x5"]):
            run(program, "compare", scene, "-o", folder / "wrong", *wrong, code=2)
        assert not (folder / "wrong").exists()
        (folder / "file").write_text("")
        run(program, "compare", scene, "-o", folder / "file", "--methods", "ltc", "--size", "8x8", "--target-error", 0.5, code=1)

        if browser is None:
            print("skipped: no Chromium here (apt-get install chromium)")
            sys.exit(77)
        check_page(browser, program, folder / "space", scene, space, [])
        check_page(browser, program, folder / "plane", plane, flat, ["--size", "95x53"])


if __name__ == "__main__":
    main()
