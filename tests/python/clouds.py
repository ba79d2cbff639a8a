# SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
# SPDX-License-Identifier: BSD-3-Clause
"""Clouds that the tests share, with fixed seeds."""

import numpy as np

import pcl_bv


def normal(count, seed=1, dtype=np.float64):
    return np.random.default_rng(seed).normal(size=(count, 3)).astype(dtype)


def clouds():
    """Points of several kinds, by name: round, flat, few, far from the origin, rows that are not finite."""
    bad = normal(500, 3, np.float32)
    bad[::7, 1] = np.nan
    bad[3] = np.inf
    flat = normal(300, 4)
    flat[:, 2] = 1.5
    return {
        "float32": normal(2000, 1, np.float32),
        "float64": normal(2000, 2),
        "not finite": bad,
        "flat": flat,
        "one point": np.array([[1.0, 2.0, 3.0]]),
        "far": normal(200, 5) + [500000.0, 5000000.0, 100.0],
    }


def numbers_of(volume):
    """The fields of the JSON of this shape, as the volume has them."""
    fields = {
        "aabb": ("min", "max"),
        "kdop": ("directions", "min", "max"),
        "sphere": ("center", "radius"),
        "obb": ("center", "axes", "half_extents", "quaternion"),
        "cylinder": ("center", "axis", "radius", "half_height"),
        "capsule": ("a", "b", "radius"),
        "ellipsoid": ("center", "axes", "radii"),
        "hull": ("vertices", "faces", "planes"),
        "prism": ("axes", "outline", "low", "high"),
    }[volume.shape]
    return {name: getattr(volume, name) for name in fields}


def street():
    return pcl_bv.read("synth:street:40000:3")
