// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Docstrings of the functions and classes for segmentation.
#pragma once

namespace pcl_bv::python {

inline constexpr const char* clusters_doc =
    R"(Clusters of a cloud, the largest first, of equal ones that with the smallest point number.

clusters[i] is the point numbers of one, an int32 array. Arrays are read-only views of what this object holds.

>>> import pcl_bv
>>> clusters = pcl_bv.cluster([[0., 0, 0], [9, 0, 0], [0.1, 0, 0]], 0.5)
>>> [numbers.tolist() for numbers in clusters]
[[0, 2], [1]]
>>> clusters.labels
array([0, 1, 0], dtype=int32)
)";

inline constexpr const char* cluster_doc =
    R"(cluster(points, tolerance, *, min_size=1, max_size=None, min_points=1, tolerance_per_metre=0, oversized='drop', classes=None, class_settings=None, threads=1)
--

Points nearer to each other than `tolerance` (unit of the points, above 0) are one cluster: the partition of
PCL's EuclideanClusterExtraction and, with min_points, of DBSCAN, by exact cells. Points as fit() takes them;
those that are not finite are in no cluster.

min_size, max_size: clusters of fewer or more points are dropped and counted; None: no limit.
min_points: DBSCAN's core condition, itself included: points with fewer that near, and near no such point, are
    noise.
tolerance_per_metre: how much the tolerance grows with the distance from the origin.
oversized: clusters above max_size: 'drop', 'keep', or 'split' by half the tolerance.
classes: an integer for each point: points of different classes never share a cluster.
class_settings: {class: {'tolerance': .., 'min_size': .., 'max_size': .., 'drop': True}} where they differ.
threads: 0 for all processors. They do not change the result.

Returns Clusters. Raises TypeError or ValueError naming the argument, its value and what is allowed.

>>> import numpy, pcl_bv
>>> points = numpy.random.default_rng(1).normal(size=(1000, 3)) + numpy.repeat([[0.], [50]], 500, axis=0)
>>> pcl_bv.cluster(points, 2, min_size=10)
Clusters(2 of 1000 points, largest=500)
>>> pcl_bv.cluster(points, -1)
Traceback (most recent call last):
ValueError: tolerance: -1 is not above 0 and at most 1e+06
)";

inline constexpr const char* ground_class_doc =
    R"(What ground() found: found, normal and offset of the plane near the sensor, and the points on either side.

>>> import numpy, pcl_bv
>>> level = numpy.array([[x, y, 0.] for x in range(10) for y in range(10)] + [[5, 5, 2.]])
>>> split = pcl_bv.ground(level, 'plane')
>>> split.found, split.rest.tolist(), int(split.mask.sum())
(True, [100], 100)
)";

inline constexpr const char* ground_doc =
    R"(ground(points, method='zones', *, up='z', sensor=None, sensor_height=None, distance=None, max_slope_degrees=None, threads=1)
--

Finds the ground and splits the points by it. Metres; points as fit() takes them, x, y, z in the sensor's frame.

method: 'zones', for outdoors: it may rise and fall; or 'plane', for rooms and tables.
up: against gravity: 'x', '-z', ... or three numbers.
sensor: where zones are centred; None: the origin, or where the points are densest if they do not lie around it.
sensor_height: of the sensor (with a plane: of the origin) above the ground; None: learnt.
distance: points up to this far above the ground are ground; None: 0.15 of zones, 0.2 of a plane.
max_slope_degrees: 0 to 89; None: 20 of zones, 15 of a plane.

Returns a Ground. Nothing found is no error: found is False. Raises as cluster(). Warns (UserWarning) where no
ground is found, or everything is ground, where the points do not lie around the sensor's place, and where far
more of them were ground if the cloud were turned upside down.

>>> import pcl_bv
>>> street = pcl_bv.read('synth:street:20000:1')
>>> pcl_bv.ground(street).found
True
)";

inline constexpr const char* statistics_doc = R"(statistics(points, *, threads=1)
--

What a cloud is like, for choosing a range or a tolerance: a dict of box, an Aabb of the finite points that
are not at 0,0,0; spacing, the median distance to the nearest point, or None; nonfinite and zero, numbers of
points. Points as fit() takes them.

>>> import pcl_bv
>>> pcl_bv.statistics([[0., 0, 0], [1, 1, 1], [1, 1, 3]])['spacing']
2.0
)";

}  // namespace pcl_bv::python
