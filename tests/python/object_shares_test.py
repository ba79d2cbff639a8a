# SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
# SPDX-License-Identifier: BSD-3-Clause
"""The Python code for objects of docs/many-machines.md finds the objects that one process finds."""
import concurrent.futures
import contextlib
import os
import pathlib
import re
import subprocess
import tempfile
import unittest

import children

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


class ObjectShares(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.addCleanup(os.chdir, os.getcwd())
        self.addCleanup(os.environ.update, PATH=os.environ["PATH"])
        os.chdir(folder.name)
        os.environ["PATH"] = COMMANDS + os.pathsep + os.environ["PATH"]
        children.run(["synth", "town-objects:9:3:8000", "tiles"])

    def expect_the_objects_of_one_process(self, client):
        names = {"__name__": "__main__", "subprocess": subprocess, "client": client}
        exec(documented_code(), names)  # pylint: disable=exec-used
        whole = ["pcd_bv", "--together", "--cluster", "0.5", "--format", "jsonl", "--output", "whole.jsonl", "tiles"]
        children.run(whole)
        objects = pathlib.Path("objects.jsonl").read_bytes()
        self.assertEqual(objects, pathlib.Path("whole.jsonl").read_bytes())
        self.assertGreater(objects.count(b'"id"'), 20)
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
        with dask_client() as client, self.assertRaises(subprocess.CalledProcessError):
            self.expect_the_objects_of_one_process(client)
        self.assertFalse(pathlib.Path("objects.jsonl").exists())


if __name__ == "__main__":
    unittest.main()
