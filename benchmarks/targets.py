# SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
# SPDX-License-Identifier: BSD-3-Clause
"""What the project set out to reach: works, inputs and bounds."""
import re

from judging import Line, Target, by_set, cost, faster, judge, share
from results import count, points_of

L2, MEMORY = "gauss/xyz/no-nan/n:32768", "gauss/xyz/no-nan/n:16000000"
SHAPES = ("gauss", "cube", "ball", "car", "golfball", "surface")
THREE = "aabb + sphere-exact + obb-dito14"
INPUTS = {
    L2: "32 768 points, L2",
    MEMORY: "16 M points, memory",
    "paper/xyz/no-nan/n:100722": "100 722 points, L3",
}


def boxes(results):
    one = "one thread"
    yield Target(
        "dop26-cache",
        "26-DOP against plain loops",
        "pairs",
        (
            by_set(
                results,
                "over the plain loop, -O3, not vectorised",
                f"32 768 points, L2, {one}",
                "over-plain-dop26/dop26/{}/" + L2,
                {"avx512": 16, "avx2": 7, "sse4": 4},
            )
            + by_set(
                results,
                "over the library's scalar reference, -O3",
                f"32 768 points, L2, {one}",
                "over-scalar/dop26/{}/" + L2,
                {"avx512": 16, "avx2": 7, "sse4": 4},
            )
            + by_set(
                results,
                "over the naive loop, -O2",
                f"32 768 points, L2, {one}",
                "over-naive-dop26/dop26/{}/" + L2,
                {},
            )
        ),
    )
    yield Target(
        "dop26-memory",
        "26-DOP from memory, of the bandwidth read in the same run",
        "pairs pairs-passive",
        [
            line
            for wait in ("default", "passive")
            for line in by_set(
                results,
                f"two threads, {wait} waiting",
                "16 M points, memory",
                "of-bandwidth/dop26/{}/" + MEMORY + "/threads:2/wait:" + wait,
                {"avx512": 90, "avx2": 75} if wait == "default" else {},
                share,
            )
        ]
        + by_set(
            results, one, "16 M points, memory", "of-bandwidth/dop26/{}/" + MEMORY + "/threads:1", {}, share
        ),
    )
    yield Target(
        "aabb-pcl",
        "AABB against pcl::getMinMax3D",
        "pairs",
        [
            line
            for cloud, flag, bounds in (
                (L2, "dense", {"avx512": 6.5}),
                (L2, "non-dense", {"avx512": 30, "avx2": 18, "sse4": 5}),
                (MEMORY, "dense", {}),
                (MEMORY, "non-dense", {"avx512": 6, "avx2": 6, "sse4": 6}),
            )
            for line in by_set(
                results,
                f"is_dense {'true' if flag == 'dense' else 'false'}",
                f"{INPUTS[cloud]}, {one}",
                f"over-pcl-{flag}/aabb/{{}}/{cloud}",
                bounds,
            )
        ],
    )
    yield Target(
        "bad-points",
        "What dropping bad points costs",
        "pairs",
        [
            line
            for cloud, aabb, dop in (
                (L2, {"avx512": 15, "avx2": 15, "sse4": 60}, 6),
                (MEMORY, dict.fromkeys(results.sets, 3), 3),
            )
            for work, name, bounds in (
                ("AABB, test of every point", "over-unchecked-aabb/aabb", aabb),
                (
                    "26-DOP, test of every point",
                    "over-unchecked-dop26/tested-dop26",
                    dict.fromkeys(results.sets, dop),
                ),
                ("26-DOP, the exact look at its extremes", "over-tested-dop26/dop26", {}),
            )
            for line in by_set(results, work, f"{INPUTS[cloud]}, {one}", f"{name}/{{}}/{cloud}", bounds, cost)
        ],
    )


def spheres(results):
    one = "one thread"
    yield Target(
        "epos26",
        "EPOS-26 against its scalar reference",
        "pairs",
        [
            line
            for cloud in (L2, "paper/xyz/no-nan/n:100722")
            for line in by_set(
                results,
                "over scalar",
                f"{INPUTS[cloud]}, {one}",
                f"over-scalar/sphere-epos26/{{}}/{cloud}",
                {"avx512": 12, "sse4": 3.5},
            )
        ],
    )
    lines = []
    for shape in SHAPES:
        for n in (100722, 1000000):
            row = results.ratio(f"over-epos26/sphere-exact/{results.best}/{shape}/xyz/no-nan/n:{n}")
            most = (3 if shape in ("golfball", "surface") else 1.3) if results.best == "avx512" else None
            if row:
                lines.append(
                    Line(
                        shape,
                        f"{count(n)} points, {one}, {results.best}",
                        *judge(1 / row[0], "<=", most, aside=1 / row[1]),
                    )
                )
    yield Target("exact-epos", "Smallest sphere, time over that of EPOS-26", "pairs", lines)
    yield Target(
        "exact-cgal",
        "Smallest sphere against CGAL",
        "pairs",
        [
            line
            for peer, bound in (("cgal-min-sphere", 25), ("cgal-min-sphere-of-spheres", None))
            for shape in SHAPES
            for line in faster(
                results,
                f"{shape}, over {peer}",
                f"1 M points, {one}, {results.best}",
                f"over-{peer}/sphere-exact/{results.best}/{shape}/xyz/no-nan/n:1000000",
                bound,
            )
        ],
    )


def clusters(results):
    lines = []
    for name in results.matching("over-pcl/(street|sweep)/"):
        scene, n, r = re.match(r"over-pcl/([^/]*)/n:(\d+)/r:(.*)", name).groups()
        bound = {"0.5": 100, "0.2": 20}.get(r)
        if bound:
            usual = scene == "sweep" or n == "42886"  # of 128 000 rays
            lines += faster(
                results,
                "synth:street" if scene == "street" else "a recorded sweep",
                f"{count(int(n))} points above ground, {r} m, one thread",
                name,
                bound if usual else None,
            )
    yield Target("clusters", "Clusters against pcl::EuclideanClusterExtraction", "clusters", lines)
    lines = []
    for name in results.matching("turns/CGAL oriented_bounding_box over obb-min/"):
        cloud = name.split("/")[-1]
        lines += faster(
            results,
            f"{cloud}, time",
            "one thread, " + results.best,
            name,
            None if cloud.startswith("sphere") else 2,
        )
        lines.append(
            Line(
                f"{cloud}, volume over CGAL's",
                "one thread, " + results.best,
                *judge(
                    results.rows[name]["volume_over_peer"],
                    "<=",
                    None if cloud.startswith("sphere") else 1.0005,
                    "{:.4f}".format,
                ),
            )
        )
    yield Target("obb-cgal", "Least oriented box against CGAL::oriented_bounding_box", "obb", lines)
    yield Target(
        "clusters-pcl",
        "100 clusters of 300 points, AABB and PCA box, against PCL",
        "obb",
        [
            line
            for peer, bound in (
                ("PCL cheapest", 3),
                ("PCL MomentOfInertia, one axis", None),
                ("PCL MomentOfInertia", None),
            )
            for line in faster(
                results,
                f"over {peer}",
                "one thread, " + results.best,
                f"turns/100 clusters of 300, {peer} over aabb + obb-pca",
                bound,
            )
        ],
    )
    lines = []
    for wait in ("default", "passive"):
        for threads in (2, 1):
            bound = 0.5 if threads == 2 else None
            row = results.rows.get(f"100 clusters of 300/{THREE}/threads:{threads}/wait:{wait}")
            if row:
                where = f"one after another in memory, {results.best}"
                reached = judge(row["us"][0] / 1e3, "<=", bound, unit=" ms", aside=row["us"][-1] / 1e3)
                lines.append(Line(f"threads: {threads}, {wait} waiting", where, *reached))
            row = results.rows.get(f"batch/{THREE.replace(' ', '')}/100x300/threads:{threads}/wait:{wait}")
            if row:
                where = f"index lists into a mixed cloud, {results.best}"
                reached = judge(row["second_us"] / 1e3, "<=", None, unit=" ms")
                lines.append(Line(f"threads: {threads}, {wait} waiting", where, *reached))
    title = "The same clusters: AABB, smallest sphere and obb-dito14; median (least)"
    yield Target("batch", title, "obb obb-passive batch batch-passive", lines)


def threads(results):
    """The least ratio from 4 k points on, and in L3 where one thread takes at least 200 us."""
    least = {}
    for name in results.matching("threads-2/.*/gauss/"):
        work, isa, wait = name.split("/")[1], name.split("/")[2], name.split("wait:")[1]
        n = points_of(name)
        places = ["4 k to 32 M points"]
        if results.rows[name]["first_us"] >= 200 and 2**20 < 16 * n <= 2**25:
            places.append("L3, one thread takes >= 200 us")
        for place in places:
            key = (place, wait, work, isa)
            least[key] = min(least.get(key, (9e9, 0, 0)), (*results.ratio(name), n))
    lines = [
        Line(
            f"{work} {isa}, {wait} waiting",
            f"{place}; least at {count(n)} points",
            *judge(ratio, ">=", 0.95 if place[0] == "4" else 1.8, aside=aside),
        )
        for (place, wait, work, isa), (ratio, aside, n) in sorted(least.items())
    ]
    yield Target("threads", "Two threads against one", "pairs pairs-passive", lines)


def programs(results):
    lines = []
    for name in results.matching("pipeline/[12]-thread/"):
        row = results.rows[name]
        lines.append(
            Line(
                {"street": "synth:street-sequence", "sweeps": "recorded sweeps"}[name.split("/")[2]],
                f"{count(round(row['points']))} points, {name.split('/')[1]}, p99 of 127 frames",
                *judge(row["total_p99"], "<=", 12 if "/2-" in name else None, unit=" ms"),
            )
        )
    yield Target(
        "pipeline",
        "Filter, ground by zones, clusters, AABB, sphere, obb-yaw and 26-DOP of a 64-beam sweep",
        "pipeline",
        lines,
    )
    yield Target(
        "files-binary",
        "pcd_bv on a 16 M-point binary .pcd against loadPCDFile and getMinMax3D",
        "files",
        file_lines(results, "binary"),
    )
    yield Target("files-ascii", "ASCII .pcd against loadPCDFile", "files", file_lines(results, "ascii"))


def file_lines(results, kind):
    return []


def all_targets(results):
    return [t for part in (boxes, spheres, clusters, threads, programs) for t in part(results)]
