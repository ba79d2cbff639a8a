# SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
# SPDX-License-Identifier: BSD-3-Clause
"""Shares of objects in Python: the code of docs/many-machines.md, and the functions next to the command."""
import concurrent.futures
import contextlib
import json
import os
import pathlib
import pickle
import re
import tempfile
import unittest
import warnings

import children
import numpy as np

import pcl_bv
from clouds import numbers_of

try:
    import distributed
except ImportError:
    distributed = None

PAGE = pathlib.Path(os.environ["PCL_BV_EXAMPLES"]).parent.parent / "docs" / "many-machines.md"
COMMANDS = os.environ["PCL_BV_BIN_DIR"]


def documented_code():
    """The first Python code of the section Objects, which has Dask's `client` and the folder tiles."""
    section = PAGE.read_text().split("\n## Objects\n")[1].split("\n## ")[0]
    return re.search(r"```python\n(.*?)```", section, re.DOTALL)[1]


class Threads:
    """What the code calls of Dask's client, for machines without Dask."""

    def __init__(self):
        self.executor = concurrent.futures.ThreadPoolExecutor(4)

    def map(self, function, items, pure):
        del pure
        return [self.executor.submit(function, item) for item in items]

    def gather(self, futures):
        return [future.result() for future in futures]


@contextlib.contextmanager
def dask_client():
    arguments = {"n_workers": 2, "threads_per_worker": 1, "processes": True, "dashboard_address": None}
    with distributed.LocalCluster(**arguments, local_directory="dask") as cluster:
        with distributed.Client(cluster) as client:
            yield client


def command(*arguments):
    return children.run(["pcd_bv", *arguments], capture_output=True).stdout


class InAFolder(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.addCleanup(os.chdir, os.getcwd())
        self.addCleanup(os.environ.update, PATH=os.environ["PATH"])
        os.chdir(folder.name)
        os.environ["PATH"] = COMMANDS + os.pathsep + os.environ["PATH"]
        children.run(["synth", "town-objects:9:3:8000", "tiles"])

    def expect_objects(self, objects, *options):
        """Each as the command reports it, which is given the files of `options`."""
        expected = json.loads(command("--cluster", "0.5", "--format", "jsonl", *options))["clusters"]
        self.assertEqual(len(objects), len(expected))
        self.assertGreater(len(objects), 20)
        for found, said in zip(objects, expected):
            self.assertEqual((found.id, found.points, found.class_value),
                             (said["id"], said["points"], said.get("class")))
            self.assertEqual(found.incomplete, said.get("incomplete", False))
            self.assertEqual(found.methods, [volume["method"] for volume in said["volumes"]])
            for method, volume, numbers in zip(found.methods, found.volumes, said["volumes"]):
                self.assertEqual(found[method], volume)
                for name, value in numbers_of(volume).items():
                    np.testing.assert_array_equal(value, numbers[name], method)


class DocumentedCode(InAFolder):
    def expect_the_objects_of_one_process(self, client):
        names = {"__name__": "__main__", "pcl_bv": pcl_bv, "client": client}
        exec(documented_code(), names)  # pylint: disable=exec-used
        self.expect_objects(names["objects"], "--together", "tiles")
        self.assertEqual(len(list(pathlib.Path("parts").iterdir())), 64)

    def test_threads_find_the_objects_of_one_process(self):
        self.expect_the_objects_of_one_process(Threads())

    @unittest.skipUnless(distributed, "Dask's distributed scheduler is not here")
    def test_workers_of_dask_find_the_objects_of_one_process(self):
        with dask_client() as client:
            self.expect_the_objects_of_one_process(client)

    @unittest.skipUnless(distributed, "Dask's distributed scheduler is not here")
    def test_a_share_that_fails_is_an_error_where_it_is_gathered(self):
        pathlib.Path("tiles/000_000.pcd").write_text("no cloud")
        with dask_client() as client, self.assertRaisesRegex(OSError, "tiles/000_000.pcd: "):
            self.expect_the_objects_of_one_process(client)
        self.assertFalse(list(pathlib.Path(".").glob("parts/*")))


class Functions(InAFolder):
    VOLUMES = ["aabb", "obb-pca", "sphere"]

    def test_files_have_the_bytes_of_the_command(self):
        shares = [({"share": (1, 3), "volumes": self.VOLUMES}, ["--part", "1/3", "--volume", ",".join(self.VOLUMES)]),
                  ({"cluster": {"tolerance": 0.5, "min_points": 4, "min_size": 20}, "threads": 2},
                   ["--min-points", "4", "--min-size", "20"]),
                  ({"volumes": "dop14", "memory": 1, "origin": [1, 2, 3]},
                   ["--volume", "dop14", "--memory", "1", "--origin", "1,2,3"]),
                  ({"filter": {"range_max": 200}}, ["--range", "0:200"]),
                  ({"cluster": {"tolerance": 0.5, "class_field": "object"}}, ["--class", "object"])]
        for number, (named, options) in enumerate(shares):
            pcl_bv.write_object_share(f"function/{number}", "tiles", **{"cluster": 0.5, **named})
            command("--partial", f"command{number}", "--cluster", "0.5", *options, "tiles")
            self.assertEqual(pathlib.Path(f"function/{number}").read_bytes(),
                             pathlib.Path(f"command{number}").read_bytes(), named)

    def test_objects_are_those_of_the_command(self):
        tiles = [str(path) for path in sorted(pathlib.Path("tiles").iterdir())]
        for k in range(3):
            pcl_bv.write_object_share(pathlib.Path("parts") / str(k), tiles, share=(k, 3), cluster=0.5,
                                      volumes=self.VOLUMES)
        for volumes in (self.VOLUMES, ["dop26"]):
            objects = pcl_bv.merge_object_shares(["parts/2", "parts/0", "parts/1"], cluster=0.5, volumes=volumes,
                                                 memory=1)
            self.expect_objects(objects, "--merge", "--volume", ",".join(volumes), "parts")
        read = pickle.loads(pickle.dumps(objects))
        self.assertEqual([repr(each) for each in read], [repr(each) for each in objects])
        self.assertEqual([each.volumes for each in read], [each.volumes for each in objects])
        for tile in tiles:
            pcl_bv.write_object_share(f"independent/{pathlib.Path(tile).stem}", tile, cluster=0.5)
        self.expect_objects(pcl_bv.merge_object_shares("independent", cluster=0.5), "--together", "tiles")

    def test_files_above_the_ground_merge_and_have_the_paths_of_inputs(self):
        children.run(["synth", "town:4:3:20000", "map"])
        options = ["--cluster", "0.5", "--ground", "slope"]
        command("--partial", "ground", "--ground", "slope", "map")
        for k in range(2):
            command("--partial", f"above/{k}", "--part", f"{k}/2", *options, "--ground-parts", "ground", "map")
        self.expect_objects(pcl_bv.merge_object_shares("above", cluster=0.5, ground={"method": "slope"}),
                            "--together", "--ground", "slope", "map")
        for k in range(2):
            pcl_bv.write_object_share(f"parts/{k}", "tiles", share=(k, 2), cluster=0.5)
        command("--together", "--cluster", "0.5", "--labels", "expected", "tiles")
        command("--merge", "--cluster", "0.5", "--labels", "labels", "parts")
        names = sorted(path.name for path in pathlib.Path("expected").iterdir())
        self.assertEqual(len(names), 9)
        for name in names:
            self.assertEqual((pathlib.Path("labels") / name).read_bytes(), (pathlib.Path("expected") / name).read_bytes())

    def test_objects_near_damaged_points_are_incomplete(self):
        for k in range(2):
            pcl_bv.write_object_share(f"parts/{k}", "tiles", share=(k, 2), cluster=0.5, volumes="aabb")
        content = bytearray(pathlib.Path("parts/1").read_bytes())
        for at in range(10_000, len(content) // 3, 10_000):
            content[at] ^= 64
        pathlib.Path("parts/1").write_bytes(content)
        with warnings.catch_warnings(record=True) as warned:
            warnings.simplefilter("always")
            objects = pcl_bv.merge_object_shares("parts", cluster=0.5, volumes=["obb-pca"])
        self.assertIn("parts/1: its points are damaged: ", str(warned[0].message))
        self.assertIn(True, [each.incomplete for each in objects])
        self.assertIn(False, [each.incomplete for each in objects])

    def refused(self, error, words, call, *arguments, **named):
        with self.assertRaisesRegex(error, words):
            call(*arguments, **named)

    def test_what_is_wrong_is_named(self):
        write, merge = pcl_bv.write_object_share, pcl_bv.merge_object_shares
        for k in range(2):
            write(f"parts/{k}", "tiles", share=(k, 2), cluster=0.5)
        self.refused(OSError, "shares are missing: points 0 to ", merge, "parts/1", cluster=0.5)
        self.refused(OSError, "parts/1: overlaps another share", merge, ["parts", "parts/1"], cluster=0.5)
        self.refused(OSError, "parts/0: was made with --cluster 0.5 --min-points 1", merge, "parts", cluster=0.4)
        self.refused(FileNotFoundError, "parts/2", merge, ["parts", "parts/2"], cluster=0.5)
        self.refused(FileNotFoundError, "nowhere.pcd", write, "p", ["tiles", "nowhere.pcd"], cluster=0.5)
        pathlib.Path("tiles/000_000.pcd").write_text("no cloud " * 20)
        self.refused(OSError, "tiles/000_000.pcd: ", write, "p", "tiles", cluster=0.5)
        self.refused(OSError, "tiles/000_000.pcd: is no file of objects", merge, "tiles/000_000.pcd", cluster=0.5)
        self.refused(ValueError, "tiles/001_000.pcd", write, "tiles/001_000.pcd", "tiles", cluster=0.5)
        for path in ("tiles", "/proc/nothing/p"):
            self.refused(OSError, path, write, path, "synth:box:100", cluster=0.5)
        for call in (lambda **named: write("p", "synth:box:100", **named), lambda **named: merge("parts", **named)):
            self.refused(ValueError, "cluster: 0 is not above 0", call, cluster=0)
            self.refused(ValueError, "cluster: a tolerance above 0 is needed", call, cluster={"min_size": 1})
            self.refused(ValueError, "cluster.min_size: '-1'", call, cluster={"tolerance": 1, "min_size": -1})
            self.refused(TypeError, "cluster: expected a number, got 'near'", call, cluster="near")
            self.refused(ValueError, "volumes: 'boxx' is no method", call, cluster=1, volumes=["boxx"])
            self.refused(ValueError, "memory: 0 is not", call, cluster=1, memory=0)
            self.refused(ValueError, "unknown key 'colour'", call, cluster=1, colour="red")
            self.refused(ValueError, "ground.method", call, cluster=1, ground={"method": "zones"})
            self.refused(ValueError, "filter.regions: shares need files", call, cluster=1,
                         filter={"regions": [{"volumes": pcl_bv.Sphere([0, 0, 0], 1)}]})
        self.refused(ValueError, "ground.method", write, "p", "synth:box:100", cluster=1, ground={"method": "slope"})
        self.refused(ValueError, "share: k: 2 is not", write, "p", "synth:box:100", cluster=1, share=(2, 2))
        self.refused(TypeError, "share: expected a pair", write, "p", "synth:box:100", cluster=1, share=1)
        self.refused(ValueError, "origin", write, "p", "synth:box:100", cluster=1, origin=[0, 0, np.inf])
        self.refused(ValueError, "inputs: an empty list", write, "p", [], cluster=1)
        self.assertFalse(pathlib.Path("p").exists())


if __name__ == "__main__":
    unittest.main()
