# SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
# SPDX-License-Identifier: BSD-3-Clause
"""States of pickle come from outside: whatever they are, Python goes on, and what cannot be is a ValueError."""
import copy
import pickle
import random
import unittest
import warnings

import numpy as np

import pcl_bv
from clouds import normal

POINTS = normal(200)
HOSTILE = (None, True, -1, 4, 255, 2**31, 2**62, 2**63, 2**64, 10**400, 0.5, float("nan"), float("inf"), "", "x" * 1000,
           "\0", "\ud800", b"", b"\xff" * 64, [], [[]], (), (1,), {}, {"a": 1}, object(), np.zeros(0), np.zeros((3, 3)),
           np.full(3, np.nan), np.array([2**31 - 1], np.int32), np.array([-1], np.int32), np.zeros(5, "U3"),
           np.arange(200, dtype=np.int32), np.array(None, object))


def deep(n):
    state = ()
    for _ in range(n):
        state = (state,)
    return state


def samples():
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # of ground that is not there
        return made_samples()


def made_samples():
    methods = ["aabb", "dop14", "sphere", "obb", "cylinder", "capsule", "ellipsoid", "hull", "prism"]
    volumes = pcl_bv.fit(POINTS, methods)
    pipeline = pcl_bv.Pipeline(cluster={"tolerance": 1.0, "min_size": 3}, ground={"method": "plane"},
                               track={"enabled": True, "birth": 1}, filter={"range_min": 0.1}, volumes=["aabb", "sphere"])
    whole = pcl_bv.Pipeline(cluster={"tolerance": 0}, ground={"method": "none"}, volumes=["aabb"])
    return volumes + [pcl_bv.Sphere([1, 2, 3], 4), pcl_bv.Partial(POINTS), pcl_bv.cluster(POINTS, 0.5),
                      pcl_bv.cluster(POINTS, 0.5, classes=[1] * 200), pcl_bv.ground(POINTS, "plane"),
                      pipeline.process(POINTS, stamp_ns=1), whole.process(POINTS)]


def use(value):
    """Reads all that there is of it."""
    for name in dir(type(value)):
        if name.startswith("__"):
            continue
        attribute = getattr(value, name)
        if name in ("aabb", "mesh", "to_bytes"):
            attribute()
    repr(value)
    if isinstance(value, pcl_bv.Volume):
        value.contains(POINTS)
        value.status, value.reason, value.fit_rank
    if hasattr(value, "clusters"):
        for cluster in value.clusters:
            repr(cluster), cluster.indices, cluster.volumes, cluster.track, cluster.points
    if hasattr(value, "__len__"):
        len(value)
    pickle.dumps(value)


def paths(state, before=()):
    yield before
    if isinstance(state, (tuple, list)):
        for i, part in enumerate(state):
            yield from paths(part, before + (i,))
    elif isinstance(state, dict):
        for key, part in state.items():
            yield from paths(part, before + (key,))


def changed(state, path, value):
    if not path:
        return value
    parts = list(state) if isinstance(state, tuple) else copy.copy(state)
    parts[path[0]] = changed(state[path[0]], path[1:], value)
    return tuple(parts) if isinstance(state, tuple) else parts


def shortened(state, path):
    at = state
    for key in path:
        at = at[key]
    if isinstance(at, (tuple, list)) and at:
        return [changed(state, path, at[:-1]), changed(state, path, at + at[-1:])]
    if isinstance(at, dict) and at:
        fewer = dict(at)
        fewer.popitem()
        return [changed(state, path, fewer)]
    if isinstance(at, np.ndarray) and at.size:
        return [changed(state, path, at[:-1]), changed(state, path, at[::-1]), changed(state, path, at + 1),
                changed(state, path, at.astype(object)), changed(state, path, np.concatenate([at, at]))]
    return []


class States(unittest.TestCase):
    def offer(self, kind, state):
        """True if it was taken; then it is whole. It has no other way but a ValueError, of its class."""
        made = kind.__new__(kind)
        try:
            made.__setstate__(state)
        except ValueError as error:
            self.assertIn("invalid pickled state", str(error))
            self.assertNotIn("Unable to cast", str(error))
            return False
        use(made)
        return True

    def test_every_part_is_checked_like_an_argument(self):
        rng = random.Random(7)
        for sample in samples():
            state = sample.__reduce_ex__(4)[2] if sample.__reduce_ex__(4)[2] is not None else sample.__getstate__()
            kind = type(sample)
            self.assertTrue(self.offer(kind, state), kind)
            for path in paths(state):
                for value in HOSTILE if len(path) < 2 else rng.sample(HOSTILE, 3):
                    self.offer(kind, changed(state, path, value))
                for other in shortened(state, path):
                    self.offer(kind, other)

    def test_a_frame_id_that_is_no_text_is_refused(self):
        result = samples()[-1]
        state = result.__getstate__()
        header = list(state["header"])
        for value in (b"\xff", 3, None):
            header[2] = value
            self.assertFalse(self.offer(type(result), {**state, "header": tuple(header)}))

    def test_a_status_or_rank_that_does_not_exist_is_refused(self):
        for kind in ("aabb", "hull", "sphere"):
            volume = pcl_bv.fit(POINTS, kind)
            state = volume.__getstate__()
            for wrong in (-1, 4, 255, 2**31, 2**63, "ok", None, 1.5):
                for place in (1, 2):
                    self.assertFalse(self.offer(type(volume), changed(state, (1, place), wrong)), (kind, place, wrong))
            self.assertFalse(self.offer(type(volume), changed(state, (1, 0), "cube")))
            self.assertFalse(self.offer(type(volume), changed(state, (1, 5), "x" * 1000)))

    def test_what_is_no_state_at_all_is_refused(self):
        for sample in samples():
            kind = type(sample)
            for state in HOSTILE + (deep(10), deep(50_000)):
                self.offer(kind, state)

    def test_any_bytes_as_a_partial_are_refused_or_whole(self):
        state = pcl_bv.Partial(POINTS).__getstate__()
        rng = random.Random(11)
        for _ in range(500):
            damaged = bytearray(state)
            for _ in range(rng.choice((1, 1, 1, 8, 64))):
                damaged[rng.randrange(len(damaged) if rng.random() < 0.5 else 64)] = rng.randrange(256)
            self.offer(pcl_bv.Partial, bytes(damaged[:rng.choice((len(damaged), rng.randrange(len(damaged))))]))


if __name__ == "__main__":
    unittest.main()
