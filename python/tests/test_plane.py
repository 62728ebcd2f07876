"""Light in the plane: arrays against the program and against a closed form."""
import math
import os
import subprocess
import tempfile
import unittest
from pathlib import Path

import numpy as np

import steradian

DRAWING = Path(os.environ["STERADIAN_SOURCE_DIR"]) / "scenes/plane/lamps.svg"
DISK = '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 100 100"><circle class="light" cx="50" cy="50" r="10" fill="#fff"/></svg>'


class Plane(unittest.TestCase):
    def test_a_disk_is_seen_under_its_angle(self):
        world = steradian.plane.loads(DISK)
        self.assertEqual((world.width, world.height, world.body_count), (100, 100, 1))
        x = np.linspace(65, 95, 7)
        got = steradian.plane.mean_radiance(world, np.stack([x, np.full(7, 50)], axis=-1))
        np.testing.assert_allclose(got, np.repeat(np.arcsin(10 / (x - 50))[:, None] / math.pi, 3, axis=1), rtol=1e-12)
        moments = steradian.plane.moments(world, [80, 50])
        self.assertLess(moments.x[0], 0)  # the light is to the left
        np.testing.assert_allclose(moments.y, 0, atol=1e-12)

    def test_frames_are_the_program_s(self):
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "lamps.exr"
            subprocess.run([os.environ["STERADIAN_PROGRAM"], "render", DRAWING, "-o", path, "--size", "80x60"], check=True,
                           capture_output=True)
            np.testing.assert_array_equal(steradian.plane.render(DRAWING, 80, 60), steradian.read_picture(path))

    def test_a_frame_s_pixels_are_the_mean_radiance(self):
        world = steradian.plane.loads(DISK)
        frame = steradian.plane.render(world, 20, 20)
        centres = (np.arange(20) + 0.5) * 5
        at = np.stack(np.meshgrid(centres, centres), axis=-1)
        np.testing.assert_allclose(frame, steradian.plane.mean_radiance(world, at), atol=1e-5)  # the frames' bound, plane.h

    def test_clear_occluders_have_alpha(self):
        world = steradian.plane.loads(DISK.replace("</svg>", '<rect x="5" y="5" width="20" height="20"/></svg>'))
        clear = steradian.plane.render(world, 50, 50, occluders="clear")
        self.assertEqual(clear.shape, (50, 50, 4))
        self.assertEqual((clear[5, 5, 3], clear[40, 40, 3]), (0, 1))

    def test_points_are_checked(self):
        with self.assertRaises(steradian.Error) as caught:
            steradian.plane.mean_radiance(steradian.plane.loads(DISK), [1, 2, 3])
        self.assertEqual(caught.exception.place, "position")
        with self.assertRaises(steradian.Error):
            steradian.plane.render(steradian.plane.loads(DISK), method="magic")


if __name__ == "__main__":
    unittest.main()
