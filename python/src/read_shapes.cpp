// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "read_shapes.h"
#include "pcl_bv/volumes/kdop_sets.h"

#include "arguments.h"
#include "arrays.h"

namespace pcl_bv::python {
using namespace detail;
namespace {

constexpr NumberRange any_number{-kNoLimit, kNoLimit};

double real(py::handle value, const char* name) {
  return number(value, name, any_number);
}

/// Returns three numbers. They may be NaN or infinite, as in empty volumes. The constructors of the shapes
/// check them.
Eigen::Vector3d three_numbers(py::handle value, const char* name) {
  const py::array_t<double> numbers = doubles(value, name);
  if (numbers.size() != 3) raise_value_error(name, "expected three numbers, got " + repr_text(value));
  return {numbers.data()[0], numbers.data()[1], numbers.data()[2]};
}

/// Returns an array of numbers of the shape (n, columns). An empty list is also allowed.
py::array_t<double> table(py::handle value, const char* name, py::ssize_t columns) {
  py::array_t<double> numbers = doubles(value, name);
  if (numbers.size() > 0 && (numbers.ndim() != 2 || numbers.shape(1) != columns))
    raise_value_error(name, "expected (n, " + std::to_string(columns) + ") numbers, got " + repr_text(value));
  return numbers;
}

std::vector<Eigen::Vector3d> vectors(py::handle value, const char* name) {
  const py::array_t<double> numbers = table(value, name, 3);
  std::vector<Eigen::Vector3d> list;
  for (py::ssize_t i = 0; i < numbers.size(); i += 3)
    list.emplace_back(Eigen::Map<const Eigen::Vector3d>(numbers.data() + i));
  return list;
}

/// Returns a matrix with the axes as columns. The axes are the rows of the argument.
Eigen::Matrix3d axes(py::handle value) {
  const std::vector<Eigen::Vector3d> rows = vectors(value, "axes");
  if (rows.size() != 3) raise_value_error("axes", "expected (3, 3) numbers, got " + repr_text(value));
  Eigen::Matrix3d m;
  m << rows[0], rows[1], rows[2];
  return m;
}

SlabVector slabs(py::handle value, const char* name) {
  const py::array_t<double> numbers = doubles(value, name);
  if (numbers.size() > static_cast<py::ssize_t>(KdopSet::max_size))
    raise_value_error(name, "more than 49 slabs");
  return Eigen::Map<const Eigen::VectorXd>(numbers.data(), numbers.size());
}

/// Returns the built-in set with these directions or, if there is none, a new set.
std::shared_ptr<const KdopSet> set_of(std::vector<Eigen::Vector3d> directions) {
  auto own = std::make_shared<const KdopSet>(std::move(directions));
  for (const DirectionSet set :
       {DirectionSet::dop6, DirectionSet::dop14, DirectionSet::dop18, DirectionSet::dop26}) {
    if (*kdop_set_of(set) == *own) return kdop_set_of(set);
  }
  return own;
}

}  // namespace

Aabb make_aabb(py::handle min, py::handle max) {
  return {three_numbers(min, "min"), three_numbers(max, "max")};
}
Obb make_obb(py::handle center, py::handle axes_rows, py::handle half_extents) {
  return {three_numbers(center, "center"), axes(axes_rows), three_numbers(half_extents, "half_extents")};
}
Kdop make_kdop(py::handle directions, py::handle min, py::handle max) {
  return {set_of(vectors(directions, "directions")), slabs(min, "min"), slabs(max, "max")};
}
Sphere make_sphere(py::handle center, py::handle radius) {
  return {three_numbers(center, "center"), real(radius, "radius")};
}
Cylinder make_cylinder(py::handle center, py::handle axis, py::handle radius, py::handle half_height) {
  return {three_numbers(center, "center"), three_numbers(axis, "axis"), real(radius, "radius"),
          real(half_height, "half_height")};
}
Capsule make_capsule(py::handle a, py::handle b, py::handle radius) {
  return {three_numbers(a, "a"), three_numbers(b, "b"), real(radius, "radius")};
}
Ellipsoid make_ellipsoid(py::handle center, py::handle axes_rows, py::handle radii) {
  return {three_numbers(center, "center"), axes(axes_rows), three_numbers(radii, "radii")};
}
Prism make_prism(py::handle axes_rows, py::handle outline, py::handle low, py::handle high) {
  const py::array_t<double> numbers = table(outline, "outline", 2);
  std::vector<Eigen::Vector2d> corners;
  for (py::ssize_t i = 0; i < numbers.size(); i += 2)
    corners.emplace_back(numbers.data()[i], numbers.data()[i + 1]);
  return {axes(axes_rows), std::move(corners), real(low, "low"), real(high, "high")};
}
Hull make_hull(py::handle vertices, py::handle faces, py::handle planes, py::handle rank) {
  const py::array_t<double> corners = table(faces, "faces", 3), sides = table(planes, "planes", 4);
  std::vector<Hull::Triangle> triangles;
  for (py::ssize_t i = 0; i < corners.size(); i += 3) {
    Hull::Triangle& triangle = triangles.emplace_back();
    std::transform(corners.data() + i, corners.data() + i + 3, triangle.begin(), [](double number) {
      const bool whole = number >= 0 && number <= 2147483647.0 && number == std::floor(number);
      return whole ? static_cast<std::int32_t>(number) : -1;  // invalid index: the constructor throws
    });
  }
  std::vector<HullPlane> half_spaces;
  for (py::ssize_t i = 0; i < sides.size(); i += 4)
    half_spaces.push_back({Eigen::Map<const Eigen::Vector3d>(sides.data() + i), sides.data()[i + 3]});
  return {vectors(vertices, "vertices"), std::move(triangles), std::move(half_spaces),
          static_cast<int>(whole_number(rank, "rank", {0, 3}))};
}

}  // namespace pcl_bv::python
