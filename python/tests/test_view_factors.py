"""View factors of arrays of polygons."""
import unittest

import numpy as np

import steradian


def box(size):
    """The six faces of a box, seen from inside."""
    corners = np.array([[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)], dtype=float) * size
    order = [[0, 4, 6, 2], [1, 3, 7, 5], [0, 1, 5, 4], [2, 6, 7, 3], [0, 2, 3, 1], [4, 5, 7, 6]]
    return [corners[o] for o in order]


class ViewFactorsTest(unittest.TestCase):
    def test_rows_of_a_box_add_up_to_one(self):
        f = steradian.view_factors(box([1, 2, 3]), eps=1e-10)
        np.testing.assert_array_less(np.abs(f.row_sums - 1), f.row_errors + 1e-14)
        dense = f.dense()
        np.testing.assert_allclose(dense.sum(1), f.row_sums, rtol=1e-14)
        np.testing.assert_allclose(f.areas[:, None] * dense, (f.areas[:, None] * dense).T, rtol=0, atol=1e-15)

    def test_unit_cube_has_the_published_factors(self):
        dense = steradian.view_factors(box([1, 1, 1]), eps=1e-10).dense()
        self.assertAlmostEqual(dense[0, 1], 0.1998248956983873830416, delta=1e-11)
        self.assertAlmostEqual(dense[0, 2], 0.2000437760754031542396, delta=1e-11)

    def test_obstacles_hide(self):
        floor, ceiling = box([1, 1, 1])[:2]
        a, b, c, d = [0, 0, 0.5], [0.5, 0, 0.5], [0.5, 0.5, 0.5], [0, 0.5, 0.5]
        quarter = [[a, b, c], [a, c, d]]
        f = steradian.view_factors([floor, {"outline": ceiling, "name": "ceiling"}], quarter, eps=1e-8)
        self.assertAlmostEqual(f.dense()[0, 1], 0.75 * 0.1998248956983873830416, delta=1e-9)
        whole = steradian.view_factors([floor, ceiling], quarter, eps=1e-8, obstruction=False)
        self.assertAlmostEqual(whole.dense()[0, 1], 0.1998248956983873830416, delta=1e-8)

    def test_sparse_matrices(self):
        try:
            import scipy  # noqa: F401
        except ImportError:
            self.skipTest("needs SciPy")
        f = steradian.view_factors(box([1, 1, 2]))
        np.testing.assert_allclose(f.factors().toarray(), f.dense(), rtol=1e-14)
        self.assertEqual(f.exchange_errors().nnz, f.exchange().nnz)

    def test_errors_name_the_face(self):
        with self.assertRaises(steradian.Error) as caught:
            steradian.view_factors([{"outline": [[0, 0, 0], [1, 0, 0], [2, 0, 0]], "name": "lid"}])
        self.assertIn("lid", str(caught.exception))
        for wrong in ([[0, 0, 0]], {"outlines": []}, [[0, 0], [1, 0], [0, 1]]):
            with self.assertRaises(steradian.Error):
                steradian.view_factors([wrong])
        with self.assertRaises(steradian.UsageError):
            steradian.view_factors(box([1, 1, 1]), eps=0)


if __name__ == "__main__":
    unittest.main()
