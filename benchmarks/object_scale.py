# SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
# SPDX-License-Identifier: BSD-3-Clause
"""Models pcd_bv_mpi --together --cluster on up to 1 024 ranks and 10^12 points. What a point, an object and a message
cost is measured on a small town; the model is then compared with runs on a town of four times as many tiles."""
import json
import math
import os
import pathlib
import re
import statistics
import subprocess
import tempfile
import time

from object_index import Counts, Index

OPTIONS = ["--cluster", "0.5", "--volume", "obb-pca"]
RECORD = 20  # bytes of a point in a file, of floats
THREADS = 8  # of the first rank: the ranks of its machine
LIMIT = 2**31  # bytes of the cells of all ranks, in a message
FIT_SHARES, CHECK_RANKS = (2, 4, 8, 16), (1, 2)


def peak_of(pid):
    """Maximum memory of a running process in bytes. (That of getrusage() includes this process before exec.)"""
    found = re.search(r"VmHWM:\s*(\d+) kB", pathlib.Path(f"/proc/{pid}/status").read_text())
    return 1024 * int(found[1]) if found else 0  # none when it has ended


def seconds_of(command):
    """Wall time, maximum memory in bytes, and what a command with --timings says on its line of JSON."""
    environment = {**os.environ, "OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"}
    with tempfile.TemporaryFile() as output:
        begin, memory = time.monotonic(), 0
        with subprocess.Popen(list(map(str, command)), env=environment, stdout=output) as child:
            while child.poll() is None:
                memory = max(memory, peak_of(child.pid))
                time.sleep(0.001)
        wall = time.monotonic() - begin
        if child.returncode != 0:
            raise subprocess.CalledProcessError(child.returncode, command)
        output.seek(0)
        text = output.read()
    report = json.loads(text) if text.startswith(b"{") else {"points": 0, "seconds": {}, "clusters": []}
    said = {"points": report["points"], "objects": len(report["clusters"]), **report["seconds"]}
    return {"wall": wall, "memory": memory, **said}


def medians(commands, turns):
    """Medians of each command; the commands take turns, so that a busy moment hits all alike."""
    runs = {name: [] for name in commands}
    for _ in range(turns):
        for name, command in commands.items():
            runs[name].append(seconds_of(command))
    return {name: {key: statistics.median(run[key] for run in done) for key in done[0]} for name, done in runs.items()}


class Town:
    """A town of tiles, and files of its shares."""

    def __init__(self, build, folder, tiles, points):
        self.build, self.tiles, self.folder = build, tiles, folder / f"town{tiles}"
        subprocess.run([f"{build}/bin/synth", f"town-objects:{tiles}:1:{points}", self.folder], check=True)
        for path in self.folder.iterdir():  # into the page cache
            path.read_bytes()

    def shares(self, count):
        """The files of shares."""
        files = [self.folder.parent / f"part{self.tiles}_{number}_{count}" for number in range(count)]
        for number, file in enumerate(files):
            command = [f"{self.build}/bin/pcd_bv", "--partial", file, "--part", f"{number}/{count}"]
            subprocess.run([*command, *OPTIONS, self.folder], check=True)
        return files

    def on_ranks(self, ranks):
        command = ["mpirun", "--oversubscribe", "-n", ranks, f"{self.build}/bin/pcd_bv_mpi", "--together"]
        return [*command, *OPTIONS, "--timings", "--format", "jsonl", self.folder]

    def merging(self, files):
        command = [f"{self.build}/bin/pcd_bv", "--merge", "--threads", 1, "--timings", "--format", "jsonl"]
        return [*command, *OPTIONS, *files]


def sides(tiles, ranks):
    """Sides of tiles between shares of a square town. Tiles are in the order of columns, so are shares."""
    columns = math.sqrt(tiles)
    return (min(ranks, columns) - 1) * columns + max(0, ranks - columns)


class Model:
    """Seconds and bytes of a run on a town of any size."""

    def __init__(self, town, counts, times):
        one = counts[1]
        self.tile = one.points / town.tiles  # points
        self.objects, self.components = one.objects / one.points, one.components / one.points
        self.text, self.cells = one.text_bytes / one.objects, one.cells / one.points
        self.cubes = one.cubes / one.points
        borders = sum(sides(town.tiles, n) for n in FIT_SHARES)
        # Where a border lies between houses matters, so it takes several to know what a side has.
        self.near = {}
        for what in ("written", "active"):
            self.near[what] = sum(getattr(counts[n], what) for n in FIT_SHARES) / borders
        alone, shared, merged = times["mpi1"], times["merge_shares"], times["merge1"]
        self.join = alone["segment"] / one.components  # a component that is one run
        self.read_text = merged["fit"] / one.objects
        output = merged["wall"] - times["start"]["wall"] - merged["segment"] - merged["fit"]
        self.output = max(0.0, output) / one.objects
        self.again = max(0.0, shared["segment"] - merged["segment"]) / counts[FIT_SHARES[-1]].active
        larger = times["merge_larger"]
        more = max(0.0, larger["memory"] - merged["memory"])
        self.memory = more / (larger["objects"] - merged["objects"])
        rest = alone["wall"] - times["start1"]["wall"] - self.merging(one.points, 1, 1)
        self.read = max(rest / one.points, 1e-9)  # a small town takes less than what the start of ranks varies

    def near_points(self, what, points, ranks):
        return min(points, self.near[what] * sides(points / self.tile, ranks)) if ranks > 1 else 0

    def merging(self, points, ranks, threads):
        objects = points * self.objects
        own = points * self.components * self.join + objects * (self.read_text / threads + self.output)
        return own + self.near_points("active", points, ranks) * self.again / threads

    def index_bytes(self, points):
        return points * (self.components * (24 + 16 + 16) + self.objects * self.text)

    def message_bytes(self, points, ranks):
        """Of the cells that a rank gets: of all cubes, and of the cells of cubes near other shares at most."""
        cube_side = 128  # metres; a tile has 100
        near_tiles = sides(points / self.tile, ranks) * 2 * (cube_side / 100 + 1) if ranks > 1 else 0
        cells = min(points, near_tiles * self.tile) * self.cells
        return 8 * (points * self.cubes + cells)

    def seconds(self, points, ranks, latency, bandwidth, threads=THREADS):
        files = self.index_bytes(points) + RECORD * self.near_points("written", points, ranks)
        messages = 0
        if ranks > 1:  # two times the lengths, by a tree, and the cells, by a ring
            steps = 2 * (math.ceil(math.log2(ranks)) + ranks - 1)
            messages = steps * latency + self.message_bytes(points, ranks) / bandwidth
        share = points / ranks * self.read + files / ranks / bandwidth
        return share + messages + files / bandwidth + self.merging(points, ranks, min(threads, ranks))

    def first_memory(self, points):
        return points * self.objects * self.memory


def version(build, ranks):
    """A command that only starts: that of one process, or of ranks."""
    mpi = ["mpirun", "--oversubscribe", "-n", ranks, f"{build}/bin/pcd_bv_mpi"]
    return [*(mpi if ranks else [f"{build}/bin/pcd_bv"]), "--version"]


def measure(build, folder, tiles, points, turns):
    """The model, and the times of runs on the larger town: (town's points, ranks, seconds)."""
    small, large = Town(build, folder, tiles, points), Town(build, folder, 4 * tiles, points)
    files = {count: small.shares(count) for count in (1, *FIT_SHARES)}
    counts = {count: Counts([Index(file) for file in of_count]) for count, of_count in files.items()}
    if counts[1].objects == 0 or counts[FIT_SHARES[-1]].active == 0:
        raise SystemExit("the town has no objects near other shares: give more tiles or points")
    commands = {"start": version(build, 0), "mpi1": small.on_ranks(1)}
    commands |= {f"start{n}": version(build, n) for n in CHECK_RANKS}
    commands |= {"merge1": small.merging(files[1]), "merge_shares": small.merging(files[FIT_SHARES[-1]])}
    commands["merge_larger"] = large.merging(large.shares(1))
    commands |= {n: large.on_ranks(n) for n in CHECK_RANKS}
    times = medians(commands, turns)
    checks = []
    for n in CHECK_RANKS:
        checks.append((times[n]["points"], n, max(0.0, times[n]["wall"] - times[f"start{n}"]["wall"])))
    return Model(small, counts, times), checks


def size(count):
    for unit, least in (("TB", 1e12), ("GB", 1e9), ("MB", 1e6)):
        if count >= least:
            return f"{count / least:.3g} {unit}"
    return f"{count / 1e3:.3g} kB"


def constants(model, tiles, points):
    rows = [
        ("reading, clustering and fitting a share", f"{1e-6 / model.read:.2f} M points/s a rank"),
        ("sizes", f"{1 / model.components:.0f} points a cluster; {1 / model.objects:.0f} for each object (10 or more)"),
        ("merging", f"{model.join * 1e6:.2f} us a cluster, {model.read_text * 1e6:.1f} us to read an object, "
                    f"{model.output * 1e6:.1f} us to write it, {model.again * 1e6:.2f} us a point near other shares"),
        ("files", f"{model.index_bytes(1) / model.objects:.0f} B an object, "
                  f"{RECORD} B a point of a cluster near other shares"),
        ("near other shares", f"{model.near['active']:.0f} points a side of a tile between shares, and "
                              f"{model.near['written']:.0f} points of clusters that are written"),
        ("messages", f"8 B a cell near other shares, which has {1 / model.cells:.0f} points"),
        ("memory of the first rank", f"{model.memory:.0f} B an object"),
    ]
    return [f"Measured on {tiles} tiles with {points / 1e6:.2f} M points:", "", "| what | how much |", "|---|---|",
            *(f"| {what} | {how} |" for what, how in rows)]


def checked_rows(model, checks):
    rows = ["| points | ranks | seconds | model |", "|---|---|---|---|"]
    for points, ranks, seconds in checks:
        local = model.seconds(points, ranks, 1e-6, 5e9)
        rows.append(f"| {points / 1e6:.2f} M | {ranks} | {seconds:.2f} | {local:.2f} |")
    return rows


def modelled_rows(model, duration, latency, bandwidth):
    ranks = (1, 8, 64, 512, 1024)
    rows = ["| points | " + " | ".join(f"{n} ranks" for n in ranks) + " | merging of 1024 | memory of the first rank |"]
    rows.append("|---" * (len(ranks) + 3) + "|")
    for power in (9, 10, 11, 12):
        points = 10**power
        cells = [duration(model.seconds(points, n, latency, bandwidth)) for n in ranks]
        cells = [cell + (" (*)" if model.message_bytes(points, n) > LIMIT else "") for cell, n in zip(cells, ranks)]
        cells += [duration(model.merging(points, ranks[-1], THREADS)), size(model.first_memory(points))]
        rows.append(f"| 10^{power} | " + " | ".join(cells) + " |")
    return rows


def page_part(model, checks, tiles, duration, network):
    latency, bandwidth = network
    text = [
        *constants(model, tiles, model.tile * tiles),
        "",
        f"Runs on {4 * tiles} tiles, to which the times of the model were not fitted, without the start of the ranks:",
        "",
        *checked_rows(model, checks),
        "",
        f"Modelled, for a first machine of {THREADS} ranks and a network of {latency * 1e6:.0f} us and "
        f"{bandwidth / 1e9:.1f} GB/s:",
        "",
        *modelled_rows(model, duration, latency, bandwidth),
    ]
    cells = size(model.message_bytes(10**11, 512))
    text += ["", f"Each rank also needs `--memory`, and gets {cells} of cells for 10^11 points on 512 ranks."]
    if any("(*)" in row for row in text):
        text += ["", "(*) The cells near other shares are more than 2 GiB, the limit of a message: use fewer ranks, "
                 "or `--partial` and `--merge`."]
    return "\n".join(text)
