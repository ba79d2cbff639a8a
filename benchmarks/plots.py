# SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
# SPDX-License-Identifier: BSD-3-Clause
"""The figures as SVG, written by hand: name to text."""
import math

from paper_tables import METHODS, point_sets
from results import POOLS, points_of

WIDTH, HEIGHT = 760, 420
LEFT, RIGHT, TOP, BOTTOM = 70, 200, 40, 50
COLOURS = {
    "scalar": "#7f7f7f",
    "sse4": "#1f77b4",
    "avx2": "#2ca02c",
    "avx512": "#d62728",
    "neon": "#1f77b4",
    "sve": "#2ca02c",
    "sve2": "#d62728",
}
SERIES = ["#d62728", "#1f77b4", "#2ca02c", "#9467bd", "#ff7f0e", "#8c564b", "#e377c2", "#17becf"]


class Chart:
    """Axes, logarithmic or not, and what is drawn into them."""

    def __init__(self, title, x_title, y_title, x, y, x_log=True, y_log=True):
        self.x_range, self.y_range, self.x_log, self.y_log = x, y, x_log, y_log
        self.legend = 0
        self.parts = [
            f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {HEIGHT}" '
            'font-family="sans-serif" font-size="12">',
            f'<rect width="{WIDTH}" height="{HEIGHT}" fill="white"/>',
            f'<text x="{LEFT}" y="22" font-size="15">{title}</text>',
            f'<text x="{(LEFT + WIDTH - RIGHT) / 2:.0f}" y="{HEIGHT - 10}" text-anchor="middle">'
            f"{x_title}</text>",
            f'<text x="16" y="{(TOP + HEIGHT - BOTTOM) / 2:.0f}" text-anchor="middle" '
            f'transform="rotate(-90 16 {(TOP + HEIGHT - BOTTOM) / 2:.0f})">{y_title}</text>',
        ]

    @staticmethod
    def _part(value, low_high, log):
        low, high = low_high
        if log:
            return math.log(value / low) / math.log(high / low)
        return (value - low) / (high - low)

    def x(self, value):
        return LEFT + self._part(value, self.x_range, self.x_log) * (WIDTH - LEFT - RIGHT)

    def y(self, value):
        return HEIGHT - BOTTOM - self._part(value, self.y_range, self.y_log) * (HEIGHT - TOP - BOTTOM)

    def x_ticks(self, ticks):
        for value, text in ticks:
            x = self.x(value)
            self.parts += [
                f'<path d="M{x:.1f} {TOP}V{HEIGHT - BOTTOM}" stroke="#ddd"/>',
                f'<text x="{x:.1f}" y="{HEIGHT - BOTTOM + 17}" text-anchor="middle">{text}</text>',
            ]

    def y_ticks(self, ticks):
        for value in ticks:
            y = self.y(value)
            self.parts += [
                f'<path d="M{LEFT} {y:.1f}H{WIDTH - RIGHT}" stroke="#ddd"/>',
                f'<text x="{LEFT - 6}" y="{y + 4:.1f}" text-anchor="end">{value:g}</text>',
            ]

    def name(self, text, colour, dashed=False):
        y = TOP + 10 + 18 * self.legend
        self.legend += 1
        self.parts += [
            f'<path d="M{WIDTH - RIGHT + 12} {y}h22" stroke="{colour}" stroke-width="2"{_dash(dashed)}/>',
            f'<text x="{WIDTH - RIGHT + 40}" y="{y + 4}">{text}</text>',
        ]

    def line(self, points, colour, text, dashed=False):
        if not points:
            return
        path = " ".join(f"{self.x(a):.1f},{self.y(b):.1f}" for a, b in points)
        self.parts.append(
            f'<polyline points="{path}" fill="none" stroke="{colour}" stroke-width="2"{_dash(dashed)}/>'
        )
        if not dashed:
            self.parts += [
                f'<circle cx="{self.x(a):.1f}" cy="{self.y(b):.1f}" r="2.5" fill="{colour}"/>'
                for a, b in points
            ]
        self.name(text, colour, dashed)

    def dot(self, a, b, colour):
        self.parts.append(
            f'<circle cx="{self.x(a):.1f}" cy="{self.y(b):.1f}" r="3.5" fill="{colour}" fill-opacity="0.7"/>'
        )

    def bar(self, left, right, value, colour):
        x, y = self.x(left), self.y(value)
        self.parts += [
            f'<rect x="{x:.1f}" y="{y:.1f}" width="{self.x(right) - x:.1f}" '
            f'height="{HEIGHT - BOTTOM - y:.1f}" fill="{colour}"/>',
            f'<text x="{(x + self.x(right)) / 2:.1f}" y="{y - 3:.1f}" text-anchor="middle" '
            f'font-size="10">{value:.1f}</text>',
        ]

    def text(self):
        return "\n".join(self.parts + ["</svg>"]) + "\n"


def _dash(dashed):
    return ' stroke-dasharray="6 4"' if dashed else ""


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
    plots = dict(speeds(results))
    plots.update(
        {"speed-up.svg": speed_up(results), "radii.svg": radii(results), "threads.svg": threads(results)}
    )
    return {name: text for name, text in plots.items() if text}
