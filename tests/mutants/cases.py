# SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
# SPDX-License-Identifier: BSD-3-Clause
"""The test cases of the built programs: what each reaches, how long it takes, and which one notices a mutant."""
import hashlib
import json
import os
import re
import signal
import subprocess
import tempfile
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import NamedTuple

# A mutant may ask for all memory there is; no test needs nearly as much.
_LIMITED = ["sh", "-c", 'ulimit -c 0; ulimit -v 12000000; exec "$@"', "sh"]
_FIRST_BATCH = 0.5  # seconds of tests; each further batch has four times as many


class Case(NamedTuple):
    program: str
    name: str
    seconds: float
    slots: frozenset


def run(command, variables, limit):
    """Its exit status (None: out of time) and what it says."""
    # Without PCL_BV_ISA the best instruction set of the machine is taken.
    environment = {k: v for k, v in os.environ.items() if not k.startswith("PCL_BV_")} | variables
    with tempfile.TemporaryDirectory() as folder:
        process = subprocess.Popen(_LIMITED + command, cwd=folder, env=environment, text=True, errors="replace",
                                   stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                                   start_new_session=True)
        try:
            said, _ = process.communicate(timeout=limit)
            return process.returncode, said
        except subprocess.TimeoutExpired:
            os.killpg(process.pid, signal.SIGKILL)
            process.communicate()
            return None, ""


def names_of(program):
    listed = subprocess.run([program, "--gtest_list_tests"], check=True, capture_output=True, text=True).stdout
    names, suite = [], ""
    for line in listed.splitlines():
        word = line.split("#")[0].strip()
        if not line.startswith(" "):
            suite = word
        elif not (suite + word).startswith("DISABLED_") and ".DISABLED_" not in suite + word:
            names.append(suite + word)
    return [name for name in names if name.count(".") == 1]


def record(program, name):
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "reached"
        begin = time.monotonic()
        status, said = run([program, f"--gtest_filter={name}"], {"PCL_BV_MUTANT_RECORD": str(file)}, 900)
        seconds = time.monotonic() - begin
        if status != 0:
            raise SystemExit(f"{name} fails with no mutant alive:\n{said}")
        return Case(program, name, seconds, frozenset(int(n) for n in file.read_text().split()))


def cases_of(programs, memory, jobs, say):
    """All cases; what is known of a program whose file is the same is not asked again."""
    known = json.loads(memory.read_text()) if memory.exists() else {}
    kept, result = {}, []
    for program in map(str, programs):
        key = hashlib.sha256(Path(program).read_bytes()).hexdigest()
        if key not in known:
            say(f"what the cases of {Path(program).name} reach")
            with ThreadPoolExecutor(jobs) as pool:
                found = list(pool.map(lambda name, p=program: record(p, name), names_of(program)))
            known[key] = [[c.name, c.seconds, sorted(c.slots)] for c in found]
        kept[key] = known[key]
        memory.write_text(json.dumps({**known, **kept}))
        result += [Case(program, name, seconds, frozenset(slots)) for name, seconds, slots in kept[key]]
    memory.write_text(json.dumps(kept))
    return result


def batches(cases):
    """Cheapest first, in groups of growing cost: most mutants are noticed by the first of them."""
    group, total, most = [], 0.0, _FIRST_BATCH
    for case in sorted(cases, key=lambda c: c.seconds):
        group.append(case)
        total += case.seconds
        if total >= most:
            yield group
            group, total, most = [], 0.0, 4 * most
    if group:
        yield group


def who_notices(mutant, cases):
    """What a test does where the mutant lives: the first failure, or None if all pass."""
    variables = {"PCL_BV_MUTANT": f"{mutant.slot}:{mutant.number}"}
    for group in batches(cases):
        for program in dict.fromkeys(c.program for c in group):
            own = [c for c in group if c.program == program]
            command = [program, "--gtest_fail_fast", "--gtest_brief=1", "--gtest_filter=" + ":".join(c.name for c in own)]
            seconds = sum(c.seconds for c in own)
            status, said = run(command, variables, min(10 + 10 * seconds, 60 + 3 * seconds))
            if status is None:
                return f"out of time in {Path(program).name}"
            if status != 0:
                failed = re.search(r"^\[  FAILED  \] (\S+)", said, re.MULTILINE)
                return failed.group(1).rstrip(",") if failed else f"crash in {Path(program).name}"
    return None
