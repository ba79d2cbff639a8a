# SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
# SPDX-License-Identifier: BSD-3-Clause
import unittest

import numpy as np

import pcl_bv
from clouds import normal

POINTS = normal(50)


class Errors(unittest.TestCase):
    def refused(self, error, words, call, *arguments, **named):
        with self.assertRaises(error) as caught:
            call(*arguments, **named)
        for word in words:
            self.assertIn(word, str(caught.exception))

    def test_numbers_of_another_type_say_what_to_do(self):
        for dtype in (np.int32, np.int64, np.uint8, np.float16, np.complex128, bool, np.longdouble):
            self.refused(TypeError, ["points", str(np.dtype(dtype)), "astype"], pcl_bv.fit,
                         POINTS.astype(dtype), "aabb")
        for wrong in ("text", None, {"x": 1}, [["a", "b", "c"]]):
            self.refused(TypeError, ["points"], pcl_bv.fit, wrong, "aabb")
        self.refused(TypeError, ["points", "'z'"], pcl_bv.fit, np.zeros(3, [("x", "f4"), ("y", "f4")]),
                     "aabb")

    def test_wrong_shapes_are_named(self):
        for shape in ((3,), (5, 2), (2, 3, 2), (1, 1, 1, 3), ()):
            self.refused(ValueError, ["points", "shape", str(shape)], pcl_bv.fit, np.zeros(shape), "aabb")

    def test_methods_are_named(self):
        self.refused(ValueError, ["method", "'boxx'", "aabb", "hull"], pcl_bv.fit, POINTS, "boxx")
        self.refused(ValueError, ["method", "'boxx'"], pcl_bv.fit, POINTS, ["aabb", "boxx"])
        self.refused(ValueError, ["method"], pcl_bv.fit, POINTS, [])
        for wrong in (3, None, {"aabb"}, [3]):
            self.refused(TypeError, ["method"], pcl_bv.fit, POINTS, wrong)

    def test_values_are_named_with_their_ranges(self):
        self.refused(ValueError, ["threads", "-1", "at least 0"], pcl_bv.fit, POINTS, "aabb", threads=-1)
        self.refused(ValueError, ["threads", "5000", "1024"], pcl_bv.fit, POINTS, "aabb", threads=5000)
        self.refused(TypeError, ["threads", "1.5"], pcl_bv.fit, POINTS, "aabb", threads=1.5)
        self.refused(ValueError, ["up", "'w'"], pcl_bv.fit, POINTS, "obb-yaw", up="w")
        self.refused(ValueError, ["up"], pcl_bv.fit, POINTS, "obb-yaw", up=[0, 0, 0])
        self.refused(ValueError, ["up"], pcl_bv.fit, POINTS, "obb-yaw", up=[0, 0])
        self.refused(ValueError, ["growth", "'slow'", "deferred"], pcl_bv.fit, POINTS, "sphere",
                     growth="slow")
        self.refused(ValueError, ["isa", "'mmx'"], pcl_bv.fit, POINTS, "aabb", isa="mmx")
        self.refused(ValueError, ["labels", "3", "50"], pcl_bv.fit, POINTS, "aabb", [1, 2, 3])
        self.refused(TypeError, ["labels", "float64"], pcl_bv.fit, POINTS, "aabb", np.zeros(50))

    def test_settings_of_clusters_are_named(self):
        for value in (0, -1, np.nan, np.inf, 1e9):
            self.refused(ValueError, ["tolerance", "above 0"], pcl_bv.cluster, POINTS, value)
        self.refused(TypeError, ["tolerance", "'near'"], pcl_bv.cluster, POINTS, "near")
        self.refused(ValueError, ["min_points", "0", "at least 1"], pcl_bv.cluster, POINTS, 1, min_points=0)
        self.refused(ValueError, ["oversized", "'burn'", "split"], pcl_bv.cluster, POINTS, 1,
                     oversized="burn")
        self.refused(ValueError, ["min"], pcl_bv.cluster, POINTS, 1, min_size=5, max_size=2)
        self.refused(ValueError, ["class_settings"], pcl_bv.cluster, POINTS, 1, class_settings={1: {}})
        self.refused(ValueError, ["class_settings", "'colour'", "drop"], pcl_bv.cluster, POINTS, 1,
                     classes=[0] * 50, class_settings={1: {"colour": 3}})
        self.refused(ValueError, ["classes", "2"], pcl_bv.cluster, POINTS, 1, classes=[0, 1])

    def test_settings_of_the_ground_are_named(self):
        self.refused(ValueError, ["method", "'none'"], pcl_bv.ground, POINTS, "none")
        self.refused(ValueError, ["distance", "0"], pcl_bv.ground, POINTS, distance=0)
        self.refused(ValueError, ["max_slope_degrees", "90", "89"], pcl_bv.ground, POINTS,
                     max_slope_degrees=90)
        self.refused(ValueError, ["sensor"], pcl_bv.ground, POINTS, "plane", sensor=[0, 0, 0])

    def test_settings_of_a_pipeline_are_named(self):
        self.refused(ValueError, ["unknown key 'cluster.tolerence'"], pcl_bv.Pipeline,
                     cluster={"tolerence": 1})
        self.refused(ValueError, ["unknown key 'speed'"], pcl_bv.Pipeline, speed=1)
        self.refused(ValueError, ["track.gate", "0", "above 0"], pcl_bv.Pipeline, {"track": {"gate": 0}})
        self.refused(ValueError, ["track.enabled", "'perhaps'"], pcl_bv.Pipeline,
                     {"track": {"enabled": "perhaps"}})
        self.refused(ValueError, ["volumes", "'cube'"], pcl_bv.Pipeline, volumes=["cube"])
        self.refused(ValueError, ["preset", "'sea'", "road"], pcl_bv.Pipeline, preset="sea")
        self.refused(ValueError, ["line 2", "cluster.tolerance"], pcl_bv.Pipeline,
                     "cluster:\n  tolerance: far\n")
        self.refused(TypeError, ["config"], pcl_bv.Pipeline, 3)
        pipeline = pcl_bv.Pipeline(threads=2)
        with self.assertRaises(ValueError):
            pipeline.config = {"threads": -1}
        self.assertEqual(pipeline.config["threads"], 2)
        self.refused(TypeError, ["stamp_ns", "0.5"], pipeline.process, POINTS, stamp_ns=0.5)
        self.refused(ValueError, ["pose", "4 x 4"], pipeline.process, POINTS, pose=np.eye(3))
        self.refused(ValueError, ["pose"], pipeline.process, POINTS, pose=2 * np.eye(4))

    def test_files_that_cannot_be_read_are_named(self):
        self.refused(FileNotFoundError, ["/no/such.pcd"], pcl_bv.read, "/no/such.pcd")
        self.refused(FileNotFoundError, ["/no/such"], pcl_bv.frames, "/no/such")
        self.refused(FileNotFoundError, ["/no/such"], pcl_bv.read_volumes, "/no/such")
        self.refused(OSError, [__file__], pcl_bv.read, __file__)
        self.refused(ValueError, ["path", ".xyz", ".json"], pcl_bv.write, "a.xyz", pcl_bv.Sphere([0, 0, 0],
            1))
        self.refused(OSError, [], pcl_bv.write, "/no/such/folder/a.json", pcl_bv.Sphere([0, 0, 0], 1))
        self.refused(ValueError, ["rate", "0"], pcl_bv.frames, "synth:street-sequence:2", rate=0)

    def test_volumes_are_checked(self):
        self.refused(TypeError, ["volume", "3"], pcl_bv.verify, 3, POINTS)
        self.refused(ValueError, ["center"], pcl_bv.Sphere, [1, 2], 1)
        self.refused(TypeError, ["radius", "'big'"], pcl_bv.Sphere, [1, 2, 3], "big")
        self.refused(ValueError, [], pcl_bv.Obb, [0, 0, 0], np.ones((3, 3)), [1, 1, 1])
        self.refused(ValueError, ["matrix", "4 x 4"], pcl_bv.Sphere([0, 0, 0], 1).transformed, np.eye(3))
        self.refused(ValueError, ["padding", "-1"], pcl_bv.RegionMask, pcl_bv.Sphere([0, 0, 0], 1), -1)
        self.refused(ValueError, [], pcl_bv.Partial.from_bytes, b"no partial")
        part = pcl_bv.Partial(POINTS)
        self.refused(ValueError, [], part.merge, part)
        self.refused(ValueError, [], part.fit, "obb-lshape")


if __name__ == "__main__":
    unittest.main()
