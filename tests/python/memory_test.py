# SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
# SPDX-License-Identifier: BSD-3-Clause
import gc
import os
import pickle
import sys
import threading
import unittest

import numpy as np

import pcl_bv
from clouds import normal, street


def resident_bytes():
    with open("/proc/self/statm") as file:
        return int(file.read().split()[1]) * os.sysconf("SC_PAGE_SIZE")


class Memory(unittest.TestCase):
    def grows_by(self, calls, call):
        """Bytes that so many calls leave, after as many to warm up."""
        for _ in range(calls // 5):
            call()
        gc.collect()
        before = resident_bytes()
        for _ in range(calls):
            call()
        gc.collect()
        return resident_bytes() - before

    def test_a_hundred_thousand_fits_leave_nothing(self):
        points = normal(100, 51, np.float32)

        def call():
            box = pcl_bv.fit(points, "aabb")
            box.min, box.volume, repr(box)

        held = sys.getrefcount(points)
        self.assertLess(self.grows_by(100_000, call), 1_000_000)  # 10 bytes a call would be that
        self.assertEqual(sys.getrefcount(points), held)

    def test_what_is_refused_leaves_nothing(self):
        points = normal(100, 52)
        wrong = points.astype(int)

        def call():
            for bad in (lambda: pcl_bv.fit(wrong, "aabb"), lambda: pcl_bv.fit(points, "boxx"),
                        lambda: pcl_bv.cluster(points, -1), lambda: pcl_bv.Pipeline(nothing=1)):
                try:
                    bad()
                except (TypeError, ValueError):
                    pass

        self.assertLess(self.grows_by(5_000, call), 500_000)

    def test_everything_else_leaves_nothing(self):
        points = normal(60, 53)
        labels = np.arange(60) % 4
        pipeline = pcl_bv.Pipeline(filter={"range_min": 0}, ground={"method": "none"},
                                   cluster={"min_size": 1})

        def call():
            for volume in pcl_bv.fit(points, ["dop26", "sphere", "obb-pca", "hull"]):
                pickle.loads(pickle.dumps(volume)).contains(points)
                volume.distance(points), volume.mesh(), volume.aabb(), volume.support([1, 2, 3])
            pcl_bv.fit(points, "aabb", labels)
            clusters = pcl_bv.cluster(points, 1)
            list(clusters), clusters.labels
            result = pipeline.process(points)
            result.labels, result.json(), [c.indices for c in result.clusters], result.ground
            (pcl_bv.Partial(points) + pcl_bv.Partial(points, 60)).to_bytes()
            pcl_bv.RegionMask(pcl_bv.Sphere([0, 0, 0], 1)).contains(points)
            pcl_bv.verify(pcl_bv.Sphere([0, 0, 0], 9), points)

        self.assertLess(self.grows_by(1_500, call), 1_500_000)

    def test_clouds_of_files_and_pictures_leave_nothing(self):
        def call():
            cloud = pcl_bv.read("synth:sphere:2000:1")
            pcl_bv.show(cloud, pcl_bv.fit(cloud, "aabb"), width=64, height=64).png()
            next(pcl_bv.frames("synth:street-sequence:1:1")).points

        self.assertLess(self.grows_by(30, call), 3_000_000)

    def test_results_outlive_what_they_are_of(self):
        result = pcl_bv.Pipeline(cluster={"min_size": 50}).process(street())
        cluster, before = result.clusters[0], result.json()
        indices = cluster.indices
        numbers = indices.tolist()
        del result
        gc.collect()
        garbage = [np.full(100_000, i) for i in range(20)]
        self.assertEqual(indices.tolist(), numbers)
        self.assertEqual(cluster.indices.tolist(), numbers)
        self.assertIn(f'"points":{cluster.points}', before)
        first = pcl_bv.cluster(normal(100, 54), 5)[0]
        del garbage
        self.assertEqual(first.tolist(), list(range(100)))


class Threads(unittest.TestCase):
    def in_threads(self, work, count=4):
        errors = []

        def run(i):
            try:
                work(i)
            except BaseException as error:  # shown by the main thread
                errors.append(error)

        threads = [threading.Thread(target=run, args=(i,)) for i in range(count)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual(errors, [])

    def test_fits_side_by_side_give_the_bits_of_one_after_another(self):
        points = normal(20_000, 55)
        methods = ["dop26", "sphere", "obb-yaw", "hull"]
        expected = pcl_bv.fit(points, methods)

        def work(i):
            for _ in range(10):
                self.assertEqual(pcl_bv.fit(points, methods, threads=1 + i % 2), expected)

        self.in_threads(work)

    def test_a_pipeline_and_its_results_may_be_shared(self):
        points = street()
        pipeline = pcl_bv.Pipeline(cluster={"min_size": 50}, volumes=["aabb", "obb-yaw"])
        first = pipeline.process(points)
        volumes = [c.volumes for c in first.clusters]

        def work(_):
            for _ in range(10):
                result = pipeline.process(points)
                self.assertEqual([c.volumes for c in result.clusters], volumes)
                self.assertTrue(np.array_equal(first.labels, result.labels))
                repr(pipeline), pipeline.config

        self.in_threads(work)
        self.assertEqual(pipeline.process(points).seq, 41)

    def test_the_gil_is_released(self):
        """While a thread fits, this one runs: it counts on, which it could not with the GIL held."""
        points = normal(300_000, 56)
        began, ended = threading.Event(), threading.Event()

        def work():
            began.set()
            for _ in range(5):
                pcl_bv.fit(points, ["sphere", "obb", "hull"])
            ended.set()

        thread = threading.Thread(target=work)
        old = sys.getswitchinterval()
        sys.setswitchinterval(1000)  # nobody gives up the GIL who does not release it
        try:
            thread.start()
            began.wait()
            self.assertFalse(ended.is_set())
            turns = 0
            while not ended.wait(0.001):
                turns += 1
        finally:
            sys.setswitchinterval(old)
            thread.join()
        self.assertGreater(turns, 0)

    def test_frames_may_be_taken_by_several_threads(self):
        frames = pcl_bv.frames("synth:street-sequence:12")
        taken = []
        self.in_threads(lambda _: taken.extend(frame.seq for frame in frames))
        self.assertEqual(sorted(taken), list(range(12)))


if __name__ == "__main__":
    unittest.main()
