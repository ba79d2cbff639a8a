# SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
# SPDX-License-Identifier: BSD-3-Clause
"""What the benchmarks' page leaves empty is named: peers without rows, parts without results, uncommitted trees."""
import pathlib
import re
import sys
import types
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "benchmarks"))
import peer_list  # noqa: E402


def results_with(rows, parts, commit="0123456"):
    return types.SimpleNamespace(
        rows=rows,
        parts={part: {"commit": commit} for part in parts},
        matching=lambda pattern: [name for name in rows if re.match(pattern, name)],
    )


ALL_PARTS = {peer.part for peer in peer_list.PEERS}
ALL_ROWS = [
    *("pcl-dense/peer/gauss", "cgal-bounding-box/peer/gauss", "fcl-kdop18/peer/gauss"),
    *("cgal-min-sphere/peer/paper/xyz", "cgal-min-sphere/peer/cube/xyz", "over-cgal-min-sphere/sphere-exact"),
    *("turns/CGAL oriented_bounding_box over obb-min/car:300", "obb-min/avx2/stanford-bunny"),
    *("turns/PCL MomentOfInertia over obb-pca/car:300", "pcl::ConvexHull/peer/car", "qhull-of-all-points/peer/car"),
    *("over-pcl/street/n:9", "over-nanoflann/street/n:9", "dbscan-5-over-open3d/street", "over-pcl/sweep/n:9"),
    *("pipeline/pcl/street", "tree/over-flann/build", "tree/over-pcl-octree/build", "tree/over-nanoflann/build"),
    *("tree/over-fcl-bvh/build", "tree/over-embree/ray", "files/over-pcl/car", "files/over-laszip/laz/n:9"),
    "ros1/over-pcl_ros/aabb",
]


class PeerList(unittest.TestCase):
    def test_complete_results_leave_no_gap(self):
        self.assertEqual(peer_list.gaps(results_with(ALL_ROWS, ALL_PARTS)), [])

    def test_each_peer_without_rows_is_named_with_its_package(self):
        for peer in peer_list.PEERS:
            rows = [name for name in ALL_ROWS if not re.match(peer.rows, name)]
            gaps = peer_list.gaps(results_with(rows, ALL_PARTS))
            self.assertIn(f"{peer.name} (part `{peer.part}`): install {peer.packages}, build again", gaps)

    def test_a_part_without_results_is_named(self):
        self.assertIn("the whole part `trees`", peer_list.gaps(results_with(ALL_ROWS, ALL_PARTS - {"trees"})))

    def test_results_of_an_uncommitted_tree_are_named(self):
        gaps = peer_list.gaps(results_with(ALL_ROWS, ["boxes"], "0123456+changes"))
        self.assertIn("parts measured on a tree with uncommitted changes: boxes", gaps)


if __name__ == "__main__":
    unittest.main()
