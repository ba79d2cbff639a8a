# SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
# SPDX-License-Identifier: BSD-3-Clause
"""Compares ratios of a short run with those of benchmarks/results, to find what a change has made slower.

A ratio divides the time of another program, or of another way, by ours; both run alternately. So it changes
less than times do when others use the machine.
"""
import re

from results import number, table

# Part: which of its rows. All together take about four minutes on two processors.
ROWS = {
    "pairs": "^(over|of)-",
    "obb": "^turns/.*(gauss|car|street)",
    "clusters": "^(dbscan|over)-.*/street",
    "batch": "^batch/",
    "trees": "^tree/over-(flann|nanoflann|embree)/.*/street",
    "recordings": "^(over-pread|packets)/",
}
FALLEN = 0.85  # of the ratio before
TRIES = 3  # of a row that has fallen; the best one counts


def ratios(rows):
    return {name: row["ratio"] for name, row in rows.items() if "ratio" in row}


def fallen(before, now):
    """Names of the rows whose ratio is less than FALLEN of that before."""
    return [name for name, ratio in now.items() if name in before and ratio < FALLEN * before[name]]


def best(now, again):
    return {name: max(ratio, again.get(name, ratio)) for name, ratio in now.items()}


def exactly(names):
    """A filter for these rows, whatever Google Benchmark appends to their names."""
    # re.escape() quotes more than POSIX permits.
    quoted = [re.sub(r"([.[\\()*+?{|^$])", r"\\\1", name) for name in names]
    return f"^({'|'.join(quoted)})(/|$)"


def measure(part, before, run):
    """The ratios of a part's rows. `run(part, filter)` returns rows. Rows that have fallen are run again."""
    now = ratios(run(part, ROWS[part]))
    for _ in range(TRIES - 1):
        names = fallen(before, now)
        if not names:
            break
        now = best(now, ratios(run(part, exactly(names))))
    return now


def missing_rows(before, now):
    """Rows of the file that this run should have had: their peer is not installed, or they have another name."""
    return [name for name in before if name not in now and any(re.match(rows, name) for rows in ROWS.values())]


def report(before, now):
    """What to print, and whether a row has fallen."""
    names = fallen(before, now)
    compared = sum(name in before for name in now)
    missing = missing_rows(before, now)
    gap = f"\n{len(missing)} rows of the file were not measured: {', '.join(missing[:3])} ..." if missing else ""
    if not compared:
        return "There are no results of this processor to compare with.", False
    if not names:
        return f"{compared} ratios: none fell by more than {round(100 - 100 * FALLEN)} %.{gap}", False
    lines = [[f"`{n}`", number(before[n]), number(now[n]), f"{100 * now[n] / before[n] - 100:+.0f} %"] for n in names]
    return (
        f"{len(names)} of {compared} ratios fell by more than {round(100 - 100 * FALLEN)} %, best of {TRIES} runs:\n\n"
        + table(["row", "before", "now", "change"], lines)
        + gap
    ), True
