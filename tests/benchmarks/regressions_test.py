# SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
# SPDX-License-Identifier: BSD-3-Clause
"""A ratio that fell is measured again and named; others are not."""
import pathlib
import re
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "benchmarks"))
import regressions  # noqa: E402


class Runs:
    """Returns the rows of one run after another, and keeps the filters."""

    def __init__(self, *runs):
        self.runs, self.filters = list(runs), []

    def __call__(self, part, rows):
        self.filters.append(rows)
        return {name: {"ratio": ratio} for name, ratio in self.runs.pop(0).items()}


class Regressions(unittest.TestCase):
    def test_a_row_that_fell_is_named_with_its_change(self):
        text, fell = regressions.report({"over-pcl/a": 10, "over-pcl/b": 2}, {"over-pcl/a": 8.4, "over-pcl/b": 1.71})
        self.assertTrue(fell)
        self.assertIn("1 of 2 ratios fell", text)
        self.assertIn("`over-pcl/a` | 10.0 | 8.40 | -16 %", text)
        self.assertNotIn("over-pcl/b", text)

    def test_new_rows_and_rows_without_a_ratio_are_not_compared(self):
        now = regressions.ratios({"new": {"ratio": 1}, "time": {"us": [3, 2]}})
        self.assertEqual(now, {"new": 1})
        text, fell = regressions.report({"other": 5}, now)
        self.assertFalse(fell)
        self.assertIn("no results of this processor", text)

    def test_the_best_of_three_runs_counts(self):
        run = Runs({"a": 5, "b": 10}, {"a": 6}, {"a": 9})
        now = regressions.measure("pairs", {"a": 10, "b": 10}, run)
        self.assertEqual(now, {"a": 9, "b": 10})
        self.assertEqual(len(run.filters), 3)
        self.assertEqual(run.filters[0], regressions.ROWS["pairs"])

    def test_no_row_is_run_again_if_none_fell(self):
        run = Runs({"a": 9})
        regressions.measure("pairs", {"a": 10}, run)
        self.assertEqual(len(run.filters), 1)

    def test_rows_that_were_not_measured_are_named(self):
        text, _ = regressions.report({"over-pcl/a": 1, "over-pcl/b": 1, "mask/other": 1}, {"over-pcl/a": 1})
        self.assertIn("1 rows of the file were not measured: over-pcl/b", text)

    def test_a_filter_matches_only_its_rows(self):
        name = "turns/PCL (cheapest) over obb-pca/gauss:300"
        found = re.compile(regressions.exactly([name, "mask/x.y"]))
        self.assertTrue(found.match(name + "/iterations:10/manual_time"))
        self.assertTrue(found.match("mask/x.y"))
        self.assertFalse(found.match("mask/xzy"))
        self.assertFalse(found.match(name + "0"))
        self.assertEqual(regressions.exactly(["a]}"]), "^(a]})(/|$)")
        self.assertNotIn("\\-", regressions.exactly([name]))  # which POSIX does not permit


if __name__ == "__main__":
    unittest.main()
