# SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
# SPDX-License-Identifier: BSD-3-Clause
"""A copy of the sources that holds all mutants, and its test programs."""
import json
import os
import re
import shutil
import subprocess
from pathlib import Path

from rewrite import rewrite

ROOT = Path(__file__).resolve().parents[2]
BUILD = ROOT / "build/mutants"
SOURCE = BUILD / "source"
BINARY = BUILD / "build"

MODULES = ("numeric", "kernels", "volumes", "fitting", "trees", "segmentation")
TEST_FOLDERS = ("numeric", "volumes", "kernels", "parallel", "fitting", "trees", "segmentation", "estimation")
# Other implementations, as peers: slow to build, and what they compare has tests without them.
PEERS = {"test_fitting_cgal", "test_clusters_as_pcl", "test_extract_clusters"}
WITHOUT_TESTS = {"modules/segmentation/include/pcl_bv/segmentation/extract_clusters.h"}
# With assertions: an index past an array's end is noticed as the sanitizers notice it, not only by what it changes.
FLAGS = "-w -D_GLIBCXX_ASSERTIONS"
OPTIMISED = "-O2"

_ERROR = re.compile(r"^([^:\s]+):(\d+):(\d+): (?:fatal )?error: ", re.MULTILINE)
_PLACE = re.compile(r"^(?:In file included from |\s+from )?([^:\s]+):(\d+)(?::(\d+))?", re.MULTILINE)


def tracked_files():
    listed = subprocess.run(["git", "ls-files", "-z"], cwd=ROOT, check=True, capture_output=True).stdout
    return [name for name in listed.decode().split("\0") if name and (ROOT / name).is_file()]


def functions_of_speed_alone():
    """What only_speed.txt lists: (file, function)."""
    lines = (Path(__file__).parent / "only_speed.txt").read_text().splitlines()
    return {tuple(line.split(": ")) for line in lines if line and not line.startswith(("#", " "))}


def is_mutated(name):
    path = Path(name)
    in_module = len(path.parts) > 2 and path.parts[0] == "modules" and path.parts[1] in MODULES
    return in_module and path.suffix in (".cpp", ".h") and name not in WITHOUT_TESTS


class Sources:
    """The copy. What was seen not to compile is left out, and remembered for the next run."""

    def __init__(self):
        self.mutants = []
        self._places = {}  # by file: what Arm says, and the text
        self._memory = BUILD / "not_compiling.json"
        self._dropped = set(json.loads(self._memory.read_text())) if self._memory.exists() else set()
        BUILD.mkdir(parents=True, exist_ok=True)

    def write(self):
        """Brings the copy up to date with the sources and with what is left out."""
        self.mutants = []
        names, unasked = tracked_files(), functions_of_speed_alone()
        first = 0
        for name in names:
            data = (ROOT / name).read_bytes()
            if is_mutated(name):
                # Always inlined, a function would be there once for each mutant of all that call it.
                text = data.decode().replace("HWY_INLINE", "inline")
                text, made, arms, count = rewrite(text, name, self._dropped | unasked, first, first)
                # Room, so that an edit of one file leaves the numbers in others, and those need no compiler.
                first += (count // 64 + 2) * 64
                self.mutants += made
                self._places[name] = (text, arms)
                data = text.encode()
            _write_if_new(SOURCE / name, data)
        _remove_others(names)

    def drop(self, log):
        """Leaves out the mutants that the compiler complains about. Says how many."""
        found = set()
        for block in _error_blocks(log):
            found |= self._blamed(block)
        found -= self._dropped
        self._dropped |= found
        self._memory.write_text(json.dumps(sorted(self._dropped)))
        return len(found)

    def _blamed(self, block):
        error = _ERROR.search(block)
        places = [error.groups(), *(m.groups() for m in _PLACE.finditer(block))]
        for path, line, column in places:
            found = self._mutants_at(path, int(line), int(column or 0))
            if found:
                return found
        return set()

    def _mutants_at(self, path, line, column):
        try:
            name = str((BINARY / path).resolve().relative_to(SOURCE))
        except ValueError:
            return set()
        if name not in self._places:
            return set()
        text, arms = self._places[name]
        start = 0
        for _ in range(line - 1):
            start = text.find("\n", start) + 1
        position = start + column - 1
        around = [a for a in arms if a.start <= position < a.end]
        if around:
            return set(min(around, key=lambda a: a.end - a.start).identities)
        end = text.find("\n", start)
        return {i for a in arms if a.start < end and a.end > start for i in a.identities}


def _error_blocks(log):
    """Each error with the lines around it that say where it comes from."""
    starts = [m.start() for m in _ERROR.finditer(log)]
    return [log[a:b] for a, b in zip(starts, [*starts[1:], len(log)])]


def _write_if_new(path, data):
    if path.exists() and path.read_bytes() == data:
        return
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_bytes(data)


def _remove_others(names):
    wanted = {SOURCE / name for name in names}
    for path in SOURCE.rglob("*"):
        if path.is_file() and path not in wanted:
            path.unlink()


def configure():
    header = ROOT / "tests/mutants/mutant.h"
    command = ["cmake", "-S", SOURCE, "-B", BINARY, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release"]
    command += ["-DPCL_BV_BUILD_BENCHMARKS=OFF", "-DCMAKE_DISABLE_PRECOMPILE_HEADERS=ON", "--no-warn-unused-cli"]
    command += [f"-DCMAKE_CXX_FLAGS={FLAGS} -include {header}", f"-DCMAKE_CXX_FLAGS_RELEASE={OPTIMISED}"]
    if shutil.which("ccache"):
        command += ["-DCMAKE_CXX_COMPILER_LAUNCHER=ccache"]
    subprocess.run(command, check=True, stdout=subprocess.DEVNULL)


def targets():
    """The test programs that there are."""
    wanted = set()
    for folder in TEST_FOLDERS:
        text = (ROOT / "tests" / folder / "CMakeLists.txt").read_text()
        wanted |= {"test_" + name for name in re.findall(r"pcl_bv_test\((\w+)", text)}
    listed = subprocess.run(["ninja", "-C", BINARY, "-t", "targets", "all"], check=True, capture_output=True, text=True)
    there = set(re.findall(r"^(\w+): phony", listed.stdout, re.MULTILINE))
    return sorted((wanted & there) - PEERS)


def build(sources, jobs, say):
    """Writes, compiles, leaves out what does not compile, until all does. Returns the programs."""
    sources.write()
    configure()
    names = targets()
    libraries = [f"pcl_bv_{m}" for m in MODULES]
    for goal in (libraries, names):
        for _ in range(30):
            say(f"building {len(sources.mutants)} mutants: {' '.join(goal)}")
            done = subprocess.run(["ninja", "-C", BINARY, "-k", "0", f"-j{jobs}", *goal], capture_output=True, text=True)
            if done.returncode == 0:
                break
            log = done.stdout + done.stderr
            (BUILD / "errors.txt").write_text(log)
            count = sources.drop(log)
            if count == 0:
                raise SystemExit(f"the mutants do not compile, for reasons in {BUILD / 'errors.txt'}")
            say(f"left out: {count} that do not compile")
            sources.write()
    found = {path.name: path for path in BINARY.rglob("test_*") if path.is_file() and os.access(path, os.X_OK)}
    return [found[name] for name in names]
