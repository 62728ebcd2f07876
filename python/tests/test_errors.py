"""What is wrong is said with its place, and no input ends the interpreter."""
import pickle
import subprocess
import sys
import unittest

import numpy as np

import steradian

QUAD = {"type": "rect", "center": [0, 2, 0], "x": [1, 0, 0], "y": [0, 0, 1]}
UP = [0, 1, 0]


class Errors(unittest.TestCase):
    def refused(self, place, *arguments, function=steradian.radiance, **keys):
        with self.assertRaises(steradian.Error) as caught:
            function(*arguments, **keys)
        self.assertEqual(caught.exception.place, place, str(caught.exception))
        self.assertTrue(caught.exception.problem)
        return caught.exception

    def test_say_their_place(self):
        origin = [0, 0, 0]
        self.refused("light.centre", {**QUAD, "centre": [0, 0, 0]}, origin, UP)
        self.refused("light.vertices[1]", {"type": "polygon", "vertices": [[0, 0, 0], [1, 0], [0, 0, 1]]}, origin, UP)
        self.refused("material.brdf", QUAD, origin, UP, None, {"brdf": "paint"})
        self.refused("view", QUAD, origin, UP, None, {"brdf": "ggx", "roughness": 0.5})
        self.refused("method", QUAD, origin, UP, None, {"brdf": "lambert"}, "magic")
        self.refused("quality", QUAD, origin, UP, quality="best")
        self.refused("precision", QUAD, origin, UP, precision="half")
        self.refused("position", QUAD, [0, 0], UP)
        self.refused("normal", QUAD, origin, np.zeros((2, 4)))
        self.refused("position, normal", QUAD, np.zeros((2, 3)), np.zeros((5, 3)))
        self.refused("position", QUAD, "here", UP)
        self.refused("occluders", QUAD, origin, UP, occluders=np.zeros((2, 3)))
        self.refused("derivatives", [{"type": "sphere", "center": [0, 2, 0], "radius": 1}] * 2, origin, UP, derivatives=True)
        self.refused("fit", "x.json", function=steradian.fit)

    def test_of_a_light_that_bends(self):
        bent = {"type": "polygon", "vertices": [[0, 1, 0], [1, 1, 0], [1, 1.5, 1], [0, 1, 1]]}
        for dtype in (np.float32, np.float64):
            error = self.refused("light.vertices[0]", bent, np.zeros((3, 3), dtype), UP)
            self.assertIn("plane", str(error))

    def test_several_at_once_are_all_said(self):
        error = self.refused("", {"type": "rect", "centre": UP, "x": UP, "y": UP}, [0, 0, 0], UP)
        self.assertIn("light.centre: unknown key", error.problem)
        self.assertIn("light.center: missing", error.problem)

    def test_of_files(self):
        with self.assertRaises(steradian.Error) as caught:
            steradian.load_scene("/nowhere/at/all.glb")
        self.assertIn("all.glb", str(caught.exception))
        with self.assertRaises(steradian.Error):
            steradian.plane.loads("<svg")
        with self.assertRaises(steradian.Error):
            steradian.diff(np.zeros((2, 2, 3)), np.zeros((3, 2, 3)))
        with self.assertRaises(steradian.Error):
            steradian.write_picture(np.zeros((2, 2)), "x.png")

    def test_survive_other_processes(self):
        error = steradian.UsageError("there", "wrong", "do this")
        back = pickle.loads(pickle.dumps(error))
        self.assertEqual((type(back), back.place, back.problem, back.hint, str(back)),
                         (steradian.UsageError, "there", "wrong", "do this", "there: wrong (do this)"))

    def test_what_no_json_holds(self):
        with self.assertRaises(TypeError):
            steradian.irradiance({**QUAD, "radiance": object()}, [0, 0, 0], UP)
        self.refused("", {**QUAD, "radiance": float("nan")}, [0, 0, 0], UP)


class Program(unittest.TestCase):
    def test_python_m_is_the_program(self):
        told = subprocess.run([sys.executable, "-m", "steradian", "info"], capture_output=True, text=True)
        self.assertEqual(told.returncode, 0, told.stderr)
        self.assertIn(steradian.__version__, told.stdout)


if __name__ == "__main__":
    unittest.main()
