#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
# SPDX-License-Identifier: BSD-3-Clause
"""Measures one cloud over 1, 2, 4 and 8 ranks of this machine, models up to 1 024 ranks and 10^12 points from what
one rank, one merge and one message cost, and writes docs/benchmarks/scale.svg and the table of docs/many-machines.md.
Then does the same for objects (object_scale.py).

usage: benchmarks/scale.py BUILD_DIR [--points N] [--tiles N] [--turns N] [--folder DIR]
                           [--only volumes|objects] [--page FILE] [--dry]

Needs 12 bytes of disk and of page cache for each point (default 64 million points in 64 tiles); for objects 30 MB for
each of the tiles of a town (default 36). --page writes the sections of another page, --dry nothing.
"""
import math
import os
import pathlib
import platform
import re
import statistics
import subprocess
import tempfile
import time

import object_scale
from arguments import Parser, Section, count, existing_folder, page_with
from svg import SERIES, Chart

ROOT = pathlib.Path(__file__).resolve().parent.parent
VOLUMES, OBJECTS = "scale.py", "scale.py objects"  # sections of the page
PAGE, PLOT = ROOT / "docs/many-machines.md", ROOT / "docs/benchmarks/scale.svg"
TILES = 64
ONE_PASS, ROUNDS = "aabb,dop26,obb-pca,obb-yaw", "aabb,dop26,obb-pca,obb-yaw,sphere"
RANKS = (1, 2, 4, 8)
# Of the network between machines, which one machine cannot measure: 10 Gbit/s, and what MPI over TCP takes.
LATENCY, BANDWIDTH = 50e-6, 1.2e9
COSTS = re.compile(
    r"(\d+) ranks: ([\d.]+) s wall time, ([\d.]+) s CPU time, (\d+) query rounds, (\d+) messages with (\d+) bytes "
    r"in total, maximum memory of a rank (\d+) KiB"
)


class Run:
    """What pcd_bv_mpi says of itself."""

    def __init__(self, build, ranks, volumes, inputs):
        environment = {**os.environ, "OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"}
        command = ["mpirun", "--oversubscribe", "-n", str(ranks), f"{build}/bin/pcd_bv_mpi", "--together"]
        command += ["--timings", "--volume", volumes, "--format", "jsonl", inputs]
        begin = time.monotonic()
        done = subprocess.run(command, env=environment, check=True, capture_output=True, text=True)
        self.wall = time.monotonic() - begin  # with the start of the ranks
        self.text = re.sub(r',"seconds".*', "", done.stdout)
        costs = COSTS.search(done.stderr)
        self.seconds, self.work = float(costs[2]), float(costs[3])
        self.rounds, self.messages, self.bytes, self.memory = (int(costs[i]) for i in range(4, 8))


def make_tiles(build, folder, points):
    for tile in range(TILES):
        scene = f"gauss:{points // TILES}:{tile + 1}"
        subprocess.run([f"{build}/bin/synth", scene, f"{folder}/{tile:02}.pcd"], check=True, stdout=subprocess.DEVNULL)
    for path in sorted(pathlib.Path(folder).iterdir()):  # into the page cache
        path.read_bytes()


def measure(build, folder, turns):
    """Medians by volumes and ranks; the runs take turns, so that a busy moment hits all alike."""
    runs = {(volumes, ranks): [] for volumes in (ONE_PASS, ROUNDS) for ranks in RANKS}
    for _ in range(turns):
        for (volumes, ranks), done in runs.items():
            done.append(Run(build, ranks, volumes, folder))
    for volumes in (ONE_PASS, ROUNDS):
        texts = {run.text for ranks in RANKS for run in runs[volumes, ranks]}
        if len(texts) != 1:
            raise SystemExit("the ranks' results differ")
    return runs


def median(runs, what):
    return statistics.median(getattr(run, what) for run in runs)


def merging(build, folder, work):
    """Bytes of a share's results and seconds to read and merge one more of them."""
    files = []
    for share in range(16):
        files.append(f"{work}/{share}.part")
        subprocess.run([f"{build}/bin/pcd_bv", "--partial", files[-1], "--part", f"{share}/16", folder], check=True)
    size = statistics.mean(pathlib.Path(file).stat().st_size for file in files)

    def seconds(count):
        least = math.inf
        for _ in range(5):
            begin = time.monotonic()
            command = [f"{build}/bin/pcd_bv", "--merge", "--partial", f"{work}/all", *files[:count]]
            subprocess.run(command, check=True)
            least = min(least, time.monotonic() - begin)
        return least

    return size, max(0.0, (seconds(16) - seconds(1)) / 15)


class Model:
    """Seconds of a run: reading, and what grows with the depth of the tree of ranks."""

    def __init__(self, runs, points, size, merge):
        one, rounds = runs[ONE_PASS, 1], runs[ROUNDS, 1]
        self.rounds = int(median(rounds, "rounds"))
        self.read = median(one, "seconds") / points
        self.ask = max(0.0, median(rounds, "seconds") - median(one, "seconds")) / points / max(1, self.rounds)
        self.size, self.merge = size, merge

    def per_point(self):
        return self.read + self.rounds * self.ask

    def seconds(self, points, ranks, latency=LATENCY, bandwidth=BANDWIDTH):
        depth = math.ceil(math.log2(ranks)) if ranks > 1 else 0
        tree = depth * (latency + self.size / bandwidth + self.merge)
        answers = self.rounds * depth * 2 * latency  # the question down, the answers up
        return points / ranks * self.per_point() + tree + answers


def measured_rows(runs, model, points):
    rows = ["| ranks | seconds | over one | model | work over one | messages | bytes | KiB a rank |"]
    rows.append("|---|---|---|---|---|---|---|---|")
    first = runs[ROUNDS, 1]
    for ranks in RANKS:
        now = runs[ROUNDS, ranks]
        seconds, work = median(now, "seconds"), median(now, "work")
        wall = ranks <= (os.cpu_count() or 1)  # more ranks than processors say nothing about time
        local = model.seconds(points, ranks, 1e-6, 5e9)
        rows.append(
            f"| {ranks} | {f'{seconds:.2f}' if wall else '-'} "
            f"| {'%.2fx' % (median(first, 'seconds') / seconds) if wall else '-'} | {f'{local:.2f}' if wall else '-'} "
            f"| {work / median(first, 'work'):.2f} | {median(now, 'messages'):.0f} "
            f"| {median(now, 'bytes'):.0f} | {median(now, 'memory'):.0f} |"
        )
    return rows


def duration(seconds):
    for unit, size, least in (("h", 3600, 7200), ("min", 60, 120), ("s", 1, 1)):
        if seconds >= least:
            return f"{seconds / size:.3g} {unit}"
    return f"{seconds * 1e3:.3g} ms"


def modelled_rows(model):
    ranks = (1, 8, 64, 512, 1024)
    rows = ["| points | " + " | ".join(f"{n} ranks" for n in ranks) + " |", "|---" * (len(ranks) + 1) + "|"]
    for power in (9, 10, 11, 12):
        cells = [duration(model.seconds(10**power, n)) for n in ranks]
        rows.append(f"| 10^{power} | " + " | ".join(cells) + " |")
    return rows


def plot(runs, model, points):
    chart = Chart("One cloud over ranks: measured, and modelled", "ranks", "seconds", (1, 1024), (0.01, 1e5))
    chart.x_ticks([(4**i, str(4**i)) for i in range(6)])
    chart.y_ticks([10**i for i in range(-2, 6)])
    for power, colour in zip((9, 10, 11, 12), SERIES):
        line = [(2**i, model.seconds(10**power, 2**i)) for i in range(11)]
        chart.line(line, colour, f"10^{power} points", dashed=True)
    shown = [n for n in RANKS if n <= (os.cpu_count() or 1)]
    chart.line([(n, median(runs[ROUNDS, n], "seconds")) for n in shown], SERIES[4], f"{points / 1e6:.0f} M, measured")
    return chart.text()


def processor():
    for line in pathlib.Path("/proc/cpuinfo").read_text().splitlines():
        if line.startswith("model name"):
            return line.split(":")[1].strip()
    return platform.machine()


def page_part(runs, model, points):
    cores = os.cpu_count()
    pace = f"One rank reads and fits {1e-6 / model.read:.0f} M points/s in a pass"
    if model.ask > 0:
        pace += f" and {1e-6 / model.ask:.0f} in a round of the sphere"
    text = [
        f"{processor()}, {cores} processors, {points / 1e6:.0f} M points in {TILES} tiles in the page cache, "
        f"`--volume {ROUNDS}`, one thread a rank, medians of {len(runs[ROUNDS, 1])} runs in turns. {pace}; rounds: "
        f"{model.rounds}; a share's results are {model.size / 1e3:.0f} kB and merged in {model.merge * 1e3:.1f} ms.",
        "",
        *measured_rows(runs, model, points),
        "",
        f"Modelled, for ranks that read at that pace ({12e-9 / model.read:.1f} GB/s each) and a network of "
        f"{LATENCY * 1e6:.0f} us and {BANDWIDTH / 1e9:.1f} GB/s:",
        "",
        *modelled_rows(model),
        "",
        "![seconds by ranks](benchmarks/scale.svg)",
    ]
    return "\n".join(text)


def measure_volumes(asked):
    with tempfile.TemporaryDirectory(dir=asked.folder) as tiles, tempfile.TemporaryDirectory() as work:
        make_tiles(asked.build, tiles, asked.points)
        runs = measure(asked.build, tiles, asked.turns)
        size, merge = merging(asked.build, tiles, work)
    model = Model(runs, asked.points, size, merge)
    part = page_part(runs, model, asked.points)
    print(part)
    if not asked.dry:
        PLOT.write_text(plot(runs, model, asked.points))
        Section(VOLUMES, asked.page).write(part)


def measure_objects(asked):
    with tempfile.TemporaryDirectory(dir=asked.folder) as work:
        model, checks = object_scale.measure(
            asked.build, pathlib.Path(work), asked.tiles, asked.tile_points, asked.turns
        )
    part = f"{processor()}, {os.cpu_count()} processors, `{' '.join(object_scale.OPTIONS)}`, one thread a rank, files "
    part += f"in the page cache, medians of {asked.turns} runs in turns.\n\n"
    part += object_scale.page_part(model, checks, asked.tiles, duration, (LATENCY, BANDWIDTH))
    print(part)
    if not asked.dry:
        Section(OBJECTS, asked.page).write(part)


def main():
    parser = Parser(__doc__, ["synth", "pcd_bv", "pcd_bv_mpi"])
    parser.add_argument("--points", type=count, default=64_000_000)
    parser.add_argument("--tiles", type=count, default=36)
    parser.add_argument("--tile-points", type=count, default=200_000, help="of the town, with the ground")
    parser.add_argument("--turns", type=count, default=5)
    parser.add_argument("--folder", type=existing_folder, help="where the tiles are made, and removed")
    parser.add_argument("--only", choices=["volumes", "objects"])
    parser.add_argument("--page", type=page_with(VOLUMES, OBJECTS), default=str(PAGE))
    parser.add_argument("--dry", action="store_true")
    asked = parser.parse_args()
    if asked.only != "objects":
        measure_volumes(asked)
    if asked.only != "volumes":
        measure_objects(asked)


if __name__ == "__main__":
    main()
