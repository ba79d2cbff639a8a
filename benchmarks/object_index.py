# SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
# SPDX-License-Identifier: BSD-3-Clause
"""What merging shares of a cloud takes, counted in the indexes of their files of objects (pcd_bv --partial --cluster,
with --min-points 1)."""
import struct

PREAMBLE, RUN, COMPONENT = struct.Struct("<24s6Q"), struct.Struct("<QQII"), struct.Struct("<QQ")
TEXT = struct.Struct("<QQ")
NOISE, MASK, HALF = 0xFFFFFFFF, (1 << 21) - 1, 1 << 20
# Cells of 4 tolerances are those of runs, cells of 16 tolerances those of bricks; a cube has 16 of the latter a side.
CELLS, CUBES = 4, 16


class Index:
    """Runs as (cell, points, component), numbers of points of components, and texts."""

    def __init__(self, path):
        data = path.read_bytes()
        kind, records, texts, header, cloud, runs, components = PREAMBLE.unpack_from(data)
        if kind.rstrip(b"\0") != b"pcl_bv objects 1\n":
            raise ValueError(f"{path} is no file of objects of version 1")
        at = PREAMBLE.size + records + texts + header + cloud
        end = at + runs * RUN.size
        self.runs = [(position(key), points, number) for key, points, number, _ in RUN.iter_unpack(data[at:end])]
        at, end = end, end + components * COMPONENT.size
        self.points_of = [points for points, _ in COMPONENT.iter_unpack(data[at:end])]
        begins = [begin for begin, _ in TEXT.iter_unpack(data[end : end + (components + 1) * TEXT.size])]
        self.text_bytes = texts
        self.objects = sum(begin < after for begin, after in zip(begins, begins[1:]))
        self.points = sum(points for _, points, _ in self.runs)


def position(key):
    return tuple(((key >> shift) & MASK) - HALF for shift in (42, 21, 0))


def coarser(cell, times):
    return tuple(axis // times for axis in cell)


def around(cell):
    x, y, z = cell
    return ((x + i, y + j, z + k) for i in (-1, 0, 1) for j in (-1, 0, 1) for k in (-1, 0, 1))


def near_others(cells_of_shares):
    """For each share, its cells that have cells of other shares in or around them."""
    shares_of = {}
    for number, cells in enumerate(cells_of_shares):
        for cell in cells:
            shares_of.setdefault(cell, set()).add(number)
    near = []
    for number, cells in enumerate(cells_of_shares):
        near.append({c for c in cells if any(shares_of.get(a, set()) - {number} for a in around(c))})
    return near


class Counts:
    """What shares have and send, and what merging them reads."""

    def __init__(self, shares):
        cells = [{coarser(cell, CELLS) for cell, _, _ in share.runs} for share in shares]
        cubes = [{coarser(cell, CUBES) for cell in each} for each in cells]
        near_cubes = near_others(cubes)
        candidates = [{c for c in each if coarser(c, CUBES) in near} for each, near in zip(cells, near_cubes)]
        near = near_others(candidates)
        self.cells = sum(map(len, cells))
        self.cubes, self.candidates = sum(map(len, cubes)), sum(map(len, candidates))
        self.components = sum(len(share.points_of) for share in shares)
        self.objects = sum(share.objects for share in shares)
        self.text_bytes = sum(share.text_bytes for share in shares)
        self.points = sum(share.points for share in shares)
        self.runs = self.written = 0  # of files that other processes merge now: without what they do not need
        for share, cells_near in zip(shares, near):
            written = {number for cell, _, number in share.runs if coarser(cell, CELLS) in cells_near}
            self.written += sum(share.points_of[number] for number in written)
            self.runs += len(share.points_of) - len(written)
            self.runs += sum(number in written for _, _, number in share.runs)
        active = near_others([{c for c, _, _ in share.runs if coarser(c, CELLS) in cells_near}
                              for share, cells_near in zip(shares, near)])
        self.active = sum(points for share, cells in zip(shares, active) for c, points, _ in share.runs if c in cells)
