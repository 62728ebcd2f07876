"""Pictures as arrays are those that the program writes."""
import os
import subprocess
import tempfile
import threading
import unittest
from pathlib import Path

import numpy as np

import steradian

SCENES = Path(os.environ["STERADIAN_SOURCE_DIR"]) / "scenes"
PLANE = SCENES / "plane.glb"


class Pictures(unittest.TestCase):
    def test_are_the_program_s(self):
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "plane.exr"
            subprocess.run([os.environ["STERADIAN_PROGRAM"], "render", PLANE, "-o", path, "--size", "64x48"], check=True,
                           capture_output=True)
            picture = steradian.render(PLANE, 64, 48)
            self.assertEqual((picture.shape, picture.dtype), ((48, 64, 3), np.float32))
            self.assertGreater(picture.max(), 0)
            np.testing.assert_array_equal(picture, steradian.read_picture(path))

    def test_scene_and_its_lights(self):
        scene = steradian.load_scene(PLANE)
        self.assertGreater(scene.triangle_count, 0)
        self.assertTrue(scene.cameras)
        self.assertTrue(scene.lights)
        # The floor's light, asked at a point, is its light in eval's words.
        got = steradian.irradiance(scene.lights, [0, 0, 0], [0, 1, 0])
        self.assertTrue(np.isfinite(got).all())

    def test_stats(self):
        picture, told = steradian.render(steradian.load_scene(PLANE), 32, 24, stats=True, method="ltc")
        self.assertEqual(told["method"], "ltc")
        self.assertIn("total_ms", told)
        self.assertEqual(picture.shape, (24, 32, 3))

    def test_lights_one_by_one_or_together(self):
        alone, told = steradian.render(PLANE, 32, 24, stats=True, lights="all")
        self.assertFalse(told["light_tree"])
        together, told = steradian.render(PLANE, 32, 24, stats=True, lights="tree", light_error=1e-3)
        self.assertTrue(told["light_tree"])
        np.testing.assert_allclose(together, alone, atol=1e-3 * alone.max())
        with self.assertRaisesRegex(steradian.Error, "auto, all or tree"):
            steradian.render(PLANE, 32, 24, lights="some")

    def test_progress_is_told_and_may_end_it(self):
        seen = []
        steradian.render(PLANE, 64, 64, progress=lambda done, total: seen.append((done, total)))
        self.assertTrue(seen)

        class Enough(Exception):
            pass

        def refuse(done, total):
            raise Enough

        with self.assertRaises(Enough):
            steradian.render(PLANE, 256, 256, progress=refuse)

    def test_several_threads_at_once(self):
        scene, pictures = steradian.load_scene(PLANE), {}

        def work(name):
            pictures[name] = steradian.render(scene, 48, 32)

        threads = [threading.Thread(target=work, args=(i,)) for i in range(4)]
        for t in threads:
            t.start()
        for t in threads:
            t.join()
        for i in range(1, 4):
            np.testing.assert_array_equal(pictures[0], pictures[i])

    def test_write_read_diff(self):
        rng = np.random.default_rng(1)
        a = rng.random((5, 7, 3)).astype(np.float32)
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "a.exr"
            steradian.write_picture(a, path)
            np.testing.assert_array_equal(steradian.read_picture(path), a)
            self.assertEqual(steradian.diff(path, a).max, 0)
        d = steradian.diff(a + np.float32(0.5), a)
        self.assertAlmostEqual(d.rmse, 0.5, places=6)
        self.assertAlmostEqual(d.max, 0.5, places=6)
        self.assertGreater(d.mean_ratio, 1.5)
        self.assertGreater(steradian.auto_exposure(a / 1000), 5)

    def test_wrong_options(self):
        for keys in ({"shadows": "perhaps"}, {"quality": "best"}, {"indirect": "all"}, {"camera": "none"}, {"method": "magic"},
                     {"width": 0}):
            with self.assertRaises(steradian.Error):
                steradian.render(PLANE, **{"width": 16, "height": 16, **keys})


class Tables(unittest.TestCase):
    def test_a_fitted_table_serves(self):
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "ggx.json"
            fitted = steradian.fit(path, lobe="ggx", size=8)
            self.assertLess(fitted.mean_error, 0.5)
            self.assertGreaterEqual(fitted.largest_error, fitted.mean_error)
            quad = {"type": "rect", "center": [0, 2, 0], "x": [1, 0, 0], "y": [0, 0, 1]}
            ggx = {"brdf": "ggx", "roughness": 0.5}
            for dtype in (np.float32, np.float64):
                at = [np.array(v, dtype) for v in ([0, 0, 0], [0, 1, 0], [0.5, 1, 0])]
                ours, shipped = (steradian.radiance(quad, *at, ggx, "ltc", **keys) for keys in ({"table": str(path)}, {}))
                self.assertNotEqual(ours[0], shipped[0])
                np.testing.assert_allclose(ours, shipped, rtol=0.05)


if __name__ == "__main__":
    unittest.main()
