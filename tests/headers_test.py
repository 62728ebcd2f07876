#!/usr/bin/env python3
"""Each public header compiles alone, with one include path, and steradian.h is all of them. Usage: headers_test.py INCLUDE COMPILER..."""
import concurrent.futures
import pathlib
import re
import shutil
import subprocess
import sys


def compiles(compiler, header, include):
    source = f'#include "steradian/{header}"\n' * 2  # twice: guarded, too
    command = [compiler, "-std=c++20", "-fsyntax-only", "-Wall", "-Wextra", "-Werror", "-x", "c++", "-"]
    run = subprocess.run(command + [f"-I{include}"], input=source, text=True, capture_output=True)
    return run.returncode == 0, run.stderr


def main():
    include, *compilers = sys.argv[1:]
    folder = pathlib.Path(include) / "steradian"
    headers = sorted(h.name for h in folder.glob("*.h"))
    wrong = []
    whole = set(re.findall(r'#include "steradian/(\w+\.h)"', (folder / "steradian.h").read_text()))
    for header in sorted(set(headers) - whole - {"steradian.h"}):
        wrong.append(f"steradian.h does not include {header}")
    for compiler in filter(shutil.which, compilers):
        with concurrent.futures.ThreadPoolExecutor(2) as pool:
            for header, (good, text) in zip(headers, pool.map(lambda h: compiles(compiler, h, include), headers)):
                if not good:
                    wrong.append(f"{header} does not compile alone with {compiler}:\n{text}")
        print(f"{compiler}: {len(headers)} headers")
    print("\n".join(wrong))
    return 1 if wrong or not headers else 0


if __name__ == "__main__":
    sys.exit(main())
