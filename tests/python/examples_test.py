# SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
# SPDX-License-Identifier: BSD-3-Clause
import os
import pathlib
import sys
import tempfile
import unittest

import children

EXAMPLES = sorted(pathlib.Path(os.environ["PCL_BV_EXAMPLES"]).glob("*.py"))


class Examples(unittest.TestCase):
    def test_each_runs_and_says_something(self):
        self.assertEqual(len(EXAMPLES), 5)
        with tempfile.TemporaryDirectory() as folder:
            for example in EXAMPLES:
                with self.subTest(example.name):
                    done = children.run([sys.executable, "-W", "error", example], cwd=folder, check=False,
                                        capture_output=True, text=True)
                    self.assertEqual((done.returncode, done.stderr), (0, ""))
                    self.assertTrue(done.stdout)
                    self.assertEqual(os.listdir(folder), [])

    def test_a_picture_is_written_where_one_is_asked_for(self):
        with tempfile.TemporaryDirectory() as folder:
            children.run([sys.executable, EXAMPLES[1], "synth:street:20000:1", "street.png"], cwd=folder,
                         capture_output=True)
            self.assertEqual(pathlib.Path(folder, "street.png").read_bytes()[:4], b"\x89PNG")

    def test_they_are_short(self):
        for example in EXAMPLES:
            self.assertLess(len(example.read_text().splitlines()), 60)


if __name__ == "__main__":
    unittest.main()
