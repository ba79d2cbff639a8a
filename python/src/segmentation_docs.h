// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Docstrings of the functions and classes for segmentation.
#pragma once

namespace pcl_bv::python {
using namespace detail;

inline constexpr const char* clusters_doc =
    R"(The clusters of a cloud, in descending order of size. Clusters of equal size are ordered by their
smallest point index.

clusters[i] is an int32 array of the point indices of cluster i. Arrays are read-only views of this object's
data.

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

Groups points into clusters. Two points that are nearer to each other than `tolerance` (in the unit of the
points, above 0) are in the same cluster. The result is the partition of PCL's EuclideanClusterExtraction or,
with min_points, of DBSCAN, computed by exact cells.

points: as for fit(). Points that are not finite are in no cluster.
min_size, max_size: clusters with fewer or more points are dropped and counted; None: no limit.
min_points: the core condition of DBSCAN. A core point has at least min_points points nearer than the
    tolerance, itself included. Points that are neither core points nor nearer than the tolerance to one are
    noise. Points at exactly the tolerance are not linked (scikit-learn's DBSCAN links them).
tolerance_per_metre: growth of the tolerance per metre of distance from the origin.
oversized: treatment of clusters with more than max_size points: 'drop', 'keep', or 'split' with half the
    tolerance.
classes: an integer for each point. Points of different classes never share a cluster.
class_settings: {class: {'tolerance': .., 'min_size': .., 'max_size': .., 'drop': True}} for classes with
    other settings.
threads: number of threads; 0: all processors. Does not change the result.

Returns Clusters. Raises TypeError or ValueError with the argument, its value and the allowed values.

>>> import numpy, pcl_bv
>>> points = numpy.random.default_rng(1).normal(size=(1000, 3)) + numpy.repeat([[0.], [50]], 500, axis=0)
>>> pcl_bv.cluster(points, 2, min_size=10)
Clusters(2 of 1000 points, largest=500)
>>> pcl_bv.cluster(points, -1)
Traceback (most recent call last):
ValueError: tolerance: -1 is not above 0 and at most 1e+06
)";

inline constexpr const char* ground_class_doc =
    R"(The result of ground(): whether the ground is found, normal and offset of the ground plane near the
sensor, and the indices of ground points and of other points.

>>> import numpy, pcl_bv
>>> level = numpy.array([[x, y, 0.] for x in range(10) for y in range(10)] + [[5, 5, 2.]])
>>> split = pcl_bv.ground(level, 'plane')
>>> split.found, split.rest.tolist(), int(split.mask.sum())
(True, [100], 100)
)";

inline constexpr const char* ground_doc =
    R"(ground(points, method='zones', *, up='z', sensor=None, sensor_height=None, distance=None, max_slope_degrees=None, cell_size=None, threads=1)
--

Detects the ground and splits the points into ground and other points. Lengths are in metres.

points: as for fit(), with x, y, z in the sensor's frame.
method: 'zones' for uneven ground outdoors, 'plane' for floors and tables, 'slope' for maps.
up: the direction opposite to gravity: 'x', '-z', ... or three numbers.
sensor: only with 'zones', their centre; None: the origin or, if the points do not lie around it, the position where
    they are densest.
sensor_height: height of the sensor (with 'plane': of the origin) above the ground; None: estimated.
    Not allowed with 'slope'.
distance: largest height of ground points above the ground; None: 0.2, with 'zones' 0.15.
max_slope_degrees: 0 to 89; None: 20, with 'plane' 15.
cell_size: only with 'slope', the side of the cells, 0.01 to 1000; None: 1.

Returns a Ground. If no ground is found, found is False. Raises errors as cluster() does. Warns
(UserWarning) if no ground is found, if everything is ground, if the points do not lie around the sensor, and
if far more points would be ground with the cloud turned upside down.

>>> import pcl_bv
>>> street = pcl_bv.read('synth:street:20000:1')
>>> pcl_bv.ground(street).found
True
)";

inline constexpr const char* statistics_doc = R"(statistics(points, *, threads=1)
--

Returns statistics of a cloud for choosing a range or a tolerance, as a dict with the keys

box: the Aabb of the finite points that are not at 0,0,0.
spacing: the median distance from a point to its nearest other point, or None.
nonfinite, zero: the number of points that are not finite, and that are at 0,0,0.

points: as for fit().

>>> import pcl_bv
>>> pcl_bv.statistics([[0., 0, 0], [1, 1, 1], [1, 1, 3]])['spacing']
2.0
)";

}  // namespace pcl_bv::python
