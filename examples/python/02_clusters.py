# SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
# SPDX-License-Identifier: BSD-3-Clause
"""Removes the ground, finds clusters, fits a box to each cluster and draws a picture.

Usage: python3 02_clusters.py [CLOUD [PICTURE.png]]
"""

import sys

import numpy as np

import pcl_bv

cloud = pcl_bv.read(sys.argv[1] if len(sys.argv) > 1 else "synth:street:60000:2")
xyz = np.stack([cloud[name].ravel() for name in "xyz"], axis=1)
xyz = xyz[np.linalg.norm(xyz, axis=1) > 1]  # rays without a return are points at 0, 0, 0

ground = pcl_bv.ground(xyz)
objects = xyz[~ground.mask]
clusters = pcl_bv.cluster(objects, 0.5, min_size=30)
boxes = pcl_bv.fit(objects, "obb-lshape", labels=clusters)

print(ground)
print(clusters)
for label, box in list(boxes.items())[:5]:
    length, width, height = 2 * np.asarray(box.half_extents)
    print(f"{label:3}: {box.used:5} points, {length:.1f} x {width:.1f} x {height:.1f} m")
if len(sys.argv) > 2:
    pcl_bv.write(sys.argv[2], pcl_bv.show(objects, boxes, clusters))
assert all(box.contains(objects[clusters[label]]).all() for label, box in boxes.items())
