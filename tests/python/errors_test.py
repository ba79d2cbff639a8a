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
        for dtype in (np.int32, np.int64, np.uint8, np.float16, np.longdouble):
            self.refused(TypeError, ["points", str(np.dtype(dtype)), "astype"], pcl_bv.fit,
                         POINTS.astype(dtype), "aabb")
        self.refused(TypeError, ["points", "complex128", "array.real"], pcl_bv.fit, POINTS.astype(complex), "aabb")
        self.refused(TypeError, ["points", "bool"], pcl_bv.fit, POINTS.astype(bool), "aabb")
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
        self.refused(ValueError, ["sensor_height"], pcl_bv.ground, POINTS, "slope", sensor_height=1)
        self.refused(ValueError, ["cell_size", "0.001"], pcl_bv.ground, POINTS, "slope", cell_size=0.001)
        self.refused(ValueError, ["cell_size", "'slope'"], pcl_bv.ground, POINTS, "zones", cell_size=1)

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

    def test_numbers_of_any_size_are_named(self):
        pipeline = pcl_bv.Pipeline(cluster={"tolerance": 0}, ground={"method": "none"}, volumes=["aabb"])
        huge = (2**63, 2**64, -2**63 - 1, 10**400)
        for value in huge:
            self.refused(ValueError, ["stamp_ns", "-9223372036854775808", "9223372036854775807"], pipeline.process,
                         POINTS, stamp_ns=value)
            self.refused(ValueError, ["class_settings"], pcl_bv.cluster, POINTS, 1, classes=[0] * 50,
                         class_settings={value: {"drop": True}})
        for value in (-2**63, 2**63 - 1, np.int64(5)):
            self.assertEqual(pipeline.process(POINTS, stamp_ns=value).stamp_ns, value)
        for value in (-1, 2**64, 10**400):
            calls = [("seq", lambda n: pipeline.process(POINTS, seq=n)), ("first", lambda n: pcl_bv.Partial(POINTS, n)),
                     ("threads", lambda n: pcl_bv.fit(POINTS, "aabb", threads=n)),
                     ("min_size", lambda n: pcl_bv.cluster(POINTS, 1, min_size=n)),
                     ("max_size", lambda n: pcl_bv.cluster(POINTS, 1, max_size=n)),
                     ("min_points", lambda n: pcl_bv.cluster(POINTS, 1, min_points=n)),
                     ("number", lambda n: pcl_bv.read("synth:sphere:10", number=n)),
                     ("bin_fields", lambda n: pcl_bv.read("synth:sphere:10", bin_fields=n)),
                     ("width", lambda n: pcl_bv.show(POINTS, width=n)),
                     ("height", lambda n: pcl_bv.show(POINTS, height=n))]
            for name, call in calls:
                self.refused(ValueError, [name, str(value)[:20]], call, value)
                self.refused(TypeError, [name], call, "5")
                self.refused(TypeError, [name], call, 1.5)
                self.refused(TypeError, [name], call, True)
        self.refused(TypeError, ["stamp_ns"], pipeline.process, POINTS, stamp_ns=True)
        found = pcl_bv.cluster(POINTS, 1)
        for value in (2**70, -2**70, 1000):
            self.refused(IndexError, [str(value)], found.__getitem__, value)
        self.refused(TypeError, ["index", "'a'"], found.__getitem__, "a")
        for label in (2**32, -3, 2**63 - 1):
            self.refused(ValueError, ["labels", str(label)], pcl_bv.write, "never.pcd", POINTS, [label] * 50)
            self.refused(ValueError, ["labels", str(label)], pcl_bv.show, POINTS, labels=[label] * 50)
        self.refused(ValueError, ["labels"], pcl_bv.fit, POINTS, "aabb", np.full(50, 2**64 - 1, np.uint64))

    def test_a_number_that_is_zero_as_a_float_is_refused_like_zero(self):
        for value in (0, -1, np.nan, np.inf, 1e-300, 1e300):
            small = value == 1e-300
            above = "use at least 1.4e-45" if small else "is not above 0 and at most 1e+06"
            closed = "use 0, or at least 1.4e-45" if small else "is not at least 0 and at most 1e+06"
            self.refused(ValueError, ["tolerance: ", above], pcl_bv.cluster, POINTS, value)
            self.refused(ValueError, ["class_settings: tolerance: ", above], pcl_bv.cluster,
                         POINTS, 1, classes=[0] * 50, class_settings={1: {"tolerance": value}})
            if value != 0:
                self.refused(ValueError, ["tolerance_per_metre: ", closed], pcl_bv.cluster,
                             POINTS, 1, tolerance_per_metre=value)
                self.refused(ValueError, ["cluster.tolerance: ", closed], pcl_bv.Pipeline,
                             cluster={"tolerance": value})
        pcl_bv.cluster(POINTS, 1.4e-45)

    def test_settings_without_end_are_no_crash(self):
        deep = {}
        for _ in range(100_000):
            deep = {"a": deep}
        deep_list = []
        for _ in range(100_000):
            deep_list = [deep_list]
        itself = {}
        itself["a"] = itself["b"] = itself
        wide = {"a": [0] * 200_000}

        class Odd:
            def tolist(self):
                return self
        for settings in (deep, {"filter": deep_list}, itself, {"a": Odd()}):
            self.refused(ValueError, ["nested more than 16 deep"], pcl_bv.Pipeline, settings)
        self.refused(ValueError, ["more than 100000 values"], pcl_bv.Pipeline, wide)
        pipeline = pcl_bv.Pipeline()
        with self.assertRaises(ValueError):
            pipeline.config = deep
        while isinstance(deep, dict) and deep:  # Python's own end of it would recurse
            deep = deep.pop("a")
        for call in (lambda v: pcl_bv.fit(v, "aabb"), lambda v: pcl_bv.fit(POINTS, v),
                     lambda v: pcl_bv.fit(POINTS, "aabb", v), lambda v: pcl_bv.Sphere(v, 1),
                     lambda v: pcl_bv.Sphere([0, 0, 0], v), lambda v: pcl_bv.RegionMask(v),
                     lambda v: pcl_bv.fit(POINTS, "obb-yaw", up=v), lambda v: pcl_bv.Partial(v)):
            with self.assertRaises((ValueError, TypeError)):
                call(deep_list)

    def test_others_of_another_class_are_named(self):
        ball = pcl_bv.Sphere([0, 0, 0], 1)
        for call in (ball.merge, ball.overlaps, pcl_bv.Partial(POINTS).merge):
            self.refused(TypeError, ["other: expected a", "got 3"], call, 3)
            self.refused(TypeError, ["other: expected a", "got Aabb"], call, pcl_bv.Aabb([0, 0, 0], [1, 1, 1]))

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
