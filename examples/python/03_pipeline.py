# SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
# SPDX-License-Identifier: BSD-3-Clause
"""Detects and tracks the objects in each frame of a recording.

Usage: python3 03_pipeline.py [RECORDING]
"""

import sys

import pcl_bv

source = sys.argv[1] if len(sys.argv) > 1 else "synth:street-sequence:10"
pipeline = pcl_bv.Pipeline(
    preset="road",
    cluster={"tolerance": 0.5, "min_size": 20},
    volumes=["obb-lshape"],
    track={"enabled": True},
    threads=0,
)
for frame in pcl_bv.frames(source):
    result = pipeline.process(frame.points, stamp_ns=frame.stamp_ns, pose=frame.pose)
    tracks = [cluster.track for cluster in result.clusters if cluster.track]
    moving = [track for track in tracks if track.moving]
    took = result.ms["total"]
    print(f"{frame.seq:3}: {len(result):3} objects, {len(tracks):3} tracks, {len(moving):2} move, {took:.1f} ms")
assert tracks, "no object was seen in three frames"
