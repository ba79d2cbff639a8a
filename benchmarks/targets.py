# SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
# SPDX-License-Identifier: BSD-3-Clause
"""What the project set out to reach, a function for each target: works, inputs and bounds."""
import re

import tree_tables
from judging import Line, Target, by_set, cost, faster, judge, share
from results import POOLS, count, number, points_of

L2, L3, MEMORY = "gauss/xyz/no-nan/n:32768", "paper/xyz/no-nan/n:100722", "gauss/xyz/no-nan/n:16000000"
INPUTS = {
    L2: "32 768 points, L2, one thread",
    L3: "100 722 points, L3, one thread",
    MEMORY: "16 M points, memory, one thread",
}
SHAPES = ("gauss", "cube", "ball", "car", "golfball", "surface")
THREE = "aabb + sphere-exact + obb-dito14"


def dop26_in_cache(results):
    bounds = {"avx512": 16, "avx2": 7, "sse4": 4}
    lines = []
    for what, peer, wanted in (
        ("over the plain loop, -O3, not vectorised", "plain-dop26", bounds),
        ("over the library's scalar reference, -O3", "scalar", bounds),
        ("over the naive loop, -O2", "naive-dop26", {}),
    ):
        lines += by_set(results, what, INPUTS[L2], f"over-{peer}/dop26/{{}}/{L2}", wanted)
    return Target("dop26-cache", "26-DOP against plain loops", "pairs", lines)


def dop26_from_memory(results):
    row, lines = f"of-bandwidth/dop26/{{}}/{MEMORY}/threads:", []
    for wait, bounds in (("own", {"avx512": 90, "avx2": 75}), ("default", {}), ("passive", {})):
        what = f"two threads, {POOLS[wait]}"
        lines += by_set(results, what, "16 M points, memory", f"{row}2/wait:{wait}", bounds, share)
    lines += by_set(results, "one thread", "16 M points, memory", f"{row}1", {}, share)
    title = "26-DOP from memory, of the bandwidth read in the same run"
    return Target("dop26-memory", title, "pairs pairs-openmp pairs-passive", lines)


def aabb_against_pcl(results):
    lines = []
    for cloud, flag, bounds in (
        (L2, "dense", {"avx512": 6.5}),
        (L2, "non-dense", {"avx512": 30, "avx2": 18, "sse4": 5}),
        (MEMORY, "dense", {}),
        (MEMORY, "non-dense", {"avx512": 6, "avx2": 6, "sse4": 6}),
    ):
        what = f"is_dense {'true' if flag == 'dense' else 'false'}"
        lines += by_set(results, what, INPUTS[cloud], f"over-pcl-{flag}/aabb/{{}}/{cloud}", bounds)
    return Target("aabb-pcl", "AABB against pcl::getMinMax3D", "pairs", lines)


def bad_points(results):
    lines = []
    for cloud, aabb, dop26, look in (
        (L2, {"avx512": 15, "avx2": 15, "sse4": 60}, dict.fromkeys(results.sets, 6), {"avx512": 15}),
        (MEMORY, dict.fromkeys(results.sets, 3), dict.fromkeys(results.sets, 3), {}),
    ):
        for what, row, bounds in (
            ("AABB, test of every point", "over-unchecked-aabb/aabb", aabb),
            ("26-DOP, test of every point", "over-unchecked-dop26/tested-dop26", dop26),
            ("26-DOP, the exact comparison of its extremes", "over-tested-dop26/dop26", look),
        ):
            lines += by_set(results, what, INPUTS[cloud], f"{row}/{{}}/{cloud}", bounds, cost)
    return Target("bad-points", "What dropping bad points costs", "pairs", lines)


def epos26(results):
    lines = []
    for cloud in (L2, L3):
        row, bounds = f"over-scalar/sphere-epos26/{{}}/{cloud}", {"avx512": 12, "sse4": 3.5}
        lines += by_set(results, "over scalar", INPUTS[cloud], row, bounds)
    return Target("epos26", "EPOS-26 against its scalar reference", "pairs", lines)


def exact_over_epos(results):
    lines = []
    for shape in SHAPES:
        most = 3 if shape in ("golfball", "surface") else 1.3
        for n in (100722, 1000000):
            found = results.ratio(f"over-epos26/sphere-exact/{results.best}/{shape}/xyz/no-nan/n:{n}")
            if found:
                bound = most if results.best == "avx512" else None
                reached = judge(1 / found[0], "<=", bound, aside=1 / found[1])
                lines.append(Line(shape, f"{count(n)} points, one thread, {results.best}", *reached))
    return Target("exact-epos", "Smallest sphere, time over that of EPOS-26", "pairs", lines)


def exact_against_cgal(results):
    lines = []
    for peer, bound in (("cgal-min-sphere", 25), ("cgal-min-sphere-of-spheres", None)):
        for shape in SHAPES:
            row = f"over-{peer}/sphere-exact/{results.best}/{shape}/xyz/no-nan/n:1000000"
            where = f"1 M points, one thread, {results.best}"
            lines += faster(results, f"{shape}, over {peer}", where, row, bound)
    return Target("exact-cgal", "Smallest sphere against CGAL", "pairs", lines)


def clusters_against_pcl(results):
    lines = []
    for name in results.matching("over-pcl/(street|sweep)/n:.*/r:0.[25]"):
        scene, n, r = re.match(r"over-pcl/([^/]*)/n:(\d+)/r:(.*)", name).groups()
        what = "synth:street" if scene == "street" else "a recorded sweep"
        usual = scene == "sweep" or n == "42886"  # of 128 000 rays
        bound = {"0.5": 100, "0.2": 20}[r] if usual else None
        where = f"{count(int(n))} points above ground, {r} m, one thread"
        lines += faster(results, what, where, name, bound)
    return Target("clusters", "Clusters against pcl::EuclideanClusterExtraction", "clusters", lines)


def conditions_of_clusters(results):
    lines = []
    for name in results.matching("dbscan-[0-9]+/(street|sweep)/n:.*/r:0.[25]"):
        min_points, scene, n, r = re.match(r"dbscan-(\d+)/([^/]*)/n:(\d+)/r:(.*)", name).groups()
        median, of_minima = results.ratio(name)
        what = f"DBSCAN, {min_points} points, time over no condition"
        where = f"{scene}, {count(int(n))} points, {r} m, one thread"
        lines.append(Line(what, where, *judge(1 / median, "<=", 1.5, aside=1 / of_minima)))
    for name in results.matching("growing-"):
        growth, threads, n, r = re.match(r"growing-([^/]*)/threads:(\d)/sweep/n:(\d+)/r:(.*)", name).groups()
        where = f"sweep, {count(int(n))} points, {r} m, threads: {threads}"
        reached = judge(results.rows[name]["second_us"] / 1e3, "<=", 5, unit=" ms")
        lines.append(Line(f"tolerance grows by {growth} m a metre", where, *reached))
    return Target("conditions", "Clusters with core points, and with growing tolerances", "clusters", lines)


def least_box_against_cgal(results):
    lines = []
    for name in results.matching("turns/CGAL oriented_bounding_box over obb-min/"):
        cloud, where = name.split("/")[-1], f"one thread, {results.best}"
        apart = cloud.startswith("sphere")  # where no box is much smaller than others
        lines += faster(results, f"{cloud}, time", where, name, None if apart else 2)
        volume = results.rows[name]["volume_over_peer"]
        reached = judge(volume, "<=", None if apart else 1.0005, "{:.4f}".format)
        lines.append(Line(f"{cloud}, volume over CGAL's", where, *reached))
    row = results.rows.get(f"obb-min/{results.best}/gauss:1000")
    if row:
        reached = judge(row["us"][0] / 1e3, "<=", 0.3, unit=" ms")
        lines.append(Line("gauss:1000, alone", f"one thread, {results.best}", *reached))
    return Target("obb-cgal", "Smallest oriented box against CGAL::oriented_bounding_box", "obb", lines)


def many_clusters_against_pcl(results):
    lines = []
    for peer, bound in (
        ("PCL cheapest", 1.5),
        ("PCL MomentOfInertia, one axis", None),
        ("PCL MomentOfInertia", None),
    ):
        row = f"turns/100 clusters of 300, {peer} over aabb + obb-pca"
        lines += faster(results, f"over {peer}", f"one thread, {results.best}", row, bound)
    return Target("clusters-pcl", "100 clusters of 300 points, AABB and PCA box, against PCL", "obb", lines)


def many_clusters(results):
    lines = []
    for threads, bound in ((2, 0.35), (1, None)):
        row = results.rows.get(f"100 clusters of 300/{THREE}/threads:{threads}/wait:own")
        if row:
            reached = judge(row["us"][0] / 1e3, "<=", bound, unit=" ms", aside=row["us"][-1] / 1e3)
            lines.append(Line(f"threads: {threads}", f"one after another in memory, {results.best}", *reached))
        row = results.rows.get(f"batch/{THREE.replace(' ', '')}/100x300/threads:{threads}/wait:own")
        if row:
            reached = judge(row["second_us"] / 1e3, "<=", None, unit=" ms")
            lines.append(Line(f"threads: {threads}", f"index lists into a mixed cloud, {results.best}", *reached))
    title = "The same clusters: AABB, smallest sphere and obb-dito14; median (least)"
    return Target("batch", title, "obb batch", lines)


def two_threads(results):
    """The least ratio from 4 k points on, and in L3 where one thread takes at least 200 us."""
    least = {}
    for name in results.matching("threads-2/.*/gauss/"):
        work, isa, wait = name.split("/")[1], name.split("/")[2], name.split("wait:")[1]
        n = points_of(name)
        places = ["4 k to 32 M points"]
        if results.rows[name]["first_us"] >= 200 and 2**20 < 16 * n <= 2**25:
            places.append("L3, one thread takes >= 200 µs")
        for place in places:
            key = (place, wait, work, isa)
            least[key] = min(least.get(key, (9e9, 0, 0)), (*results.ratio(name), n))
    lines = []
    for (place, wait, work, isa), (ratio, aside, n) in sorted(least.items()):
        bound = (0.95 if place[0] == "4" else 1.8) if wait == "own" else None
        reached = judge(ratio, ">=", bound, aside=aside)
        lines.append(Line(f"{work} {isa}, {POOLS[wait]}", f"{place}; smallest ratio at {count(n)} points", *reached))
    return Target("threads", "Two threads against one", "pairs pairs-openmp pairs-passive", lines)


def pipeline(results):
    lines = []
    scenes = {
        "street": "synth:street-sequence",
        "street-128": "the same street, 128 beams",
        "sweeps": "recorded sweeps",
    }
    bounds = {"paced-2-thread/sweeps": (5, 7), "paced-1-thread/sweeps": (None, 10)}  # p50, p99
    for name in results.matching("pipeline/(paced-)?[12]-thread/"):
        row, (_, way, source) = results.rows[name], name.split("/")
        for quantile, bound in zip(("p50", "p99"), bounds.get(f"{way}/{source}", (None, None))):
            where = f"{count(round(row['points']))} points, {way}, {quantile} of 154 frames"
            reached = judge(row[f"total_{quantile}"], "<=", bound, unit=" ms")
            lines.append(Line(scenes[source], where, *reached))
    one, two = (results.rows.get(f"pipeline/paced-{n}-thread/sweeps") for n in (1, 2))
    if one and two:
        reached = judge(one["total_p50"] / two["total_p50"], ">=", 1.6)
        lines.append(Line("recorded sweeps", "two threads over one, paced, p50", *reached))
    title = "Filter, ground by zones, clusters, AABB, sphere, obb-yaw and 26-DOP of a sweep (paced: every 100 ms)"
    return Target("pipeline", title, "pipeline", lines)


def ground_of_sweeps(results):
    row, lines = results.rows.get("pipeline/1-thread/sweeps"), []
    if row:
        reached = judge(row["ground_p50"], "<=", 2, unit=" ms")
        lines.append(Line("recorded sweeps", "one thread, back to back, p50", *reached))
    return Target("ground", "Ground by zones", "pipeline", lines)


def least_boxes_of_sweeps(results):
    row, lines = results.rows.get("pipeline/obb-min-1-thread/sweeps"), []
    if row:
        lines.append(Line("recorded sweeps", "one thread, p50", *judge(row["fit_p50"], "<=", 30, unit=" ms")))
    return Target("obb-sweep", "Smallest oriented boxes of all clusters of a sweep", "pipeline", lines)


def binary_file(results):
    lines = []
    for threads in (1, 2):
        name, where = (
            f"files/over-pcl/binary/n:16000000/threads:{threads}",
            f"16 M points, threads: {threads}",
        )
        lines += faster(results, "over loadPCDFile and getMinMax3D", where, name, 15)
        row = results.rows.get(name)
        if row:
            most = judge(row["second_mib"], "<=", 96, unit=" MiB")
            lines.append(Line(f"resident at most (PCL: {number(row['first_mib'])} MiB)", where, *most))
    title = "pcd_bv on a binary .pcd, AABB and 26-DOP, whole process, against PCL"
    return Target("files-binary", title, "files", lines)


def ascii_file(results):
    lines = []
    for threads, bound in ((1, 8), (2, 14)):
        name = f"files/over-pcl/ascii/n:1024000/threads:{threads}"
        where = f"1 024 000 points, threads: {threads}"
        lines += faster(results, "over loadPCDFile and getMinMax3D", where, name, bound)
    return Target("files-ascii", "pcd_bv on an ASCII .pcd, whole process, against PCL", "files", lines)


def masks(results):
    lines = []
    for scene, what in (("sweep", "a sweep, a ninth of it on the robot"), ("links", "all about the robot")):
        name = f"mask/{scene}/{results.best}/n:300032/threads:2/wait:own"
        row, where = results.rows.get(name), f"{what}; threads: 2, {results.best}"
        if row:
            lines.append(Line("least time", where, *judge(row["second_us"] / 1e3, "<=", 1, unit=" ms")))
        lines += faster(results, "over a loop over contains()", where, name)
    return Target("mask", "Mask of 300 k points against ten padded volumes", "mask", lines)


def recordings(results):
    lines = []
    for compression, bound in (("none", 0.8), ("lz4", None), ("zstd", None)):
        row = results.rows.get(f"over-pread/{compression}")
        if row:
            what = f"messages of an MCAP file, {compression}, over plain pread"
            lines.append(Line(what, "100 clouds of 130 k points", *judge(row["ratio"], ">=", bound)))
    row = results.rows.get("cloud-in-place/n:130000")
    if row:
        reached = judge(row["second_us"] / 1e3, "<=", 0.3, unit=" ms")
        lines.append(Line("a PointCloud2 to a view", "130 k points", *reached))
    return Target("recordings", "Recordings from the page cache", "recordings", lines)


def live_topics(results):
    lines = []
    row = results.rows.get("dds/clouds-to-markers")
    if row:
        where = f"{row['sent']} clouds of 2 MB, 20 a second, loopback, threads: 2"
        lines.append(Line("clouds processed", where, *judge(row["answered"], ">=", 600)))
        lines.append(Line("cloud to markers, p50", where, *judge(row["p50_ms"], "<=", None, unit=" ms")))
        lines.append(Line("cloud to markers, p99", where, *judge(row["p99_ms"], "<=", 15, unit=" ms")))
    return Target("dds", "bv_stream between ROS 2's topics", "dds", lines)


def nodelet(results):
    lines = []
    for volume, threads in (("aabb", 1), ("aabb", 2), ("obb-lshape", 1), ("obb-lshape", 2)):
        row = results.rows.get(f"ros1/over-pcl_ros/{volume}/threads:{threads}")
        if row:
            where = f"{count(round(row['points']))} points, with {volume}, threads: {threads}"
            bound = 50 if (volume, threads) != ("obb-lshape", 1) else None
            lines.append(Line("cloud to the first message", where, *judge(row["ratio"], ">=", bound)))
    title = "Nodelet against pcl_ros' EuclideanClusterExtraction, which fits no volumes"
    return Target("nodelet", title, "ros1", lines)


def all_targets(results):
    return [
        target(results)
        for target in (
            *(dop26_in_cache, dop26_from_memory, aabb_against_pcl, bad_points),
            *(epos26, exact_over_epos, exact_against_cgal),
            *(clusters_against_pcl, conditions_of_clusters),
            *(least_box_against_cgal, many_clusters_against_pcl, many_clusters),
            *(two_threads, masks, tree_tables.target, pipeline, ground_of_sweeps, least_boxes_of_sweeps),
            *(binary_file, ascii_file, recordings, live_topics, nodelet),
        )
    ]
