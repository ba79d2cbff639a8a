#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
# SPDX-License-Identifier: BSD-3-Clause
"""Draws a generated town from above: its points, the borders of its tiles, and the boxes that
`pcd_bv --together --cluster` fits to its objects.

usage: benchmarks/town_picture.py BUILD_DIR OUT.png [--tiles N] [--points N]

N tiles (default 64) of N points on average, with the ground (default 200000). Needs python3-numpy.
"""
import json
import math
import pathlib
import struct
import subprocess
import sys
import tempfile
import zlib

try:
    import numpy
except ImportError:
    sys.exit("town_picture.py: needs python3-numpy")

from arguments import Parser, count

TILE = 100  # metres
SCALE, MARGIN = 1.25, 4  # pixels for a metre; pixels around the town
BACKGROUND, BORDER, POINTS, BOXES = 0, 1, 2, 3  # of the palette; the colours of boxes follow
PALETTE = [(13, 16, 28), (62, 72, 108), (84, 92, 112)]
PALETTE += [(255, 107, 107), (255, 169, 77), (255, 224, 102), (140, 233, 154), (102, 217, 232), (116, 192, 252)]
PALETTE += [(177, 151, 252), (247, 131, 172)]


def tile_points(path):
    """x and y of a tile of `synth town-objects`, whose records are x, y, z, object."""
    data = path.read_bytes().split(b"DATA binary\n", 1)[1]
    return numpy.frombuffer(data, dtype="<f4").reshape(-1, 4)[:, :2]


class Picture:
    """Colours of pixels of a square with sides of `side` metres; north is up."""

    def __init__(self, side):
        self.side = side
        size = int(side * SCALE) + 2 * MARGIN
        self.image = numpy.full((size, size), BACKGROUND, dtype=numpy.uint8)

    def draw_points(self, xy, colour):
        column = MARGIN + numpy.asarray(xy)[:, 0] * SCALE
        row = MARGIN + (self.side - numpy.asarray(xy)[:, 1]) * SCALE
        last = len(self.image) - 1
        self.image[tuple(numpy.clip(numpy.round(axis).astype(int), 0, last) for axis in (row, column))] = colour

    def draw_lines(self, corners, colour):
        """A closed line through the corners."""
        for begin, end in zip(corners, numpy.roll(corners, -1, axis=0)):
            steps = int(numpy.ceil(numpy.abs(end - begin).max() * SCALE)) + 1
            t = numpy.linspace(0, 1, steps)[:, None]
            self.draw_points(begin + t * (end - begin), colour)


def corners_of(box):
    center = numpy.array(box["center"])
    x, y = (numpy.array(box["axes"][i]) * box["half_extents"][i] for i in range(2))
    return numpy.array([center + s * x + t * y for s, t in ((-1, -1), (1, -1), (1, 1), (-1, 1))])[:, :2]


def write_png(path, image):
    def chunk(name, data):
        return struct.pack(">I", len(data)) + name + data + struct.pack(">I", zlib.crc32(name + data))

    height, width = image.shape
    rows = b"".join(b"\0" + image[row].tobytes() for row in range(height))
    header = struct.pack(">IIBBBBB", width, height, 8, 3, 0, 0, 0)  # 8 bits, palette
    palette = b"".join(map(bytes, PALETTE))
    chunks = [(b"IHDR", header), (b"PLTE", palette), (b"IDAT", zlib.compress(rows, 9)), (b"IEND", b"")]
    path.write_bytes(b"\x89PNG\r\n\x1a\n" + b"".join(chunk(*each) for each in chunks))


def main():
    parser = Parser(__doc__, ["synth", "pcd_bv"])
    parser.add_argument("out", type=pathlib.Path)
    parser.add_argument("--tiles", type=count, default=64)
    parser.add_argument("--points", type=count, default=200_000)
    options = parser.parse_args()
    if not options.out.absolute().parent.is_dir():
        parser.error(f"no folder for '{options.out}'")
    side = TILE * math.ceil(math.sqrt(options.tiles))
    picture = Picture(side)
    with tempfile.TemporaryDirectory() as folder:
        town = f"town-objects:{options.tiles}:1:{options.points}"
        subprocess.run([f"{options.build}/bin/synth", town, folder], check=True)
        command = [f"{options.build}/bin/pcd_bv", "--together", "--cluster", "0.5", "--volume", "obb-yaw"]
        done = subprocess.run([*command, "--format", "json", folder], check=True, capture_output=True)
        for metres in range(0, side + 1, TILE):
            picture.draw_lines(numpy.array([(0.0, metres), (side, metres)]), BORDER)
            picture.draw_lines(numpy.array([(metres, 0.0), (metres, side)]), BORDER)
        for path in pathlib.Path(folder).iterdir():
            picture.draw_points(tile_points(path), POINTS)
    for cluster in reversed(json.loads(done.stdout)[0]["clusters"]):  # the largest last
        colour = BOXES + cluster["id"] % (len(PALETTE) - BOXES)
        picture.draw_lines(corners_of(cluster["volumes"][0]), colour)
    write_png(options.out, picture.image)


if __name__ == "__main__":
    main()
