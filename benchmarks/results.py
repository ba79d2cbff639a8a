# SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
# SPDX-License-Identifier: BSD-3-Clause
"""Reads a file of benchmarks/results: rows by name, as boxes_benchmark.cpp and pairs_benchmark.cpp name them."""
import json
import pathlib
import re

SETS = ["scalar", "sse4", "avx2", "avx512", "neon", "sve", "sve2"]
PAPER = {
    4010: "Frog", 7260: "Chair", 30892: "Tiger", 32875: "Bunny", 48485: "Horse", 100722: "Golfball", 327323: "Hand",
}
LEVELS = {2048: "L1", 32768: "L2", 1000000: "L3", 16000000: "memory"}


class Results:
    def __init__(self, path):
        self.path = pathlib.Path(path)
        content = json.loads(self.path.read_text())
        self.context = content["context"]
        self.rows = {}
        for run in content["benchmarks"]:
            # What Google Benchmark appends to a name says how it was run, not what.
            name = re.sub(r"(/(iterations|repeats):\d+|/manual_time|/real_time)+$", "", run["run_name"])
            statistic = run.get("aggregate_name", "median")
            self.rows.setdefault(name, {}).setdefault(statistic, run)

    def row(self, name):
        """The medians of a row's repetitions (of a comparison: the row), or None."""
        return self.rows.get(name, {}).get("median")

    def speed(self, name):
        """Mpt/s, or None if there is no such row."""
        row = self.row(name)
        return row and row["items_per_second"] / 1e6

    def milliseconds(self, name):
        row = self.row(name)
        return row and 1e-3 * (row["cpu_time"] if "real_time" not in row["run_name"] else row["real_time"])

    def sets(self):
        """The instruction sets of the run, scalar first."""
        found = {name.split("/")[1] for name in self.rows if name.startswith("aabb/")}
        return [s for s in SETS if s in found]


def table(head, lines):
    """A Markdown table; None becomes a dash."""
    cells = [head, ["---"] * len(head)] + [["-" if c is None else str(c) for c in line] for line in lines]
    return "\n".join("| " + " | ".join(line) + " |" for line in cells)
