# SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
# SPDX-License-Identifier: BSD-3-Clause
import csv
import json
import os
import pathlib
import struct
import tempfile
import unittest

import numpy as np

import children
import pcl_bv
from clouds import normal, street

BIN = os.environ["PCL_BV_BIN_DIR"]


class Files(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def test_clouds_keep_every_field_and_bit(self):
        layout = [("intensity", "u1"), ("x", "f4"), ("y", "f4"), ("z", "f4"), ("t", "f8"), ("normal", "f4",
            (3,)), ("i", "i2")]
        array = np.zeros(100, layout)
        raw = np.random.default_rng(41).integers(0, 256, array.nbytes, np.uint8)
        array = raw.view(layout).copy()
        path = self.folder / "a.pcd"
        pcl_bv.write(path, array)
        again = pcl_bv.read(path)
        self.assertEqual(again.dtype.names, array.dtype.names)
        for name in array.dtype.names:
            self.assertEqual(again[name].tobytes(), array[name].tobytes(), name)
        organised = array.reshape(4, 25)
        pcl_bv.write(path, organised)
        self.assertEqual(pcl_bv.read(path).shape, (4, 25))
        for dtype in (np.float32, np.float64):
            points = normal(50, 42, dtype)
            pcl_bv.write(path, points[:, ::1], labels=np.arange(50) - 2)
            again = pcl_bv.read(path)
            self.assertEqual(again["x"].dtype, dtype)
            self.assertTrue(np.array_equal(np.stack([again[n] for n in "xyz"], axis=1), points))
            self.assertEqual(again["label"].astype(np.int32).tolist(), list(range(-2, 48)))
            self.assertEqual(list(pcl_bv.fit(points, "aabb", again["label"])), list(range(48)))

    def test_kitti_and_ply_and_text_are_read(self):
        points = normal(64, 43, np.float32)
        np.hstack([points, np.ones((64, 1), np.float32)]).tofile(self.folder / "a.bin")
        lines = ["%r %r %r" % tuple(map(float, p)) for p in points]
        head = "ply\nformat ascii 1.0\nelement vertex 64\n"
        head += "".join(f"property float {name}\n" for name in "xyz") + "end_header\n"
        (self.folder / "a.ply").write_text(head + "\n".join(lines) + "\n")
        for name in ("a.bin", "a.ply"):
            cloud = pcl_bv.read(self.folder / name)
            self.assertEqual(pcl_bv.fit(cloud, "dop26"), pcl_bv.fit(points, "dop26"))
        self.assertEqual(pcl_bv.read(self.folder / "a.bin").dtype.names, ("x", "y", "z", "intensity"))

    def test_odd_files_are_read_and_what_is_odd_is_a_warning(self):
        head = "FIELDS X Y Z label\nSIZE 2 8 4 4\nTYPE I F F U\nWIDTH 2\nHEIGHT 1\n"
        (self.folder / "a.pcd").write_text(head + "DATA ascii\n0 0 0 1.0\n1 2 3 -1\n")
        cloud = pcl_bv.read(self.folder / "a.pcd")
        self.assertEqual(cloud.dtype.names, ("X", "Y", "Z", "label"))
        self.assertEqual(cloud["label"].tolist(), [1, 4294967295])
        box = pcl_bv.Aabb([0, 0, 0], [1, 2, 3])
        self.assertEqual(pcl_bv.fit(cloud, "aabb"), box)
        self.assertEqual(pcl_bv.fit(next(pcl_bv.frames(self.folder / "a.pcd")).points, "aabb"), box)
        (self.folder / "a.pcd").write_text(head + "VIEWPOINT 1 0 0 1 0 0 0\nDATA ascii\n0 0 0 car\n1 2 3 4\n")
        for read in (pcl_bv.read, lambda path: next(pcl_bv.frames(path)).points):
            with self.assertWarnsRegex(UserWarning, "VIEWPOINT is not the identity.*'car' is not an "):
                self.assertEqual(pcl_bv.fit(read(self.folder / "a.pcd"), "aabb"), box)

    def test_an_array_of_a_file_owns_its_memory(self):
        pcl_bv.write(self.folder / "a.pcd", normal(1000, 44))
        x = pcl_bv.read(self.folder / "a.pcd")["x"]
        before = x.tobytes()
        for _ in range(20):
            pcl_bv.read(self.folder / "a.pcd")
        self.assertEqual(x.tobytes(), before)
        x[0] = 5  # and may be written

    @unittest.skipUnless(os.path.exists(os.path.join(BIN, "bv_stream")), "the commands are not built")
    def test_recordings_are_read_frame_by_frame(self):
        made = "synth:street-sequence:4"
        frames = list(pcl_bv.frames(made))
        for kind, name in (("mcap", "a.mcap"), ("rosbag2", "b")):
            path = self.folder / name
            children.run([os.path.join(BIN, "bv_stream"), "--source", made, "--rate", "max",
                          "--sink", f"{kind}:{path},points"], capture_output=True)
            recorded = list(pcl_bv.frames(path))
            self.assertEqual([f.stamp_ns for f in recorded], [f.stamp_ns for f in frames])
            for number, (one, other) in enumerate(zip(recorded, frames)):
                finite = np.isfinite(other.points).all(axis=1)
                self.assertEqual(pcl_bv.fit(one.points, "dop26"), pcl_bv.fit(other.points[finite], "dop26"))
                self.assertEqual(pcl_bv.fit(pcl_bv.read(path, number=number), "dop26"),
                                 pcl_bv.fit(one.points, "dop26"))
            with self.assertRaisesRegex(ValueError, "/nothing"):
                pcl_bv.frames(path, topic="/nothing")

    @unittest.skipUnless(os.path.exists(os.path.join(BIN, "bv_stream")), "the commands are not built")
    def test_what_is_noticed_of_a_recording_is_a_warning(self):
        path = self.folder / "damaged.mcap"
        children.run([os.path.join(BIN, "bv_stream"), "--source", "synth:street-sequence:6", "--rate", "max",
                      "--sink", f"mcap:{path},points"], capture_output=True)
        content = bytearray(path.read_bytes())
        middle = len(content) // 2
        content[middle:middle + 40] = b"\x55" * 40
        path.write_bytes(content)
        with self.assertWarnsRegex(UserWarning, "damaged.mcap: skipped the "):
            pcl_bv.read(path, number=4)
        with self.assertRaisesRegex(OSError, "clouds of the recording can be read, and numbers count these; skipped the "):
            pcl_bv.read(path, number=5)

    def test_a_capture_of_two_sensors_is_a_warning(self):
        def packet(azimuth, port):
            blocks = b"".join(struct.pack("<HH", 0xEEFF, (azimuth + 40 * block) % 36000) +
                              b"".join(struct.pack("<HB", 1000 + laser, laser) for laser in range(32))
                              for block in range(12))
            payload = blocks + struct.pack("<IBB", 0, 0x37, 0x22)
            datagram = struct.pack(">HHHH", 2368, port, 8 + len(payload), 0) + payload
            ip = struct.pack(">BBHHHBBH4s4s", 0x45, 0, 20 + len(datagram), 0, 0, 64, 17, 0,
                             b"\x01\x02\x03\x04", b"\0" * 4)
            return b"m" * 12 + b"\x08\0" + ip + datagram

        capture = struct.pack("<IHHiIII", 0xA1B2C3D4, 2, 4, 0, 0, 65535, 1)
        for number, azimuth in enumerate(range(0, 2 * 36000, 480)):
            for port in (2368, 2369):
                frame = packet(azimuth % 36000, port)
                capture += struct.pack("<IIII", 100, 1327 * number, len(frame), len(frame)) + frame
        path = self.folder / "two_sensors.pcap"
        path.write_bytes(capture)
        with self.assertWarnsRegex(UserWarning, r"two_sensors.pcap: packets of 2 sensors \(1.2.3.4:2368"):
            pcl_bv.read(path)

    def test_a_live_source_that_is_silent_can_be_interrupted(self):
        try:
            pcl_bv.frames("dds:/pcl_bv_python_test_of_silence")
        except OSError as error:
            self.assertIn("pcl_bv_dds.so is not installed", str(error))
            return
        program = "import pcl_bv\nframes = pcl_bv.frames('dds:/pcl_bv_python_test_of_silence')\n"
        program += "print('on', flush=True)\nnext(frames)"
        # More than once: a signal that came while a warning was printed was lost.
        for _ in range(5):
            self.assertIn("KeyboardInterrupt", children.interrupted(program))

    def test_frames_of_a_folder_come_in_their_order_with_rates_and_poses(self):
        for i in range(3):
            pcl_bv.write(self.folder / f"{i}.pcd", normal(10, i))
        (self.folder / "poses.txt").write_text("".join(f"1 0 0 {i} 0 1 0 0 0 0 1 0\n" for i in range(3)))
        frames = list(pcl_bv.frames(self.folder, rate=20, poses=self.folder / "poses.txt", frame_id="lidar"))
        self.assertEqual([f.stamp_ns for f in frames], [0, 50_000_000, 100_000_000])
        self.assertEqual([f.pose[0, 3] for f in frames], [0, 1, 2])
        self.assertEqual({f.frame_id for f in frames}, {"lidar"})
        self.assertTrue(frames[2].file.endswith("2.pcd"))
        points = frames[1].points
        del frames
        self.assertTrue(np.array_equal(points, normal(10, 1)))

    def test_poses_of_frames_that_are_missing_are_left_out_by_the_numbers_in_the_names(self):
        for i in (0, 2):
            pcl_bv.write(self.folder / f"00000{i}.pcd", normal(10, i))
        poses = self.folder / "poses.txt"
        poses.write_text("".join(f"1 0 0 {i} 0 1 0 0 0 0 1 0\n" for i in range(3)))
        with self.assertWarnsRegex(UserWarning, "3 poses of 2 frames: matched by the numbers in the file names"):
            frames = list(pcl_bv.frames(self.folder, poses=poses))
        self.assertEqual([f.pose[0, 3] for f in frames], [0, 2])

    def test_volumes_come_back_from_json_bit_by_bit(self):
        points = normal(200, 45)
        volumes = pcl_bv.fit(points, ["aabb", "dop26", "sphere", "obb", "cylinder", "capsule", "ellipsoid",
                                      "prism", "hull"])
        path = self.folder / "v.json"
        pcl_bv.write(path, volumes)
        self.assertEqual(pcl_bv.read_volumes(path), volumes)
        report = json.loads(path.read_text())
        self.assertEqual([v["method"] for v in report["clusters"][0]["volumes"]], [v.method for v in volumes])
        by_label = pcl_bv.fit(points, ["aabb", "sphere"], np.arange(200) % 3)
        pcl_bv.write(path, by_label)
        self.assertEqual([c["id"] for c in json.loads(path.read_text())["clusters"]], [0, 1, 2])

    def test_every_kind_of_file_is_written_of_results_and_volumes(self):
        result = pcl_bv.Pipeline(cluster={"min_size": 50}, volumes=["aabb", "sphere"]).process(street())
        for what in (result, result.clusters[0].volumes, pcl_bv.fit(street(), ["aabb"], result)):
            for extension, begin in ((".json", b"{"), (".csv", b""), (".ply", b"ply"), (".vtp", b"<?xml"),
                                     (".png", b"\x89PNG"),
                                     (".svg", b"<?xml")):
                path = self.folder / ("out" + extension)
                pcl_bv.write(path, what)
                self.assertEqual(path.read_bytes()[:len(begin)], begin)
        pcl_bv.write(self.folder / "r.csv", result)
        with open(self.folder / "r.csv") as file:
            rows = list(csv.DictReader(file))
        self.assertEqual(len(rows), 2 * len(result))
        self.assertEqual((rows[0]["seq"], rows[0]["method"]), ("0", "aabb"))
        self.assertEqual(float(rows[0]["volume"]), result.clusters[0].volumes[0].volume)

    def test_notebooks_get_pictures(self):
        result = pcl_bv.Pipeline(cluster={"min_size": 50}).process(street())
        self.assertEqual(result._repr_png_(), result.picture().png())
        shown = pcl_bv.show(street(), pcl_bv.fit(street(), "obb", result), result, width=400, height=300)
        self.assertEqual(shown._repr_png_()[:4], b"\x89PNG")
        path = self.folder / "p.png"
        pcl_bv.write(path, shown)
        self.assertEqual(path.read_bytes(), shown.png())
        self.assertNotEqual(result.picture(view="top").png(), result.picture(view="side").png())

    def test_pictures_and_files_of_points_of_any_magnitude(self):
        for value in (0, 5e-324, 1e-300, 1e16, 1e20, 1e38, 1e100):
            for extent in (0, 5e-324, 1e-300, 1e20, 9e99):
                points = np.full((20, 3), value, dtype=np.float64)
                points[::2] -= extent
                volumes = pcl_bv.fit(points, ["aabb", "obb-yaw", "sphere", "prism"])
                for view in ("iso", "top", "front", "side"):
                    self.assertEqual(pcl_bv.show(points, view=view).png()[:4], b"\x89PNG")
                shown = pcl_bv.show(points, volumes, width=400, height=300)
                self.assertEqual(shown.png()[:4], b"\x89PNG")
                for extension in (".json", ".csv", ".ply", ".vtp", ".svg"):
                    path = self.folder / ("out" + extension)
                    pcl_bv.write(path, shown if extension == ".svg" else volumes)
                    self.assertNotRegex(path.read_bytes(), rb"[ ,:>](-?inf|-?nan|NaN|null)")


if __name__ == "__main__":
    unittest.main()
