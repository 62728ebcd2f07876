"""Arrays against `steradian eval`, single precision against double, double against quadrature."""
import json
import math
import os
import subprocess
import time
import unittest

import numpy as np

import steradian

QUAD = {"type": "rect", "center": [0, 2, 0], "x": [1, 0, 0], "y": [0, 0, 1], "radiance": [10, 9, 8]}
LIGHTS = [
    QUAD,
    {"type": "polygon", "vertices": [[-1, 2, 1], [-1, 2, -1], [1, 2, -1], [1, 2, 1]], "holes": [[[0, 2, 0], [0.5, 2, 0], [0, 2, 0.5]]],
     "two_sided": True},
    {"type": "disk", "center": [0, 1, 0], "x": [0.5, 0, 0], "y": [0, 0, 0.7], "radiance": 3},
    {"type": "sphere", "center": [0.5, 2, 0], "radius": 0.4},
    {"type": "capsule", "ends": [[-1, 2, 0], [1, 2, 0]], "radius": 0.1},
    {"type": "capsule", "ends": [[-1, 2, 0], [1, 2, 0]], "radius": 0},
    {"type": "point", "position": [0, 2, 0], "intensity": 100},
    {"type": "directional", "direction": [0, -1, 0.2]},
]
MATERIALS = [
    {"brdf": "lambert", "albedo": [0.5, 0.4, 0.3]},
    {"brdf": "ggx", "roughness": 0.4, "f0": [0.9, 0.6, 0.1]},
    {"brdf": "ggx", "alpha_x": 0.1, "alpha_y": 0.3, "tangent": [1, 0, 0.5]},
    {"brdf": "phong", "exponent": 30},
    {"brdf": "charlie", "roughness": 0.6},
    {"brdf": "beckmann", "roughness": 0.5},
    [{"brdf": "lambert"}, {"brdf": "phong", "exponent": 20, "albedo": 0.2}],
]


def points(count, seed=1):
    """Positions below the lights, normals and views that are not unit, some of them below the surface."""
    rng = np.random.default_rng(seed)
    position = rng.random((count, 3)) * [4, 1, 4] - [2, 0.5, 2]
    normal = rng.normal(size=(count, 3)) + [0, 1.5, 0]
    view = rng.normal(size=(count, 3)) + [0, 1, 0]
    return position, normal, view


def evaluated(light, position, normal, view, material, **keys):
    lines = "\n".join(json.dumps({"light": light, "material": material, "position": list(p), "normal": list(n), "view": list(v), **keys})
                      for p, n, v in zip(position, normal, view))
    told = subprocess.run([os.environ["STERADIAN_PROGRAM"], "eval"], input=lines, capture_output=True, text=True, check=True)
    return [json.loads(line) for line in told.stdout.splitlines()]


class Radiance(unittest.TestCase):
    def test_is_what_eval_answers(self):
        """In double, within the few roundings by which a batch's order of products differs from eval's."""
        position, normal, view = points(40)
        for light in LIGHTS:
            for material in MATERIALS:
                with self.subTest(light=light["type"], material=material):
                    got = steradian.radiance(light, position, normal, view, material)
                    want = np.array([a["radiance"] for a in evaluated(light, position, normal, view, material)])
                    self.assertEqual(got.dtype, np.float64)
                    self.assertGreater(want.max(), 0)
                    np.testing.assert_allclose(got, want, rtol=0, atol=1e-13 * want.max())

    def test_methods_and_qualities_are_those_of_eval(self):
        position, normal, view = points(20)
        ggx = MATERIALS[1]
        for method, quality in [("ltc", "normal"), ("ltc", "high"), ("ltc-compact", "normal"), ("closed-form", "draft"),
                                ("half-vector", "high"), ("representative-point", "normal")]:
            got = steradian.radiance(QUAD, position, normal, view, ggx, method, quality)
            want = [a["radiance"] for a in evaluated(QUAD, position, normal, view, ggx, method=method, quality=quality)]
            np.testing.assert_allclose(got, want, rtol=0, atol=1e-13 * np.max(want), err_msg=method)

    def test_single_precision_is_double_to_its_bound(self):
        """1e-4 of the largest value. Glossy lines are strips in float, 3 % of the lobe wide, whose error is the square of that."""
        position, normal, view = (a.astype(np.float32) for a in points(1000))
        double = [a.astype(np.float64) for a in (position, normal, view)]
        for light in LIGHTS:
            for material in MATERIALS:
                with self.subTest(light=light["type"], material=material):
                    got = steradian.radiance(light, position, normal, view, material)
                    want = steradian.radiance(light, *double, material)
                    self.assertEqual(got.dtype, np.float32)
                    off = np.abs(got - want).max(axis=-1)
                    bound = 1e-3 if light.get("radius") == 0 else 1e-4
                    # A percent of the points may lie where float chooses another branch (an edge of the horizon, the light's plane).
                    self.assertLess(np.quantile(off, 0.99), bound * want.max())
                    self.assertLess(off.max(), 2e-2 * want.max())

    def test_points_beside_an_edge(self):
        """Where an edge is seen under nearly half a turn no direction of it is left in single precision, unless it is split."""
        turn = np.linalg.qr(np.random.default_rng(3).normal(size=(3, 3)))[0]
        light = {"type": "rect", "center": turn @ [0, 2, 0], "x": turn @ [1, 0, 0], "y": turn @ [0, 0, 1]}
        light["y"] *= -1 if np.linalg.det(turn) < 0 else 1
        below = np.array([[t, 2 - h, 1 + s] for t in (-0.5, 0, 0.3) for h in (1e-3, 1e-4) for s in (1e-3, 0, -1e-3)])
        below = (below @ turn.T).astype(np.float32)
        normal = turn @ [0, 1, -0.3]
        got = steradian.irradiance(light, below, normal, precision="float")
        want = steradian.irradiance(light, below.astype(np.float64), normal)
        quadrature = np.pi * steradian.reference(light, below, normal).radiance
        self.assertGreater(want.min(), 0.01)
        np.testing.assert_allclose(want, quadrature, rtol=0, atol=1e-8 * want.max())
        np.testing.assert_allclose(got, want, rtol=0, atol=1e-4 * want.max())

    def test_shapes_broadcast(self):
        position, normal, view = points(6)
        want = steradian.radiance(QUAD, position, normal, view, MATERIALS[1])
        grid = steradian.radiance(QUAD, position.reshape(2, 3, 3), normal.reshape(2, 3, 3), view.reshape(2, 3, 3), MATERIALS[1])
        np.testing.assert_array_equal(grid.reshape(6, 3), want)
        one = steradian.radiance(QUAD, position[0], normal[0], view[0], MATERIALS[1])
        self.assertEqual(one.shape, (3,))
        np.testing.assert_array_equal(one, want[0])
        crossed = steradian.irradiance(QUAD, position[:, None], normal[None, :])
        self.assertEqual(crossed.shape, (6, 6, 3))
        np.testing.assert_array_equal(crossed[2, 5], steradian.irradiance(QUAD, position[2], normal[5]))
        strided = steradian.irradiance(QUAD, np.asfortranarray(position), np.ascontiguousarray(normal[::-1])[::-1])
        np.testing.assert_array_equal(strided, steradian.irradiance(QUAD, position, normal))
        self.assertEqual(steradian.irradiance(QUAD, np.zeros((0, 3)), [0, 1, 0]).shape, (0, 3))

    def test_types(self):
        single = np.zeros((2, 3), np.float32)
        self.assertEqual(steradian.irradiance(QUAD, single, [0, 1, 0]).dtype, np.float32)
        self.assertEqual(steradian.irradiance(QUAD, single, np.array([0.0, 1, 0])).dtype, np.float64)
        self.assertEqual(steradian.irradiance(QUAD, [0, 0, 0], [0, 1, 0]).dtype, np.float64)
        self.assertEqual(steradian.irradiance(QUAD, [0, 0, 0], [0, 1, 0], precision="float").dtype, np.float32)
        self.assertEqual(steradian.irradiance(QUAD, single, [0, 1, 0], precision="double").dtype, np.float64)

    def test_no_surface_is_dark_and_no_number_is_none(self):
        for dtype in (np.float32, np.float64):
            position = np.zeros((4, 3), dtype)
            normal = np.array([[0, 1, 0], [0, 0, 0], [0, np.nan, 0], [0, 1, 0]], dtype)
            position[3, 0] = np.inf
            for light in (QUAD, LIGHTS[3], LIGHTS[6]):
                got = steradian.irradiance(light, position, normal)
                self.assertGreater(got[0, 0], 0)
                np.testing.assert_array_equal(got[1], 0)
                self.assertTrue(np.isnan(got[2:]).all())

    def test_irradiance_of_a_hemisphere_is_pi(self):
        """A ceiling a million times as wide as it is high."""
        ceiling = {"type": "rect", "center": [0, 1, 0], "x": [1e6, 0, 0], "y": [0, 0, 1e6]}
        for dtype in (np.float32, np.float64):
            got = steradian.irradiance(ceiling, np.zeros(3, dtype), np.array([0, 1, 0], dtype))
            np.testing.assert_allclose(got, math.pi, rtol=2e-6)

    def test_lists_add(self):
        position, normal, view = points(10)
        both = steradian.radiance([QUAD, LIGHTS[3]], position, normal, view, MATERIALS[1])
        apart = sum(steradian.radiance(light, position, normal, view, MATERIALS[1]) for light in (QUAD, LIGHTS[3]))
        np.testing.assert_allclose(both, apart, rtol=1e-15)

    def test_arrays_within_a_light(self):
        light = {**QUAD, "center": np.array([0, 2, 0], np.float32), "radiance": np.float64(2)}
        self.assertAlmostEqual(steradian.irradiance(light, [0, 0, 0], [0, 1, 0])[0] * 5, steradian.irradiance(QUAD, [0, 0, 0], [0, 1, 0])[0])

    def test_occluders(self):
        triangles = np.array([[[0, 1, -1], [0, 1, 1], [2, 1, 0]]])
        position, normal, view = np.zeros((1, 3)), np.array([[0, 1.0, 0]]), np.array([[1, 1.0, 0]])
        for material in MATERIALS[:2]:
            got = steradian.radiance(QUAD, position, normal, view, material, occluders=triangles)
            want = evaluated(QUAD, position, normal, view, material, occluders=triangles.tolist())[0]["radiance"]
            np.testing.assert_allclose(got[0], want, rtol=1e-12)
            self.assertLess(got[0, 0], steradian.radiance(QUAD, position, normal, view, material)[0, 0])

    def test_the_same_bytes_every_time(self):
        position, normal, view = (a.astype(np.float32) for a in points(10000))
        a, b = (steradian.radiance(QUAD, position, normal, view, MATERIALS[1]) for _ in range(2))
        np.testing.assert_array_equal(a, b)


class GroundTruth(unittest.TestCase):
    def test_reference_brings_its_bound(self):
        position, normal, view = points(12)
        for material in MATERIALS[:2]:
            truth = steradian.reference(QUAD, position, normal, view, material)
            want = evaluated(QUAD, position, normal, view, material, method="reference")
            np.testing.assert_allclose(truth.radiance, [a["radiance"] for a in want], rtol=1e-13)
            np.testing.assert_allclose(truth.bound, [a["bound"] for a in want], rtol=1e-9)
            self.assertLess(truth.bound.max(), 1e-8)
        exact = steradian.radiance(QUAD, position, normal)
        truth = steradian.reference(QUAD, position, normal)
        np.testing.assert_array_less(np.abs(exact - truth.radiance).max(axis=-1), truth.bound * 10 + 1e-12)

    def test_sampled_is_eval_s_at_the_first_point_and_draws_anew_at_each(self):
        position, normal, view = np.zeros((3, 3)), np.tile([0.0, 1, 0], (3, 1)), np.tile([1.0, 1, 0], (3, 1))
        got = steradian.radiance(QUAD, position, normal, view, MATERIALS[1], "sampled", spp=64, seed=7)
        want = evaluated(QUAD, position[:1], normal[:1], view[:1], MATERIALS[1], method="sampled", spp=64, seed=7)[0]
        np.testing.assert_allclose(got[0], want["radiance"], rtol=1e-13)
        self.assertNotEqual(got[0, 0], got[1, 0])


class DerivativesOfLight(unittest.TestCase):
    def test_are_those_of_eval(self):
        position, normal, view = points(8)
        normal, view = np.abs(normal), np.abs(view)
        got = steradian.radiance(QUAD, position, normal, view, MATERIALS[1], derivatives=True)
        for i, want in enumerate(evaluated(QUAD, position, normal, view, MATERIALS[1], derivatives=True)):
            for key in ("d_vertices", "d_position", "d_normal", "d_view", "d_radiance", "d_f0", "d_f90", "d_roughness"):
                np.testing.assert_allclose(getattr(got, key)[i], want[key], rtol=1e-12, atol=1e-15)
            np.testing.assert_allclose(got.value[i], want["radiance"], rtol=1e-12)
        self.assertEqual(got.d_vertices.shape, (8, 3, 4, 3))
        self.assertIsNone(got.d_occluders)

    def test_are_those_of_round_lights(self):
        position, normal, view = points(4)
        tube = {"type": "capsule", "ends": [[-1, 2, 0], [1, 2, 0.5]], "radius": 0.1}
        got = steradian.radiance(tube, position, np.abs(normal), np.abs(view), {"brdf": "phong", "exponent": 9}, derivatives=True)
        self.assertEqual(got.d_ends.shape, (4, 3, 2, 3))
        self.assertEqual(got.d_radius.shape, got.d_exponent.shape, (4, 3))
        self.assertIsNone(got.d_vertices)

    def test_irradiance_moves_as_they_say(self):
        at, step = np.array([0.3, 0.1, 0.2]), 1e-5
        d = steradian.irradiance(QUAD, at, [0, 1, 0.2], derivatives=True)
        for axis in range(3):
            h = np.eye(3)[axis] * step
            slope = (steradian.irradiance(QUAD, at + h, [0, 1, 0.2]) - steradian.irradiance(QUAD, at - h, [0, 1, 0.2])) / (2 * step)
            np.testing.assert_allclose(d.d_position[:, axis], slope, rtol=1e-7, atol=1e-8)
        np.testing.assert_allclose(d.value, steradian.irradiance(QUAD, at, [0, 1, 0.2]), rtol=1e-14)


class Speed(unittest.TestCase):
    def test_a_million_lambert_queries(self):
        """A guard against falling off the packs (a hundred times as long), not a measurement: machines of tests are busy."""
        position, normal, _ = (a.astype(np.float32) for a in points(1_000_000))
        times = []
        for _ in range(5):
            start = time.perf_counter()
            steradian.irradiance(QUAD, position, normal)
            times.append(time.perf_counter() - start)
        print(f"a million irradiances in {1e3 * min(times):.1f} ms at best")
        self.assertLess(min(times), 0.5)


if __name__ == "__main__":
    unittest.main()
