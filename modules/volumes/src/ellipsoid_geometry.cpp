// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include <algorithm>
#include <boost/math/special_functions/ellint_rg.hpp>
#include <cmath>
#include <numbers>

#include "pcl_bv/numeric/constants.h"
#include "pcl_bv/numeric/float_environment.h"
#include "pcl_bv/volumes/ellipsoid.h"
#include "ring_mesh.h"

namespace pcl_bv {
using namespace detail;
namespace {

// Returns the largest t with sum (r_i y_i / (r_i^2 + t))^2 = 1, for a point y >= 0 outside the ellipsoid with
// radii r. The point of the ellipsoid nearest to y is then r_i^2 y_i / (r_i^2 + t) (Eberly 2013). Lengths are
// in units of the largest radius.
double nearest_parameter(const Eigen::Vector3d& r, const Eigen::Vector3d& y) {
  const auto excess = [&](double t) {
    double sum = -1;
    for (int i = 0; i < 3; ++i) {
      const double term = r[i] * y[i] > 0 ? r[i] * y[i] / (r[i] * r[i] + t) : 0;
      sum += term * term;
    }
    return sum;
  };
  double low = 0, high = Eigen::Vector3d(r.cwiseProduct(y)).stableNorm();
  for (int i = 0; i < 1100 && low < high; ++i) {
    const double middle = low + (high - low) / 2;
    if (middle == low || middle == high) break;
    (excess(middle) > 0 ? low : high) = middle;
  }
  return high;
}

}  // namespace

double Ellipsoid::surface_area() const {
  const FloatEnvironment environment;
  if (empty()) return 0;
  Eigen::Vector3d r = radii_;
  std::sort(r.begin(), r.end());  // r[2] is the largest
  if (r[1] == 0) return 0;
  if (r[0] == 0) return 2 * std::numbers::pi * r[1] * r[2];
  const double unit = r[2], a = r[0] / unit, b = r[1] / unit;
  // Carlson's symmetric integral. The policy prevents promotion to long double, whose precision depends on
  // the platform, so the result has the same bits on all platforms.
  const boost::math::policies::policy<boost::math::policies::promote_double<false>> doubles;
  const double integral = boost::math::ellint_rg(b * b, a * a, a * a * b * b, doubles);
  return 4 * std::numbers::pi * integral * unit * unit;
}

double Ellipsoid::distance(const Eigen::Vector3d& point) const {
  const FloatEnvironment environment;
  if (point.hasNaN()) return kNan;
  if (empty() || !point.allFinite()) return kInfinity;
  if (contains(point)) return 0;
  const Eigen::Vector3d q = point - center_;
  const double unit = radii_.maxCoeff();
  // From so far away an ellipsoid is a point, and in its unit squares of the distance could overflow.
  if (unit <= 0x1p-500 * q.cwiseAbs().maxCoeff()) return q.stableNorm();
  const Eigen::Vector3d r = radii_ / unit, y = (axes_.transpose() * q).cwiseAbs() / unit;
  const double t = nearest_parameter(r, y);
  Eigen::Vector3d away;
  for (int i = 0; i < 3; ++i)
    away[i] = t > 0 ? y[i] * (t / (r[i] * r[i] + t)) : std::max(0.0, y[i] - r[i]);
  return away.stableNorm() * unit;
}

Mesh Ellipsoid::mesh() const {
  const FloatEnvironment environment;
  if (empty()) return {};
  constexpr int sides = 24, steps = 7;
  std::vector<detail::Ring> rings;
  for (int i = 1 - steps; i < steps; ++i) {
    const double angle = std::numbers::pi / 2 * i / steps;
    rings.push_back({Eigen::Vector3d(0, 0, std::sin(angle)), std::cos(angle)});
  }
  Mesh mesh = detail::ring_mesh(rings, detail::Triad(Eigen::Vector3d::UnitZ()), sides);
  for (Eigen::Vector3d& v : mesh.vertices)
    v = center_ + axes_ * radii_.cwiseProduct(v);
  if (axes_.determinant() < 0) {
    for (auto& face : mesh.faces)
      std::reverse(face.begin(), face.end());
  }
  return mesh;
}

}  // namespace pcl_bv
