# SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
# SPDX-License-Identifier: BSD-3-Clause
"""pcl_bv.gpu, on the first device; without one, or in builds without it, the tests are skipped."""
import doctest
import inspect
import sys
import unittest

import numpy
import pcl_bv

try:
    import pcl_bv.gpu as gpu

    DEVICES = gpu.devices()
except (ImportError, RuntimeError) as error:
    print(f"skipped: {error}")
    sys.exit(77)
if not DEVICES:
    print("skipped: no device for Vulkan 1.1 (install mesa-vulkan-drivers)")
    sys.exit(77)

METHODS = ["aabb", "dop26", "sphere-epos26", "sphere", "obb-pca"]


def cloud(count, dtype, seed=3):
    return (numpy.random.default_rng(seed).normal(size=(count, 3)) * 5 + 100).astype(dtype)


class Gpu(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.device = gpu.Device(0)

    def test_fits_equal_those_of_the_processor(self):
        for dtype in (numpy.float32, numpy.float64):
            points = cloud(50000, dtype)
            self.assertEqual(gpu.Cloud(points, self.device).fit(METHODS), pcl_bv.fit(points, METHODS))

    def test_clusters_equal_those_of_the_processor(self):
        points = cloud(1000, numpy.float32)
        offsets = numpy.array([0, 100, 100, 105, 1000])
        fits = gpu.Cloud(points, self.device, threads=2).fit(["dop14", "sphere-ritter"], offsets)
        self.assertEqual(fits, [pcl_bv.fit(points[a:b], ["dop14", "sphere-ritter"])
                                for a, b in zip(offsets, offsets[1:])])

    def test_the_cloud_keeps_the_array(self):
        on_device = gpu.Cloud(cloud(5000, numpy.float32), self.device)  # nobody else has this array
        self.assertEqual(on_device.fit("dop26"), pcl_bv.fit(cloud(5000, numpy.float32), "dop26"))

    def test_errors_name_what_is_wrong(self):
        on_device = gpu.Cloud(cloud(10, numpy.float32), self.device)
        with self.assertRaisesRegex(gpu.Error, "no device for Vulkan is 'no such card'"):
            gpu.Device("no such card")
        with self.assertRaisesRegex(IndexError, "offset 11 is beyond the 10 points"):
            on_device.fit("aabb", [0, 11])
        with self.assertRaisesRegex(ValueError, "offsets descend"):
            on_device.fit("aabb", [5, 0])
        with self.assertRaisesRegex(ValueError, "method"):
            on_device.fit("cube")
        with self.assertRaises(TypeError):
            gpu.Cloud(["a"], self.device)

    def test_every_docstring_has_an_example_that_runs(self):
        runner = doctest.DocTestRunner(verbose=False)
        for value in (gpu, gpu.devices, gpu.Device, gpu.Cloud, gpu.Cloud.fit):
            test = doctest.DocTestParser().get_doctest(inspect.getdoc(value), {}, str(value), None, 0)
            self.assertTrue(test.examples, value)
            runner.run(test)
        self.assertEqual(runner.summarize(verbose=False).failed, 0)


unittest.main()
