// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Functions that construct volumes from Python arguments, and the docstrings of the volumes' classes.
#pragma once

#include "precompiled.h"

namespace pcl_bv::python {
using namespace detail;

namespace py = pybind11;

Aabb make_aabb(py::handle min, py::handle max);
Obb make_obb(py::handle center, py::handle axes, py::handle half_extents);
Kdop make_kdop(py::handle directions, py::handle min, py::handle max);
Sphere make_sphere(py::handle center, py::handle radius);
Cylinder make_cylinder(py::handle center, py::handle axis, py::handle radius, py::handle half_height);
Capsule make_capsule(py::handle a, py::handle b, py::handle radius);
Ellipsoid make_ellipsoid(py::handle center, py::handle axes, py::handle radii);
Prism make_prism(py::handle axes, py::handle outline, py::handle low, py::handle high);
Hull make_hull(py::handle vertices, py::handle faces, py::handle planes, py::handle rank);

inline constexpr const char* aabb_doc = R"(Aabb(min, max)
--

An axis-aligned box: min <= p <= max in each coordinate. If any min is larger than its max, the box is empty.

>>> import pcl_bv
>>> box = pcl_bv.Aabb([0, 0, 0], [1, 2, 3])
>>> box.volume, box.center
(6.0, array([0.5, 1. , 1.5]))
)";

inline constexpr const char* obb_doc = R"(Obb(center, axes, half_extents)
--

An oriented box: |axes[i] . (p - center)| <= half_extents[i]. Raises ValueError unless the axes are
orthonormal to 1e-12. In boxes of obb-yaw and obb-lshape, axes[2] is up and axes[0] is the longer horizontal
axis, so 2 * half_extents is length, width, height.

>>> import numpy, pcl_bv
>>> pcl_bv.Obb([0, 0, 0], numpy.eye(3), [3, 2, 1]).volume
48.0
)";

inline constexpr const char* kdop_doc = R"(Kdop(directions, min, max)
--

A k-DOP: min[i] <= directions[i] . p <= max[i] for each of 3 to 49 directions. If any min is larger than its
max, the k-DOP is empty.

>>> import numpy, pcl_bv
>>> pcl_bv.Kdop(numpy.eye(3), [0, 0, 0], [1, 1, 1])
Kdop(k=6, volume=1)
)";

inline constexpr const char* sphere_doc = R"(Sphere(center, radius)
--

A solid sphere: |p - center| <= radius. If the radius is negative, the sphere is empty.

>>> import pcl_bv
>>> pcl_bv.Sphere([1, 2, 3], 4)
Sphere(center=[1, 2, 3], radius=4)
)";

inline constexpr const char* cylinder_doc = R"(Cylinder(center, axis, radius, half_height)
--

A cylinder: the points at most radius from the axis and at most half_height from the centre along the axis.
The axis is normalised.

>>> import pcl_bv
>>> pcl_bv.Cylinder([0, 0, 0], [0, 0, 2], 1, 3).axis
array([0., 0., 1.])
)";

inline constexpr const char* capsule_doc = R"(Capsule(a, b, radius)
--

A capsule: the points at most radius from the segment between a and b. If the radius is negative, the capsule
is empty.

>>> import pcl_bv
>>> pcl_bv.Capsule([0, 0, 0], [0, 0, 2], 1).aabb()
Aabb(min=[-1, -1, -1], max=[1, 1, 3])
)";

inline constexpr const char* ellipsoid_doc = R"(Ellipsoid(center, axes, radii)
--

An ellipsoid: sum over i of ((axes[i] . (p - center)) / radii[i])^2 <= 1. If a radius is 0, the ellipsoid is
flat along that axis.

>>> import numpy, pcl_bv
>>> pcl_bv.Ellipsoid([0, 0, 0], numpy.eye(3), [3, 2, 1]).contains([3, 0, 0])
True
)";

inline constexpr const char* hull_doc = R"(Hull(vertices, faces, planes, rank=3)
--

A convex hull: n . p <= d for each plane nx, ny, nz, d. Its measures and its mesh are those of vertices and
faces. A fitted hull has the planes of its faces and of its axis-aligned box.

>>> import pcl_bv
>>> hull = pcl_bv.fit([[0., 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], 'hull')
>>> hull.vertices.shape, hull.faces.shape, hull.planes.shape, hull.rank
((4, 3), (4, 3), (7, 4), 3)
)";

inline constexpr const char* prism_doc = R"(Prism(axes, outline, low, high)
--

An upright prism over a simple polygon. A point p has the coordinates u = axes[0] . p, v = axes[1] . p and
h = axes[2] . p. The prism is the set of all p with low <= h <= high whose (u, v) is inside the outline, which
has counter-clockwise corners and need not be convex. Its edges meet only at the corners that they share.
Without corners or with low > high, the prism is empty. overlaps() and padded regions use the prism over the
convex hull of the outline.

>>> import numpy, pcl_bv
>>> prism = pcl_bv.Prism(numpy.eye(3), [[0, 0], [2, 0], [0, 2]], 0, 1)
>>> prism.volume, prism.footprint_area, prism.contains([1, 1, 0.5])
(2.0, 2.0, True)
)";

inline constexpr const char* overlaps_doc = R"(overlaps(self, other, /)
--

Returns whether two volumes of the same class overlap. The test is conservative: only True may be wrong.
If either volume is empty, returns False.

>>> import pcl_bv
>>> pcl_bv.Sphere([0, 0, 0], 1).overlaps(pcl_bv.Sphere([0, 0, 2], 1))
True
)";

inline constexpr const char* merge_doc = R"(merge(self, other, /)
--

Returns a new volume of the same class that contains both. If one volume is empty, returns the other. Neither
argument changes.

For Aabb and Kdop the result is exact. For Sphere it is larger by rounding errors. For Obb it is not the
smallest box.

>>> import pcl_bv
>>> pcl_bv.Aabb([0, 0, 0], [1, 1, 1]).merge(pcl_bv.Aabb([2, 0, 0], [3, 1, 1]))
Aabb(min=[0, 0, 0], max=[3, 1, 1])
)";

inline constexpr const char* extend_doc = R"(extend(self, points, /)
--

Returns a new volume that also contains the points: three numbers, or (N, 3). Points that are not finite are
ignored.

>>> import pcl_bv
>>> pcl_bv.Aabb([0, 0, 0], [1, 1, 1]).extend([5, 0, 0])
Aabb(min=[0, 0, 0], max=[5, 1, 1])
)";

inline constexpr const char* tightened_doc = R"(tightened(self, /)
--

Returns the same k-DOP with each slab tightened to the support values of the volume. Useful after merge() or
transformed().

>>> import numpy, pcl_bv
>>> loose = pcl_bv.Kdop([[1, 0, 0], [0, 1, 0], [0, 0, 1], [1, 1, 1]], [0] * 4, [1, 1, 1, 9])
>>> bool(loose.tightened().max[3] < 3.1)
True
)";

}  // namespace pcl_bv::python
