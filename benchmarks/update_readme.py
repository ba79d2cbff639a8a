#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
# SPDX-License-Identifier: BSD-3-Clause
"""Writes the table of README.md from a file of benchmarks/results; with --check, only says whether it is current.

usage: benchmarks/update_readme.py [--check] RESULTS.json
"""
import json
import pathlib
import sys

POINTS = 100722
SETS = ["scalar", "sse4", "avx2", "avx512", "neon", "sve", "sve2"]
ROWS = [("AABB", "aabb"), ("26-DOP", "dop26"), ("sphere, EPOS-26", "sphere-epos26")]


def speeds(results):
    """Median speed in Mpt/s by the benchmark's name without its size."""
    found = {}
    for run in results["benchmarks"]:
        if run.get("aggregate_name") == "median" and f"/n:{POINTS}/" in run["run_name"]:
            found[run["run_name"].split("/n:")[0]] = run["items_per_second"] / 1e6
    return found


def table(path):
    results = json.loads(path.read_text())
    speed = speeds(results)
    sets = [s for s in SETS if f"aabb/{s}" in speed]
    pcl = f"{speed['getMinMax3D/dense']:.0f} dense, {speed['getMinMax3D/non-dense']:.0f} not dense"
    lines = [
        f"| Mpt/s, {POINTS} pcl::PointXYZ, one core | " + " | ".join(sets) + " |",
        "|---|" + "---|" * len(sets),
    ]
    for label, name in ROWS:
        lines.append(f"| {label} | " + " | ".join(f"{speed[f'{name}/{s}']:.0f}" for s in sets) + " |")
    lines += [
        "",
        f"`pcl::getMinMax3D` in the same run: {pcl}. [{path.name}](benchmarks/results/{path.name}), made by",
        "`./bootstrap bench`; boxes and k-DOPs exact, enclosure proven; scalar is the reference loop of the same fit.",
    ]
    return "\n".join(lines)


def main(arguments):
    check = "--check" in arguments
    paths = [pathlib.Path(a) for a in arguments if a != "--check"]
    if len(paths) != 1:
        sys.exit(__doc__)
    readme = pathlib.Path(__file__).parent.parent / "README.md"
    before, rest = readme.read_text().split("<!-- table:begin -->\n")
    after = rest.split("<!-- table:end -->")[1]
    text = f"{before}<!-- table:begin -->\n{table(paths[0])}\n<!-- table:end -->{after}"
    if check:
        sys.exit(0 if text == readme.read_text() else "README.md: the table does not come from this file")
    readme.write_text(text)


main(sys.argv[1:])
