# SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
# SPDX-License-Identifier: BSD-3-Clause
import copy
import functools
import operator
import pickle
import unittest
from fractions import Fraction

import numpy as np

import pcl_bv
from clouds import clouds, normal, numbers_of


def exact(v):
    return [Fraction(float(x)) for x in v]


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def inside(volume, point):
    """The predicates of the JSON's documentation, in rationals."""
    p = exact(point)
    if volume.shape == "aabb":
        return all(low <= x <= high for low, x, high in zip(exact(volume.min), p, exact(volume.max)))
    if volume.shape == "kdop":
        along = [dot(exact(n), p) for n in volume.directions]
        return all(low <= d <= high for low, d, high in zip(exact(volume.min), along, exact(volume.max)))
    if volume.shape == "hull":
        return all(dot(exact(n[:3]), p) <= Fraction(float(n[3])) for n in volume.planes)
    if volume.shape == "prism":
        u, v, h = (dot(exact(axis), p) for axis in volume.axes)
        outline = [exact(corner) for corner in volume.outline]
        edges = zip(outline, outline[1:] + outline[:1])
        return volume.low <= h <= volume.high and all(
            (b[0] - a[0]) * (v - a[1]) >= (b[1] - a[1]) * (u - a[0]) for a, b in edges)
    q = [a - b for a, b in zip(p, exact(volume.center))]
    if volume.shape == "sphere":
        return dot(q, q) <= Fraction(volume.radius) ** 2
    if volume.shape == "obb":
        return all(abs(dot(exact(a), q)) <= h for a, h in zip(volume.axes, exact(volume.half_extents)))
    if volume.shape == "ellipsoid":
        return sum((dot(exact(a), q) / r) ** 2 for a, r in zip(volume.axes, exact(volume.radii))) <= 1
    raise AssertionError(volume.shape)


def fitted():
    for points in clouds().values():
        for method in pcl_bv.methods():
            yield points, pcl_bv.fit(points, method)


class Volumes(unittest.TestCase):
    def test_every_point_is_inside_in_exact_arithmetic(self):
        points = normal(300, 21, np.float32) * np.float32([100, 1e-3, 5]) + np.float32(1000)
        for method in ("aabb", "dop14", "dop26", "hull", "sphere", "sphere-ritter", "obb", "obb-pca",
                       "obb-yaw", "prism", "ellipsoid"):
            volume = pcl_bv.fit(points, method)
            self.assertTrue(all(inside(volume, p) for p in points), method)
            outside = np.array(volume.center) + [1e6, 0, 0]
            self.assertFalse(inside(volume, outside), method)

    def test_upright_boxes_stand_on_their_third_axis(self):
        pole = normal(300, 23, np.float32) * np.float32([0.3, 0.6, 5])
        for method in ("obb-yaw", "obb-lshape"):
            for up, lift in (([0, 0, 1], np.eye(3)), ([0, -1, 0], [[1, 0, 0], [0, 0, -1], [0, 1, 0]])):
                box = pcl_bv.fit(pole @ np.float32(lift).T, method, up=up)
                self.assertEqual(box.axes[2].tolist(), up)
                self.assertAlmostEqual(np.linalg.det(box.axes), 1, 14)
                length, width, height = 2 * box.half_extents
                self.assertTrue(height > length >= width > 0, box)
                self.assertTrue(-np.pi / 2 < box.yaw <= np.pi / 2 + 1e-9, box.yaw)
                self.assertEqual(pickle.loads(pickle.dumps(box)).yaw, box.yaw)
        turned = pcl_bv.Obb([0, 0, 0], [[0, 1, 0], [-1, 0, 0], [0, 0, 1]], [2, 1, 3])
        self.assertAlmostEqual(turned.yaw, np.pi / 2, 15)

    def test_what_is_fitted_contains_its_points_and_verifies(self):
        for points, volume in fitted():
            finite = np.isfinite(points).all(axis=1)
            self.assertTrue(np.array_equal(volume.contains(points), finite), volume)
            found = pcl_bv.verify(volume, points)
            self.assertEqual((found.checked, found.outside), (finite.sum(), 0), volume)
            distances = volume.distance(points)
            self.assertTrue((distances[finite] == 0).all(), volume)
            i = int(np.argmax(finite))
            self.assertIs(volume.contains(points[i]), True)
            self.assertEqual(volume.distance(points[i]), distances[i])
            far = volume.center + [1e9, 0, 0]
            self.assertIs(volume.contains(far), False)
            self.assertGreater(volume.distance(far), 0.9e9)

    def test_contains_of_one_point_is_that_of_many(self):
        grid = np.random.default_rng(22).uniform(-4, 4, (400, 3))
        for volume in pcl_bv.fit(normal(100, 23), "all"):
            self.assertEqual([volume.contains(p) for p in grid], volume.contains(grid).tolist())
            self.assertEqual([volume.distance(p) for p in grid], volume.distance(grid).tolist())

    def test_pickles_and_copies_keep_every_bit_and_what_the_fit_said(self):
        hand_made = [pcl_bv.Sphere([1, 2, 3], 0.1), pcl_bv.Aabb([1, 1, 1], [0, 0, 0]),
                     pcl_bv.Kdop(np.array([[1, 0, 0], [0, 2, 0.5], [0, 0, 3]]), [0, 0, 0], [1, 1, 1])]
        nothing = pcl_bv.fit(np.zeros((0, 3)), "all") + [pcl_bv.fit(np.zeros((0, 3)), "hull")]
        for volume in [v for _, v in fitted()] + hand_made + nothing:
            for again in (pickle.loads(pickle.dumps(volume)), copy.copy(volume), copy.deepcopy(volume)):
                self.assertIs(type(again), type(volume))
                self.assertEqual(again, volume)
                for name, value in numbers_of(volume).items():
                    self.assertEqual(np.asarray(getattr(again, name)).tobytes(), np.asarray(value).tobytes())
                for name in ("method", "status", "reason", "used", "dropped", "fit_rank"):
                    self.assertEqual(getattr(again, name), getattr(volume, name))
                self.assertEqual(repr(again), repr(volume))

    def test_the_numbers_of_a_volume_make_it_again(self):
        for _, volume in fitted():
            numbers = numbers_of(volume)
            numbers.pop("quaternion", None)
            if volume.shape == "hull":
                numbers["rank"] = volume.rank
            self.assertEqual(type(volume)(**numbers), volume)

    def test_volumes_are_equal_by_their_numbers_and_have_no_hash(self):
        a, b = pcl_bv.Sphere([0, 0, 0], 1), pcl_bv.Sphere([0, 0, 0], 1)
        self.assertTrue(a == b and not a != b)
        self.assertFalse(a == pcl_bv.Sphere([0, 0, 0], 2) or a == pcl_bv.Aabb([0, 0, 0], [1, 1, 1]) or a == 1)
        self.assertRaises(TypeError, hash, a)

    def test_arrays_of_volumes_may_not_be_written(self):
        for volume in pcl_bv.fit(normal(50), "all") + [pcl_bv.fit(normal(50), "hull")]:
            for value in numbers_of(volume).values():
                if isinstance(value, np.ndarray):
                    self.assertFalse(value.flags.writeable)

    def test_moved_volumes_hold_moved_points(self):
        angle = 0.3
        matrix = np.array([[np.cos(angle), -np.sin(angle), 0, 5], [np.sin(angle), np.cos(angle), 0, -2], [0,
            0, 1, 1],
                           [0, 0, 0, 1]])
        points = normal(200, 24)
        moved = points @ matrix[:3, :3].T + matrix[:3, 3]
        for volume in pcl_bv.fit(points, "all"):
            after = volume.transformed(matrix)
            self.assertLess(after.distance(moved).max(), 1e-12, volume)
            self.assertIsNone(after.method)

    def test_merging_and_extending_give_new_volumes(self):
        a, b = normal(100, 25), normal(100, 26) + 3
        for method in ("aabb", "dop26", "sphere", "obb"):
            one, other = pcl_bv.fit(a, method), pcl_bv.fit(b, method)
            before = repr(one)
            both = one.merge(other)
            self.assertTrue(both.contains(a).all() and both.contains(b).all(), method)
            self.assertEqual(repr(one), before)
            self.assertTrue(one.overlaps(both))
            if method != "obb":
                self.assertTrue(one.extend(b).contains(b).all())
        self.assertEqual(pcl_bv.fit(a, "dop26").merge(pcl_bv.fit(b, "dop26")), pcl_bv.fit(np.vstack([a, b]),
            "dop26"))

    def test_meshes_lie_on_their_volumes(self):
        for volume in pcl_bv.fit(normal(100, 27), "all"):
            vertices, faces = volume.mesh()
            self.assertLess(volume.distance(vertices).max(), 1e-9)
            self.assertTrue(all(face.max() < len(vertices) for face in faces))

    def test_a_concave_outline_follows_a_bay_and_holds_all_points(self):
        points = np.random.default_rng(31).uniform(0, 10, (4000, 3))
        points = points[np.minimum(points[:, 0], points[:, 1]) < 2]
        convex = pcl_bv.fit(points, "prism")
        concave = pcl_bv.fit(points, "prism", concave_length=1.5)
        self.assertTrue(convex.is_convex)
        self.assertFalse(concave.is_convex)
        self.assertLess(concave.footprint_area, 0.6 * convex.footprint_area)
        self.assertEqual(pcl_bv.verify(concave, points).outside, 0)
        self.assertTrue(concave.contains(points).all())
        self.assertFalse(concave.contains([7, 7, 5]))
        self.assertEqual(pickle.loads(pickle.dumps(concave)), concave)
        self.assertEqual(pcl_bv.fit(points, "prism", concave_length=None), convex)
        for wrong in (0, -1, float("nan"), float("inf")):
            with self.assertRaisesRegex(ValueError, "concave_length"):
                pcl_bv.fit(points, "prism", concave_length=wrong)

    def test_parts_give_the_bits_of_the_whole(self):
        points = normal(9000, 28, np.float32)
        cuts = [0, 1000, 1001, 5000, 9000]
        parts = [pickle.loads(pickle.dumps(pcl_bv.Partial(points[a:b], first=a))) for a, b in zip(cuts,
            cuts[1:])]
        whole = functools.reduce(operator.add, reversed(parts), pcl_bv.Partial())
        self.assertEqual(len(whole), len(points))
        self.assertEqual(whole.to_bytes(), functools.reduce(operator.add, parts).to_bytes())
        methods = ["aabb", "dop6", "dop26", "hull", "obb-pca", "obb-dito14", "obb-min", "cylinder",
                   "capsule", "ellipsoid"]
        for volume in whole.fit(methods):
            self.assertEqual(volume, pcl_bv.fit(points, volume.method), volume.method)
            self.assertEqual(volume.used, len(points))

    def test_a_mask_is_the_union_of_its_volumes(self):
        points = np.random.default_rng(29).uniform(-5, 5, (2000, 3))
        volumes = pcl_bv.fit(normal(100, 30), "all")
        union = np.any([volume.contains(points) for volume in volumes], axis=0)
        self.assertTrue(np.array_equal(pcl_bv.RegionMask(volumes).contains(points, threads=2), union))
        grown = pcl_bv.RegionMask(pcl_bv.Sphere([0, 0, 0], 1), padding=1).contains(points)
        self.assertTrue(np.array_equal(grown, pcl_bv.Sphere([0, 0, 0], 2).contains(points)))

    def test_reprs_say_what_a_person_wants_to_know(self):
        said = repr(pcl_bv.fit([[0.0, 0, 0], [1, 0, 0], [np.nan, 0, 0]], "aabb"))
        self.assertEqual(said,
                         "Aabb(min=[0, 0, 0], max=[1, 0, 0], method='aabb', used=2, dropped=1, status='degenerate')")
        self.assertEqual(repr(pcl_bv.fit(np.zeros((0, 3)), "obb")),
                         "Obb(empty, method='obb-min', used=0, status='no_valid_points')")


if __name__ == "__main__":
    unittest.main()
