#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
# SPDX-License-Identifier: BSD-3-Clause
"""Draws a generated town of 64 tiles from above: its points, the borders of its tiles, and the boxes that
`pcd_bv --together --cluster` fits to its objects.

usage: benchmarks/town_picture.py BUILD_DIR OUT.png

Needs python3-numpy.
"""
import json
import pathlib
import struct
import subprocess
import sys
import tempfile
import zlib

import numpy

TILES, SIDE = 64, 800  # metres
SCALE, MARGIN = 1.25, 4  # pixels for a metre; pixels around the town
BACKGROUND, BORDER, POINTS, BOXES = 0, 1, 2, 3  # of the palette; the colours of boxes follow
PALETTE = [(13, 16, 28), (62, 72, 108), (84, 92, 112)]
PALETTE += [(255, 107, 107), (255, 169, 77), (255, 224, 102), (140, 233, 154), (102, 217, 232), (116, 192, 252)]
PALETTE += [(177, 151, 252), (247, 131, 172)]


def tile_points(path):
    """x and y of a tile of `synth town-objects`, whose records are x, y, z, object."""
    data = path.read_bytes().split(b"DATA binary\n", 1)[1]
    return numpy.frombuffer(data, dtype="<f4").reshape(-1, 4)[:, :2]


def pixels(xy):
    """Rows and columns of positions in the picture; north is up."""
    column = MARGIN + numpy.asarray(xy)[:, 0] * SCALE
    row = MARGIN + (SIDE - numpy.asarray(xy)[:, 1]) * SCALE
    size = int(SIDE * SCALE) + 2 * MARGIN
    return tuple(numpy.clip(numpy.round(axis).astype(int), 0, size - 1) for axis in (row, column))


def draw_lines(image, corners, colour):
    """A closed line through the corners, in pixels."""
    for begin, end in zip(corners, numpy.roll(corners, -1, axis=0)):
        steps = int(numpy.ceil(numpy.abs(end - begin).max() * SCALE)) + 1
        t = numpy.linspace(0, 1, steps)[:, None]
        image[pixels(begin + t * (end - begin))] = colour


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
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    build, out = sys.argv[1:]
    size = int(SIDE * SCALE) + 2 * MARGIN
    image = numpy.full((size, size), BACKGROUND, dtype=numpy.uint8)
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run([f"{build}/bin/synth", f"town-objects:{TILES}", folder], check=True)
        command = [f"{build}/bin/pcd_bv", "--together", "--cluster", "0.5", "--volume", "obb-yaw", "--format", "json"]
        report = json.loads(subprocess.run([*command, folder], check=True, capture_output=True).stdout)[0]
        for metres in range(0, SIDE + 1, 100):
            draw_lines(image, numpy.array([(0.0, metres), (SIDE, metres)]), BORDER)
            draw_lines(image, numpy.array([(metres, 0.0), (metres, SIDE)]), BORDER)
        for path in pathlib.Path(folder).iterdir():
            image[pixels(tile_points(path))] = POINTS
    for cluster in reversed(report["clusters"]):  # the largest last
        colour = BOXES + cluster["id"] % (len(PALETTE) - BOXES)
        draw_lines(image, corners_of(cluster["volumes"][0]), colour)
    write_png(pathlib.Path(out), image)


if __name__ == "__main__":
    main()
