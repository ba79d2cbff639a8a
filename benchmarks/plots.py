# SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
# SPDX-License-Identifier: BSD-3-Clause
"""The figures as SVG: name to text."""
import math

import tree_tables
from paper_tables import METHODS, point_sets
from results import POOLS, points_of
from svg import BOTTOM, COLOURS, HEIGHT, SERIES, Chart

SIZES = [
    (1 << 10, "1 k"),
    (1 << 12, "4 k"),
    (1 << 14, "16 k"),
    (1 << 16, "64 k"),
    (1 << 18, "256 k"),
    (1 << 20, "1 M"),
    (1 << 22, "4 M"),
    (1 << 24, "16 M"),
    (1 << 25, ""),
]


def curve(results, prefix):
    """Mpt/s by points of the powers of two."""
    names = [
        n for n in results.matching(f"{prefix}/gauss/xyz/no-nan/") if points_of(n) & (points_of(n) - 1) == 0
    ]
    return sorted((points_of(n), 1e3 * results.bandwidth(n) / 16) for n in names)


def speed_chart(title, curves, roofs):
    values = [v for _, points, *_ in curves + roofs for _, v in points]
    if not any(points for _, points, *_ in curves) or not values:
        return None
    low, high = 10 ** math.floor(math.log10(min(values))), 1.2 * max(values)
    chart = Chart(
        title,
        "pcl::PointXYZ (16 bytes each)",
        "million points a second",
        (SIZES[0][0], SIZES[-1][0]),
        (low, high),
    )
    chart.x_ticks(SIZES)
    chart.y_ticks([m * 10**e for e in range(0, 6) for m in (1, 2, 5) if low <= m * 10**e <= high])
    for text, points, colour in curves:
        chart.line(points, colour, text)
    for text, points, colour in roofs:
        chart.line(points, colour, text, dashed=True)
    return chart.text()


def speeds(results):
    """A chart of each kernel by instruction set, one of all on the best set; the limit: reading alone."""
    roof = [("read only, one core", curve(results, "read-1-thread/best"), "#000")]
    both = roof + [("read only, two cores", curve(results, "read-2-thread/best"), "#888")]
    titles = {"aabb": "AABB", "dop26": "26-DOP"}
    for work, title in titles.items():
        curves = [(s, curve(results, f"{work}/{s}"), COLOURS[s]) for s in results.sets]
        yield f"speed-{work}.svg", speed_chart(f"{title} on one core, by instruction set", curves, roof)
    works = [
        ("AABB", "aabb"),
        ("14-DOP", "dop14"),
        ("26-DOP", "dop26"),
        ("EPOS-26 sphere", "sphere-epos26"),
        ("smallest sphere", "sphere-exact"),
    ]
    curves = [
        (title, curve(results, f"{work}/{results.best}"), SERIES[i]) for i, (title, work) in enumerate(works)
    ]
    yield "speed-all.svg", speed_chart(f"One core, {results.best}", curves, both)


def speed_up(results):
    works = [
        ("AABB", "aabb"),
        ("14-DOP", "dop14"),
        ("26-DOP", "dop26"),
        ("EPOS-26", "sphere-epos26"),
        ("EPOS-98", "sphere-epos98"),
        ("smallest sphere", "sphere-exact"),
    ]
    cloud = "paper/xyz/no-nan/n:100722"
    sets = results.sets[1:]
    ratios = {
        (w, s): results.us(f"{w}/scalar/{cloud}") / results.us(f"{w}/{s}/{cloud}")
        for _, w in works
        for s in sets
        if results.us(f"{w}/{s}/{cloud}")
    }
    if not ratios:
        return None
    top = 1.1 * max(ratios.values())
    chart = Chart(
        "Over the scalar reference of the same fit, 100 722 points, one core",
        "",
        "times as fast",
        (0, len(works)),
        (0, top),
        False,
        False,
    )
    chart.y_ticks(range(0, int(top) + 1, 4))
    chart.parts += [
        f'<text x="{chart.x(i + 0.5):.1f}" y="{HEIGHT - BOTTOM + 17}" text-anchor="middle">{title}</text>'
        for i, (title, _) in enumerate(works)
    ]
    width = 0.8 / len(sets)
    for i, (_, work) in enumerate(works):
        for k, s in enumerate(sets):
            if (work, s) in ratios:
                chart.bar(i + 0.1 + k * width, i + 0.1 + (k + 0.9) * width, ratios[work, s], COLOURS[s])
    for s in sets:
        chart.name(s, COLOURS[s])
    return chart.text()


def radii(results):
    """A dot for each point set of the paper's tables and each method."""
    least, most = 1e-4, 20
    chart = Chart(
        "Radius over the smallest one, for each point set",
        "",
        "percent above (at least 0.0001 drawn)",
        (0, len(METHODS)),
        (least, most),
        False,
        True,
    )
    chart.y_ticks([1e-4, 1e-3, 1e-2, 0.1, 1, 10])
    drawn = False
    for i, (title, work) in enumerate(METHODS):
        chart.parts.append(
            f'<text x="{chart.x(i + 0.5):.1f}" y="{HEIGHT - BOTTOM + 17}" text-anchor="middle">{title}</text>'
        )
        clouds = point_sets(results)
        for k, cloud in enumerate(clouds):
            row = results.rows.get(f"{work}/{results.best}/{cloud}")
            if row and "over_optimum" in row:
                over = min(max(100 * (row["over_optimum"] - 1), least), most)
                stand_in = cloud.startswith("paper")
                chart.dot(i + 0.2 + 0.6 * k / len(clouds), over, SERIES[1] if stand_in else SERIES[0])
                drawn = True
    chart.name("stand-ins", SERIES[1])
    chart.name("real meshes", SERIES[0])
    return chart.text() if drawn else None


def threads(results):
    """One thread's time over two threads' by size."""
    curves = []
    for work, s in (
        ("aabb", results.best),
        ("dop26", results.best),
        ("dop26", results.sets[min(1, len(results.sets) - 1)]),
    ):
        for wait in ("own", "passive"):
            names = results.matching(f"threads-2/{work}/{s}/gauss/.*/wait:{wait}$")
            points = sorted((points_of(n), results.ratio(n)[0]) for n in names)
            curves.append((f"{work} {s}, {POOLS[wait]}", points, SERIES[len(curves)]))
    if not any(points for _, points, _ in curves):
        return None
    top = max(2.2, 1.05 * max(v for _, points, _ in curves for _, v in points))
    chart = Chart(
        "Two threads against one, median of 30 pairs in turns",
        "points",
        "times as fast",
        (4096, SIZES[-1][0]),
        (0, top),
        True,
        False,
    )
    chart.x_ticks([t for t in SIZES if t[0] >= 4096])
    chart.y_ticks([0, 0.5, 1, 1.5, 2])
    for text, points, colour in curves:
        chart.line(points, colour, text)
    return chart.text()


def all_plots(results):
    plots = dict(speeds(results)) | dict(tree_tables.plots(results))
    plots.update(
        {"speed-up.svg": speed_up(results), "radii.svg": radii(results), "threads.svg": threads(results)}
    )
    return {name: text for name, text in plots.items() if text}
