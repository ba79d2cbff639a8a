#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
# SPDX-License-Identifier: BSD-3-Clause
"""Compares whole processes that find the objects of a map: pcd_bv on tiles and on one file, and peers on one file.
The map is a generated town without its ground. Writes the table of docs/many-machines.md.

usage: benchmarks/objects.py BUILD_DIR [--tiles N] [--points N] [--turns N] [--limit S] [--folder DIR]
                             [--no-peers] [--page FILE] [--dry]

N tiles (default 64) of N points on average, with the ground (default 200000), need 3.6 MB of disk for each. A peer that
fails, needs more than the memory or more than S seconds (default 300) is tried again on a square of a quarter of the
tiles. --page writes the section of another page than docs/many-machines.md, --dry none.

Peers: PCL (the target pcl_load of this build), Open3D (Debian's python3-open3d), CloudCompare (cloudcompare; 0.1 GB)
and PDAL (pdal, which Debian 12 lacks). Missing ones are named and left out; --no-peers leaves out all.
"""
import os
import pathlib
import re
import shutil
import statistics
import subprocess
import sys
import tempfile
import time

from arguments import Parser, Section, count, existing_folder, page_with
from scale import PAGE, processor

TOLERANCE, MIN_SIZE = 0.5, 10
OWN = 2  # of the programs are no peers
OPEN3D = """
import sys
import numpy, open3d
cloud = open3d.io.read_point_cloud(sys.argv[1])
labels = numpy.asarray(cloud.cluster_dbscan(float(sys.argv[2]), 1))
print((numpy.bincount(labels) >= int(sys.argv[3])).sum(), "clusters")
"""


class Failed(Exception):
    """Why a program gave no result."""


class Process:
    """A finished process: its output, seconds and peak memory."""

    def __init__(self, command, limit):
        with tempfile.TemporaryFile() as output:
            begin = time.monotonic()
            child = subprocess.Popen(
                command, stdout=output, stderr=subprocess.STDOUT, env={**os.environ, "QT_QPA_PLATFORM": "offscreen"}
            )
            status, usage = self.wait(child, begin + limit)
            self.seconds = time.monotonic() - begin
            self.mebibytes = usage.ru_maxrss / 1024
            output.seek(0)
            self.text = output.read().decode(errors="replace")
        if status != 0:
            raise Failed(f"ran {self.seconds:.0f} s, status {os.waitstatus_to_exitcode(status)}: {self.text[-200:]}")

    @staticmethod
    def wait(child, end):
        while True:
            pid, status, usage = os.wait4(child.pid, os.WNOHANG)
            if pid != 0:
                child.returncode = os.waitstatus_to_exitcode(status)
                return status, usage
            if time.monotonic() > end or memory_left() < 0.5e9:
                child.kill()
            time.sleep(0.002)


def memory_left():
    for line in pathlib.Path("/proc/meminfo").read_text().splitlines():
        if line.startswith("MemAvailable:"):
            return int(line.split()[1]) * 1024
    return 1e12


class Part:
    """The first `tiles` tiles of a town, in a folder, and as one file of each format."""

    def __init__(self, build, folder, tiles, points):
        self.tiles, self.folder = tiles, folder / f"tiles{tiles}"
        subprocess.run([f"{build}/bin/synth", f"town-objects:{tiles}:1:{points}", self.folder], check=True)
        self.points, self.pcd, self.ply = 0, folder / f"{tiles}.pcd", folder / f"{tiles}.ply"
        self.side = 100 * max(int(name.stem[:3]) + 1 for name in self.folder.iterdir())
        records = [path.read_bytes().split(b"DATA binary\n", 1)[1] for path in sorted(self.folder.iterdir())]
        self.points = sum(map(len, records)) // 16  # x, y, z, object
        header = f"FIELDS x y z object\nSIZE 4 4 4 4\nTYPE F F F U\nCOUNT 1 1 1 1\nWIDTH {self.points}\nHEIGHT 1\n"
        header = f"VERSION 0.7\n{header}VIEWPOINT 0 0 0 1 0 0 0\nPOINTS {self.points}\nDATA binary\n"
        properties = "property float x\nproperty float y\nproperty float z\nproperty uint object\nend_header\n"
        ply = f"ply\nformat binary_little_endian 1.0\nelement vertex {self.points}\n{properties}"
        for path, text in ((self.pcd, header), (self.ply, ply)):
            with open(path, "wb") as file:
                file.write(text.encode())
                for record in records:
                    file.write(record)


class Program:
    """A way to find the objects of a part: its command, and the number of objects in its output."""

    def __init__(self, name, missing, command, count):
        self.name, self.missing, self.command, self.count = name, missing, command, count

    def run(self, part, limit):
        done = Process(list(map(str, self.command(part))), limit)
        return done, self.count(done.text)


def has_open3d():
    return subprocess.run(["/usr/bin/python3", "-c", "import open3d"], capture_output=True, check=False).returncode == 0


def octree_level(part):
    """Of the level whose cells are nearest to half of the tolerance or smaller: neighbours are in cells that touch."""
    level = 1
    while part.side / 2**level > TOLERANCE:
        level += 1
    return level


def programs(build):
    # The output of --format csv has a header and a line for each object.
    own = [f"{build}/bin/pcd_bv", "--cluster", TOLERANCE, "--min-size", MIN_SIZE, "--volume", "aabb", "--format", "csv"]

    def lines(text):
        return len(text.splitlines())

    def number(pattern):
        return lambda text: int(re.search(pattern, text)[1])

    def pdal(part):
        output = part.folder.parent / "pdal.las"
        options = [f"--filters.cluster.tolerance={TOLERANCE}", f"--filters.cluster.min_points={MIN_SIZE}"]
        return ["pdal", "translate", part.ply, output, "cluster", *options, "--writers.las.extra_dims=all"]

    cloud_compare = ["CloudCompare", "-SILENT", "-AUTO_SAVE", "OFF", "-O"]
    return [
        Program("`pcd_bv --together`", None, lambda p: [*own, "--together", p.folder], lambda text: lines(text) - 1),
        Program("`pcd_bv`", None, lambda p: [*own, p.pcd], lambda text: lines(text) - 1),
        Program(
            "PCL",
            None if pathlib.Path(f"{build}/bin/pcl_load").exists() else "no target pcl_load in this build",
            lambda p: [f"{build}/bin/pcl_load", TOLERANCE, p.pcd],
            lines,
        ),
        Program(
            "Open3D",
            None if has_open3d() else "python3-open3d is not installed",
            lambda p: ["/usr/bin/python3", "-c", OPEN3D, p.pcd, TOLERANCE, MIN_SIZE],
            number(r"(\d+) clusters"),
        ),
        Program(
            "CloudCompare",
            None if shutil.which("CloudCompare") else "cloudcompare is not installed",
            lambda p: [*cloud_compare, p.ply, "-EXTRACT_CC", octree_level(p), MIN_SIZE],
            number(r"(\d+) component"),
        ),
        Program("PDAL", None if shutil.which("pdal") else "pdal is not installed", pdal, lambda text: None),
    ]


def largest_part(program, parts, limit):
    """Runs the program once on the largest part that it can process. Returns this part, or None."""
    for part in parts:
        try:
            program.run(part, limit)
            return part
        except Failed as why:
            print(f"{program.name}: {part.tiles} tiles: {why}", file=sys.stderr)
    return None


def measure(jobs, turns, limit):
    """Runs of each job; the jobs take turns, so that a busy moment affects all of them."""
    runs = {job: [] for job in jobs}
    for _ in range(turns):
        for (program, part), done in runs.items():
            done.append(program.run(part, limit))
    return runs


def row(program, part, done, expected):
    seconds = statistics.median(process.seconds for process, _ in done)
    memory = max(process.mebibytes for process, _ in done)
    objects = done[0][1]
    text = "-" if objects is None else str(objects)
    if objects is not None and objects != expected:
        text += f" ({objects - expected:+d})"
    return (
        f"| {program.name} | {part.tiles} | {part.points / 1e6:.2f} M | {seconds:.2f} "
        f"| {part.points / seconds / 1e6:.2f} M | {memory:.0f} | {text} |"
    )


def page_part(runs, absent, turns):
    expected = {part: done[0][1] for (program, part), done in runs.items() if program.name == "`pcd_bv`"}
    text = [
        f"{processor()}, {os.cpu_count()} processors, whole processes with files in the page cache, medians of {turns} "
        f"runs in turns. Tolerance {TOLERANCE} m, objects of {MIN_SIZE} points or more.",
        "",
        "| program | tiles | points | seconds | points/s | peak MiB | objects |",
        "|---|---|---|---|---|---|---|",
        *(row(program, part, done, expected[part]) for (program, part), done in runs.items()),
        "",
        "A number in parentheses is the difference from `pcd_bv` on the same points. CloudCompare joins cells of an "
        "octree that touch, not points, so it finds other objects by definition.",
    ]
    if absent:
        text += ["", "Left out: " + "; ".join(absent) + "."]
    return "\n".join(text)


def main():
    parser = Parser(__doc__, ["synth", "pcd_bv"])
    parser.add_argument("--tiles", type=count, default=64)
    parser.add_argument("--points", type=count, default=200_000)
    parser.add_argument("--turns", type=count, default=3)
    parser.add_argument("--limit", type=float, default=300)
    parser.add_argument("--folder", type=existing_folder, help="where the tiles are made, and removed")
    parser.add_argument("--no-peers", dest="peers", action="store_false")
    parser.add_argument("--page", type=page_with("objects.py"), default=str(PAGE))
    parser.add_argument("--dry", action="store_true")
    options = parser.parse_args()
    known = programs(options.build)[: None if options.peers else OWN]
    absent = [f"{program.name} ({program.missing})" for program in known if program.missing]
    with tempfile.TemporaryDirectory(dir=options.folder) as work:
        parts = []
        tiles = options.tiles
        while tiles >= 1 and len(parts) < 4:
            parts.append(Part(options.build, pathlib.Path(work), tiles, options.points))
            tiles //= 4
        jobs = {}
        for program in known:
            part = None if program.missing else largest_part(program, parts, options.limit)
            if part:
                jobs[known[1], part] = None  # the reference for the number of objects
                jobs[program, part] = None
        order = sorted(jobs, key=lambda job: (-job[1].tiles, known.index(job[0])))
        runs = measure(order, options.turns, options.limit)
    page = page_part(runs, absent, options.turns)
    print(page)
    if not options.dry:
        Section("objects.py", options.page).write(page)


if __name__ == "__main__":
    main()
