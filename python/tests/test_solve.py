"""Lights that fit themselves."""
import os
import tempfile
import unittest

import numpy as np

import steradian

SOURCE = os.environ["STERADIAN_SOURCE_DIR"]
OFFICE = os.path.join(SOURCE, "scenes", "office.glb")
ROOM = os.path.join(SOURCE, "scenes", "room.glb")
DESK = {"name": "desk", "zone": {"center": [0.9, 0.75, -0.6], "x": [0.75, 0, 0], "y": [0, 0, 0.35], "grid": [8, 4]},
        "lux": {"min": 450, "max": 550}}


class SolveTest(unittest.TestCase):
    def test_desk_is_lit(self):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "desk.glb")
            found = steradian.solve(OFFICE, {"fit": [{"light": "panel*", "power": True}], "targets": [DESK], "least": "power"}, path)
            self.assertTrue(found.converged)
            self.assertEqual(found.lux[0]["outside"], 0)
            self.assertEqual(len(found.parameters), 12)
            self.assertTrue(steradian.load_scene(path).lights)

    def test_picture_as_an_array(self):
        wanted = steradian.render(ROOM, 64, 36)
        spec = {"fit": [{"light": "sky", "power": True}], "targets": [{"picture": wanted * 2, "mask": np.ones((36, 64))}]}
        power, = steradian.solve(ROOM, spec).parameters
        self.assertAlmostEqual(power.value / power.start, 2, delta=1e-5)

    def test_every_kind_of_light_is_written(self):
        # A panel, a disk, a sphere and an emissive star, all twice as bright.
        scene = os.path.join(SOURCE, "scenes", "gallery.glb")
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "bright.glb")
            found = steradian.solve(scene, {"fit": [{"light": "*", "power": True}], "targets": [{"picture": steradian.render(scene, 96, 54) * 2}]}, path)
            self.assertTrue(found.converged)
            before, after = steradian.load_scene(scene).lights, steradian.load_scene(path).lights
        self.assertEqual(len(before), 4)
        for a, b in zip(before, after):
            np.testing.assert_allclose(b["radiance"], 2 * np.array(a["radiance"]), rtol=1e-4)

    def test_jacobian_is_that_of_differences(self):
        model = steradian.LightModel(OFFICE, {"fit": [{"light": "panel 7", "position": True, "power": True}], "targets": [DESK]}, shadows="off")
        self.assertEqual(model.names, ["panel 7: power", "panel 7: position x", "panel 7: position y", "panel 7: position z"])
        jacobian = model.jacobian(model.start)
        self.assertEqual(jacobian.shape, (32, 4))
        for i in range(4):
            step = np.zeros(4)
            step[i] = 0.01
            difference = (model.values(model.start + step) - model.values(model.start - step)) / 0.02
            # Truncation: the step over the distance, squared; rounding of floats over the step.
            np.testing.assert_allclose(jacobian[:, i], difference, rtol=1e-3, atol=2e-3 * np.abs(jacobian).max())

    def test_scipy_finds_the_powers(self):
        """The snippet of docs/solve-questions.md."""
        try:
            from scipy.optimize import least_squares
        except ImportError:
            self.skipTest("SciPy is not installed (python3-scipy)")
        model = steradian.LightModel(OFFICE, {"fit": [{"light": "panel*", "power": True}], "targets": [DESK]})
        found = least_squares(lambda x: model.values(x) - 500, model.start, model.jacobian, bounds=(model.low, model.high))
        self.assertTrue(found.success)
        # Twelve powers cannot give exactly 500 lux at 32 points. The sum of squares has no slope where no bound is reached.
        self.assertLess(np.abs(model.values(found.x) - 500).max(), 25)

    def test_errors_name_the_place(self):
        with self.assertRaisesRegex(steradian.Error, "no light is named 'pannel'"):
            steradian.solve(OFFICE, {"fit": [{"light": "pannel", "power": True}], "targets": [DESK]})
        with self.assertRaisesRegex(steradian.Error, "bounces"):
            steradian.solve(OFFICE, {"fit": [], "targets": []}, bounces="many")

    def test_progress_can_stop_it(self):
        class Stop(Exception):
            pass

        def stop(start, step, cost):
            raise Stop

        with self.assertRaises(Stop):
            steradian.solve(OFFICE, {"fit": [{"light": "panel*", "power": True}], "targets": [DESK]}, progress=stop)


if __name__ == "__main__":
    unittest.main()
