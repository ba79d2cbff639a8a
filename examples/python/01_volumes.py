# SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
# SPDX-License-Identifier: BSD-3-Clause
"""Fits all kinds of volumes to points, prints their sizes and proves that no point is outside."""

import numpy as np

import pcl_bv

points = np.random.default_rng(1).normal(size=(10_000, 3)) * [3, 1, 0.2]

for volume in pcl_bv.fit(points, "all"):
    proof = pcl_bv.verify(volume, points)
    assert proof.outside == 0
    print(f"{volume.method:13} {volume.volume:10.2f} m3")

box = pcl_bv.fit(points, "obb")
print(box)
print("axes", box.axes.round(3).tolist(), "corner", box.mesh()[0][0].round(2))
print("nearest point of (9, 9, 9):", round(box.distance([9, 9, 9]), 2), "m away")
assert box.contains(points).all()
