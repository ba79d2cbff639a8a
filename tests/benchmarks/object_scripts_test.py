# SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
# SPDX-License-Identifier: BSD-3-Clause
"""The scripts that measure, model and draw objects, on small towns. The argument is the build folder."""
import importlib.util
import pathlib
import re
import shutil
import struct
import subprocess
import sys
import tempfile
import unittest
import zlib

BENCHMARKS = pathlib.Path(__file__).resolve().parents[2] / "benchmarks"
BUILD = sys.argv.pop()
TOWN = ["--tiles", "4", "--points", "20000"]
PAGE = "# Objects\n\n<!-- objects.py: begin -->\nold\n<!-- objects.py: end -->\n\nThe end.\n"


def run(script, *arguments):
    command = [sys.executable, "-B", BENCHMARKS / script, *arguments]
    return subprocess.run(command, capture_output=True, text=True, timeout=120, check=False)


def read_png(path):
    """The width of a picture with a palette, and its rows of colour numbers."""
    data, at, chunks = path.read_bytes(), 8, {}
    while at < len(data):
        (length,), name = struct.unpack(">I", data[at : at + 4]), data[at + 4 : at + 8]
        chunks[name] = data[at + 8 : at + 8 + length]
        at += length + 12
    width, height = struct.unpack(">II", chunks[b"IHDR"][:8])
    pixels = zlib.decompress(chunks[b"IDAT"])
    return width, [pixels[row * (width + 1) + 1 : (row + 1) * (width + 1)] for row in range(height)]


class InFolder(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.page = self.folder / "page.md"
        self.page.write_text(PAGE)

    def assert_refused(self, result, reason):
        self.assertEqual(result.returncode, 2, result.stderr)
        self.assertIn(reason, result.stderr)
        self.assertEqual(len(result.stderr.splitlines()), 1, result.stderr)
        self.assertEqual(self.page.read_text(), PAGE)


class Objects(InFolder):
    arguments = [BUILD, *TOWN, "--turns", "1", "--no-peers"]

    def test_the_table_is_written_between_its_markers(self):
        done = run("objects.py", *self.arguments, "--page", self.page)
        self.assertEqual(done.returncode, 0, done.stderr)
        before, rest = self.page.read_text().split("<!-- objects.py: begin -->\n")
        table, after = rest.split("<!-- objects.py: end -->")
        self.assertEqual((before, after), ("# Objects\n\n", "\n\nThe end.\n"))
        self.assertEqual(table, done.stdout)
        rows = [line.strip("| ").split(" | ") for line in table.splitlines() if line.startswith("| `")]
        self.assertEqual([row[0] for row in rows], ["`pcd_bv --together`", "`pcd_bv`"])
        self.assertEqual({row[1] for row in rows}, {"4"})
        self.assertEqual(len({row[6] for row in rows}), 1, "both find the same objects")
        self.assertGreater(int(rows[0][6]), 10)

    def test_a_dry_run_writes_no_page(self):
        done = run("objects.py", *self.arguments, "--page", self.page, "--dry")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("| `pcd_bv` | 4 |", done.stdout)
        self.assertEqual(self.page.read_text(), PAGE)

    def test_wrong_arguments_are_one_line(self):
        self.assert_refused(run("objects.py"), "required: build")
        self.assert_refused(run("objects.py", self.folder), "is no build folder: it has no bin/synth")
        self.assert_refused(run("objects.py", BUILD, "--tiles", "0"), "--tiles: '0' is not an integer from 1 on")
        self.assert_refused(run("objects.py", BUILD, "--turns", "x"), "--turns: 'x' is not an integer from 1 on")
        self.assert_refused(run("objects.py", BUILD, "--folder", self.folder / "none"), "none' is no folder")
        for page in (self.folder / "none.md", BENCHMARKS / "misses.md"):
            self.assert_refused(run("objects.py", BUILD, "--page", page), "has no section of objects.py")


@unittest.skipUnless(shutil.which("mpirun") and pathlib.Path(BUILD, "bin/pcd_bv_mpi").exists(), "MPI is not here")
class Scale(InFolder):
    arguments = [BUILD, "--only", "objects", "--tiles", "4", "--tile-points", "20000", "--turns", "1"]

    def test_the_model_of_objects_is_written_between_its_markers(self):
        self.page.write_text("<!-- scale.py: begin -->\nvolumes\n<!-- scale.py: end -->\n"
                             "<!-- scale.py objects: begin -->\nold\n<!-- scale.py objects: end -->\n")
        done = run("scale.py", *self.arguments, "--page", self.page)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(self.page.read_text(),
                         "<!-- scale.py: begin -->\nvolumes\n<!-- scale.py: end -->\n"
                         f"<!-- scale.py objects: begin -->\n{done.stdout}<!-- scale.py objects: end -->\n")
        checks = re.findall(r"^\| [\d.]+ M \| (\d) \| ([\d.]+) \| ([\d.]+) \|$", done.stdout, re.MULTILINE)
        self.assertEqual([ranks for ranks, _, _ in checks], ["1", "2"])
        rows = [line for line in done.stdout.splitlines() if line.startswith("| 10^")]
        self.assertEqual(len(rows), 4)
        self.assertEqual({row.count("|") for row in rows}, {9})

    def test_wrong_arguments_are_one_line(self):
        self.assert_refused(run("scale.py", BUILD, "--page", self.page), "has no section of scale.py")
        self.assert_refused(run("scale.py", BUILD, "--only", "boxes"), "--only")
        self.assert_refused(run("scale.py", BUILD, "--tiles", "0"), "--tiles: '0' is not an integer from 1 on")


class Index(InFolder):
    """What the model of scale.py counts in the files of two shares."""

    def test_counts_agree_with_the_points_and_borders_of_the_shares(self):
        sys.path.insert(0, str(BENCHMARKS))
        import object_index  # pylint: disable=import-outside-toplevel

        tiles = self.folder / "tiles"
        subprocess.run([f"{BUILD}/bin/synth", "town-objects:4:1:20000", tiles], check=True)

        def shares(count):
            for number in range(count):
                command = [f"{BUILD}/bin/pcd_bv", "--partial", self.folder / f"{number}", "--part", f"{number}/{count}"]
                subprocess.run([*command, "--cluster", "0.5", tiles], check=True)
            return object_index.Counts([object_index.Index(self.folder / f"{number}") for number in range(count)])

        points = sum(int(re.search(rb"POINTS (\d+)", path.read_bytes())[1]) for path in tiles.iterdir())
        one, two = shares(1), shares(2)
        self.assertEqual((one.points, two.points), (points, points))
        self.assertEqual((one.written, one.active, one.candidates), (0, 0, 0))
        self.assertEqual(one.runs, one.components, "a component that no other share is near is one run")
        self.assertLess(0, two.active)
        self.assertLess(two.active, two.written)
        self.assertLess(two.written, points)


@unittest.skipUnless(importlib.util.find_spec("numpy"), "numpy is not here")
class TownPicture(InFolder):
    def test_the_picture_has_the_town_and_boxes_around_its_objects(self):
        path = self.folder / "town.png"
        done = run("town_picture.py", BUILD, path, *TOWN)
        self.assertEqual(done.returncode, 0, done.stderr)
        width, rows = read_png(path)
        self.assertEqual((width, len(rows)), (258, 258))  # 2 x 2 tiles of 125 pixels, and margins
        colours = set(b"".join(rows))
        self.assertLessEqual({0, 1, 2}, colours, "background, borders and points")
        self.assertGreater(len(colours - {0, 1, 2}), 3, "boxes")
        middle = rows[129]
        self.assertGreater(middle.count(1), 150, "a border of tiles")

    def test_wrong_arguments_are_one_line(self):
        path = self.folder / "town.png"
        self.assert_refused(run("town_picture.py", BUILD), "required: out")
        self.assert_refused(run("town_picture.py", self.folder, path), "is no build folder: it has no bin/synth")
        self.assert_refused(run("town_picture.py", BUILD, self.folder / "none" / "town.png"), "no folder for")
        self.assert_refused(run("town_picture.py", BUILD, path, "--tiles", "-4"), "--tiles")
        self.assertFalse(path.exists())


if __name__ == "__main__":
    unittest.main()
