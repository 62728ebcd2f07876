#!/usr/bin/env python3
"""Each public header compiles alone, and steradian.h is all of them. Usage: headers_test.py INCLUDE KERNELS COMPILER..."""
import concurrent.futures
import pathlib
import re
import shutil
import subprocess
import sys


def compiles(compiler, header, folders):
    source = f'#include "steradian/{header}"\n' * 2  # twice: guarded, too
    command = [compiler, "-std=c++20", "-fsyntax-only", "-Wall", "-Wextra", "-Werror", "-x", "c++", "-"]
    run = subprocess.run(command + [f"-I{f}" for f in folders], input=source, text=True, capture_output=True)
    return run.returncode == 0, run.stderr


def main():
    include, kernels, *compilers = sys.argv[1:]
    folder = pathlib.Path(include) / "steradian"
    headers = sorted(h.name for h in folder.glob("*.h"))
    wrong = []
    whole = set(re.findall(r'#include "steradian/(\w+\.h)"', (folder / "steradian.h").read_text()))
    for header in sorted(set(headers) - whole - {"steradian.h"}):
        wrong.append(f"steradian.h does not include {header}")
    for compiler in filter(shutil.which, compilers):
        with concurrent.futures.ThreadPoolExecutor(2) as pool:
            for header, (good, text) in zip(headers, pool.map(lambda h: compiles(compiler, h, [include, kernels]), headers)):
                if not good:
                    wrong.append(f"{header} does not compile alone with {compiler}:\n{text}")
        print(f"{compiler}: {len(headers)} headers")
    print("\n".join(wrong))
    return 1 if wrong or not headers else 0


if __name__ == "__main__":
    sys.exit(main())
