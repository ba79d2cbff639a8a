# SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
# SPDX-License-Identifier: BSD-3-Clause
"""pip install into an empty prefix, without a network, of a copy of the sources; then a stranger's program."""

import os
import pathlib
import shutil
import subprocess
import sys

PROGRAM = """
import pathlib, pickle, sys, numpy, pcl_bv
assert pathlib.Path(pcl_bv.__file__).is_relative_to(sys.argv[1]), pcl_bv.__file__
points = numpy.random.default_rng(1).normal(size=(1000, 3))
volumes = pcl_bv.fit(points, "all")
assert all(pcl_bv.verify(volume, points).outside == 0 for volume in volumes)
assert pickle.loads(pickle.dumps(volumes)) == volumes
assert (pathlib.Path(pcl_bv.__file__).parent / "py.typed").exists()
import importlib.metadata
assert importlib.metadata.version("pcl_bv") == pcl_bv.__version__
"""


def main(source, work):
    source, work = pathlib.Path(source), pathlib.Path(work)
    shutil.rmtree(work, ignore_errors=True)
    copy, prefix, empty = work / "source", work / "prefix", work / "empty"
    empty.mkdir(parents=True)
    shutil.copytree(source, copy, ignore=lambda folder, names: {"build", ".git",
                                                                ".cache"} if folder == str(source) else ())
    environment = {name: value for name,
                   value in os.environ.items() if name != "PYTHONPATH" and not name.startswith("PIP_")}
    pip = [sys.executable, "-m", "pip", "install", "--no-build-isolation", "--no-deps", "--no-index",
           "--prefix", prefix,
           "--ignore-installed", "--break-system-packages", copy]
    subprocess.run(pip, check=True, env=environment, cwd=empty, timeout=1500)
    installed = [path.parent for path in prefix.rglob("pcl_bv/__init__.py")]
    assert len(installed) == 1, installed
    environment["PYTHONPATH"] = str(installed[0].parent)
    subprocess.run([sys.executable, "-W", "error", "-c", PROGRAM, prefix], check=True, env=environment,
                   cwd=empty, timeout=120)
    shutil.rmtree(work)


main(*sys.argv[1:])
