"""docs/python.md, docs/lights.md and docs/solve-questions.md, run from the first line to the last."""
import doctest
import os
import tempfile
import unittest
from pathlib import Path

ROOT = Path(os.environ["STERADIAN_SOURCE_DIR"])


class Manual(unittest.TestCase):
    def test_python(self):
        self.run_page("python.md", 30)

    def test_lights(self):
        self.run_page("lights.md", 8)

    def test_questions_of_solve(self):
        self.run_page("solve-questions.md", 7)

    def run_page(self, name, least):
        with tempfile.TemporaryDirectory() as folder:
            os.symlink(ROOT / "scenes", Path(folder) / "scenes")
            here = os.getcwd()
            os.chdir(folder)
            try:
                failed, tried = doctest.testfile(str(ROOT / "docs" / name), module_relative=False, encoding="utf-8")
            finally:
                os.chdir(here)
        self.assertGreaterEqual(tried, least)
        self.assertEqual(failed, 0)


if __name__ == "__main__":
    unittest.main()
