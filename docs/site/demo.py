# SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
# SPDX-License-Identifier: BSD-3-Clause
"""The demo: the page of `--sink ws:` with the messages of a generated street in it. replay.js replaces the
server. So that it stays small, points far away and most others are left out, and numbers are rounded."""
import base64
import gzip
import json
import pathlib
import struct
import subprocess
import tempfile

import numpy

HERE = pathlib.Path(__file__).resolve().parent
FRAMES = 60
STREAM = ["--source", f"synth:street-sequence:{FRAMES}", "--rate", "max", "--range", "1:40",
          "--min-size", "30", "--track", "--volume", "obb-lshape,dop26"]
RANGE = 45  # metres
GROUND = 4294967294  # label
EVERY_GROUND, EVERY_OTHER = 12, 5  # one of so many points stays
STEPS = 64  # of coordinates in a metre
DECIMALS = 4  # of other numbers
POINT = numpy.dtype([("x", "<f4"), ("y", "<f4"), ("z", "<f4"), ("label", "<u4")])
FRAMES_ID, POINTS_ID = 1, 2  # of the page's subscriptions
MESSAGE_DATA = 1


def read_labels(path):
    """The points of a file of --sink labels:."""
    header, data = path.read_bytes().split(b"DATA binary\n", 1)
    if b"FIELDS x y z label\n" not in header or b"SIZE 4 4 4 4\n" not in header:
        raise SystemExit(f"site: {path.name} has other fields than x, y, z and label")
    return numpy.frombuffer(data, dtype=POINT)


def smaller(points):
    """The points that stay, with coordinates whose last bits are 0, which gzip makes small."""
    distance = numpy.sqrt(points["x"] ** 2 + points["y"] ** 2)
    ground = points["label"] == GROUND
    index = numpy.arange(len(points))
    stays = numpy.where(ground, index % EVERY_GROUND == 0, index % EVERY_OTHER == 0)
    points = points[stays & (distance < RANGE) & (distance > 1)].copy()
    for name in "xyz":
        points[name] = numpy.round(points[name] * STEPS) / STEPS
    return points


def cdr_cloud(points, frame_id):
    """sensor_msgs/msg/PointCloud2 in little-endian CDR."""
    data = bytearray(b"\x00\x01\x00\x00")

    def number(value):
        data.extend(b"\x00" * (-len(data) % 4) + struct.pack("<I", value))

    def text(value):
        number(len(value) + 1)
        data.extend(value.encode() + b"\x00")

    number(0), number(0)
    text(frame_id)
    number(1), number(len(points)), number(len(POINT.names))
    for name in POINT.names:
        text(name)
        number(POINT.fields[name][1])
        data.append(6 if name == "label" else 7)  # UINT32, FLOAT32
        number(1)
    data.append(0)
    number(POINT.itemsize), number(points.nbytes), number(points.nbytes)
    return bytes(data) + points.tobytes() + b"\x01"


def message(subscription, stamp, payload):
    return struct.pack("<BIQ", MESSAGE_DATA, subscription, stamp) + payload


def record(programs):
    """The messages of the stream, each after its length."""
    messages = []
    with tempfile.TemporaryDirectory() as folder:
        sinks = ["--sink", "labels:labels", "--sink", "jsonl:frames.jsonl"]
        subprocess.run([programs / "bv_stream", *STREAM, *sinks], cwd=folder, check=True)
        lines = pathlib.Path(folder, "frames.jsonl").read_text().splitlines()
        files = sorted(pathlib.Path(folder, "labels").glob("*.pcd"))
        if len(lines) != FRAMES or len(files) != FRAMES:
            raise SystemExit(f"site: {len(lines)} frames and {len(files)} clouds instead of {FRAMES}")
        for line, path in zip(lines, files):
            frame = json.loads(line, parse_float=lambda text: round(float(text), DECIMALS))
            cloud = cdr_cloud(smaller(read_labels(path)), frame["frame_id"])
            messages.append(message(POINTS_ID, frame["stamp_ns"], cloud))
            messages.append(message(FRAMES_ID, frame["stamp_ns"], json.dumps(frame).encode()))
    return b"".join(struct.pack("<I", len(one)) + one for one in messages)


def write(out, programs, page):
    """Writes out/demo.html. `page` is the page of the live view, as it was built."""
    recording = base64.b64encode(gzip.compress(record(programs), 9, mtime=0)).decode()
    scripts = (f'\n<script type="application/octet-stream" id="recording">{recording}</script>\n'
               f"<script>\n{(HERE / 'replay.js').read_text()}</script>\n")
    text = page.read_text()
    if text.count("\n<!-- data -->\n") != 1:
        raise SystemExit("site: the live page has no place for the recording")
    (out / "demo.html").write_text(text.replace("\n<!-- data -->\n", scripts))
