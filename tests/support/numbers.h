// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// All stored numbers of a volume, to compare volumes bit by bit.
#pragma once

#include <bit>
#include <cstdint>
#include <variant>
#include <vector>

#include "pcl_bv/volumes/any_volume.h"

namespace pcl_bv::test {

inline std::vector<double> numbers(const Aabb& box) {
  return {box.min().x(), box.min().y(), box.min().z(), box.max().x(), box.max().y(), box.max().z()};
}

inline std::vector<double> numbers(const Kdop& kdop) {
  std::vector<double> all;
  for (std::size_t k = 0; k < kdop.size(); ++k)
    all.insert(all.end(), {kdop.min(k), kdop.max(k)});
  return all;
}

inline std::vector<double> numbers(const Sphere& sphere) {
  return {sphere.center().x(), sphere.center().y(), sphere.center().z(), sphere.radius()};
}

// By maps, since g++ 14 warns wrongly of the bounds if the vector grows.
inline std::vector<double> numbers_of_frame(const Eigen::Vector3d& center, const Eigen::Matrix3d& axes,
                                            const Eigen::Vector3d& sizes) {
  std::vector<double> all(15);
  Eigen::Map<Eigen::Vector3d>(all.data()) = center;
  Eigen::Map<Eigen::Matrix3d>(all.data() + 3) = axes;
  Eigen::Map<Eigen::Vector3d>(all.data() + 12) = sizes;
  return all;
}

inline std::vector<double> numbers(const Obb& box) {
  return numbers_of_frame(box.center(), box.axes(), box.half_extents());
}

inline std::vector<double> numbers(const Cylinder& cylinder) {
  const Eigen::Vector3d c = cylinder.center(), a = cylinder.axis();
  return {c.x(), c.y(), c.z(), a.x(), a.y(), a.z(), cylinder.radius(), cylinder.half_height()};
}

inline std::vector<double> numbers(const Capsule& capsule) {
  const Eigen::Vector3d a = capsule.a(), b = capsule.b();
  return {a.x(), a.y(), a.z(), b.x(), b.y(), b.z(), capsule.radius()};
}

inline std::vector<double> numbers(const Ellipsoid& ellipsoid) {
  return numbers_of_frame(ellipsoid.center(), ellipsoid.axes(), ellipsoid.radii());
}

inline std::vector<double> numbers(const Hull& hull) {
  std::vector<double> all{static_cast<double>(hull.rank())};
  for (const Eigen::Vector3d& v : hull.vertices())
    all.insert(all.end(), v.begin(), v.end());
  for (const Hull::Triangle& t : hull.triangles())
    all.insert(all.end(), t.begin(), t.end());
  for (const HullPlane& p : hull.planes())
    all.insert(all.end(), {p.normal.x(), p.normal.y(), p.normal.z(), p.offset});
  return all;
}

inline std::vector<double> numbers(const Prism& prism) {
  std::vector<double> all(prism.axes().data(), prism.axes().data() + 9);
  for (const Eigen::Vector2d& corner : prism.outline())
    all.insert(all.end(), corner.begin(), corner.end());
  all.insert(all.end(), {prism.low(), prism.high()});
  return all;
}

inline std::vector<double> numbers(const AnyVolume& volume) {
  return std::visit([](const auto& shape) { return numbers(shape); }, volume);
}

/// The same volume in a unit 1 / factor as long: what is no length stays.
template <typename Volume>
std::vector<double> scaled_numbers(const Volume& volume, double factor) {
  std::vector<double> all = numbers(volume);
  for (double& number : all)
    number *= factor;
  return all;
}

inline std::vector<double> scaled_numbers(const Obb& box, double factor) {
  return numbers(Obb(box.center() * factor, box.axes(), box.half_extents() * factor));
}

inline std::vector<double> scaled_numbers(const Cylinder& cylinder, double factor) {
  return numbers(Cylinder(cylinder.center() * factor, cylinder.axis(), cylinder.radius() * factor,
                          cylinder.half_height() * factor));
}

inline std::vector<double> scaled_numbers(const Ellipsoid& ellipsoid, double factor) {
  return numbers(Ellipsoid(ellipsoid.center() * factor, ellipsoid.axes(), ellipsoid.radii() * factor));
}

inline std::vector<double> scaled_numbers(const Prism& prism, double factor) {
  std::vector<Eigen::Vector2d> outline = prism.outline();
  for (Eigen::Vector2d& corner : outline)
    corner *= factor;
  return numbers(Prism(prism.axes(), outline, prism.low() * factor, prism.high() * factor));
}

inline std::vector<double> scaled_numbers(const Hull& hull, double factor) {
  std::vector<Eigen::Vector3d> vertices = hull.vertices();
  for (Eigen::Vector3d& v : vertices)
    v *= factor;
  std::vector<HullPlane> planes = hull.planes();
  for (HullPlane& p : planes)
    p.offset *= factor;
  return numbers(Hull(vertices, hull.triangles(), planes, hull.rank()));
}

/// Bits, not values: the centre of an empty sphere is NaN, and -0 is not 0.
inline std::vector<std::uint64_t> bits(const AnyVolume& volume) {
  std::vector<std::uint64_t> all;
  for (const double number : numbers(volume))
    all.push_back(std::bit_cast<std::uint64_t>(number));
  return all;
}

}  // namespace pcl_bv::test
