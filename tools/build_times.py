#!/usr/bin/env python3
"""Prints where a build's time goes, from Ninja's log: seconds by target and the slowest units.

    tools/build_times.py build/release [--units 20]

The seconds are those of jobs, not of the clock: with two jobs at a time a build takes about half of their sum. A unit that the
compiler cache answered counts with the time of that answer, so delete the build folder and set CCACHE_RECACHE=1 to measure a cold build.
"""
import argparse
import re
import sys
from collections import defaultdict
from pathlib import Path


def jobs_of(log):
    """Seconds by output, the last run of each; outputs of one command share a row, so each command counts once."""
    seconds, commands = {}, {}
    for line in log.splitlines()[1:]:
        start, end, _, output, command = line.split("\t")
        if command in commands:
            seconds.pop(commands[command], None)
        commands[command] = output
        seconds[output] = (int(end) - int(start)) / 1000
    return seconds


def target_of(output):
    found = re.search(r"CMakeFiles/([^/]+)\.dir/", output)
    if found:
        return found.group(1)
    if output.endswith(".inc"):
        return "shaders"
    if re.search(r"\.(a|so)$|^bin/", output):
        return "archives and links"
    return "other commands"


def unit_of(output):
    return re.sub(r".*CMakeFiles/([^/]+)\.dir/(?:__/)*(.*?)(\.o)?$", r"\1: \2", output)


def report(seconds, units):
    by_target, count = defaultdict(float), defaultdict(int)
    for output, s in seconds.items():
        by_target[target_of(output)] += s
        count[target_of(output)] += 1
    lines = [f"{'target':<44}{'jobs':>6}{'seconds':>10}"]
    for target, s in sorted(by_target.items(), key=lambda item: -item[1]):
        lines.append(f"{target:<44}{count[target]:>6}{s:>10.1f}")
    lines.append(f"{'all':<44}{len(seconds):>6}{sum(seconds.values()):>10.1f}")
    lines.append("")
    lines.append(f"the {min(units, len(seconds))} slowest units")
    for output, s in sorted(seconds.items(), key=lambda item: -item[1])[:units]:
        lines.append(f"{s:>8.1f}  {unit_of(output)}")
    return "\n".join(lines)


def test():
    log = ("# ninja log v5\n0\t2000\t1\tsource/CMakeFiles/a.dir/x.cpp.o\tc1\n0\t500\t1\tsource/CMakeFiles/a.dir/y.cpp.o\tc2\n"
           "0\t4000\t2\tsource/CMakeFiles/a.dir/x.cpp.o\tc1\n0\t1000\t1\tsource/shaders/s.inc\tc3\n0\t1000\t1\tsource/shaders/s.d\tc3\n")
    text = report({k: v for k, v in jobs_of(log).items()}, 1)
    assert re.search(r"^a +2 +4\.5$", text, re.M), text
    assert re.search(r"^all +3 +5\.5$", text, re.M), text
    assert "4.0  a: x.cpp" in text, text


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build", nargs="?", type=Path, help="build folder of a preset, e.g. build/release")
    parser.add_argument("--units", type=int, default=20, help="number of slowest units to print (default: 20)")
    parser.add_argument("--test", action="store_true", help="check the script itself")
    options = parser.parse_args()
    if options.test:
        return test()
    if options.build is None:
        parser.error("name a build folder, e.g. build/release")
    log = options.build / ".ninja_log"
    if not log.exists():
        sys.exit(f"build_times: {log}: no such file (build first: ./dev build)")
    print(report(jobs_of(log.read_text()), options.units))


if __name__ == "__main__":
    main()
