#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
# SPDX-License-Identifier: BSD-3-Clause
"""Writes docs/benchmarks.md (from benchmarks.md.in and misses.md), its plots, docs/comparison.md and the
README's tables from a file of benchmarks/results; with --check, only says whether they are what it would write.

usage: benchmarks/docs.py [--check] [RESULTS.json]

Without a file: the only one of benchmarks/results, or the one that docs/benchmarks.md names.
"""
import pathlib
import re
import sys
import textwrap

import judging
import paper_tables
import peer_tables
import plots
import tables
import targets
import tree_tables
from results import Results, duration, number, table

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parent
PLOTS = ROOT / "docs/benchmarks"
OTHERS = {"scale.svg"}  # of scale.py
PAGE = ROOT / "docs/benchmarks.md"
README = ROOT / "README.md"
COMPARISON = ROOT / "docs/comparison.md"


def misses(results, all_targets):
    """Why each missed target is missed and what was tried: the sections of misses.md, by the targets' ids."""
    sections = re.split(r"^## ([\w-]+)\n", (HERE / "misses.md").read_text(), flags=re.MULTILINE)[1:]
    reasons = dict(zip(sections[::2], sections[1::2]))
    unknown = reasons.keys() - {t.id for t in all_targets}
    if unknown:
        sys.exit(f"misses.md: no target {', '.join(sorted(unknown))}")
    text = []
    for target in judging.missed(all_targets):
        if target.id not in reasons:
            print(f"misses.md says nothing about {target.id}, which is missed", file=sys.stderr)
        reason = fill(reasons.get(target.id, "Not looked into yet.").strip(), results)
        lines = textwrap.wrap(
            f"**{target.title}.** {reason}", 120, break_long_words=False, break_on_hyphens=False
        )
        text.append("\n".join([f'<a id="{target.id}"></a>', *lines]))
    return "\n\n".join(text) or "None."


def inline(results, what, name):
    """A figure in running text: {{ms ROW}}, {{least ROW}} (repetition), {{speed ROW}}; of rows that ran
    alternately {{ratio ROW}}, {{percent ROW}}, {{minima ROW}} (their ratio), {{first ROW}}, {{second ROW}}; any
    other word is a counter.
    """
    row = results.rows.get(name)
    if row is None:
        return "(not measured)"
    ways = {
        "ms": lambda: duration(row["us"][0]),
        "least": lambda: duration(row["us"][-1]),
        "speed": lambda: f"{number(results.speed(name))} Mpt/s",
        "ratio": lambda: number(row["ratio"]),
        "percent": lambda: f"{100 * row['ratio']:.0f} %",
        "minima": lambda: number(results.ratio(name)[1]),
        "first": lambda: duration(row["first_us"]),
        "second": lambda: duration(row["second_us"]),
        "radius": lambda: f"{row['radius']:.5f}",
    }
    return ways[what]() if what in ways else f"{row[what]:g}" if what in row else "(not measured)"


def fill(text, results, blocks=None):
    """Replaces {{block}} and {{what row}}; `best` stands for the widest instruction set."""

    def one(found):
        words = found.group(1).split(maxsplit=1)
        if len(words) == 2:
            row = (
                words[1] if words[1].startswith("read-") else words[1].replace("/best/", f"/{results.best}/")
            )
            return inline(results, words[0], row)
        return blocks[words[0]]()

    return re.sub(r"\{\{([^}]+)\}\}", one, text)


def page(results, drawn):
    all_targets = targets.all_targets(results)
    blocks = {
        name: lambda f=f: f(results)
        for module in (tables, paper_tables, peer_tables, tree_tables)
        for name, f in vars(module).items()
        if callable(f) and f.__module__ == module.__name__
    }
    blocks["targets"] = lambda: judging.targets_table(all_targets)
    blocks["misses"] = lambda: misses(results, all_targets)
    trees = ("tree-build", "tree-nearest", "tree-any")
    for name in ("speed-aabb", "speed-dop26", "speed-all", "speed-up", "radii", "threads", *trees):
        blocks["plot-" + name] = (
            lambda n=name: f"![{n}](benchmarks/{n}.svg)"
            if f"{n}.svg" in drawn
            else "No figure: its rows have not been measured on this machine."
        )
    return fill((HERE / "benchmarks.md.in").read_text(), results, blocks)


def readme(results):
    points, cloud = 100722, "paper/xyz/no-nan/n:100722"
    works = [
        ("AABB", "aabb"),
        ("26-DOP", "dop26"),
        ("sphere, EPOS-26", "sphere-epos26"),
        ("smallest sphere", "sphere-exact"),
    ]
    lines = [
        [label] + [number(results.speed(f"{work}/{s}/{cloud}")) for s in results.sets]
        for label, work in works
    ]
    pcl = [number(results.speed(f"pcl-{flag}/peer/{cloud}")) for flag in ("dense", "non-dense")]
    before, rest = README.read_text().split("<!-- table:begin -->\n")
    after = rest.split("<!-- table:end -->")[1]
    text = (
        f"{table([f'Mpt/s, {points} pcl::PointXYZ, one core'] + results.sets, lines)}\n\n"
        f"`pcl::getMinMax3D` in the same run: {pcl[0]} dense, {pcl[1]} not dense. Boxes and k-DOPs exact,\n"
        "enclosure proven; scalar is the reference loop of the same fit. Made by `./bootstrap bench`; all\n"
        "tables, other libraries and what is not reached: [benchmarks](docs/benchmarks.md)."
    )
    return f"{before}<!-- table:begin -->\n{text}\n\n{pace(results)}\n<!-- table:end -->{after}"


def pace(results):
    """What a robot waits for at the sensor's pace, beside the same steps in PCL."""
    source = "sweeps" if "pipeline/pcl/sweeps" in results.rows else "street"
    rows = [
        ("one thread", f"pipeline/paced-1-thread/{source}"),
        ("two threads", f"pipeline/paced-2-thread/{source}"),
        ("PCL: RANSAC plane, `EuclideanClusterExtraction`, moments of inertia; no tracks, no pauses", f"pipeline/pcl/{source}"),
    ]
    measured = [(what, results.rows[name]) for what, name in rows if name in results.rows]
    cloud = "recorded sweeps of 64 beams" if source == "sweeps" else "generated sweeps of 64 beams"
    return (
        table(
            [f"ms from the cloud to tracked objects, {cloud}, one every 100 ms", "p50", "p99"],
            [[what, number(row["total_p50"]), number(row["total_p99"])] for what, row in measured],
        )
        + "\n\nEach frame: range filter, ground by zones, clusters with refinement, AABB, sphere, upright box and\n"
        "26-DOP of each object, tracks."
    )


def results_file(arguments):
    if arguments:
        return pathlib.Path(arguments[0])
    files = sorted((HERE / "results").glob("*.json"))
    named = re.search(r"results/([\w-]+\.json)", PAGE.read_text()) if PAGE.exists() else None
    return HERE / "results" / named.group(1) if named and len(files) > 1 else files[0]


def main(arguments):
    check = "--check" in arguments
    arguments = [a for a in arguments if a != "--check"]
    if len(arguments) > 1:
        sys.exit(__doc__)
    results = Results(results_file(arguments))
    drawn = plots.all_plots(results)
    comparison = fill((HERE / "comparison.md.in").read_text(), results)
    wanted = {PAGE: page(results, drawn), README: readme(results), COMPARISON: comparison}
    wanted.update((PLOTS / name, text) for name, text in drawn.items())
    stale = [path for path, text in wanted.items() if not path.exists() or path.read_text() != text]
    stale += [path for path in PLOTS.glob("*.svg") if path not in wanted and path.name not in OTHERS]
    if check:
        sys.exit(
            "\n".join(f"{path.relative_to(ROOT)}: not what {results.path.name} gives" for path in stale) or 0
        )
    PLOTS.mkdir(exist_ok=True)
    for path in stale:
        if path in wanted:
            path.write_text(wanted[path])
        else:
            path.unlink()


main(sys.argv[1:])
