# SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
# SPDX-License-Identifier: BSD-3-Clause
"""Every peer that the benchmarks compare with: its part, the rows it gives, the Debian packages it comes from."""
import collections

Peer = collections.namedtuple("Peer", "name part rows packages")

PEERS = [
    Peer("PCL's getMinMax3D", "boxes", "pcl-dense/peer/", "libpcl-dev"),
    Peer("CGAL's bounding box", "boxes", "cgal-bounding-box/peer/", "libcgal-dev"),
    Peer("FCL's k-DOPs", "boxes", "fcl-kdop18/peer/", "libfcl-dev"),
    Peer("CGAL's Min_sphere_d", "paper", "cgal-min-sphere/peer/paper", "libcgal-dev"),
    Peer("CGAL's Min_sphere_d", "spheres", "cgal-min-sphere/peer/(gauss|cube)", "libcgal-dev"),
    Peer("CGAL's Min_sphere_d, interleaved", "pairs", "over-cgal-min-sphere/", "libcgal-dev"),
    Peer("CGAL's oriented box", "obb", "turns/CGAL", "libcgal-dev"),
    Peer("meshes of libcgal-demo", "obb", "obb-min/[^/]*/stanford-bunny", "libcgal-demo"),
    Peer("PCL's MomentOfInertia", "obb", "turns/PCL MomentOfInertia", "libpcl-dev"),
    Peer("PCL's ConvexHull", "hulls", "pcl::ConvexHull/peer/", "libpcl-dev"),
    Peer("Qhull", "hulls", "qhull-of-all-points/peer/", "libqhull-dev"),
    Peer("PCL's clusters", "clusters", "over-pcl/(street|sparse)", "libpcl-dev"),
    Peer("nanoflann's clusters", "clusters", "over-nanoflann/", "libnanoflann-dev"),
    Peer("Open3D's DBSCAN", "clusters", "dbscan-[0-9]+-over-open3d/", "libopen3d-dev"),
    Peer("PCL's segmentation", "pipeline", "pipeline/pcl", "libpcl-dev"),
    Peer("FLANN", "trees", "tree/over-flann/", "libpcl-dev"),
    Peer("PCL's octree", "trees", "tree/over-pcl-octree/", "libpcl-dev"),
    Peer("nanoflann", "trees", "tree/over-nanoflann/", "libnanoflann-dev"),
    Peer("FCL and OctoMap", "trees", "tree/over-fcl-", "libfcl-dev liboctomap-dev"),
    Peer("Embree", "trees", "tree/over-embree/", "libembree-dev"),
    Peer("PCL's file reader", "files", "files/over-pcl/", "libpcl-dev"),
    Peer("LASzip's reader", "files", "files/over-laszip/", "liblaszip-dev"),
    Peer("pcl_ros", "ros1", "ros1/over-pcl_ros/", "libpcl-ros-dev libpcl-ros-segmentation0d"),
]


def missing(results):
    """One sentence for each peer without a row in `results`, and for each part without any."""
    lines = [
        f"{peer.name} (part `{peer.part}`): install {peer.packages}, build again"
        for peer in PEERS
        if peer.part in results.parts and not results.matching(peer.rows)
    ]
    absent = dict.fromkeys(peer.part for peer in PEERS if peer.part not in results.parts)
    if not results.matching("[^/]*/sweep/"):
        lines.append("rows on recorded sweeps: set PCL_BV_DATA to a folder with lidar_sequence/")
    return lines + [f"the whole part `{part}`" for part in absent]


def gaps(results):
    """What the page leaves empty, for its head and for the end of a run; empty if nothing is missing."""
    lines = missing(results)
    changed = uncommitted(results)
    if changed:
        lines.append(f"parts measured on a tree with uncommitted changes: {', '.join(changed)}")
    return lines


def uncommitted(results):
    """Parts that were measured on a tree with changes that no commit holds."""
    return [name for name, part in results.parts.items() if part["commit"].endswith("+changes")]
