#!/usr/bin/env python3
"""hdf5_test.py PROGRAM: the .h5 file of `steradian viewfactor` has the arrays of .npz, read by h5py. Exit status 77 without h5py."""
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np

from viewfactor_files_test import ROOM

try:
    import h5py
except ImportError:
    print("h5py is not installed: apt-get install python3-h5py")
    sys.exit(77)


def as_numpy(array):
    """An array of h5py with texts as NumPy's."""
    return np.char.decode(array, "utf-8") if array.dtype.kind == "S" else array


def main():
    program = sys.argv[1]
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        (folder / "room.vs3").write_text(ROOM)

        def make(output, *options):
            done = subprocess.run([program, "viewfactor", folder / "room.vs3", "-o", folder / output, *options], capture_output=True, text=True)
            assert done.returncode == 0, done.stderr

        # By face, and by groups, whose rows have pieces of their own.
        for options in ([], ["--by", "node", "--divide", "2"]):
            for output in ("room.npz", "room.h5", "again.h5"):
                make(output, *options)
            stored = np.load(folder / "room.npz")
            with h5py.File(folder / "room.h5", "r") as file:
                assert sorted(file) == sorted(stored.files), (sorted(file), sorted(stored.files))
                for key in stored.files:
                    ours, theirs = as_numpy(file[key][()]), stored[key]
                    if theirs.dtype.kind == "S":
                        theirs = np.char.decode(theirs, "utf-8")
                    assert ours.shape == theirs.shape and np.array_equal(ours, theirs), (key, ours, theirs)
                    assert ours.dtype.kind == theirs.dtype.kind and (ours.dtype.kind == "U" or ours.dtype == theirs.dtype), key
                assert "Dach-Fläche" in list(as_numpy(file["names"][()])), file["names"][()]
            assert (folder / "room.h5").read_bytes() == (folder / "again.h5").read_bytes(), "two runs have other bytes"
            print(f"{len(stored.files)} arrays are the same in .npz and .h5")
        # A folder that cannot be written leaves nothing.
        done = subprocess.run([program, "viewfactor", folder / "room.vs3", "-o", folder / "none" / "x.h5"], capture_output=True, text=True)
        assert done.returncode == 1 and "none/x.h5" in done.stderr, done.stderr
    return 0


if __name__ == "__main__":
    sys.exit(main())
