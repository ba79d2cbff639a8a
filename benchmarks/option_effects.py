#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
# SPDX-License-Identifier: BSD-3-Clause
"""Prints what each option of the pipeline and the tracker changes on recorded sweeps, as a table of Markdown: an option
that changes nothing, and of which no line says so, is a defect.

usage: benchmarks/option_effects.py BUILD_DIR FOLDER_OF_CLOUDS
"""
import collections
import json
import pathlib
import subprocess
import sys
import tempfile

Run = collections.namedtuple("Run", "frames said")
BASE = ["--track", "--volume", "obb-lshape"]
STEADY = ["--smooth", "--grow"]
LARGE = ["--max-size", "500"]


class Stream:
    def __init__(self, build, folder, work):
        self.bin, self.folder, self.work = pathlib.Path(build) / "bin", folder, work

    def run(self, options, source=None):
        command = [self.bin / "bv_stream", "--source", source or self.folder, "--rate", "max", *options]
        done = subprocess.run([str(part) for part in command], capture_output=True, text=True)
        if done.returncode != 0:
            raise SystemExit(done.stderr)
        said = [line.removeprefix("bv_stream: ") for line in done.stderr.splitlines()]
        return Run([json.loads(line) for line in done.stdout.splitlines()], said)

    def file(self, name, text):
        path = self.work / name
        path.write_text(text)
        return path

    def settings(self, stage, **values):
        text = f"{stage}:\n" + "".join(f"  {key}: {value}\n" for key, value in values.items())
        return ["--config", self.file(f"{stage}_{'_'.join(values)}.yaml", text)]


def boxes(run):
    """The first volume of each tracked object, by frame and cluster."""
    return {(frame["seq"], cluster["id"]): cluster["volumes"][0] for frame in run.frames
            for cluster in frame["clusters"] if cluster["track"] is not None}


def as_counter(run):
    return collections.Counter(json.dumps(volume) for volume in boxes(run).values())


def row(name, base, changed):
    before, after = as_counter(base), as_counter(changed)
    same = sum((before & after).values())
    clusters = [sum(len(frame["clusters"]) for frame in run.frames) for run in (base, changed)]
    ids = [len({c["track"] for f in run.frames for c in f["clusters"]} - {None}) for run in (base, changed)]
    counts = collections.Counter()
    for run, sign in ((base, -1), (changed, 1)):
        for frame in run.frames:
            counts.update({what: sign * points for what, points in frame["counts"].items()})
    moved = ", ".join(f"{what} {points:+}" for what, points in counts.items() if points)
    show = lambda pair: str(pair[0]) if pair[0] == pair[1] else f"{pair[0]} -> {pair[1]}"
    numbers = (show(clusters), show((before.total(), after.total())), show(ids), f"{same} of {before.total()}")
    new = [line for line in changed.said if line not in base.said]
    return f"| {name} | {' | '.join(numbers)} | {moved or '-'} | {new[0] if new else '-'} |"


def grown(base, steady):
    """How far boxes of the same points grew and turned, of those that are tracked."""
    before, after = boxes(base), boxes(steady)
    grew = turned = neither = same = 0
    for key, old in before.items():
        new = after[key]
        same += old["half_extents"] == new["half_extents"]
        # As sets of sizes: a mean turn may call the sides otherwise.
        larger = max(b - a for a, b in zip(sorted(old["half_extents"]), sorted(new["half_extents"])))
        cosines = [abs(sum(a * b for a, b in zip(old["axes"][0], axis))) for axis in new["axes"]]
        grew += larger > 0.005
        turned += max(cosines) < 1 - 1.5e-6  # 0.1 degrees
        neither += larger <= 0.005 and max(cosines) >= 1 - 1.5e-6
    return (f"{len(before)} boxes: {same} with the same half extents, {grew} larger by 1 cm, "
            f"{turned} turned by 0.1 degrees, {neither} neither")


def rows(stream):
    base = stream.run(BASE)
    robot = stream.file("inside.json", json.dumps(base.frames[0]))
    small = stream.file("small.json", json.dumps({**base.frames[0], "clusters": base.frames[0]["clusters"][:20]}))
    plane = BASE + ["--ground", "plane"]
    against = [
        ("--smooth", BASE, BASE + ["--smooth"]),
        ("--grow", BASE, BASE + ["--grow"]),
        *((f"--smooth --grow, {volume}", ["--track", "--volume", volume], ["--track", "--volume", volume, *STEADY])
          for volume in ("obb-yaw", "obb-min", "obb-pca", "aabb")),
        ("track.gate: 0.5", BASE, BASE + stream.settings("track", gate=0.5)),
        ("track.birth: 6", BASE, BASE + stream.settings("track", birth=6)),
        ("track.death: 1", BASE, BASE + stream.settings("track", death=1)),
        ("--drop-inside", BASE, BASE + ["--drop-inside", robot]),
        ("--drop-inside --padding 0.5", BASE + ["--drop-inside", robot],
         BASE + ["--drop-inside", robot, "--padding", "0.5"]),
        ("--keep-inside", BASE, BASE + ["--keep-inside", small]),
        ("filter.own_box_*", BASE,
         BASE + stream.settings("filter", own_box_min="[-5, -5, -2]", own_box_max="[5, 5, 2]")),
        ("--range 5:40", BASE, BASE + ["--range", "5:40"]),
        ("--ground none", BASE, BASE + ["--ground", "none"]),
        ("--ground plane", BASE, plane),
        ("--up 0.05,0,1", BASE, BASE + ["--up", "0.05,0,1"]),
        ("--sensor-height 1", BASE, BASE + ["--sensor-height", "1"]),
        ("--sensor-height 1, plane", plane, plane + ["--sensor-height", "1"]),
        ("--ground-distance 0.3", BASE, BASE + ["--ground-distance", "0.3"]),
        ("--ground-slope 5", BASE, BASE + ["--ground-slope", "5"]),
        ("ground.sensor: [3, 0, 0]", BASE, BASE + stream.settings("ground", sensor="[3, 0, 0]")),
        ("--cluster 0.3", BASE, BASE + ["--cluster", "0.3"]),
        ("--cluster 0.5:0.01", BASE, BASE + ["--cluster", "0.5:0.01"]),
        ("--deskew on", BASE, BASE + ["--deskew", "on"]),
        ("--concave 1, prism", ["--track", "--volume", "prism"], ["--track", "--volume", "prism", "--concave", "1"]),
        ("--refine off", BASE, BASE + ["--refine", "off"]),
        ("--refine neck", BASE, BASE + ["--refine", "neck"]),
        ("--min-size 50", BASE, BASE + ["--min-size", "50"]),
        ("--max-size 500", BASE, BASE + LARGE),
        ("--min-extent 0.3,0.3,0.5", BASE, BASE + ["--min-extent", "0.3,0.3,0.5"]),
        *((f"--min-extent {limit}", BASE, BASE + ["--min-extent", limit]) for limit in ("1,0,0", "0,0.3,0", "0,0,0.5")),
        *((f"--max-extent {limit}", BASE, BASE + ["--max-extent", limit])
          for limit in ("10,inf,inf", "inf,3,inf", "inf,inf,3")),
        ("--oversized keep, of 500", BASE + LARGE, BASE + LARGE + ["--oversized", "keep"]),
        ("--oversized split, of 500", BASE + LARGE, BASE + LARGE + ["--oversized", "split"]),
        ("--oversized split", BASE, BASE + ["--oversized", "split"]),
        ("--min-points 5", BASE, BASE + ["--min-points", "5"]),
        ("--growth stationary, sphere-epos26", ["--track", "--volume", "sphere-epos26"],
         ["--track", "--volume", "sphere-epos26", "--growth", "stationary"]),
        ("--growth stationary", BASE, BASE + ["--growth", "stationary"]),
        ("--threads 2", BASE + ["--threads", "1"], BASE + ["--threads", "2"]),
        ("--isa scalar", BASE, BASE + ["--isa", "scalar"]),
    ]
    for name, before, after in against:
        yield row(name, stream.run(before), stream.run(after))
    labels = stream.work / "labels"
    stream.run(["--volume", "aabb", "--cluster", "0.3", "--sink", f"labels:{labels}"])
    yield row("--class label", stream.run(BASE, labels), stream.run(BASE + ["--class", "label"], labels))
    for volume in ("obb-lshape", "obb-yaw"):
        with_volume = ["--track", "--volume", volume]
        yield f"\n--smooth --grow, {volume}: " + grown(stream.run(with_volume), stream.run(with_volume + STEADY))


def main():
    if len(sys.argv) != 3:
        raise SystemExit(__doc__)
    with tempfile.TemporaryDirectory() as folder:
        print("| option | objects | tracked | ids | boxes that stay the same | points and counts | said |")
        print("|---|---|---|---|---|---|---|")
        for line in rows(Stream(sys.argv[1], sys.argv[2], pathlib.Path(folder))):
            print(line, flush=True)


if __name__ == "__main__":
    main()
