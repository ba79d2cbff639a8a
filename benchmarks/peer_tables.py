# SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
# SPDX-License-Identifier: BSD-3-Clause
"""Tables in Markdown that hold our fits against other libraries' or against themselves, many in turns."""
from results import LEVELS, count, number, percent, points_of, table


def outside(row):
    return f"{row['outside']:.0f}" if row and "outside" in row else None


def box_peers(results):
    """Mpt/s in each level of memory, and the points left outside in the last."""
    lines = []
    for work in ("aabb", "dop26"):
        lines.append(
            [f"{work} {results.best}"]
            + [number(results.speed(f"{work}/{results.best}/gauss/xyz/no-nan/n:{n}")) for n in LEVELS]
            + ["0"]
        )
    rows = results.matching("(?!cgal-min)[^/]*/peer/gauss/[^/]*/no-nan")
    seen = dict.fromkeys(tuple(n.split("/")[i] for i in (0, 3)) for n in rows)
    for peer, layout in seen:
        names = [f"{peer}/peer/gauss/{layout}/no-nan/n:{n}" for n in LEVELS]
        lines.append(
            [peer] + [number(results.speed(n)) for n in names] + [outside(results.rows.get(names[-1]))]
        )
    return table(
        ["Mpt/s, one thread"]
        + [f"{level}, {count(n)}" for n, level in LEVELS.items()]
        + [f"outside of {count(16000000)}"],
        lines,
    )


def sphere_peers(results):
    lines = []
    for shape in ("gauss", "cube", "ball", "car", "golfball", "surface"):
        for n in (300, 100722, 1000000):
            cloud = f"{shape}/xyz/no-nan/n:{n}"
            line = [shape, count(n), number(results.ms(f"sphere-exact/{results.best}/{cloud}"))]
            for peer in ("cgal-min-sphere", "cgal-min-sphere-of-spheres"):
                line += [
                    number(results.ms(f"{peer}/peer/{cloud}")),
                    outside(results.rows.get(f"{peer}/peer/{cloud}")),
                ]
            lines.append(line)
    return table(
        [
            "points of",
            "points",
            f"smallest sphere {results.best}, ms (0 outside)",
            "Min_sphere_d, ms",
            "outside",
            "Min_sphere_of_spheres_d, ms",
            "outside",
        ],
        lines,
    )


def radii_of_shapes(results):
    methods = ("sphere-ritter", "sphere-epos6", "sphere-epos14", "sphere-epos26", "sphere-epos98")
    lines = []
    for shape in ("gauss", "cube", "ball", "car", "golfball", "surface"):
        for n in (300, 100722, 1000000):
            rows = [results.rows.get(f"{m}/{results.best}/{shape}/xyz/no-nan/n:{n}") for m in methods]
            lines.append(
                [f"{shape} ({count(n)})"] + [r and percent(100 * (r["over_optimum"] - 1), 3) for r in rows]
            )
    return table(["radius over the smallest", "Ritter", "EPOS-6", "EPOS-14", "EPOS-26", "EPOS-98"], lines)


def ways_to_grow(results):
    lines = []
    for name in results.matching(r"[^/]*\+[^/]*/1-thread/"):
        both = [results.rows[name], results.rows[name.replace("1-thread", "2-threads")]]
        lines.append(
            [name.split("/")[0].replace("+", ", "), count(points_of(name))]
            + [number(points_of(name) / r["us"][0]) for r in both]
            + [percent(100 * (both[0]["over_optimum"] - 1), 3)]
        )
    return table(["points in a ball", "points", "Mpt/s, one thread", "two", "over the smallest"], lines)


def in_turns(results, pattern, sides, name_of=lambda n: n, peer=True):
    """Both times in ms (minima), the ratio, and the points outside a peer's box."""
    lines = []
    for name in results.matching(pattern):
        row = results.rows[name]
        ratio, of_minima = results.ratio(name)
        lines.append(
            [
                name_of(name),
                number(row["first_us"] / 1e3),
                number(row["second_us"] / 1e3),
                f"{number(ratio)} ({number(of_minima)})",
            ]
            + ([outside(row)] if peer else [])
        )
    return table(
        ["alternately", *sides, "ratio: median of pairs (of minima)"] + (["outside"] if peer else []), lines
    )


def cluster_peers(results):
    def say(name):
        peer, scene, n, r = name.removeprefix("over-").split("/")
        return f"{peer}: {scene}, {count(points_of(n))} points, {r[2:]} m"

    return in_turns(results, "over-(pcl|nanoflann)/", ("peer, ms", "pcl_bv, ms"), say, False)


def cluster_threads(results):
    return in_turns(
        results,
        "threads-2/(street|sheets|sparse)",
        ("one thread, ms", "two, ms"),
        lambda n: n.removeprefix("threads-2/"),
        False,
    )


def ground(results):
    lines = [
        [n, number(results.ms(n)), f"{results.rows[n]['precision']:.4f}", f"{results.rows[n]['recall']:.4f}"]
        for n in results.matching("ground/")
    ]
    return table(["synth:street, one thread", "ms", "precision", "recall"], lines)


def oriented(results):
    """ms and volume over the smallest known, by method and cloud."""
    clouds = dict.fromkeys(n.split("/")[2] for n in results.matching("obb-min/"))
    methods = ("obb-pca", "obb-dito14", "obb-yaw", "obb-lshape", "obb-min")
    lines = []
    for cloud in clouds:
        rows = [results.rows[f"{m}/{results.best}/{cloud}"] for m in methods]
        lines.append([cloud] + [f"{number(r['us'][0] / 1e3)} ({r['over_least']:.3f})" for r in rows])
    return table(["ms (volume over the smallest known)", *methods], lines)


def oriented_peers(results):
    return in_turns(results, "turns/", ("peer, ms", "pcl_bv, ms"), lambda n: n.removeprefix("turns/"))


def hulls(results):
    """ms; of what is fitted to the hull also the volume over the hull's."""
    lines = []
    for name in results.matching(f"hull/{results.best}/"):
        cloud = name.split("/", 2)[2]
        line = [
            f"{cloud.split('/')[0]} ({count(points_of(cloud))})",
            number(results.ms(f"hull/scalar/{cloud}")),
            number(results.ms(name)),
        ]
        line += [
            number(results.ms(f"{peer}/peer/{cloud}")) for peer in ("pcl::ConvexHull", "qhull-of-all-points")
        ]
        line.append(outside(results.rows.get(f"pcl::ConvexHull/peer/{cloud}")))
        for work in ("cylinder", "capsule", "ellipsoid", "best"):
            row = results.rows.get(f"{work}/{results.best}/{cloud}")
            line.append(row and f"{number(row['us'][0] / 1e3)} ({row['over_hull']:.2f})")
        lines.append(line)
    return table(
        [
            "ms (volume over the hull's)",
            "hull scalar",
            f"hull {results.best}",
            "pcl::ConvexHull",
            "Qhull on all points",
            "outside PCL's",
            "cylinder",
            "capsule",
            "ellipsoid",
            "best",
        ],
        lines,
    )


def batches(results):
    return in_turns(
        results, "batch/", ("one by one, ms", "at once, ms"), lambda n: n.removeprefix("batch/"), False
    )


def files(results):
    """Whole processes in turns: ms, and the most memory that each had resident."""
    lines = []
    for name in results.matching("files/over-(pcl|laszip)/"):
        row = results.rows[name]
        ratio, of_minima = results.ratio(name)
        lines.append(
            [
                name.removeprefix("files/over-").removeprefix("pcl/"),
                number(row["first_us"] / 1e3),
                number(row["second_us"] / 1e3),
            ]
            + [f"{number(ratio)} ({number(of_minima)})", number(row["first_mib"]), number(row["second_mib"])]
        )
    head = [
        "alternately",
        "PCL or LASzip, ms",
        "pcd_bv, ms",
        "ratio: median of pairs (of minima)",
        "PCL or LASzip, MiB",
        "pcd_bv, MiB",
    ]
    return table(head, lines)
