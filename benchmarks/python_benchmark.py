#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
# SPDX-License-Identifier: BSD-3-Clause
"""Calls from Python, and Open3D's in the same run: python_benchmark.py [FOLDER OF THE PACKAGE [CLOUD]].

Medians (minima), one thread of ours. Ours and Open3D's take turns: a busy machine slows both. CLOUD: any
file or recording; else a street as a LiDAR of 64 beams sees it. Open3D's rows need Debian's python3-open3d.
"""

import statistics
import sys
import time

if len(sys.argv) > 1:
    sys.path.insert(0, sys.argv[1])

import numpy as np  # noqa: E402

import pcl_bv  # noqa: E402


def seconds(call, inner):
    begin = time.perf_counter()
    for _ in range(inner):
        call()
    return (time.perf_counter() - begin) / inner


def timed(calls, repetitions, inner=1):
    """Seconds of each of the calls, in turns: (median, minimum) each."""
    for call in calls:
        call()
    rows = [[seconds(call, inner) for call in calls] for _ in range(repetitions)]
    return [(statistics.median(column), min(column)) for column in zip(*rows)]


def text(median_and_least):
    def unit(value):
        return f"{value * 1e6:.2f} µs" if value < 1e-3 else f"{value * 1e3:.2f} ms"

    return f"{unit(median_and_least[0])} ({unit(median_and_least[1])})"


def calls_alone():
    """All of a call: what Python adds to the fit of so few points is less than that."""
    print("| call | time, the fit itself included |")
    print("|---|---|")
    few = np.random.default_rng(1).normal(size=(100, 3)).astype(np.float32)
    wide = np.hstack([few, few])[:, :3]
    records = few.copy().view([("x", "f4"), ("y", "f4"), ("z", "f4")]).ravel()
    rows = {
        "fit, aabb, (100, 3)": lambda: pcl_bv.fit(few, "aabb"),
        "fit, aabb, (100, 6)[:, :3]": lambda: pcl_bv.fit(wide, "aabb"),
        "fit, aabb, 100 records": lambda: pcl_bv.fit(records, "aabb"),
        "fit, dop26, (100, 3)": lambda: pcl_bv.fit(few, "dop26"),
        "fit, [aabb, sphere], (100, 3)": lambda: pcl_bv.fit(few, ["aabb", "sphere"]),
        "numpy: min and max of (100, 3)": lambda: (few.min(axis=0), few.max(axis=0)),
    }
    for name, times in zip(rows, timed(list(rows.values()), 51, 2000)):
        print(f"| {name} | {text(times)} |")
    print()


def beside_open3d(cloud):
    try:
        import open3d
    except ImportError:
        print("python3-open3d is not installed: its rows are left out")
        return
    xyz = np.stack([cloud[name].ravel() for name in "xyz"], axis=1).astype(np.float64)
    xyz = xyz[np.isfinite(xyz).all(axis=1) & (np.linalg.norm(xyz, axis=1) > 1)]
    points = np.ascontiguousarray(xyz[~pcl_bv.ground(xyz).mask])
    theirs = open3d.geometry.PointCloud(open3d.utility.Vector3dVector(points))
    clusters = pcl_bv.cluster(points, 0.5, min_size=30)
    largest = np.ascontiguousarray(points[clusters[0]])
    their_largest = open3d.geometry.PointCloud(open3d.utility.Vector3dVector(largest))
    print(f"| work | ours | Open3D {open3d.__version__} | ratio of medians |")
    print("|---|---|---|---|")

    def row(name, ours, others, repetitions):
        a, b = timed([ours, others], repetitions)
        print(f"| {name} | {text(a)} | {text(b)} | {b[0] / a[0]:.1f} |")

    for tolerance in (0.5, 0.2):
        for core in (1, 5):
            row(f"clusters, {tolerance} m, min_points {core}, {len(points)} points",
                lambda: pcl_bv.cluster(points, tolerance, min_points=core),
                lambda: theirs.cluster_dbscan(tolerance, core), 7)
        found = pcl_bv.cluster(points, tolerance).labels.max() + 1
        assert found == np.asarray(theirs.cluster_dbscan(tolerance, 1)).max() + 1, "not the same clusters"
    of = f", {len(largest)} points"
    row("obb-min" + of, lambda: pcl_bv.fit(largest, "obb-min"),
        their_largest.get_minimal_oriented_bounding_box
        if hasattr(their_largest,
                   "get_minimal_oriented_bounding_box") else their_largest.get_oriented_bounding_box, 7)
    row("obb-pca (Open3D: of the hull's vertices)" + of, lambda: pcl_bv.fit(largest, "obb-pca"),
        their_largest.get_oriented_bounding_box, 15)
    row("hull" + of, lambda: pcl_bv.fit(largest, "hull"), their_largest.compute_convex_hull, 15)
    row(f"aabb, {len(points)} points", lambda: pcl_bv.fit(points, "aabb"),
        theirs.get_axis_aligned_bounding_box, 31)


def main():
    isa = pcl_bv.instruction_sets[-1]
    print(f"pcl_bv {pcl_bv.__version__}, {isa}, numpy {np.__version__}, medians (minima)\n")
    calls_alone()
    beside_open3d(pcl_bv.read(sys.argv[2] if len(sys.argv) > 2 else "synth:street:128000:2"))


main()
