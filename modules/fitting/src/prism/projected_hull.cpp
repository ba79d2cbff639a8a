// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Double arithmetic decides nearly every comparison and orientation, exact arithmetic the others. The exact
// coordinates decide which points are corners, so that the corners of a cloud are those of its extreme
// points, and a Partial gives the same bits as the cloud.

#include "prism/projected_hull.h"

#include <algorithm>
#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>

#include "exact_integer.h"
#include "pcl_bv/numeric/constants.h"
#include "pcl_bv/numeric/coordinate_axis.h"
#include "pcl_bv/numeric/expansion.h"
#include "pcl_bv/numeric/vector3.h"
#include "pcl_bv/volumes/convex_chain.h"
#include "pcl_bv/volumes/planar_hull.h"

namespace pcl_bv::detail {
namespace {

using Integer = boost::multiprecision::cpp_int;

// Returns axis . (b - a), multiplied by 2^2252.
Integer exact_step(const Eigen::Vector3d& axis, const Coordinates& a, const Coordinates& b) {
  const auto integer_of = [](double x) { return exact_integer<Integer>(x, -1126); };
  Integer sum = 0;
  for (std::size_t k = 0; k < 3; ++k)
    sum += integer_of(axis[static_cast<int>(k)]) * (integer_of(b[k]) - integer_of(a[k]));
  return sum;
}

// A product of doubles as a sum of two doubles.
struct Product {
  Product(double a, double b)
      : high(a * b),
        low(std::fma(a, b, -high)),
        exact(a == 0 || b == 0 || std::abs(a) == 1 || std::abs(b) == 1 || std::abs(high) >= 0x1p-900) {}

  double high, low;
  bool exact;  // whether high + low is the product; not if low may have underflowed
};

}  // namespace

// With U = 2^-53, three products and two sums are off by at most 3.01 U of the sum of the products'
// magnitudes. The bound is 4 U of this sum, plus the smallest normal number for products that underflow.
GroundProjection::GroundProjection(const Ground& ground, const Supports& supports)
    : axes_{ground.east, ground.north} {
  double farthest = 0;
  for (std::size_t k = 0; k < 3; ++k)
    farthest = std::max({farthest, std::abs(supports.along[k].low), std::abs(supports.along[k].high)});
  scale_ = farthest > 0 ? std::ldexp(1.0, std::min(400 - std::ilogb(farthest), 1000)) : 1;
  for (int k = 0; k < 3; ++k) {
    const int i = (k + 1) % 3, j = (k + 2) % 3;
    for (const Product& p : {Product(axes_[0][i], axes_[1][j]), Product(-axes_[0][j], axes_[1][i])}) {
      has_exact_normal_ = has_exact_normal_ && p.exact;
      for (const double term : {p.high, p.low})
        if (term != 0) normal_[k].push_back(term);
    }
  }
  for (const Eigen::Vector3d& axis : axes_) {
    if (coordinate_axis(axis)) continue;
    double terms = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const double largest = std::max(std::abs(supports.along[k].low), std::abs(supports.along[k].high));
      terms += std::abs(axis[static_cast<int>(k)]) * largest;
    }
    error_bound_ = std::max(error_bound_, 0x1p-51 * terms + kSmallestNormal);
  }
}

ProjectedPoint GroundProjection::project(const Coordinates& p) const {
  return {p, {dot3(axes_[0], p), dot3(axes_[1], p)}};
}

int GroundProjection::compare(const ProjectedPoint& a, const ProjectedPoint& b, int axis) const {
  const double difference = a.at[axis] - b.at[axis];
  if (std::abs(difference) > 4 * error_bound_) return difference < 0 ? -1 : 1;
  if (is_exact() || a.point == b.point) return 0;
  Expansion exact;
  exact.add_dot(axes_[axis], a.point).add_dot(Eigen::Vector3d(-axes_[axis]), b.point);
  return exact.is_lossless() ? exact.sign() : exact_step(axes_[axis], b.point, a.point).sign();
}

// Let e be the error bound, 0 if the coordinates are exact. The differences of coordinates are off by at most
// 2 e and one rounding. The margin of 8 e exceeds the effect of 2 e on the products, and 32 e^2 exceeds the
// product of two errors.
int GroundProjection::turn(const ProjectedPoint& a, const ProjectedPoint& b, const ProjectedPoint& c) const {
  const Eigen::Vector2d ab = b.at - a.at, ac = c.at - a.at;
  const double left = ab.x() * ac.y(), right = ab.y() * ac.x();
  const double lengths =
      (std::abs(ab.x()) + std::abs(ab.y())) + (std::abs(ac.x()) + std::abs(ac.y())) + 4 * error_bound_;
  const double rounding =
      0x1p-50 * (std::abs(left) + std::abs(right)) + 8 * error_bound_ * lengths + kSmallestNormal;
  if (std::abs(left - right) > rounding) return left > right ? 1 : -1;
  if (is_exact()) return orientation(a.at, b.at, c.at);
  return exact_turn(a.point, b.point, c.point);
}

// With the axes e and n, (e . ab) (n . ac) - (n . ab) (e . ac) = (e x n) . (a x b + b x c + c x a). If up is
// near a coordinate axis, most terms of e x n are 0, so that the sum has few terms. Integers are needed only
// if products underflow. The sign does not change if all coordinates are multiplied by the power of two that
// keeps products in range.
int GroundProjection::exact_turn(const Coordinates& a, const Coordinates& b, const Coordinates& c) const {
  Expansion sum;
  bool exact = has_exact_normal_;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t i = (k + 1) % 3, j = (k + 2) % 3;
    const double factors[6][2] = {{a[i], b[j]},  {-a[j], b[i]}, {b[i], c[j]},
                                  {-b[j], c[i]}, {c[i], a[j]},  {-c[j], a[i]}};
    for (const double normal : normal_[k]) {
      for (const auto& [x, y] : factors) {
        const Product p(x * scale_, y * scale_);
        exact = exact && p.exact;
        sum.add_product(normal, p.high).add_product(normal, p.low);
      }
    }
  }
  if (exact && sum.is_lossless()) return sum.sign();
  const Integer cross = exact_step(axes_[0], a, b) * exact_step(axes_[1], a, c) -
                        exact_step(axes_[1], a, b) * exact_step(axes_[0], a, c);
  return cross.sign();
}

void GroundProjection::keep_corners(std::vector<ProjectedPoint>& points) const {
  struct Entry {
    double u;  // here too, so that most comparisons read no point
    std::size_t position;
  };
  std::vector<Entry> entries;
  entries.reserve(points.size());
  for (const ProjectedPoint& p : points)
    entries.push_back({p.at.x(), entries.size()});
  const auto order = [&](const ProjectedPoint& a, const ProjectedPoint& b) {
    const int first = compare(a, b, 0);
    return first != 0 ? first : compare(a, b, 1);
  };
  std::sort(entries.begin(), entries.end(), [&](const Entry& a, const Entry& b) {
    if (std::abs(a.u - b.u) > 4 * error_bound_) return a.u < b.u;
    const int sign = order(points[a.position], points[b.position]);
    return sign != 0 ? sign < 0 : a.position < b.position;
  });
  std::vector<ProjectedPoint> sorted;
  sorted.reserve(entries.size());
  for (const Entry& entry : entries) {
    const ProjectedPoint& p = points[entry.position];
    if (sorted.empty() || order(sorted.back(), p) != 0) sorted.push_back(p);
  }
  const std::vector<std::size_t> corners = convex_chain(
      sorted.size(),
      [&](std::size_t i, std::size_t j, std::size_t k) { return turn(sorted[i], sorted[j], sorted[k]); });
  points.clear();
  for (const std::size_t i : corners)
    points.push_back(sorted[i]);
}

PlaneBox GroundProjection::box(const Coordinates& p) const {
  Expansion u, v;
  u.add_dot(axes_[0], p);
  v.add_dot(axes_[1], p);
  return {{u.down(), v.down()}, {u.up(), v.up()}};
}

}  // namespace pcl_bv::detail
