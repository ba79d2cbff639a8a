# SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
# SPDX-License-Identifier: BSD-3-Clause
import json
import os
import tempfile
import unittest

import numpy as np

import children
import pcl_bv
from clouds import clouds, numbers_of

PCD_BV = os.path.join(os.environ["PCL_BV_BIN_DIR"], "pcd_bv")


def command(path, methods):
    """What pcd_bv says of a cloud, method by method."""
    out = children.run([PCD_BV, "--volume", ",".join(methods), "--format", "json", path],
                       capture_output=True)
    return json.loads(out.stdout)[0]["clusters"][0]["volumes"]


class Bits(unittest.TestCase):
    def test_every_method_has_the_bits_of_the_command(self):
        with tempfile.TemporaryDirectory() as folder:
            for name, points in clouds().items():
                path = os.path.join(folder, "cloud.pcd")
                pcl_bv.write(path, points)
                for wanted, volume in self.pairs(command(path, list(pcl_bv.methods())), points):
                    with self.subTest(cloud=name, method=volume.method):
                        self.assertEqual(wanted["shape"], volume.shape)
                        self.assertEqual(wanted["volume"], volume.volume)
                        for field, value in numbers_of(volume).items():
                            expected = np.array(wanted[field], dtype=np.asarray(value).dtype)
                            self.assertTrue(np.array_equal(expected.reshape(np.shape(value)), value), field)

    def pairs(self, said, points):
        methods = list(pcl_bv.methods())
        self.assertEqual([volume["method"] for volume in said], methods)
        for wanted, method in zip(said, methods):
            yield wanted, pcl_bv.fit(points, method)

    def test_a_list_of_methods_has_the_bits_of_each(self):
        methods = list(pcl_bv.methods())
        for points in clouds().values():
            for together, method in zip(pcl_bv.fit(points, methods, threads=0), methods):
                self.assertEqual(together, pcl_bv.fit(points, method), method)

    def test_labels_give_what_separate_fits_give(self):
        for points in clouds().values():
            labels = np.random.default_rng(7).integers(-1, 5, len(points))
            by_label = pcl_bv.fit(points, ["dop26", "obb", "sphere"], labels, threads=2)
            self.assertEqual(list(by_label), sorted(set(labels[labels >= 0].tolist())))
            for label, volumes in by_label.items():
                for volume in volumes:
                    self.assertEqual(volume, pcl_bv.fit(points[labels == label], volume.method))

    def test_no_set_of_instructions_changes_a_bit(self):
        for points in clouds().values():
            for method in pcl_bv.methods():
                of_scalar = pcl_bv.fit(points, method, isa="scalar")
                for isa in pcl_bv.instruction_sets:
                    self.assertEqual(pcl_bv.fit(points, method, isa=isa), of_scalar, (method, isa))


if __name__ == "__main__":
    unittest.main()
