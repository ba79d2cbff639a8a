#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
# SPDX-License-Identifier: BSD-3-Clause
"""One file from several runs: the context of the first, the rows of all.

usage: benchmarks/merge_results.py RESULTS.json PART.json...
"""
import json
import pathlib
import sys


def main(arguments):
    if len(arguments) < 2:
        sys.exit(__doc__)
    parts = [json.loads(pathlib.Path(a).read_text()) for a in arguments[1:]]
    merged = {"context": parts[0]["context"], "benchmarks": sum((p["benchmarks"] for p in parts), [])}
    merged["context"].pop("executable")
    pathlib.Path(arguments[0]).write_text(json.dumps(merged, indent=1) + "\n")


main(sys.argv[1:])
