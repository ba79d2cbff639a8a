# SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
# SPDX-License-Identifier: BSD-3-Clause
"""The package for Python: CMake builds the extension and installs it into the wheel.

CMAKE_ARGS of the environment goes to CMake, CMAKE_BUILD_PARALLEL_LEVEL says how many compilers run.
"""

import os
import pathlib
import re
import shlex
import subprocess
import sys

from setuptools import Distribution, Extension, setup
from setuptools.command.build_ext import build_ext

ROOT = pathlib.Path(__file__).parent.resolve()


class BuildWithCMake(build_ext):
    def run(self):
        build = ROOT / "build" / "pip"  # as deep as the presets' folders: ccache knows what they compiled
        prefix = pathlib.Path(self.build_lib).resolve()
        build.mkdir(parents=True, exist_ok=True)
        options = [
            "-DCMAKE_BUILD_TYPE=Release",
            "-DPCL_BV_COMPONENTS=python;laz;gpu;dds;draco",  # the last four only where their libraries are
            "-DPCL_BV_UNITY=ON",
            "-DPCL_BV_BUILD_TESTS=OFF",
            "-DPCL_BV_BUILD_BENCHMARKS=OFF",
            "-DPCL_BV_BUILD_COMMANDS=OFF",
            "-DBUILD_SHARED_LIBS=OFF",
            f"-DPython3_EXECUTABLE={sys.executable}",
            "-DPCL_BV_PYTHON_DIR=.",
            *shlex.split(os.environ.get("CMAKE_ARGS", "")),
        ]
        subprocess.run(["cmake", "-G", "Ninja", "-S", ROOT, "-B", build, *options], check=True)
        level = os.environ.get("CMAKE_BUILD_PARALLEL_LEVEL", str(os.cpu_count() or 1))
        subprocess.run(["cmake", "--build", build, "--target", "_pcl_bv", "--parallel", level], check=True)
        install = ["cmake", "--install", build, "--component", "python", "--prefix", prefix, "--strip"]
        subprocess.run(install, check=True)

    def get_outputs(self):
        return [str(path) for path in (pathlib.Path(self.build_lib) / "pcl_bv").glob("*")]


class HasAnExtension(Distribution):
    def has_ext_modules(self):  # so that the wheel is named for this Python and machine
        return True


setup(
    version=re.search(r"VERSION ([0-9.]+)",
                      (ROOT / "CMakeLists.txt").read_text().split("project(")[1]).group(1),
    packages=["pcl_bv"],
    package_dir={"": "python"},
    package_data={"pcl_bv": ["py.typed", "*.pyi"]},
    ext_modules=[Extension("pcl_bv._pcl_bv", [])],
    cmdclass={"build_ext": BuildWithCMake},
    distclass=HasAnExtension,
)
