#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
# SPDX-License-Identifier: BSD-3-Clause
"""One file from several runs: the context of the first, the rows of all.

usage: benchmarks/merge_results.py RESULTS.json PART.json...
"""
import json
import pathlib
import sys


# What is read by tables.py and update_readme.py; of repetitions the median and the least.
KEPT = ("median", "min")
DROPPED = {"name", "family_index", "per_family_instance_index", "run_type", "repetitions", "repetition_index",
           "threads", "iterations", "aggregate_unit"}


def main(arguments):
    if len(arguments) < 2:
        sys.exit(__doc__)
    parts = [json.loads(pathlib.Path(a).read_text()) for a in arguments[1:]]
    rows = [row for part in parts for row in part["benchmarks"] if row.get("aggregate_name", "median") in KEPT]
    for row in rows:
        for field in DROPPED & row.keys():
            del row[field]
    merged = {"context": parts[0]["context"], "benchmarks": rows}
    merged["context"].pop("executable", None)
    pathlib.Path(arguments[0]).write_text(json.dumps(merged, separators=(",", ":")).replace("},{", "},\n{") + "\n")


main(sys.argv[1:])
