"""python -m steradian: the program.

The one beside the module: in the build's bin folder, in the prefix's, or the one that STERADIAN_PROGRAM or PATH names.
"""
import os
import shutil
import sys
from pathlib import Path


def program() -> str:
    """The path of the program."""
    given = os.environ.get("STERADIAN_PROGRAM")
    if given:
        return given
    for folder in Path(__file__).resolve().parents:
        if os.access(folder / "bin" / "steradian", os.X_OK):
            return str(folder / "bin" / "steradian")
    found = shutil.which("steradian")
    if found is None:
        sys.exit("steradian: the program is not beside the module and not in PATH; name it by STERADIAN_PROGRAM")
    return found


if __name__ == "__main__":
    path = program()
    os.execv(path, [path, *sys.argv[1:]])
