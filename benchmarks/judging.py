# SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
# SPDX-License-Identifier: BSD-3-Clause
"""What was set out for and what is reached: figures beside their bounds, and the table of all."""
import collections

from results import number, table

# `wanted` is the bound as text ("" is none, only shown), `reached` the figure, `met` None without bound.
Line = collections.namedtuple("Line", "what where wanted reached met")
# `part` is what .ci/run-benchmarks repeats.
Target = collections.namedtuple("Target", "id title part lines")


def judge(value, sign, bound, show=number, unit="", aside=None):
    """(wanted, reached, met) of a figure. `aside` is the ratio of minima."""
    reached = show(value) + unit + (f" ({show(aside)}{unit})" if aside is not None else "")
    if bound is None:
        return "", reached, None
    return f"{sign} {bound:g}{unit}", reached, value >= bound if sign == ">=" else value <= bound


def faster(results, what, where, name, bound=None):
    """At least so many times faster: median of 30 pairs, in brackets of the two minima."""
    found = results.ratio(name)
    return [Line(what, where, *judge(found[0], ">=", bound, aside=found[1]))] if found else []


def by_set(results, what, where, name, bounds, one=faster):
    return [
        line
        for s in results.sets[1:]
        for line in one(results, what, f"{where}, {s}", name.format(s), bounds.get(s))
    ]


def share(results, what, where, name, bound=None):
    """Of the bandwidth, in percent."""
    found = results.ratio(name)
    if not found:
        return []
    return [
        Line(what, where, *judge(100 * found[0], ">=", bound, lambda v: f"{v:.0f}", " %", 100 * found[1]))
    ]


def cost(results, what, where, name, bound=None):
    """Extra time in percent."""
    found = results.ratio(name)
    if not found:
        return []
    extra = [100 / ratio - 100 for ratio in found]
    return [Line(what, where, *judge(extra[0], "<=", bound, lambda v: f"{round(v) + 0:+d}", " %", extra[1]))]


def targets_table(targets):
    lines = []
    for target in targets:
        lines.append(
            [f"**{target.title}**", f"`.ci/run-benchmarks build/release {target.part}`", " ", " ", " "]
        )
        for line in target.lines:
            met = {None: " ", True: "yes", False: f"[no](#{target.id})"}[line.met]
            lines.append([line.what, line.where, line.wanted or " ", line.reached, met])
        if not target.lines:
            lines.append(["not measured on this machine", " ", " ", " ", " "])
    return table(["work", "input, threads, instruction set", "to reach", "reached", "met"], lines)


def missed(targets):
    return [t for t in targets if any(line.met is False for line in t.lines)]
