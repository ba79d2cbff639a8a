// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The properties and methods that all volumes have.

#include "bind.h"
#include "pcl_bv/trees/region_mask.h"
#include "volume_object.h"

namespace pcl_bv::python {
using namespace detail;
namespace {

using namespace py::literals;
using Self = const VolumeObject&;

/// Returns whether the argument is a single point instead of rows of points.
bool is_one_point(py::handle object) {
  if (py::isinstance<py::array>(object)) {
    const auto array = py::reinterpret_borrow<py::array>(object);
    return array.ndim() == 1 && array.size() > 0 && !array.dtype().has_fields();
  }
  return (PyTuple_Check(object.ptr()) || PyList_Check(object.ptr())) && PySequence_Size(object.ptr()) == 3 &&
         PyNumber_Check(py::object(object[py::int_(0)]).ptr()) != 0 &&
         !py::hasattr(object[py::int_(0)], "__len__");  // an element with a length is a row
}

/// Returns three numbers, which may be NaN or infinite.
Eigen::Vector3d point_of(py::handle object) {
  const py::array_t<double> numbers = doubles(object, "points");
  if (numbers.size() != 3) raise_value_error("points", "expected three numbers, got " + repr_text(object));
  return {numbers.data()[0], numbers.data()[1], numbers.data()[2]};
}

py::object contains_points(Self self, py::handle points) {
  if (is_one_point(points)) return py::bool_(contains(self.value, point_of(points)));
  const PointArray array = points_of(points);
  std::vector<std::uint8_t> inside;
  {
    const py::gil_scoped_release unlocked;
    RegionMask({{self.value, 0}}).mark(array.view, inside);
  }
  return array_from_vector(std::move(inside)).attr("view")("bool");
}

py::object distances(Self self, py::handle points) {
  if (is_one_point(points)) return py::float_(distance(self.value, point_of(points)));
  const PointArray array = points_of(points);
  std::vector<double> found(array.view.count);
  {
    const py::gil_scoped_release unlocked;
    for (std::size_t i = 0; i < found.size(); ++i) {
      const Coordinates p = load_point(array.view, i);
      found[i] = distance(self.value, Eigen::Vector3d(p.x, p.y, p.z));
    }
  }
  return array_from_vector(std::move(found));
}

py::object ray(Self self, py::handle origin, py::handle direction) {
  const auto found = intersect(self.value, vector3(origin, "origin"), vector3(direction, "direction"));
  if (!found) return py::none();
  return py::make_tuple(found->enter, found->exit);
}

/// Returns the vertices, and a list that has the vertex indices of each face.
py::tuple mesh_of(Self self) {
  Mesh found;
  {
    const py::gil_scoped_release unlocked;
    found = mesh(self.value);
  }
  py::list faces(found.faces.size());
  for (std::size_t i = 0; i < found.faces.size(); ++i)
    faces[i] =
        py::array_t<std::int32_t>(static_cast<py::ssize_t>(found.faces[i].size()), found.faces[i].data());
  return py::make_tuple(array_of(found.vertices), std::move(faces));
}

py::object fit_text(Self self, std::string_view text) {
  if (self.method == nullptr || text.empty()) return py::none();
  return py::str(text.data(), text.size());
}

template <typename Number>
py::object fit_number(Self self, Number number) {
  if (self.method == nullptr) return py::none();
  return py::int_(number);
}

constexpr const char* volume_doc =
    R"(A volume: a closed set of points, in the frame and unit of the points to which it was fitted.

Volumes are immutable. Two volumes are equal if they have the same class and the same parameters, regardless
of their fits. Volumes have no hash. Pickling preserves every bit. Returned arrays are read-only copies.

Results of the fit. They are None for a volume that is not the result of a fit.

method: name of the method.
status: 'ok', 'degenerate' (flat points), 'no_valid_points' or 'failed'.
reason: why the fit failed.
used, dropped: numbers of points.
fit_rank: number of dimensions that the points span, 0 to 3.

>>> import pcl_bv
>>> box = pcl_bv.fit([[0., 0, 0], [1, 2, 0], [float('nan'), 0, 0]], 'aabb')
>>> box.status, box.used, box.dropped, box.fit_rank, box.surface_area
('degenerate', 2, 1, 1, 4.0)
)";

constexpr const char* contains_doc = R"(contains(self, points, /)
--

Returns whether points are inside: a bool for three numbers, an array of bool for points as for fit().

The test is conservative: rounding can only give True for a point just outside. The result is False for points
that are not finite and for an empty volume.

>>> import pcl_bv
>>> pcl_bv.Sphere([0, 0, 0], 2).contains([0, 0, 2])
True
>>> pcl_bv.Sphere([0, 0, 0], 2).contains([[0., 0, 2], [0, 0, 2.1]])
array([ True, False])
)";

constexpr const char* distance_doc = R"(distance(self, points, /)
--

Returns the distance to the volume, in the unit of the points: 0 inside, inf if it is empty, NaN for a NaN.

>>> import pcl_bv
>>> pcl_bv.Sphere([0, 0, 0], 2).distance([0, 0, 5])
3.0
)";

constexpr const char* support_doc = R"(support(self, direction, /)
--

Returns a point of the volume farthest along a direction of any length; NaN if the volume is empty.

>>> import pcl_bv
>>> pcl_bv.Aabb([0, 0, 0], [1, 2, 3]).support([1, -1, 1])
array([1., 0., 3.])
)";

constexpr const char* intersect_doc = R"(intersect(self, origin, direction, /)
--

Returns the interval of t in which the ray origin + t direction is inside: (enter, exit) with
0 <= enter <= exit, or None.

The interval encloses the exact interval. A direction of zero tests the origin.

>>> import pcl_bv
>>> pcl_bv.Aabb([1, -1, -1], [2, 1, 1]).intersect([0, 0, 0], [0, 1, 0]) is None
True
)";

constexpr const char* method_aabb_doc = R"(aabb(self, /)
--

Returns an axis-aligned box that contains the volume, by exact arithmetic.

>>> import pcl_bv
>>> pcl_bv.Sphere([0, 0, 0], 2).aabb()
Aabb(min=[-2, -2, -2], max=[2, 2, 2])
)";

constexpr const char* mesh_doc = R"(mesh(self, /)
--

Returns the surface as a mesh: vertices (V, 3), and for each face an array of vertex indices.

Faces are convex and counter-clockwise seen from outside; a flat volume may have none.

>>> import pcl_bv
>>> vertices, faces = pcl_bv.Aabb([0, 0, 0], [1, 1, 1]).mesh()
>>> vertices.shape, len(faces), len(faces[0])
((8, 3), 6, 4)
)";

constexpr const char* transformed_doc = R"(transformed(self, matrix, /)
--

Returns the transformed volume, of the same class. It contains the transformed points of the volume, by exact
arithmetic; an Aabb or Kdop is enlarged if necessary.

matrix: a 4 x 4 rigid transform: a rotation (orthonormal to 1e-6) and a translation; ValueError for others.

>>> import numpy, pcl_bv
>>> moved = numpy.eye(4)
>>> moved[0, 3] = 10
>>> pcl_bv.Aabb([0, 0, 0], [1, 1, 1]).transformed(moved)
Aabb(min=[10, 0, 0], max=[11, 1, 1])
)";

}  // namespace

void bind_volumes(py::module_& module) {
  py::class_<VolumeObject>(module, "Volume", volume_doc)
      .def_property_readonly(
          "shape", [](Self v) { return std::string(shape_name(v.value)); },
          "Its name in files: 'aabb', 'hull', ...")
      .def_property_readonly(
          "empty", [](Self v) { return empty(v.value); }, "Whether it contains no point.")
      .def_property_readonly(
          "volume", [](Self v) { return volume(v.value); }, "In cubed units; 0 if empty or flat.")
      .def_property_readonly(
          "surface_area", [](Self v) { return surface_area(v.value); },
          "In squared units; both sides of flat volumes are counted.")
      .def_property_readonly(
          "center", [](Self v) { return array_of(center(v.value)); },
          "The centre of mass; of a capsule its midpoint. NaN if empty.")
      .def_property_readonly(
          "method", [](Self v) { return fit_text(v, v.method == nullptr ? "" : v.method->name); },
          "The name of the method of the fit.")
      .def_property_readonly(
          "status", [](Self v) { return fit_text(v, status_name(v.fit.status)); },
          "'ok', 'degenerate', 'no_valid_points' or 'failed'.")
      .def_property_readonly(
          "reason", [](Self v) { return fit_text(v, v.fit.reason); }, "Why the fit failed.")
      .def_property_readonly(
          "used", [](Self v) { return fit_number(v, v.fit.used); }, "Number of enclosed points.")
      .def_property_readonly(
          "dropped", [](Self v) { return fit_number(v, v.fit.dropped); },
          "Number of points with a coordinate that is not finite (float64: or beyond 1e100).")
      .def_property_readonly(
          "fit_rank", [](Self v) { return fit_number(v, v.fit.rank); },
          "Number of dimensions that the points span, with a tolerance of 2^-36 of their extent.")
      .def("contains", contains_points, "points"_a, py::pos_only(), contains_doc)
      .def("distance", distances, "points"_a, py::pos_only(), distance_doc)
      .def(
          "support",
          [](Self v, py::handle along) { return array_of(support(v.value, vector3(along, "direction"))); },
          "direction"_a, py::pos_only(), support_doc)
      .def("intersect", ray, "origin"_a, "direction"_a, py::pos_only(), intersect_doc)
      .def(
          "aabb", [](Self v) { return to_python(aabb(v.value)); }, method_aabb_doc)
      .def("mesh", mesh_of, mesh_doc)
      .def(
          "transformed",
          [](Self v, py::handle matrix) {
            return to_python(transformed(v.value, isometry(matrix, "matrix")));
          },
          "matrix"_a, py::pos_only(), transformed_doc)
      .def(
          "__eq__", [](Self a, Self b) { return a.value == b.value; }, py::is_operator())
      .def("__repr__", repr_of);
}

}  // namespace pcl_bv::python
