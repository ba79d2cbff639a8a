# SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
# SPDX-License-Identifier: BSD-3-Clause
"""Partial results travel between the processes of Dask's distributed scheduler, and merge to the bits of the whole."""
import faulthandler
import operator
import pickle
import sys
import tempfile
import unittest

import numpy

try:
    import distributed
except ImportError:
    print("SKIP: Dask's distributed scheduler is not here")
    sys.exit(77)

import pcl_bv

faulthandler.dump_traceback_later(540, exit=True)  # where it hangs; its workers end with this process

METHODS = ["aabb", "dop26", "sphere", "obb-pca", "obb-dito14", "obb", "obb-yaw", "cylinder", "capsule", "ellipsoid", "hull", "prism"]
# Some parts are empty, some of one point.
CUTS = [0, 0, 1, 900, 25_000, 25_001, 40_000, 70_000, 70_000]


def cloud():
    points = numpy.random.default_rng(4).normal(size=(70_000, 3)).astype(numpy.float32)
    points[::100, 1] = numpy.nan
    return points


def part_of(first, end):
    """On a worker, which makes the cloud for itself: a tile that it reads."""
    return pcl_bv.Partial(cloud()[first:end], first=first)


class Dask(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.cluster = distributed.LocalCluster(
            n_workers=2,
            threads_per_worker=1,
            processes=True,
            dashboard_address=None,
            local_directory=cls.folder.name,
        )
        cls.client = distributed.Client(cls.cluster)

    @classmethod
    def tearDownClass(cls):
        cls.client.close()
        cls.cluster.close()
        cls.folder.cleanup()

    def test_tiles_reduce_to_the_bits_of_the_whole_in_any_order(self):
        expected = pcl_bv.fit(cloud(), METHODS)
        for order in (1, -1):
            tiles = list(zip(CUTS, CUTS[1:]))[::order]
            parts = [self.client.submit(part_of, *tile, workers=None, pure=False) for tile in tiles]
            while len(parts) > 1:  # a tree, whose nodes are on any worker
                pairs = [self.client.submit(operator.add, a, b, pure=False) for a, b in zip(parts[::2], parts[1::2])]
                parts = pairs + parts[len(parts) - len(parts) % 2 :]
            whole = parts[0].result(timeout=120)
            self.assertEqual(len(whole), 70_000)
            for method, found, wanted in zip(METHODS, whole.fit(METHODS), expected):
                self.assertEqual(found, wanted, method)

    def test_both_processes_make_parts(self):
        workers = list(self.client.scheduler_info()["workers"])
        self.assertEqual(len(workers), 2)
        halves = [self.client.submit(part_of, *half, workers=[w]) for half, w in zip(((0, 100), (100, 200)), workers)]
        both = self.client.submit(operator.add, *halves).result(timeout=120)
        self.assertEqual(pickle.dumps(both), pickle.dumps(pcl_bv.Partial(cloud()[:200])))

    def test_a_tile_twice_is_an_error_where_it_is_asked_for(self):
        part = self.client.submit(part_of, 0, 10)
        with self.assertRaisesRegex(ValueError, "in two parts"):
            self.client.submit(operator.add, part, part).result(timeout=120)


if __name__ == "__main__":
    unittest.main()
