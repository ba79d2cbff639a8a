# SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
# SPDX-License-Identifier: BSD-3-Clause
"""Reads a file of benchmarks/results: rows by the names that programs give them, in the tables' units."""
import json
import math
import pathlib
import re

SETS = ["scalar", "sse4", "avx2", "avx512", "neon", "sve", "sve2"]
LEVELS = {2048: "L1", 32768: "L2", 1000000: "L3", 16000000: "memory"}
POOLS = {"own": "own threads", "default": "OpenMP", "passive": "OpenMP, passive"}
BYTES = {"xyz": 16, "packed": 12, "xyzi": 32, "indices": 20, "double": 24, "groups": 12}  # a point, by layout


class Results:
    def __init__(self, path):
        self.path = pathlib.Path(path)
        content = json.loads(self.path.read_text())
        self.machine, self.parts = content["machine"], content["parts"]
        self.rows = {name: row for rows in content["rows"].values() for name, row in rows.items()}
        found = {name.split("/")[1] for name in self.rows if name.startswith("aabb/")}
        self.sets = [s for s in SETS if s in found]  # the scalar reference first
        self.best = self.sets[-1]

    def us(self, name):
        """The median of a row's repetitions in microseconds, or None."""
        row = self.rows.get(name)
        return row["us"][0] if row and "us" in row else None

    def ms(self, name):
        us = self.us(name)
        return us and us / 1e3

    def speed(self, name):
        """Mpt/s."""
        us = self.us(name)
        return us and points_of(name) / us

    def bandwidth(self, name):
        """GB/s; of what only reads by its least time, since that is the limit."""
        us = self.rows[name]["us"][-1] if name in self.rows and name.startswith("read-") else self.us(name)
        return us and 1e-3 * points_of(name) * BYTES[name.split("/")[3]] / us

    def ratio(self, name):
        """Of a comparison in turns: the median of the pairs' ratios, the ratio of the two minima; or None."""
        row = self.rows.get(name)
        return row and (row["ratio"], row["first_us"] / row["second_us"])

    def matching(self, pattern):
        """Names that match from their beginning, in the order of the file."""
        return [name for name in self.rows if re.match(pattern, name)]


def points_of(name):
    return int(re.search(r"n:(\d+)", name).group(1))


def exponent(pairs):
    """Least squares in the logarithms: the p of time ~ points^p."""
    logs = [(math.log(n), math.log(t)) for n, t in pairs]
    mean_x, mean_y = (sum(v) / len(logs) for v in zip(*logs))
    return sum((x - mean_x) * (y - mean_y) for x, y in logs) / sum((x - mean_x) ** 2 for x, _ in logs)


def number(value, figures=3):
    """With so many figures, never in powers of ten; None becomes a dash."""
    if value is None:
        return "-"
    if value == 0:
        return "0"
    decimals = max(0, figures - 1 - math.floor(math.log10(abs(value))))
    return f"{value:.{decimals}f}"


def duration(us):
    """Microseconds in the unit that leaves no zeros behind the point."""
    return f"{number(us)} µs" if us < 100 else f"{number(us / 1e3)} ms"


def count(n):
    """16777216 as 16 777 216."""
    return f"{n:,}".replace(",", " ")


def percent(value, decimals=0):
    return "-" if value is None else f"{round(value, decimals) + 0.0:+.{decimals}f} %"


def table(head, lines):
    """A Markdown table without the lines that hold nothing but their names."""
    lines = [["-" if c is None else str(c) for c in line] for line in lines]
    kept = [line for line in lines if any(c != "-" for c in line[1:])]
    if not kept:
        return "No row of this table has been measured on this machine."
    cells = [head, ["---"] * len(head)] + kept
    return "\n".join("| " + " | ".join(line) + " |" for line in cells)
