# SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
# SPDX-License-Identifier: BSD-3-Clause
"""Fits a box to a cloud in parts. Each process reads only its own part and returns a few kilobytes."""

import functools
import operator
from concurrent.futures import ProcessPoolExecutor

import numpy as np

import pcl_bv

PARTS, EACH = 8, 50_000


def points_of(part):
    """Generates the points of one part. A real program reads one of many files here."""
    return np.random.default_rng(part).normal(size=(EACH, 3)).astype(np.float32)


def partial_of(part):
    return pcl_bv.Partial(points_of(part), first=part * EACH)


if __name__ == "__main__":
    with ProcessPoolExecutor(2) as workers:
        whole = functools.reduce(operator.add, workers.map(partial_of, range(PARTS)))
    print(whole, len(whole.to_bytes()), "bytes")
    box = whole.fit("obb")
    print(box)
    assert box == pcl_bv.fit(np.vstack([points_of(part) for part in range(PARTS)]), "obb")
