#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
# SPDX-License-Identifier: BSD-3-Clause
"""Changes operators, constants and comparisons of the modules one at a time and lists the changes that no test
notices: each is a gap in the tests, or has its reason in explained.txt.

All that a run writes is in build/mutants. Results are kept there and collected over runs.
"""
import argparse
import os
import sys
import threading
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import build
from cases import cases_of, who_notices
from results import Results, explained_in, in_random_order, key_of

HERE = Path(__file__).resolve().parent


def arguments():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--seed", type=int, default=1, help="of the order in which mutants are tried")
    parser.add_argument("--minutes", type=float, default=20, help="for trying mutants, once all is built")
    parser.add_argument("--sample", type=int, default=0, help="how many of that order to judge the tests by (0: all)")
    parser.add_argument("--only", default="", metavar="PART", help="of the paths of files to mutate")
    parser.add_argument("--results", type=Path, default=build.BUILD / "results.json", metavar="FILE")
    parser.add_argument("--jobs", type=int, default=os.cpu_count(), help="mutants at a time, and compilers")
    parser.add_argument("--list", action="store_true", help="list the mutants in this order, try none")
    return parser.parse_args()


def say(text):
    print(f"[{time.strftime('%H:%M:%S')}] {text}", file=sys.stderr, flush=True)


def line_of(mutant):
    return f"{mutant.file}:{mutant.line}: `{mutant.original}` -> `{mutant.mutated}`, {mutant.function or 'no function'}"


def try_all(mutants, cases, results, options):
    """Until the time is over."""
    covering = {}
    for case in cases:
        for slot in case.slots:
            covering.setdefault(slot, []).append(case)
    deadline = time.monotonic() + 60 * options.minutes
    lock = threading.Lock()
    tried = 0

    def try_one(mutant):
        nonlocal tried
        with lock:
            if time.monotonic() > deadline or results.is_settled(mutant):
                return
            tried += 1
        reaching = covering.get(mutant.slot, [])
        noticed_by = who_notices(mutant, reaching)
        with lock:
            results.put(mutant, noticed_by, len(reaching))
            if not noticed_by:
                say(f"not noticed: {line_of(mutant)}, reached by {len(reaching)} tests")

    with ThreadPoolExecutor(options.jobs) as pool:
        list(pool.map(try_one, mutants))
    return tried


def report(mutants, results, reasons, there):
    """Prints what no test noticed and nothing explains. True if there is none of that. `there`: the keys of all."""
    known = [(m, results.get(m)) for m in mutants]
    known = [(m, r) for m, r in known if r is not None]
    missed = [(m, r) for m, r in known if not r["noticed_by"]]
    unexplained = [(m, r) for m, r in missed if key_of(m) not in reasons]
    for mutant, result in unexplained:
        print(f"{line_of(mutant)}, reached by {result['reached']} tests")
    for key in reasons:
        if key not in there:
            print(f"explained.txt: no such mutant any more: {' | '.join(key)}")
    blocks = ["\n".join(key_of(m)) + "\n" for m, _ in unexplained]
    (build.BUILD / "not_noticed.txt").write_text("\n".join(blocks))
    noticed = len(known) - len(missed)
    share = noticed / max(1, noticed + len(unexplained))
    print(f"mutants: {len(known)} tried, {len(missed) - len(unexplained)} explained, "
          f"{noticed} noticed ({100 * share:.1f} % of the others), {len(unexplained)} not noticed")
    return not unexplained


def main():
    options = arguments()
    sources = build.Sources()
    if options.list:
        sources.write()
    else:
        programs = build.build(sources, options.jobs, say)
    mutants = [m for m in in_random_order(sources.mutants, options.seed) if options.only in m.file]
    there = {key_of(m) for m in sources.mutants}
    mutants = mutants[: options.sample or None]
    if options.list:
        print("\n".join(map(line_of, mutants)))
        return 0
    cases = cases_of(programs, build.BUILD / "cases.json", options.jobs, say)
    say(f"{len(cases)} cases, {sum(c.seconds for c in cases):.0f} s; {len(mutants)} mutants")
    reasons = explained_in((HERE / "explained.txt").read_text())
    results = Results(options.results, reasons)
    say(f"{try_all(results.with_unsettled_first(mutants), cases, results, options)} mutants tried in this run")
    return 0 if report(mutants, results, reasons, there) else 1


if __name__ == "__main__":
    sys.exit(main())
