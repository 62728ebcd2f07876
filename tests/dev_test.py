#!/usr/bin/env python3
"""dev_test.py DEV: every verb of the script `dev` prints its help for --help, and does nothing else."""
import re
import subprocess
import sys


def run(*arguments):
    return subprocess.run([sys.argv[1], *arguments], capture_output=True, text=True, timeout=20)


def main():
    with open(sys.argv[1], encoding="utf-8") as file:
        text = file.read()
    verbs = re.findall(r"^  ([a-z]+)\)", text[text.rindex("\ncase "):], re.MULTILINE)
    assert len(verbs) > 10, verbs
    listed = run("help")
    assert listed.returncode == 0, listed
    for verb in verbs:
        assert re.search(rf"^  {verb} ", listed.stdout, re.MULTILINE), f"{verb} is not in ./dev help"
        for option in ("--help", "-h"):
            done = run(verb, option)
            assert done.returncode == 0 and done.stderr == "", (verb, done)
            assert done.stdout.startswith(f"usage: ./dev {verb} ") and done.stdout.count("\n") == 1, (verb, done)
    for wrong in (["nonsense"], ["nonsense", "--help"]):
        done = run(*wrong)
        assert done.returncode == 2 and "usage" in done.stderr, (wrong, done)
    print(f"{len(verbs)} verbs")


main()
