#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
# SPDX-License-Identifier: BSD-3-Clause
"""usage: sbom_test.py REPOSITORY BUILD_DIR: the bill of materials names every library of the commands."""
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

ROOT, BUILD = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2])


def made(folder, name):
    path = pathlib.Path(folder, name)
    environment = {**os.environ, "SOURCE_DATE_EPOCH": "1700000000"}
    subprocess.run([ROOT / ".ci/sbom", BUILD, path], check=True, env=environment, stdout=subprocess.DEVNULL)
    return path.read_text()


class Sbom(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        with tempfile.TemporaryDirectory() as folder:
            cls.text, cls.again = made(folder, "one"), made(folder, "two")
        cls.document = json.loads(cls.text)
        cls.named = {entry["SPDXID"]: entry for entry in cls.document["packages"] + cls.document["files"]}

    def test_the_same_build_gives_the_same_bytes(self):
        self.assertEqual(self.text, self.again)

    def test_relationships_are_between_elements_of_the_document(self):
        known = {"SPDXRef-DOCUMENT", *self.named}
        self.assertEqual(len(known), len(self.document["packages"]) + len(self.document["files"]) + 1)
        for link in self.document["relationships"]:
            self.assertLessEqual({link["spdxElementId"], link["relatedSpdxElement"]}, known)

    def linked(self, files):
        """The names of the packages that these files load."""
        return {self.named[link["relatedSpdxElement"]]["name"] for link in self.document["relationships"]
                if link["relationshipType"] == "DYNAMIC_LINK" and link["spdxElementId"] in files}

    def test_every_library_that_a_command_asks_for_has_a_package(self):
        for command in ["pcd_bv", "bv_stream"]:
            asked = subprocess.run(["readelf", "-d", BUILD / "bin" / command], check=True,
                                   stdout=subprocess.PIPE, text=True).stdout
            count = len(set(re.findall(r"\(NEEDED\).*\[(?!ld-linux|libpcl_bv)(.+)\]", asked)))
            names = self.linked({"SPDXRef-File-bin-" + command.replace("_", "-")})
            ours = {name for name in names if "pcl_bv" in name}  # in builds of shared libraries
            self.assertLessEqual(len(names - ours), count)
            self.assertGreaterEqual(len(names - ours) + 1, count)  # libm and libc are of one package

    def test_the_libraries_of_all_files_have_packages(self):
        names = self.linked({file["SPDXID"] for file in self.document["files"]})
        for word in ["libc6", "libstdc++6", "libyaml-cpp", "libcairo2", "libsqlite3", "libzstd"]:
            self.assertTrue(any(name.startswith(word) for name in names), f"{word} in {names}")

    def test_packages_whose_headers_are_compiled_in_are_named(self):
        built_with = {self.named[link["spdxElementId"]]["name"] for link in self.document["relationships"]
                      if link["relationshipType"] == "BUILD_DEPENDENCY_OF"}
        self.assertLessEqual({"libeigen3-dev", "libhwy-dev", "nlohmann-json3-dev"}, built_with)
        self.assertNotIn("libgtest-dev", built_with)


if not all(map(shutil.which, ["dpkg-query", "ninja", "readelf"])):
    sys.exit(77)
unittest.main(argv=sys.argv[:1])
