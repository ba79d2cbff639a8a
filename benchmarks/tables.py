#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
# SPDX-License-Identifier: BSD-3-Clause
"""Prints a file of benchmarks/results as Markdown: the paper's Tables 2 to 5, what was aimed at and what is
reached, memory, layouts, bad points, peers, clusters, oriented boxes, batches, the pipeline.

usage: benchmarks/tables.py RESULTS.json
"""
import sys

from results import LEVELS, PAPER, Results, table

SPHERES = [("Ritter", "sphere-ritter"), ("EPOS-6", "sphere-epos6"), ("EPOS-14", "sphere-epos14"),
           ("EPOS-26", "sphere-epos26"), ("EPOS-98", "sphere-epos98"), ("smallest", "sphere-exact")]
SHAPES = ("gauss", "cube", "ball", "car", "golfball", "surface")
VOLUMES = [("AABB", "aabb"), ("14-DOP", "dop14"), ("26-DOP", "dop26")]

# Work, points, comparison, what to reach by instruction set. Ratios of two sides that ran in turns.
TARGETS = [
    ("26-DOP over its scalar reference, L2", "over-scalar/dop26/{}/gauss/xyz/no-nan/n:32768",
     {"avx512": 16, "avx2": 7, "sse4": 4}),
    ("26-DOP over a plain -O3 loop, L2", "over-plain-dop26/dop26/{}/gauss/xyz/no-nan/n:32768", {}),
    ("26-DOP over a naive -O2 loop, L2", "over-naive-dop26/dop26/{}/gauss/xyz/no-nan/n:32768", {}),
    ("26-DOP from memory, of the read bandwidth, 2 threads",
     "of-bandwidth/dop26/{}/gauss/xyz/no-nan/n:16000000/threads:2/wait:default", {"avx512": 0.9, "avx2": 0.75}),
    ("26-DOP from memory, of the read bandwidth, 1 thread",
     "of-bandwidth/dop26/{}/gauss/xyz/no-nan/n:16000000/threads:1", {}),
    ("AABB from memory, of the read bandwidth, 1 thread",
     "of-bandwidth/aabb/{}/gauss/xyz/no-nan/n:16000000/threads:1", {}),
    ("AABB over getMinMax3D, dense, L2", "over-pcl-dense/aabb/{}/gauss/xyz/no-nan/n:32768", {"avx512": 6.5}),
    ("AABB over getMinMax3D, not dense, L2", "over-pcl-non-dense/aabb/{}/gauss/xyz/no-nan/n:32768",
     {"avx512": 30, "avx2": 18, "sse4": 5}),
    ("AABB over getMinMax3D, dense, memory", "over-pcl-dense/aabb/{}/gauss/xyz/no-nan/n:16000000", {}),
    ("AABB over getMinMax3D, not dense, memory", "over-pcl-non-dense/aabb/{}/gauss/xyz/no-nan/n:16000000",
     {"avx512": 6, "avx2": 6, "sse4": 6}),
]
TARGETS += [
    (f"EPOS-26 over its scalar reference, {n}", f"over-scalar/sphere-epos26/{{}}/{c}", {"avx512": 12, "sse4": 3.5})
    for n, c in (("L2", "gauss/xyz/no-nan/n:32768"), ("100722", "paper/xyz/no-nan/n:100722"))
]
TARGETS += [
    (f"smallest sphere over EPOS-26, {shape} {n}", f"over-epos26/sphere-exact/{{}}/{shape}/xyz/no-nan/n:{n}",
     {"avx512": round(1 / most, 2)})
    for most, shapes in ((1.3, ("gauss", "cube", "ball", "car")), (3, ("golfball", "surface")))
    for shape in shapes for n in (100722, 1000000)
]
TARGETS += [
    (f"smallest sphere over CGAL's Min_sphere_d, {shape}", f"over-cgal/sphere-exact/{{}}/{shape}/xyz/no-nan/n:1000000",
     {"avx512": 25})
    for shape in ("gauss", "cube", "ball", "car", "golfball", "surface")
]
# Work, comparison, the greatest extra time in percent by instruction set.
COSTS = [
    ("AABB: the test of every point, L2", "over-unchecked/aabb/{}/gauss/xyz/no-nan/n:32768",
     {"avx512": 15, "avx2": 15, "sse4": 60}),
    ("AABB: the same, memory", "over-unchecked/aabb/{}/gauss/xyz/no-nan/n:16000000",
     {"avx512": 0, "avx2": 0, "sse4": 0}),
    ("26-DOP: the test of every point and the exact look, L2", "over-unchecked/dop26/{}/gauss/xyz/no-nan/n:32768", {}),
    ("26-DOP: the same, memory", "over-unchecked/dop26/{}/gauss/xyz/no-nan/n:16000000", {}),
]


def figure(results, name, show):
    """Median of the pairs and, in brackets, the same of the two minima."""
    row = results.row(name)
    return row and f"{show(row['ratio'])} ({show(row['ratio_of_minima'])})"


def targets(results):
    sets = results.sets()[1:]
    as_ratio = "{:.2f}".format
    as_cost = lambda ratio: f"{100 / ratio - 100:+.0f} %"
    lines = []
    for rows, sign, show in ((TARGETS, ">=", as_ratio), (COSTS, "<=", as_cost)):
        for label, name, wanted in rows:
            lines.append([label] + [
                (f"{sign} {wanted[s]}{' %' if sign == '<=' else ''}: " if s in wanted else "")
                + str(figure(results, name.format(s), show)) for s in sets
            ])
    return table(["target: median of 30 pairs (ratio of minima)"] + sets, lines)


def thread_targets(results):
    """The least ratio over all sizes, and over those in L3 that take one thread at least 200 us."""
    found = {}
    for name, row in results.rows.items():
        if not name.startswith("two-threads/") or "/gauss/" not in name or "/wait:" not in name:
            continue
        _, work, s, *_ = name.split("/")
        points, wait = int(name.split("n:")[1].split("/")[0]), name.split("/wait:")[1]
        run = row["median"]
        place = "L3, >= 200 us" if run["first_us"] >= 200 and 2**20 < 16 * points <= 2**25 else None
        for where in {"all sizes", place} - {None}:
            found.setdefault((work, s, where, wait), []).append((run["ratio"], run["ratio_of_minima"], points))
    aims = {"all sizes": ">= 0.95", "L3, >= 200 us": ">= 1.8"}
    lines = []
    for (work, s, where, wait), ratios in sorted(found.items()):
        ratio, of_minima, points = min(ratios)
        lines.append([f"{work} {s}, {wait} waiting, {where}", aims[where], f"{ratio:.2f} ({of_minima:.2f})", points])
    return table(["two threads over one, the least", "target", "median of 30 pairs (ratio of minima)", "points"], lines)


def threads(results):
    """Two threads against one, by size; waiting as OpenMP does by default and passively."""
    works = [("AABB", "aabb", results.sets()[-1])] + [("26-DOP", "dop26", s) for s in results.sets()[1:]]
    points = sorted({int(n.split("n:")[1].split("/")[0]) for n in results.rows
                     if n.startswith("two-threads/") and "/gauss/" in n and "/wait:" in n})
    waits = sorted({n.split("/wait:")[1] for n in results.rows if n.startswith("two-threads/") and "/wait:" in n})
    head = ["points"] + [f"{label} {s}, {wait}" for label, _, s in works for wait in waits]
    lines = [[n] + [figure(results, f"two-threads/{work}/{s}/gauss/xyz/no-nan/n:{n}/wait:{wait}", "{:.2f}".format)
                    for _, work, s in works for wait in waits] for n in points]
    return table(head, lines)


def table_2(results):
    sets = results.sets()
    lines = []
    for points, mesh in PAPER.items():
        cells = [f"{mesh} ({points})"]
        for _, work in VOLUMES:
            times = [results.milliseconds(f"{work}/{s}/paper/xyz/no-nan/n:{points}") for s in sets]
            cells += [f"{times[0]:.3f}"] + [f"{t:.4f} ({times[0] / t:.1f})" for t in times[1:]]
        lines.append(cells)
    return table(["points"] + [f"{label} {s}" for label, _ in VOLUMES for s in sets], lines)


def table_3(results):
    sets = results.sets()
    lines = []
    for points, mesh in PAPER.items():
        cells = [f"{mesh} ({points})"]
        for _, work in SPHERES:
            times = [results.milliseconds(f"{work}/{s}/paper/xyz/no-nan/n:{points}") for s in sets]
            cells += [f"{times[0]:.3f}"] + [f"{t:.4f} ({times[0] / t:.1f})" for t in times[1:]] if times[0] else [None] * len(sets)
        lines.append(cells)
    return table(["points"] + [f"{label} {s}" for label, _ in SPHERES for s in sets], lines)


def table_4(results):
    """Radii in units of the longest side of the box, and how far over the smallest one."""
    best = results.sets()[-1]
    clouds = [(f"{mesh} ({n})", f"paper/xyz/no-nan/n:{n}") for n, mesh in PAPER.items()]
    clouds += [(f"{shape} ({n})", f"{shape}/xyz/no-nan/n:{n}") for shape in SHAPES for n in (300, 100722, 1000000)]
    lines = []
    for label, cloud in clouds:
        rows = [results.row(f"{work}/{best}/{cloud}") for _, work in SPHERES]
        if rows[0]:
            lines.append([label] + [f"{r['radius']:.4f} ({100 * (r['over_optimum'] - 1):+.2f} %)" for r in rows])
    return table(["points"] + [label for label, _ in SPHERES], lines)


def growth(results):
    lines = []
    for method in ("sphere-ritter", "sphere-epos26"):
        for way in ("sequential", "stationary", "deferred"):
            for n in (100722, 1000000):
                rows = [results.row(f"{method}+{way}/{t}/ball/xyz/no-nan/n:{n}") for t in ("1-thread", "2-threads")]
                if all(rows):
                    lines.append([f"{method}, {way}", n] + [f"{r['items_per_second'] / 1e6:.0f}" for r in rows]
                                 + [f"{100 * (rows[0]['over_optimum'] - 1):+.3f} %"])
    return table(["points in a ball", "points", "Mpt/s, one thread", "two", "over the smallest"], lines)


def table_5(results):
    sets = sorted({n.split("/")[2] for n in results.rows if n.startswith("two-threads/") and "/paper/" in n})
    lines = []
    for points, mesh in PAPER.items():
        cells = [f"{mesh} ({points})"]
        for s in sets:
            row = results.row(f"two-threads/dop26/{s}/paper/xyz/no-nan/n:{points}/wait:default")
            cells += [f"{row['first_us'] / 1e3:.4f}", f"{row['second_us'] / 1e3:.4f}"] if row else [None, None]
        lines.append(cells)
    return table(["points"] + [f"{s}, {c}" for s in sets for c in ("1 core", "2 cores")], lines)


def speeds(results, works, clouds):
    """Mpt/s of each work and set in each cloud."""
    lines = []
    for work, sets in works:
        for s in sets:
            found = [results.speed(f"{work}/{s}/{cloud}") for _, cloud in clouds]
            if any(found):
                lines.append([f"{work} {s}"] + [f and f"{f:.0f}" for f in found])
    return table(["Mpt/s"] + [label for label, _ in clouds], lines)


def bandwidth(results):
    names = [("reading, 1 thread", "read-1-thread/best"), ("reading, 2 threads", "read-2-thread/best")]
    names += [(f"{work} {s}", f"{work}/{s}") for work in ("aabb", "dop26") for s in results.sets()]
    lines = []
    for label, name in names:
        rows = [results.row(f"{name}/gauss/xyz/no-nan/n:{n}") for n in LEVELS]
        lines.append([label] + [row and f"{row['bytes_per_second'] / 1e9:.1f}" for row in rows])
    return table(["GB/s"] + [f"{level} ({n})" for n, level in LEVELS.items()], lines)


def in_turns(results, prefix, sides):
    """Comparisons in turns whose names begin so: both times in ms, and their ratio."""
    lines = []
    for name, row in sorted(results.rows.items()):
        run = row.get("median", {})
        if name.startswith(prefix) and "ratio" in run:
            lines.append([name[len(prefix):], f"{run['first_us'] / 1e3:.4g}", f"{run['second_us'] / 1e3:.4g}",
                          f"{run['ratio']:.2f} ({run['ratio_of_minima']:.2f})"])
    return table(["", *sides, "median of pairs (ratio of minima)"], lines)


def pipeline(results):
    stages = ("filter", "ground", "cluster", "fit", "track", "total")
    lines = []
    for name, row in results.rows.items():
        run = row.get("median", {})
        if name.startswith("pipeline/"):
            lines.append([name[9:], f"{run['clusters']:.0f}"]
                         + [f"{run[s + '_p50']:.2f} / {run[s + '_p99']:.2f}" if s + "_p50" in run else None for s in stages]
                         + [f"{run['max']:.1f}", f"{run['first_max']:.1f}" if "first_max" in run else None])
    return table(["ms, 50th / 99th percentile", "clusters", *stages, "greatest", "of the first five"], lines)


def milliseconds_of(results, prefixes):
    lines = [[n, f"{results.milliseconds(n):.4g}"] for n in sorted(results.rows)
             if n.startswith(prefixes) and results.row(n) and "cpu_time" in results.row(n)]
    return table(["", "ms"], lines)


def sections(results):
    sets = results.sets()
    both = [("aabb", sets), ("dop26", sets)]
    works = [(w, sets) for w in ("aabb", "dop14", "dop18", "dop26", "dop26-points", "unchecked-aabb",
                                 "unchecked-dop26")]
    peers = [(n.split("/")[0], ["peer"]) for n in results.rows if "/peer/gauss/" in n and n.endswith("no-nan/n:32768")]
    pcl = [("pcl-dense", ["peer"]), ("pcl-non-dense", ["peer"])]
    layouts = ("xyz", "packed", "xyzi", "indices", "groups", "double")
    bad = ("no-nan", "one-nan", "1pc-nan")
    two_levels = [(n, v) for n, v in LEVELS.items() if v in ("L2", "memory")]
    yield "Targets", targets(results) + "\n\n" + thread_targets(results)
    yield "Two threads over one, median of 30 pairs (ratio of minima)", threads(results)
    yield "Table 2 of the paper: ms of one core (speed-up over scalar)", table_2(results)
    yield "Table 3 of the paper: spheres, ms of one core (speed-up over scalar)", table_3(results)
    yield "Table 4 of the paper: radii over the box's longest side (over the smallest radius)", table_4(results)
    yield "Ways to grow a sphere", growth(results)
    yield "Table 5 of the paper: 26-DOP on one and two cores, ms, minima", table_5(results)
    yield "Bytes that pass, gauss", bandwidth(results)
    yield "Clusters: pcl::EuclideanClusterExtraction over ours", in_turns(results, "over-pcl/", ("PCL, ms", "ours, ms"))
    yield "Clusters: nanoflann and a breadth-first search over ours", in_turns(
        results, "over-nanoflann/", ("nanoflann, ms", "ours, ms"))
    yield "Clusters on two threads", in_turns(results, "two-threads/st", ("one thread, ms", "two, ms"))
    yield "Ground", milliseconds_of(results, ("ground/",))
    yield "Oriented boxes, in turns", in_turns(results, "turns/", ("first, ms", "ours, ms"))
    yield "100 clusters of 300 points", milliseconds_of(results, ("100 clusters",))
    yield "Batches: one by one over all at once", in_turns(results, "batch/", ("one by one, ms", "at once, ms"))
    yield "Hulls and what is fitted to them", milliseconds_of(
        results, ("hull/", "cylinder/", "capsule/", "ellipsoid/", "qhull", "pcl::ConvexHull"))
    yield "The pipeline, from a cloud in memory to volumes and tracks", pipeline(results)
    yield "Levels of memory, gauss", speeds(
        results, works, [(v, f"gauss/xyz/no-nan/n:{n}") for n, v in LEVELS.items()])
    yield "Peers, gauss", speeds(
        results, peers, [(f"{v} {x}", f"gauss/{x}/no-nan/n:{n}") for x in ("xyz", "packed") for n, v in LEVELS.items()])
    yield "Layouts, gauss", speeds(
        results, both, [(f"{v} {x}", f"gauss/{x}/no-nan/n:{n}") for n, v in two_levels for x in layouts])
    yield "Bad points, gauss", speeds(
        results, both + pcl, [(f"{v} {b}", f"gauss/xyz/{b}/n:{n}") for n, v in two_levels for b in bad])
    yield "Scenes", speeds(results, both, [(x, f"{x}/xyz/no-nan/n:128000") for x in ("gauss", "cube", "street")])


def outside(results):
    """Rows of peers that leave points outside their own answer."""
    rows = {n: r["median"]["outside"] for n, r in results.rows.items() if r.get("median", {}).get("outside")}
    return table(["peer and cloud", "points outside its answer"], [[n, f"{c:.0f}"] for n, c in rows.items()])


def main(arguments):
    if len(arguments) != 1:
        sys.exit(__doc__)
    results = Results(arguments[0])
    context = results.context
    print(f"{results.path.name}: {context['num_cpus']} cores, {context['date']}, commit {context.get('commit')}, "
          f"{context.get('compiler')}")
    for title, text in sections(results):
        print(f"\n## {title}\n\n{text}")
    print(f"\n## Points outside\n\n{outside(results)}")


main(sys.argv[1:])
