# SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
# SPDX-License-Identifier: BSD-3-Clause
"""Finds the points on a robot's own arm. The volume of each link moves with it and is inflated by 5 cm."""

import numpy as np

import pcl_bv

rng = np.random.default_rng(1)
links = [rng.uniform([0, -0.05, -0.05], [length, 0.05, 0.05], (2000, 3)) for length in (0.4, 0.5, 0.3)]
volumes = pcl_bv.fit(np.vstack(links), "capsule", labels=np.repeat([0, 1, 2], 2000))


def pose(angle, x, z):
    c, s = np.cos(angle), np.sin(angle)
    return np.array([[c, 0, s, x], [0, 1, 0, 0], [-s, 0, c, z], [0, 0, 0, 1]])


poses = [pose(0.0, 0.2, 0.5), pose(-0.8, 0.6, 0.5), pose(0.5, 0.95, 0.86)]
arm = [volumes[link].transformed(poses[link]) for link in volumes]
mask = pcl_bv.RegionMask(arm, padding=0.05)

scene = rng.uniform([-1, -1, 0], [2, 1, 2], (100_000, 3))
seen = np.vstack([scene] + [points @ p[:3, :3].T + p[:3, 3] for points, p in zip(links, poses)])
own = mask.contains(seen, threads=0)
print(f"{own.sum()} of {len(seen)} points are the arm's own")
assert own[len(scene):].all()
