# SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
# SPDX-License-Identifier: BSD-3-Clause
"""Programs that end while a thread is at work, and objects that never began: no signal, whatever they were doing."""

import copy
import pickle
import sys
import tempfile
import unittest

import numpy

import children
import pcl_bv

# What a thread repeats while the interpreter ends. A is a large cloud, S a small one.
WORK = {
    "fit": "pcl_bv.fit(A, 'hull', threads=2)",
    "fit alone": "pcl_bv.fit(S, 'aabb')",
    "fit many": "pcl_bv.fit(A, ['aabb', 'sphere', 'obb'])",
    "fit labels": "pcl_bv.fit(A, 'aabb', labels=L)",
    "cluster": "pcl_bv.cluster(A, 0.01, threads=2)",
    "ground": "pcl_bv.ground(A, 'plane')",
    "statistics": "pcl_bv.statistics(A)",
    "verify": "pcl_bv.verify(BOX, A, threads=2)",
    "contains": "BOX.contains(A)",
    "distance": "BOX.distance(A)",
    "mask": "pcl_bv.RegionMask(BOX).contains(A)",
    "partial": "(pcl_bv.Partial(A) + pcl_bv.Partial(S, 10**6)).fit('dop14')",
    "pipeline": "pipeline.process(A)",
    "pictures": "pcl_bv.show(S, BOX, width=400, height=300).png()",
    "pages": "pipeline.process(S).page()",
    "read": "pcl_bv.read('synth:street:20000:1')",
    "frames": "list(pcl_bv.frames('synth:street-sequence:1'))",
    "write": "pcl_bv.write(os.path.join(sys.argv[1], 'a.json'), BOX)",
    "an array of Python's": "pcl_bv.fit(Slow(), 'aabb')",
}

PROGRAM = """
import os, sys, threading, time, warnings
import numpy, pcl_bv
warnings.simplefilter('ignore')
A = numpy.random.default_rng(1).normal(size=(200_000, 3))
S = A[:2000].copy()
L = numpy.arange(len(A)) % 50
BOX = pcl_bv.Sphere([0, 0, 0], 1)
pipeline = pcl_bv.Pipeline(ground={'method': 'none'}, threads=2)
class Slow:
    def __array__(self, *arguments, **options):
        time.sleep(0.001)
        return S
began = threading.Event()
def work():
    while True:
        WORK
        began.set()
threads = [threading.Thread(target=work, daemon=True) for _ in range(2)]
for thread in threads:
    thread.start()
began.wait(60)
"""


class Endings(unittest.TestCase):
    def test_a_program_ends_quietly_while_threads_are_at_work(self):
        with tempfile.TemporaryDirectory() as folder:
            for name, work in WORK.items():
                with self.subTest(work=name):
                    child = children.run([sys.executable, "-c", PROGRAM.replace("WORK", work), folder],
                                         capture_output=True, text=True, check=False)
                    self.assertEqual((child.returncode, child.stderr), (0, ""))


def classes():
    found = [value for name, value in vars(pcl_bv).items() if isinstance(value, type) and not name.startswith("_")]
    try:
        from pcl_bv import gpu
        found += [gpu.Device, gpu.Cloud]
    except ImportError:
        pass
    return found


# What is called with more arguments than self.
ARGUMENTS = {"contains": ([[0., 0, 0]],), "distance": ([[0., 0, 0]],), "support": ([0, 0, 1],), "extend": ([0, 0, 0],),
             "intersect": ([0, 0, 0], [0, 0, 1]), "transformed": (numpy.eye(4),), "process": ([[0., 0, 0]],),
             "fit": ("aabb",), "__getitem__": (0,), "__setattr__": ("config", {})}


class ObjectsWithoutAValue(unittest.TestCase):
    """Of __new__() alone, as pickle's NEWOBJ without a state makes them."""

    def refuses(self, what, call):
        with self.assertRaises(TypeError, msg=what) as caught:
            call()
        self.assertIn("has no value", str(caught.exception), what)

    def test_every_attribute_of_every_class_is_a_type_error(self):
        self.assertGreater(len(classes()), 20)
        for cls in classes():
            own = {name for base in cls.__mro__ for name in vars(base) if base.__module__.startswith("pcl_bv")}
            self.assertGreater(len(own), 0)
            for name in own - {"__module__", "__doc__", "__init__", "__new__", "__setstate__", "__hash__", "from_bytes"}:
                value = cls.__new__(cls)
                arguments = (value,) if name in ("merge", "overlaps", "__eq__", "__add__") else ARGUMENTS.get(name, ())

                def use():
                    attribute = getattr(value, name)
                    if callable(attribute):
                        attribute(*arguments)

                self.refuses(f"{cls.__name__}.{name}", use)

    def test_settings_of_a_pipeline_are_a_type_error(self):
        value = pcl_bv.Pipeline.__new__(pcl_bv.Pipeline)
        self.refuses("config", lambda: setattr(value, "config", {}))

    def test_as_an_argument_it_is_a_type_error(self):
        points = [[0., 0, 0]]
        box, result = pcl_bv.Aabb([0, 0, 0], [1, 1, 1]), pcl_bv.Result.__new__(pcl_bv.Result)
        for cls in (pcl_bv.Aabb, pcl_bv.Hull, pcl_bv.Volume):
            value = cls.__new__(cls)
            for call in (lambda: pcl_bv.verify(value, points), lambda: pcl_bv.RegionMask([box, value]),
                         lambda: pcl_bv.show(points, value), lambda: pcl_bv.write("a.json", [value]),
                         lambda: box == value, lambda: value != box):
                self.refuses(cls.__name__, call)
        box_without_value = pcl_bv.Aabb.__new__(pcl_bv.Aabb)
        self.refuses("merge", lambda: box.merge(box_without_value))
        self.refuses("overlaps", lambda: box.overlaps(box_without_value))
        self.refuses("partial", lambda: pcl_bv.Partial(points) + pcl_bv.Partial.__new__(pcl_bv.Partial))
        with self.assertRaises(TypeError):
            pcl_bv.fit(points, "aabb", pcl_bv.Clusters.__new__(pcl_bv.Clusters))
        self.refuses("result", lambda: pcl_bv.write("a.json", result))
        self.refuses("picture", lambda: pcl_bv.write("a.png", pcl_bv.Picture.__new__(pcl_bv.Picture)))
        with self.assertRaises(TypeError):
            pcl_bv.show(points, labels=result)

    def test_of_a_short_pickle_it_is_a_type_error(self):
        for cls in classes():
            state = b"\x80\x02cpcl_bv\n" + cls.__name__.encode() + b"\n)\x81."
            if not hasattr(pcl_bv, cls.__name__):
                continue
            value = pickle.loads(state)
            self.assertIs(type(value), cls)
            if hasattr(cls, "__setstate__"):
                for again in (copy.copy, copy.deepcopy, pickle.dumps):
                    self.refuses(cls.__name__, lambda: again(value))

    def test_a_failed_state_leaves_no_value(self):
        value = pcl_bv.Aabb.__new__(pcl_bv.Aabb)
        with self.assertRaises(ValueError):
            value.__setstate__((1, 2))
        self.refuses("volume", lambda: value.volume)
        with self.assertRaises(TypeError):
            value.__init__("bad")
        self.refuses("volume", lambda: value.volume)
        value.__init__([0, 0, 0], [1, 1, 1])
        self.assertEqual(value.volume, 1)

    def test_objects_with_a_value_are_copied(self):
        box = pcl_bv.Aabb([0, 0, 0], [1, 2, 3])
        partial = pcl_bv.Partial([[0., 0, 0], [1, 1, 1]])
        for again in (copy.copy, copy.deepcopy, lambda v: pickle.loads(pickle.dumps(v))):
            self.assertEqual(again(box), box)
            self.assertEqual(again(partial).to_bytes(), partial.to_bytes())


if __name__ == "__main__":
    unittest.main()
