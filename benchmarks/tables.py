# SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
# SPDX-License-Identifier: BSD-3-Clause
"""The machine and its limit, growth, the pipeline, memory: tables in Markdown that no other library is in."""
import peer_list
from results import LEVELS, count, exponent, number, points_of, table


def machine(results):
    m = results.machine
    caches = ", ".join(f"{size >> 10} KB {name}" for name, size in m["caches"].items())
    compilers = sorted({part["compiler"] for part in results.parts.values()})
    return (
        f"{m['cpu']}, family {m['family']}, model {m['model']}; {m['cores']} cores; {caches}; "
        f"{m['memory_mb'] / 1024:.0f} GB of memory; Linux {m['kernel']}; {', '.join(compilers)}; "
        f"instruction sets {', '.join(results.sets)}.\n\nSource of every figure: "
        f"[{results.path.name}](../benchmarks/results/{results.path.name})."
    )


def parts(results):
    return table(
        ["part", "commit", "date", "seconds", "load of the machine at its start"],
        [[f"`{name}`", p["commit"], p["date"], p["seconds"], p["load"]] for name, p in results.parts.items()],
    )


def not_measured(results):
    """Names each peer and part without rows, so that an empty cell is no riddle."""
    lines = peer_list.gaps(results)
    if not lines:
        return "Every peer that this page names was installed and measured."
    return "Not measured, so empty below:\n\n" + "\n".join(f"* {line}" for line in lines)


def limit(results):
    """GB/s that pass, by size: reading alone, and our passes."""
    sizes = sorted({points_of(n) for n in results.matching("read-1-thread/best/gauss/xyz/no-nan")})
    lines = []
    for n in sizes:
        cloud = f"gauss/xyz/no-nan/n:{n}"
        line = [results.bandwidth(f"read-{t}-thread/best/{cloud}") for t in (1, 2)]
        line += [
            results.bandwidth(f"{work}/{results.best}/{cloud}") for work in ("aabb", "dop26", "sphere-epos26")
        ]
        lines.append([count(n), f"{16 * n / 1e6:.3g}"] + [number(v) for v in line])
    return table(
        [
            "points",
            "MB",
            "read, one core",
            "read, two cores",
            f"AABB {results.best}, one core",
            "26-DOP",
            "EPOS-26 (two passes)",
        ],
        lines,
    )


def growth(results):
    works = [
        (work, s)
        for work in ("aabb", "dop14", "dop26", "sphere-epos26", "sphere-exact")
        for s in results.sets
    ]
    series = [
        (
            f"{w} {s}",
            [
                (points_of(n), results.us(n))
                for n in results.matching(f"{w}/{s}/gauss/xyz/no-nan/")
                if points_of(n) & (points_of(n) - 1) == 0
            ],
        )
        for w, s in works
    ]
    series.append(
        (
            "clusters, 0.5 m, synth:street",
            [(points_of(n), results.us(n)) for n in results.matching("clusters/street/")],
        )
    )
    lines = []
    for label, pairs in series:
        if len(pairs) < 4:
            continue
        pairs.sort()
        per_point = {n: 1e3 * us / n for n, us in pairs}
        middle = min(per_point, key=lambda n: abs(n - 1e6))
        shown = [pairs[0][0], middle, pairs[-1][0]]
        lines.append(
            [label, f"{count(shown[0])} to {count(shown[-1])}", f"{exponent(pairs):.3f}"]
            + [number(per_point[n]) for n in shown]
        )
    return table(
        ["one thread", "points", "exponent", "ns a point, smallest cloud", "about 1 M", "largest cloud"], lines
    )


def pipeline(results):
    stages = ("filter", "ground", "cluster", "fit", "track", "total")
    lines = []
    for name in results.matching("pipeline/"):
        run = results.rows[name]
        lines.append(
            [name[9:], f"{run['clusters']:.0f}"]
            + [
                f"{number(run[s + '_p50'])} / {number(run[s + '_p99'])}" if s + "_p50" in run else None
                for s in stages
            ]
            + [number(run["max"]), number(run.get("first_max"))]
        )
    return table(["ms, 50th / 99th percentile", "clusters", *stages, "maximum", "of the first five"], lines)


def speeds(results, works, clouds):
    """Mpt/s of each work and set in each cloud."""
    lines = [
        [f"{work} {s}"] + [number(results.speed(f"{work}/{s}/{cloud}")) for _, cloud in clouds]
        for work, sets in works
        for s in sets
    ]
    return table(["Mpt/s, one thread"] + [label for label, _ in clouds], lines)


def levels(results):
    works = (
        "aabb",
        "dop14",
        "dop18",
        "dop26",
        "dop26-points",
        "unchecked-aabb",
        "unchecked-dop26",
        "tested-dop26",
    )
    return speeds(
        results,
        [(w, results.sets) for w in works],
        [(f"{v}, {count(n)}", f"gauss/xyz/no-nan/n:{n}") for n, v in LEVELS.items()],
    )


def layouts(results):
    names = ("xyz", "packed", "xyzi", "indices", "groups", "double")
    return speeds(
        results,
        [("aabb", results.sets), ("dop26", results.sets)],
        [(f"{LEVELS[n]} {x}", f"gauss/{x}/no-nan/n:{n}") for n in (32768, 16000000) for x in names],
    )


def bad_points(results):
    works = [
        ("aabb", results.sets),
        ("dop26", results.sets),
        ("pcl-dense", ["peer"]),
        ("pcl-non-dense", ["peer"]),
    ]
    return speeds(
        results,
        works,
        [
            (f"{LEVELS[n]} {b}", f"gauss/xyz/{b}/n:{n}")
            for n in (32768, 16000000)
            for b in ("no-nan", "one-nan", "1pc-nan")
        ],
    )


def scenes(results):
    return speeds(
        results,
        [("aabb", results.sets), ("dop26", results.sets)],
        [(x, f"{x}/xyz/no-nan/n:128000") for x in ("gauss", "cube", "street")],
    )
