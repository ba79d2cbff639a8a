# SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
# SPDX-License-Identifier: BSD-3-Clause
"""Trees over points: tables, target and figures of the rows of bench_trees."""
import re

from judging import Line, Target, faster, judge
from results import count, number, points_of, table
from svg import SERIES, Chart


def _split(name):
    """Peer, question, scene and points of a row tree/over-PEER/..."""
    _, peer, what, _, scene, *_ = name.split("/")
    return peer.removeprefix("over-"), what, scene


def tree_builds(results):
    """ms of building, and of a whole sweep: built, then asked for each point of the next."""
    lines = []
    clouds = f"{results.best}/(street|sweep|gauss/n:100000/)"
    for name in results.matching(f"tree/over-[^/]*/(build|sweep-[a-z]*)/{clouds}"):
        row, (peer, what, scene) = results.rows[name], _split(name)
        ratio, of_minima = results.ratio(name)
        lines.append(
            [f"{peer}: {what}, {scene}, {count(round(row['points']))} points"]
            + [number(row[side] / 1e3) for side in ("first_us", "second_us")]
            + [f"{number(ratio)} ({number(of_minima)})"]
        )
    return table(["alternately, one thread", "peer, ms", "pcl_bv, ms", "ratio: median of pairs (of minima)"], lines)


def tree_questions(results):
    """ns a question, and how many of a peer's answers rounding to float does not explain."""
    lines = []
    clouds = f"{results.best}/(street|gauss/n:100000/)"
    for name in results.matching(f"tree/over-[^/]*/[a-z0-9-]*/{clouds}"):
        row, (peer, what, scene) = results.rows[name], _split(name)
        if "wrong" not in row:
            continue
        ratio, of_minima = results.ratio(name)
        lines.append(
            [f"{peer}: {what}, {scene}, {count(points_of(name))} points"]
            + [number(1e3 * row[side] / row["questions"]) for side in ("first_us", "second_us")]
            + [f"{number(ratio)} ({number(of_minima)})", f"{row['wrong']} of {row['questions']}"]
        )
    head = ["alternately, one thread", "peer, ns", "pcl_bv, ns", "ratio: median of pairs (of minima)", "peer's wrong"]
    return table(head, lines)


def tree_spheres(results):
    """ns of a yes-or-no sphere by its radius: the mean of random centres (in brackets the median of each alone)."""
    lines, parts = [], []
    for name in results.matching("tree/sphere/"):
        _, _, isa, scene, n, part, _ = name.split("/")
        line = f"{scene}, {count(int(n[2:]))} points, {isa}"
        if not lines or lines[-1][0] != line:
            lines.append([line])
        row = results.rows[name]
        lines[-1].append(f"{number(row['mean_ns'])} ({number(row['median_ns'])})")
        parts = parts if part in parts else parts + [part]
    return table(["radius, in parts of the longest side"] + [part[2:] for part in parts], lines)


def tree_volumes(results):
    """ns a question to volumes, one by one and by their tree; us of a robot's posture."""
    lines = []
    for name in results.matching("volumes/over-loop/"):
        row, (_, _, what, n, _) = results.rows[name], name.split("/")
        ratio, of_minima = results.ratio(name)
        lines.append(
            [f"{what}, {count(int(n[2:]))} volumes"]
            + [number(1e3 * row[side] / row["questions"]) for side in ("first_us", "second_us")]
            + [f"{number(ratio)} ({number(of_minima)})"]
        )
    for name in results.matching(f"volumes/links/{results.best}/"):
        row = results.rows[name]
        ours = number(1e3 * row["us"][0] / row["questions"])
        lines.append(["a posture of ten links: which are within 5 cm of a sweep's points", "", ours, ""])
    return table(["one thread", "one by one, ns", "pcl_bv, ns", "ratio: median of pairs (of minima)"], lines)


def target(results):
    """Built, asked and beside FLANN; ns: the median of centres that are asked alone, in brackets the mean of all."""
    best, lines, spheres = results.best, [], {}
    for name in results.matching(f"tree/build/{best}/"):
        row, scene, threads = results.rows[name], name.split("/")[3], re.search(r"threads:(\d+)", name).group(1)
        bound = 25 if threads == "1" and points_of(name) in (0, 100000, 128000) else None
        where = f"{scene}, {count(round(row['points']))} points, threads: {threads}, {best}"
        reached = judge(row["points"] / row["us"][0], ">=", bound, unit=" Mpt/s")
        lines.append(Line("build", where, *reached))
    for name in results.matching(f"tree/sphere/{best}/"):
        spheres.setdefault(name.split("/")[3], []).append(name)
    for scene, names in spheres.items():
        name = max(names, key=lambda n: results.rows[n]["median_ns"])
        row, part = results.rows[name], re.search("r:([0-9.]+)", name).group(1)
        where = f"{scene}, {count(points_of(name))} points, one thread, {best}; radius {part} of the side"
        reached = judge(row["median_ns"], "<=", 50, unit=" ns", aside=row["mean_ns"])
        lines.append(Line(f"yes-or-no sphere, slowest of {len(names)} radii", where, *reached))
    for name in results.matching(f"tree/over-flann/sweep-[a-z]*/{best}/"):
        what, scene = name.split("/")[2].removeprefix("sweep-"), name.split("/")[4]
        where = f"{scene}, {count(round(results.rows[name]['questions']))} queries, one thread, {best}"
        lines += faster(results, f"built and queried ({what}), over FLANN", where, name, 3)
    for name in results.matching("tree/wrong/"):
        row = results.rows[name]
        where = f"{count(round(row['questions']))} random queries, {name.split('/')[2]}"
        lines.append(Line("wrong answers", where, *judge(row["wrong"], "<=", 0)))
    return Target("trees", "Trees over points; ns: median (mean)", "trees", lines)


def plots(results):
    """What building and asking cost by size, beside others, in the rows that ran in turns."""
    sizes = [(10**e, text) for e, text in ((3, "1 k"), (4, "10 k"), (5, "100 k"), (6, "1 M"), (7, "10 M"))]

    def curve(peer, what, side):
        """ns a point or a question."""
        rows = {n: results.rows[n] for n in results.matching(f"tree/over-{peer}/{what}/{results.best}/gauss/")}
        per = "points" if what == "build" else "questions"
        return sorted((points_of(n), 1e3 * row[side] / row[per]) for n, row in rows.items())

    for what, title in (
        ("build", "Building, ns a point"),
        ("nearest", "The nearest point, ns a question"),
        ("any", "Is any point in a sphere? ns a question"),
    ):
        curves = [("PointTree", curve("flann", what, "second_us"))]
        curves += [(p, curve(p, what, "first_us")) for p in ("flann", "nanoflann", "pcl-octree", "fcl-octree")]
        values = [v for _, points in curves for _, v in points]
        if not values:
            continue
        low, high = 0.8 * min(values), 1.2 * max(values)
        title = f"{title}, one core, {results.best}"
        chart = Chart(title, "points of a Gauss cloud", "ns", (1000, 10**7), (low, high))
        chart.x_ticks(sizes)
        chart.y_ticks([m * 10**e for e in range(0, 7) for m in (1, 2, 5) if low <= m * 10**e <= high])
        for (text, points), colour in zip(curves, SERIES):
            chart.line(points, colour, text)
        yield f"tree-{what}.svg", chart.text()
