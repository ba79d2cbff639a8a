# SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
# SPDX-License-Identifier: BSD-3-Clause
import copy
import pickle
import unittest
import warnings

import numpy as np

import pcl_bv
from clouds import normal

SPEED, PERIOD = 10.0, 0.1  # m/s along x, seconds
SETTINGS = dict(deskew="on", ground={"method": "none"}, cluster={"tolerance": 1}, volumes=["aabb"])


def pose_of(frame):
    pose = np.eye(4)
    pose[0, 3] = SPEED * PERIOD * frame
    return pose


def cloud(seed, dtype=np.float32, count=500):
    return normal(count, seed, dtype) + dtype(20)


class Deskewing(unittest.TestCase):
    def process(self, pipeline, points, times, frame, **arguments):
        return pipeline.process(points, stamp_ns=round(1e9 * PERIOD * frame), pose=pose_of(frame), times=times,
                                **arguments)

    def second(self, points, times):
        pipeline = pcl_bv.Pipeline(SETTINGS)
        self.process(pipeline, points, times, 0)
        return self.process(pipeline, points, times, 1)

    def test_points_move_to_the_stamp(self):
        seconds = np.linspace(0, PERIOD, 500)
        for dtype in (np.float32, np.float64):
            points = cloud(1, dtype)
            result = self.second(points, seconds)
            self.assertEqual(result.deskew, "poses")
            self.assertEqual((result.deskewed.shape, result.deskewed.dtype), ((500, 3), dtype))
            wanted = points + np.outer(SPEED * seconds, [1, 0, 0])
            self.assertLess(np.abs(result.deskewed - wanted).max(), 1e-5)
            box = result.clusters[0]["aabb"]
            moved = result.deskewed[result.clusters[0].indices]
            self.assertTrue(np.array_equal(box.min, moved.min(axis=0)) and np.array_equal(box.max, moved.max(axis=0)))

    def test_times_of_every_unit_type_and_layout_give_the_same_bits(self):
        points = cloud(2)
        ns = np.arange(500, dtype=np.uint32) * 200_000
        wanted = self.second(points, ns).deskewed
        records = np.zeros(500, dtype=[("x", "f4"), ("t", "u4")])
        records["t"] = ns
        for times in (ns.astype(np.int64), ns.astype(np.float64), ns.astype(">u4"), ns.reshape(20, 25),
                      list(map(int, ns)), records["t"], ns[::-1].copy()[::-1]):
            self.assertTrue(np.array_equal(self.second(points, times).deskewed, wanted))
        for unit in (1e-9, 1e-6, 1e-3):
            self.assertLess(np.abs(self.second(points, ns * unit).deskewed - wanted).max(), 1e-5)

    def test_each_result_owns_its_points(self):
        pipeline = pcl_bv.Pipeline(SETTINGS)
        times = np.linspace(0, PERIOD, 500)
        self.process(pipeline, cloud(3), times, 0)
        first = self.process(pipeline, cloud(3), times, 1)
        array, before, picture = first.deskewed, first.deskewed.copy(), first.picture().png()
        for frame in range(2, 6):
            self.process(pipeline, cloud(3 + frame, count=300 * frame), np.linspace(0, PERIOD, 300 * frame), frame)
        self.assertTrue(np.array_equal(array, before))
        self.assertEqual(first.picture().png(), picture)
        del pipeline, first
        self.assertTrue(np.array_equal(array, before))
        self.assertFalse(array.flags.writeable)

    def test_a_copied_result_has_the_moved_points(self):
        result = self.second(cloud(9), np.linspace(0, PERIOD, 500))
        for again in (pickle.loads(pickle.dumps(result)), copy.deepcopy(result)):
            self.assertEqual(again.deskew, "poses")
            self.assertTrue(np.array_equal(again.deskewed, result.deskewed))
            self.assertEqual((again.json(), again.picture().png()), (result.json(), result.picture().png()))

    def test_without_times_or_motion_no_point_moves(self):
        points, times = cloud(10), np.linspace(0, PERIOD, 500)
        pipeline = pcl_bv.Pipeline(dict(SETTINGS, deskew="auto"))
        for given in (times, None):  # the first frame has no motion yet
            result = self.process(pipeline, points, given, 0 if given is times else 1)
            self.assertEqual((result.deskew, result.deskewed), (None, None))
        self.assertEqual(self.process(pipeline, points, times, 2).deskew, "poses")
        empty = self.process(pipeline, points[:0], times[:0], 3)
        self.assertIn(empty.deskew, (None, "poses"))

    def test_times_of_a_pipeline_that_moves_nothing_warn_once(self):
        pipeline = pcl_bv.Pipeline(dict(SETTINGS, deskew="off"))
        times = np.linspace(0, PERIOD, 500)
        with self.assertWarnsRegex(UserWarning, "times have no effect.*deskew"):
            self.process(pipeline, cloud(11), times, 0)
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            self.process(pipeline, cloud(11), times, 1)

    def test_a_point_without_a_return_may_have_no_time(self):
        points, times = cloud(12), np.linspace(0, PERIOD, 500)
        points[7], times[7] = np.nan, np.nan
        moved = self.second(points, times).deskewed
        self.assertTrue(np.isnan(moved[7]).all() and np.isfinite(np.delete(moved, 7, axis=0)).all())

    def test_bad_times_are_named(self):
        points, times = cloud(13), np.linspace(0, PERIOD, 500)
        pipeline = pcl_bv.Pipeline(SETTINGS)
        gap = times.copy()
        gap[[4, 9]] = np.nan, np.inf
        masked = np.ma.masked_array(times, mask=False)
        for error, parts, value in (
                (ValueError, ["times", "499", "500"], times[:-1]), (ValueError, ["times", "1 times", "500"], 0.5),
                (ValueError, ["times", "nan", "point 4", "2 such"], gap),
                (TypeError, ["times", "numbers"], ["a"] * 500),
                (TypeError, ["times", "numbers"], times > 0), (TypeError, ["times", "numbers"], times + 1j),
                (TypeError, ["times", "numbers"], times.astype("datetime64[ns]")),
                (TypeError, ["times", "mask"], masked)):
            with self.assertRaises(error) as raised:
                pipeline.process(points, times=value)
            for part in parts:
                self.assertIn(part, str(raised.exception))

    def test_a_state_with_other_points_is_refused(self):
        result = self.second(cloud(14), np.linspace(0, PERIOD, 500))
        state = result.__getstate__()
        for bad in (("poses", np.zeros((499, 3), np.float32)), ("poses", np.zeros((500, 3))),
                    ("magic", result.deskewed), ("poses",), 5, ("poses", np.zeros((500, 4), np.float32)[:, :3])):
            with self.assertRaises(ValueError):
                pcl_bv.Result.__new__(pcl_bv.Result).__setstate__(dict(state, deskew=bad))


if __name__ == "__main__":
    unittest.main()
