# SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
# SPDX-License-Identifier: BSD-3-Clause
import json
import os
import pickle
import tempfile
import unittest
import warnings

import numpy as np

import children
import pcl_bv
from clouds import normal, street

BIN = os.environ["PCL_BV_BIN_DIR"]
SETTINGS = dict(filter={"range_min": 1, "range_max": 60}, cluster={"tolerance": 0.5, "min_size": 20},
                volumes=["aabb", "obb-yaw", "sphere", "dop26"])


def run(*arguments):
    return children.run([os.path.join(BIN, arguments[0]), *arguments[1:]], capture_output=True).stdout


class Stamps(unittest.TestCase):
    """Of tracked frames."""

    def tracked(self):
        return pcl_bv.Pipeline(ground={"method": "none"}, cluster={"tolerance": 1.0, "min_size": 2},
                               track={"enabled": True, "birth": 1})

    def block(self, frame):
        return np.random.default_rng(1).random((50, 3)) + [10 + 0.5 * frame, 0, 0]

    def test_tracks_without_stamps_have_a_warning(self):
        pipeline = self.tracked()
        pipeline.process(self.block(0))
        with self.assertWarnsRegex(UserWarning, "^frame stamps do not advance"):
            pipeline.process(self.block(1))

    def test_stamps_that_go_back_begin_new_tracks(self):
        pipeline = self.tracked()
        ids = [set(), set()]
        for play in range(2):
            with warnings.catch_warnings(record=True) as given:
                warnings.simplefilter("always")
                for frame in range(20):
                    result = pipeline.process(self.block(frame), stamp_ns=frame * 100_000_000)
                    ids[play].add(result.clusters[0].track.id)
            self.assertEqual([str(one.message) for one in given],
                             ["frame stamps went back by more than 1 s: tracks begin anew"] if play else [])
        self.assertEqual([len(some) for some in ids], [1, 1])
        self.assertFalse(ids[0] & ids[1])


class Warnings(unittest.TestCase):
    """Of clouds that do not lie around their sensor."""

    def street(self):
        cloud = pcl_bv.read("synth:street:60000:2")
        xyz = np.stack([cloud["x"], cloud["y"], cloud["z"]], axis=-1).reshape(-1, 3).astype(np.float64)
        return xyz[np.einsum("ij,ij->i", xyz, xyz) > 1]

    def test_a_street_aside_has_its_ground_and_a_warning(self):
        street = self.street()
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            right = len(pcl_bv.ground(street).ground)
            pcl_bv.Pipeline().process(street)
        aside = street + [100, 0, 0]
        with self.assertWarnsRegex(UserWarning, "do not lie around the origin.* use sensor"):
            found = len(pcl_bv.ground(aside).ground)
        self.assertLess(abs(found - right), 30)
        with self.assertWarnsRegex(UserWarning, "few points lie around sensor"):
            pcl_bv.ground(aside, sensor=(300, 0, 0))
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            pcl_bv.ground(aside, sensor=(100, 0, 0))

    def test_a_pipeline_warns_once(self):
        aside = self.street() + [100, 0, 0]
        pipeline = pcl_bv.Pipeline()
        with self.assertWarnsRegex(UserWarning, "use ground.sensor"):
            pipeline.process(aside)
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            pipeline.process(aside)

    def test_upside_down_has_a_warning(self):
        with self.assertWarnsRegex(UserWarning, "use up -z"):
            pcl_bv.ground(self.street() * [1, -1, -1])


class Pipelines(unittest.TestCase):
    @unittest.skipUnless(os.path.exists(os.path.join(BIN, "bv_stream")), "the commands are not built")
    def test_frames_have_the_bits_of_bv_stream(self):
        source = "synth:street-sequence:6"
        settings = dict(SETTINGS, track={"enabled": True})
        with tempfile.TemporaryDirectory() as folder:
            config = os.path.join(folder, "config.yaml")
            with open(config, "w") as file:
                json.dump(settings, file)
            lines = run("bv_stream", "--source", source, "--rate", "max", "--config", config).splitlines()
        pipeline = pcl_bv.Pipeline(settings)
        frames = list(pcl_bv.frames(source))
        self.assertEqual(len(lines), len(frames))
        for line, frame in zip(lines, frames):
            result = pipeline.process(frame.points, stamp_ns=frame.stamp_ns, frame_id=frame.frame_id)
            wanted, found = json.loads(line), json.loads(result.json())
            self.assertEqual(wanted.pop("ms").keys(), found.pop("ms").keys())
            wanted.pop("file", None)
            self.assertEqual(wanted, found)
            self.assertEqual(len(result), len(wanted["clusters"]))
            for said, cluster in zip(wanted["clusters"], result.clusters):
                self.assertEqual(said["track"], cluster.track and cluster.track.id)
                for volume in cluster.volumes:
                    self.assertEqual(cluster[volume.method], volume)

    def test_clusters_and_volumes_agree_with_separate_calls(self):
        points = street()
        xyz = np.stack([points[name].ravel() for name in "xyz"], axis=1)
        result = pcl_bv.Pipeline(SETTINGS).process(points)
        self.assertGreater(len(result), 3)
        labels = result.labels
        for cluster in result.clusters:
            self.assertTrue(np.array_equal(np.flatnonzero(labels == cluster.id), cluster.indices))
            self.assertEqual(cluster.points, len(cluster.indices))
            for volume in cluster.volumes:
                self.assertEqual(volume, pcl_bv.fit(xyz[cluster.indices], volume.method))
        self.assertEqual(int((labels == -2).sum()), result.counts["ground"])
        by_label = pcl_bv.fit(points, "aabb", result)
        self.assertEqual([c["aabb"] for c in result.clusters], list(by_label.values()))

    def test_stages_agree_with_the_functions(self):
        points = street()
        xyz = np.stack([points[name].ravel() for name in "xyz"], axis=1)
        settings = dict(SETTINGS, filter={"range_min": 0})
        result = pcl_bv.Pipeline(settings).process(points)
        split = pcl_bv.ground(points)
        self.assertTrue(np.array_equal(split.ground, result.ground.ground))
        self.assertTrue(np.array_equal(split.mask, result.ground.mask))
        clusters = pcl_bv.cluster(xyz[split.rest], 0.5, min_size=20)
        self.assertEqual(len(clusters), len(result))
        for numbers, cluster in zip(clusters, result.clusters):
            self.assertTrue(np.array_equal(split.rest[numbers], cluster.indices))

    def test_one_object_without_clusters(self):
        points = normal(500, 31)
        points[4] = np.nan
        result = pcl_bv.Pipeline(filter={"range_min": 0.5}, ground={"method": "none"},
                                 cluster={"tolerance": 0}).process(points)
        self.assertEqual([v.method for v in result.clusters[0].volumes], ["aabb", "sphere-exact", "obb-min"])
        kept = np.flatnonzero(np.linalg.norm(points, axis=1) >= 0.5)
        self.assertTrue(np.array_equal(result.clusters[0].indices, kept))
        self.assertEqual(result.clusters[0]["aabb"], pcl_bv.fit(points[kept], "aabb"))
        self.assertEqual(pickle.loads(pickle.dumps(result)).json(), result.json())

    def test_the_configuration_goes_both_ways(self):
        config = pcl_bv.Pipeline(SETTINGS, preset="indoor", threads=2,
                                 cluster={"max_size": 999, "min_extent": (0.2, 0.2, 0.3),
                                          "max_extent": [12, float("inf"), 4]},
                                 ground={"method": "zones", "up": [0, -1, -1], "sensor": (1, 2, 3)},
                                 filter={"range_max": float("inf")}).config
        self.assertEqual(config["cluster"]["max_size"], 999)
        self.assertEqual(config["cluster"]["min_size"], 20)
        self.assertEqual(config["cluster"]["min_extent"], [0.2, 0.2, 0.3])
        self.assertEqual(config["cluster"]["max_extent"], [12, float("inf"), 4])
        self.assertEqual(config["ground"]["method"], "zones")
        self.assertEqual(pcl_bv.Pipeline(preset="indoor").config["ground"]["method"], "plane")
        self.assertEqual(config["ground"]["sensor"], [1, 2, 3])
        self.assertEqual(config["volumes"], SETTINGS["volumes"])
        self.assertEqual(pcl_bv.Pipeline(config).config, config)
        for stage, value in config.items():
            for key in value if isinstance(value, dict) else [None]:
                self.assertIn(stage if key is None else stage + "." + key, pcl_bv.Pipeline.__doc__)
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "config.yaml")
            with open(path, "w") as file:
                file.write("cluster: {tolerance: 0.7}\nrunner: {queue: 3}\n")
            self.assertEqual(pcl_bv.Pipeline(path).config["cluster"]["tolerance"], 0.7)
            with open(path) as file:
                self.assertEqual(pcl_bv.Pipeline(file.read()).config["cluster"]["tolerance"], 0.7)

    def test_settings_without_effect_are_warned_of(self):
        with self.assertWarnsRegex(UserWarning, "track.grow: has no effect without an upright box"):
            pcl_bv.Pipeline(volumes=["obb"], track={"enabled": True, "grow": True})
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            pcl_bv.Pipeline(volumes=["obb-yaw"], track={"enabled": True, "grow": True})

    def test_regions_may_be_volumes(self):
        points = normal(1000, 34)
        ball, box = pcl_bv.Sphere([0, 0, 0], 1), pcl_bv.Aabb([0, 0, 0], [9, 9, 9])
        settings = dict(filter={"range_min": 0, "regions": [{"volumes": [ball, box], "padding": 0.25}]},
                        volumes=["aabb"],
                        ground={"method": "none"}, cluster={"tolerance": 0})
        pipeline = pcl_bv.Pipeline(settings)
        inside = pcl_bv.RegionMask([ball, box], 0.25).contains(points)
        result = pipeline.process(points)
        self.assertTrue(0 < inside.sum() == result.counts["inside"])
        self.assertEqual(result.clusters[0].volumes[0], pcl_bv.fit(points[~inside], "aabb"))
        self.assertEqual(pipeline.config["filter"]["regions"][0]["volumes"], [ball, box])
        self.assertEqual(pcl_bv.Pipeline(pipeline.config).process(points).counts, result.counts)
        self.assertEqual(pickle.loads(pickle.dumps(result)).json(), result.json())
        self.assertEqual(settings["filter"]["regions"][0]["volumes"], [ball,
            box])  # the user's dict is left alone
        with self.assertRaisesRegex(TypeError, "filter.regions"):
            pcl_bv.Pipeline(filter={"regions": [{"volumes": [3]}]})

    def test_settings_change_between_frames(self):
        pipeline = pcl_bv.Pipeline(SETTINGS)
        many = len(pipeline.process(street()))
        pipeline.config = dict(SETTINGS, cluster={"tolerance": 0.5, "min_size": 500})
        self.assertLess(len(pipeline.process(street())), many)
        self.assertEqual(pipeline.process(street()).seq, 2)

    def test_classes_are_told_apart(self):
        points = np.array([[0.0, 0, 0], [0.1, 0, 0], [0.2, 0, 0], [5, 0, 0]])
        classes = [1, 2, 1, 3]
        clusters = pcl_bv.cluster(points, 0.5, classes=classes, class_settings={3: {"drop": True}})
        self.assertEqual(([list(c) for c in clusters], list(clusters.classes), clusters.class_points), ([[0,
            2], [1]], [1, 2], 1))
        pipeline = pcl_bv.Pipeline(filter={"range_min": 0}, ground={"method": "none"}, volumes=["aabb"],
                                   cluster={"min_size": 1, "class_field": "kind", "classes": [{"value": 3,
                                       "drop": True, "name": "far"}]})
        self.assertEqual(pipeline.config["cluster"]["classes"], [{"value": 3, "drop": True, "name": "far"}])
        result = pipeline.process(points, classes=classes)
        self.assertEqual([c.class_value for c in result.clusters], [1, 2])
        self.assertEqual(result.counts["class"], 1)

    def test_dbscan_and_its_settings_are_passed_on(self):
        points = np.array([[0.0, 0, 0], [0.1, 0, 0], [0.2, 0, 0], [0.6, 0, 0], [5, 0, 0]])
        clusters = pcl_bv.cluster(points, 0.45, min_points=3)
        self.assertEqual((clusters.labels.tolist(), clusters.noise_points), ([0, 0, 0, 0, -1], 1))
        self.assertEqual(pcl_bv.cluster(points, 0.15, min_size=2).small_points, 2)
        self.assertEqual(pcl_bv.cluster(points, 0.5, max_size=3).large_points, 4)
        self.assertEqual(pcl_bv.cluster(points, 0.5, max_size=3, oversized="keep").large_points, 0)
        self.assertEqual(len(pcl_bv.cluster(points, 0.15, tolerance_per_metre=10)), 1)

    def test_results_pickle_with_their_picture(self):
        result = pcl_bv.Pipeline(dict(SETTINGS, track={"enabled": True, "birth": 1})).process(street(),
            stamp_ns=5, frame_id="f")
        again = pickle.loads(pickle.dumps(result))
        self.assertEqual(again.json(), result.json())
        self.assertEqual(again._repr_png_(), result._repr_png_())
        self.assertEqual([c.volumes for c in again.clusters], [c.volumes for c in result.clusters])
        split = pickle.loads(pickle.dumps(result.ground))
        self.assertEqual((split.offset, split.ground.tolist()), (result.ground.offset,
                                                                 result.ground.ground.tolist()))
        self.assertTrue(np.array_equal(split.mask, result.ground.mask))
        clusters = pcl_bv.cluster(normal(300, 33), 0.3, min_size=2)
        again = pickle.loads(pickle.dumps(clusters))
        self.assertEqual([list(c) for c in again], [list(c) for c in clusters])
        self.assertEqual((repr(again), list(again.labels)), (repr(clusters), list(clusters.labels)))


if __name__ == "__main__":
    unittest.main()
