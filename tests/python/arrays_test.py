# SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
# SPDX-License-Identifier: BSD-3-Clause
import unittest
import warnings

import numpy as np
from numpy.lib.stride_tricks import as_strided

import pcl_bv
from clouds import normal


def records(points, layout):
    """Points as records of these (name, type) in a row, with 7 in what is no coordinate."""
    array = np.full(len(points), 7, dtype=layout)
    for k, name in enumerate("xyz"):
        array[name] = points[:, k]
    return array


class Arrays(unittest.TestCase):
    def same(self, array, expected, **options):
        self.assertEqual(pcl_bv.fit(array, "dop26", **options), pcl_bv.fit(expected.copy(), "dop26",
            **options))
        self.assertEqual(pcl_bv.fit(array, "sphere", **options), pcl_bv.fit(expected.copy(), "sphere",
            **options))

    def test_any_layout_gives_the_volume_of_its_points(self):
        for dtype in (np.float32, np.float64):
            for count in (1, 2, 3, 17, 1000):
                points = normal(count, count, dtype)
                wide = np.full((count, 7), 99, dtype)
                wide[:, 1:4] = points
                for array in (wide[:, 1:4], wide[:, 1:], points[::-1], np.asfortranarray(points), points[::2],
                              np.repeat(points, 2, axis=0)[::2], points.astype(points.dtype.newbyteorder())):
                    self.same(array, np.ascontiguousarray(array[:, :3], dtype))

    def test_rows_at_the_end_of_a_page_are_not_read_beyond(self):
        import mmap
        for dtype, columns in ((np.float32, 3), (np.float64, 3), (np.float32, 4)):
            size = np.dtype(dtype).itemsize
            # Two pages, of which the second may not be read.
            memory = mmap.mmap(-1, 2 * mmap.PAGESIZE)
            whole = np.frombuffer(memory, np.uint8)
            import ctypes
            libc = ctypes.CDLL(None, use_errno=True)
            page = whole.ctypes.data + mmap.PAGESIZE
            self.assertEqual(libc.mprotect(ctypes.c_void_p(page), mmap.PAGESIZE, 0), 0)
            count = 64  # whole vectors, whose last load would reach farthest
            begin = mmap.PAGESIZE - count * columns * size + (columns - 3) * size
            array = as_strided(whole[begin:begin + size].view(dtype), (count, 3), (columns * size, size))
            array[:] = normal(count, 5, dtype)
            self.same(array, array)
            labels = np.arange(count) % 3
            self.assertEqual(pcl_bv.fit(array, "obb", labels), pcl_bv.fit(array.copy(), "obb", labels))
            self.assertEqual(list(pcl_bv.cluster(array, 0.5).labels), list(pcl_bv.cluster(array.copy(),
                0.5).labels))
            libc.mprotect(ctypes.c_void_p(page), mmap.PAGESIZE, 3)

    def test_records_are_seen_by_the_names_of_their_fields(self):
        points = normal(500, 8)
        for f in ("<f4", "<f8", ">f4"):
            for layout in ([("x", f), ("y", f), ("z", f)],
                           [("i", "<u2"), ("x", f), ("y", f), ("z", f), ("ring", "u1")],
                           [("z", f), ("y", f), ("x", f)],
                           [("x", f), ("y", "<f8"), ("z", f)]):
                array = records(points, layout)
                expected = np.stack([array["x"], array["y"], array["z"]], axis=1)
                wide = np.result_type(expected.dtype, array["y"].dtype).newbyteorder("=")
                self.same(array, expected.astype(wide))

    def test_records_of_files_may_have_integers_and_upper_case(self):
        points = np.array([[0, 0, 0], [1, 2, 3], [-100, 5, 7]])
        for layout in ([("x", "<i2"), ("y", "<i2"), ("z", "<i2")], [("X", "<f4"), ("Y", "<f4"), ("Z", "<f4")],
                       [("x", "<i4"), ("tag", "u1"), ("y", "<f4"), ("z", "u1")]):
            array = np.zeros(3, layout)
            for name, column in zip([n for n in array.dtype.names if n != "tag"], points.T):
                array[name] = column
            self.assertEqual(pcl_bv.fit(array, "aabb"), pcl_bv.fit(points.astype(float), "aabb"))
        with self.assertRaisesRegex(TypeError, "int64"):
            pcl_bv.fit(np.zeros(3, [("x", "i8"), ("y", "i8"), ("z", "i8")]), "aabb")

    def test_an_organised_cloud_is_its_rows(self):
        image = normal(600, 9, np.float32).reshape(20, 30, 3)
        self.same(image, image.reshape(-1, 3))
        self.assertEqual(pcl_bv.fit(records(normal(600, 9), [("x", "f4"), ("y", "f4"), ("z",
            "f4")]).reshape(20, 30), "obb"),
                         pcl_bv.fit(image, "obb"))

    def test_views_are_not_copied(self):
        """What is written into the array shows in a picture that is drawn later."""
        points = normal(200, 10, np.float32)
        for array in (points, np.hstack([points, points])[:, :3],
                      records(points, [("x", "f4"), ("y", "f4"), ("z", "f4"), ("i", "f4")])):
            picture = pcl_bv.show(array, width=64, height=64)
            before = picture.png()
            if array.dtype.names:
                array["x"] = 0
            else:
                array[:, 0] = 0
            self.assertNotEqual(picture.png(), before)
        copied = np.asfortranarray(points + 1)
        picture = pcl_bv.show(copied, width=64, height=64)
        before = picture.png()
        copied[:] = 0
        self.assertEqual(picture.png(), before)

    def test_arrays_that_may_not_be_written_and_lists_work(self):
        points = normal(50, 11)
        points.flags.writeable = False
        self.same(points, points)
        self.assertEqual(pcl_bv.fit(points.tolist(), "obb"), pcl_bv.fit(points, "obb"))
        self.assertEqual(pcl_bv.fit(memoryview(points), "obb"), pcl_bv.fit(points, "obb"))

    def test_rows_that_are_not_finite_are_dropped_and_counted(self):
        points = normal(100, 12)
        points[10] = [np.nan, 0, 0]
        points[20] = [0, np.inf, 0]
        box = pcl_bv.fit(points, "aabb")
        self.assertEqual((box.used, box.dropped), (98, 2))
        good = np.delete(points, [10, 20], axis=0)
        self.assertEqual(box, pcl_bv.fit(good, "aabb"))

    def test_no_point_gives_an_empty_volume_that_says_so(self):
        for array in (np.zeros((0, 3)), np.zeros((0, 5), np.float32)[:, 1:4], np.full((4, 3), np.nan)):
            for method in pcl_bv.methods():
                volume = pcl_bv.fit(array, method)
                self.assertTrue(volume.empty)
                self.assertEqual(volume.status, "no_valid_points")
                self.assertEqual(volume.volume, 0)
        self.assertEqual(pcl_bv.fit(np.zeros((0, 3)), "aabb", labels=[]), {})
        self.assertEqual(len(pcl_bv.cluster(np.zeros((0, 3)), 1)), 0)

    def test_labels_of_any_integers_are_taken(self):
        points = normal(6, 13)
        expected = {0: pcl_bv.fit(points[:2], "aabb"), 4: pcl_bv.fit(points[2:4], "aabb")}
        for dtype in (np.int8, np.int16, np.int32, np.int64):
            self.assertEqual(pcl_bv.fit(points, "aabb", np.array([0, 0, 4, 4, -1, -2], dtype)), expected)
        far = [pcl_bv.fit(points, "aabb", np.array([10**15, 5, 5, 10**15, 7, 7])), pcl_bv.fit(points, "aabb",
            [2, 0, 0, 2, 1, 1])]
        self.assertEqual(list(far[0]), [5, 7, 10**15])
        self.assertEqual([far[0][5], far[0][7], far[0][10**15]], list(far[1].values()))
        written = np.array([0, 0, 4, 4, 4294967295, 4294967294], np.uint32)
        self.assertEqual(pcl_bv.fit(points, "aabb", written), expected)
        clusters = pcl_bv.cluster([[0.0, 0, 0], [9, 0, 0], [0.1, 0, 0]], 0.5)
        self.assertEqual(list(pcl_bv.fit([[0.0, 0, 0], [9, 0, 0], [0.1, 0, 0]], "aabb", clusters)), [0, 1])


class Layouts(unittest.TestCase):
    """Arrays that could mean two things are refused or warned of, everywhere points are taken."""

    def entries(self):
        box = pcl_bv.fit(normal(50, 1), "aabb")
        return {
            "fit": lambda points: pcl_bv.fit(points, "aabb"),
            "cluster": lambda points: pcl_bv.cluster(points, 0.5),
            "ground": lambda points: pcl_bv.ground(points, "plane"),
            "statistics": pcl_bv.statistics,
            "verify": lambda points: pcl_bv.verify(box, points),
            "Partial": lambda points: pcl_bv.Partial(points),
            "process": lambda points: pcl_bv.Pipeline(pcl_bv_settings()).process(points),
            "contains": box.contains,
            "distance": box.distance,
        }

    def each(self, check):
        for name, entry in self.entries().items():
            with self.subTest(entry=name):
                check(entry)

    def test_points_in_columns_are_refused_with_the_advice_to_transpose(self):
        for shape in ((3, 1000), (4, 1000), (5, 34720), (6, 256), (1, 300), (64, 1024), (3, 480, 640)):
            for dtype in (np.float32, np.float64):
                with self.assertRaisesRegex(ValueError, r"points: the shape .* If each column is a point, pass"):
                    pcl_bv.fit(np.zeros(shape, dtype), "aabb")
        self.each(lambda entry: self.assertRaisesRegex(ValueError, r"points\.T", entry, np.ones((4, 1000))))

    def test_a_few_points_of_many_numbers_have_a_warning(self):
        with self.assertWarnsRegex(UserWarning, r"points: the shape \(4, 100\) is 4 points of 100 numbers"):
            pcl_bv.fit(np.ones((4, 100)), "aabb")

    def test_points_with_features_are_taken_without_a_word(self):
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            for shape in ((3, 3), (4, 16), (2, 20), (9, 20), (500, 259), (1000, 4), (64, 1024, 3), (3, 40, 4)):
                pcl_bv.fit(np.ones(shape), "aabb")

    def test_masked_points_are_dropped_and_counted_as_those_that_are_not_finite(self):
        points = normal(100, 21)
        for dtype in (np.float32, np.float64):
            mask = np.zeros((100, 3), bool)
            mask[5, 0] = mask[7] = True
            given = np.ma.masked_array(points.astype(dtype), mask=mask)
            given.data[5] = given.data[7] = 1e6
            box = pcl_bv.fit(given, "aabb")
            self.assertEqual((box.used, box.dropped), (98, 2))
            self.assertEqual(box, pcl_bv.fit(np.delete(given.data, [5, 7], axis=0), "aabb"))
            self.assertEqual(given.data[5, 0], 1e6)  # as it was
            layout = [("x", dtype), ("y", dtype), ("z", dtype), ("ring", "u1")]
            rows = np.ma.masked_array(records(given.data, layout))
            rows.mask["x"][5] = rows.mask["z"][7] = True
            self.assertEqual(pcl_bv.fit(rows, "aabb"), box)
        unmasked = np.ma.masked_array(points)
        self.assertEqual(pcl_bv.fit(unmasked, "aabb"), pcl_bv.fit(points, "aabb"))
        self.each(lambda entry: entry(given))

    def test_masked_labels_and_vectors_are_refused(self):
        masked = np.ma.masked_array(np.zeros(6, int), mask=[0, 0, 1, 0, 0, 0])
        with self.assertRaisesRegex(TypeError, "labels: expected integers without a mask"):
            pcl_bv.fit(normal(6), "aabb", labels=masked)
        with self.assertRaisesRegex(TypeError, "classes: expected integers without a mask"):
            pcl_bv.cluster(normal(6), 1, classes=masked)
        with self.assertRaisesRegex(TypeError, "sensor: expected an array without a mask"):
            pcl_bv.ground(normal(6), sensor=np.ma.masked_array([0.0, 0, 0], mask=[0, 1, 0]))

    def test_an_empty_list_has_no_point(self):
        for empty in ([], (), np.array([]), np.zeros((0, 3))):
            self.assertEqual(pcl_bv.fit(empty, "aabb").status, "no_valid_points")
            self.assertEqual(len(pcl_bv.cluster(empty, 1)), 0)
            self.assertEqual(pcl_bv.fit(normal(5), "aabb").contains(empty).shape, (0,))
            self.assertEqual(pcl_bv.fit(normal(5), "aabb").extend(empty), pcl_bv.fit(normal(5), "aabb"))
        self.each(lambda entry: entry([]))

    def test_lists_of_whole_numbers_are_points(self):
        box = pcl_bv.fit([(0, 0, 0), (1, 2, 3)], "aabb")
        self.assertEqual((list(box.min), list(box.max)), ([0, 0, 0], [1, 2, 3]))
        self.assertEqual(pcl_bv.fit([[0, 0, 0], [1, 2.5, 3]], "aabb").max[1], 2.5)
        with self.assertRaisesRegex(ValueError, r"above 2\^53"):
            pcl_bv.fit([[0, 0, 0], [2**53 + 1, 0, 0]], "aabb")
        self.each(lambda entry: entry([(0, 0, 0), (1, 2, 3)]))

    def test_no_advice_to_call_astype_is_given_for_lists(self):
        for wrong in ([["a", "b", "c"]], [[True, False, True]], [[1j, 0, 0]], [[2**70, 0, 0]]):
            with self.assertRaises(TypeError) as caught:
                pcl_bv.fit(wrong, "aabb")
            self.assertNotIn("astype", str(caught.exception))

    def test_advice_fits_the_type(self):
        for dtype, advice in ((np.complex64, r"array\.real"), (np.int32, "astype"), (np.float16, "astype"),
                              (np.longdouble, "astype"), (object, "astype")):
            with self.assertRaisesRegex(TypeError, advice):
                pcl_bv.fit(np.ones((4, 3), dtype), "aabb")
        for dtype in (bool, "M8[s]", "U3"):
            with self.assertRaises(TypeError) as caught:
                pcl_bv.fit(np.ones((4, 3), bool).astype(dtype), "aabb")
            self.assertNotIn("astype", str(caught.exception))
        with self.assertRaisesRegex(ValueError, r"the shape \(3,\) .* for one point pass \[point\]"):
            pcl_bv.fit(np.ones(3), "aabb")

    def test_records_of_integers_are_seen_as_files_have_them(self):
        rows = records(np.arange(12).reshape(4, 3), [("x", "<i2"), ("y", ">i4"), ("z", "f4")])
        self.assertEqual(list(pcl_bv.fit(rows, "aabb").max), [9, 10, 11])

    def test_a_table_is_seen_by_the_names_of_its_columns(self):
        points = normal(30, 22)

        class Table:  # as pandas.DataFrame
            def __init__(self, data):
                self.data, self.columns = data, list(data)

            def __getitem__(self, names):
                return Table({name: self.data[name] for name in names})

            def __array__(self, dtype=None, copy=None):
                return np.stack([self.data[name] for name in self.columns], axis=1)

        table = Table({"intensity": np.full(30, 99.0), "z": points[:, 2], "x": points[:, 0], "y": points[:, 1]})
        self.assertEqual(pcl_bv.fit(table, "aabb"), pcl_bv.fit(points, "aabb"))
        with self.assertRaisesRegex(TypeError, "the table must have the columns x, y and z"):
            pcl_bv.fit(Table({"a": points[:, 0], "b": points[:, 1], "c": points[:, 2]}), "aabb")

    def test_an_object_that_makes_an_array_of_itself_is_one_and_says_why_not(self):
        class Tensor:
            def __init__(self, fails=False):
                self.fails = fails

            def __array__(self, dtype=None, copy=None):
                if self.fails:
                    raise RuntimeError("the tensor is on another device")
                return normal(20, 23)

        self.assertEqual(pcl_bv.fit(Tensor(), "aabb"), pcl_bv.fit(normal(20, 23), "aabb"))
        with self.assertRaisesRegex(TypeError, "expected an array.*on another device"):
            pcl_bv.fit(Tensor(True), "aabb")
        with self.assertRaisesRegex(TypeError, "expected an array"):
            pcl_bv.fit([[1.0, 2, 3], [4.0, 5]], "aabb")

    def test_three_arrays_in_a_list_are_three_points(self):
        box = pcl_bv.fit(normal(30, 24), "aabb")
        self.assertEqual(list(box.contains([np.zeros(3), np.full(3, 99.0), np.zeros(3)])), [True, False, True])

    def test_labels_beyond_an_int64_are_refused(self):
        with self.assertRaisesRegex(ValueError, "more than 2"):
            pcl_bv.fit(normal(2), "aabb", labels=np.array([0, 2**63], np.uint64))


def pcl_bv_settings():
    return {"ground": {"method": "none"}, "filter": {"range_min": 0}, "cluster": {"tolerance": 0}}


if __name__ == "__main__":
    unittest.main()
