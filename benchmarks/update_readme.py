#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
# SPDX-License-Identifier: BSD-3-Clause
"""Writes the table of README.md from a file of benchmarks/results; with --check, only says whether it is current.

usage: benchmarks/update_readme.py [--check] RESULTS.json
"""
import pathlib
import sys

from results import Results, table

POINTS = 100722
CLOUD = f"paper/xyz/no-nan/n:{POINTS}"
ROWS = [("AABB", "aabb"), ("26-DOP", "dop26"), ("sphere, EPOS-26", "sphere-epos26"),
        ("smallest sphere", "sphere-exact")]


def readme_table(path):
    results = Results(path)
    sets = results.sets()
    pcl = [results.speed(f"pcl-{flag}/peer/{CLOUD}") for flag in ("dense", "non-dense")]
    head = [f"Mpt/s, {POINTS} pcl::PointXYZ, one core"] + sets
    lines = [[label] + [f"{results.speed(f'{work}/{s}/{CLOUD}'):.0f}" for s in sets] for label, work in ROWS]
    return (
        f"{table(head, lines)}\n\n"
        f"`pcl::getMinMax3D` in the same run: {pcl[0]:.0f} dense, {pcl[1]:.0f} not dense. "
        f"[{path.name}](benchmarks/results/{path.name}), made by\n"
        "`./bootstrap bench`; boxes and k-DOPs exact, enclosure proven; scalar is the reference loop of the same fit."
    )


def main(arguments):
    check = "--check" in arguments
    paths = [pathlib.Path(a) for a in arguments if a != "--check"]
    if len(paths) != 1:
        sys.exit(__doc__)
    readme = pathlib.Path(__file__).parent.parent / "README.md"
    before, rest = readme.read_text().split("<!-- table:begin -->\n")
    after = rest.split("<!-- table:end -->")[1]
    text = f"{before}<!-- table:begin -->\n{readme_table(paths[0])}\n<!-- table:end -->{after}"
    if check:
        sys.exit(0 if text == readme.read_text() else "README.md: the table does not come from this file")
    readme.write_text(text)


main(sys.argv[1:])
