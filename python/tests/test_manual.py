"""docs/python.md, run from its first line to its last."""
import doctest
import os
import tempfile
import unittest
from pathlib import Path

ROOT = Path(os.environ["STERADIAN_SOURCE_DIR"])


class Manual(unittest.TestCase):
    def test_page(self):
        with tempfile.TemporaryDirectory() as folder:
            os.symlink(ROOT / "scenes", Path(folder) / "scenes")
            here = os.getcwd()
            os.chdir(folder)
            try:
                failed, tried = doctest.testfile(str(ROOT / "docs/python.md"), module_relative=False, encoding="utf-8")
            finally:
                os.chdir(here)
        self.assertGreater(tried, 30)
        self.assertEqual(failed, 0)


if __name__ == "__main__":
    unittest.main()
