// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include <algorithm>
#include <cmath>
#include <numbers>

#include "pcl_bv/numeric/constants.h"
#include "pcl_bv/numeric/float_environment.h"
#include "pcl_bv/volumes/ellipsoid.h"
#include "ring_mesh.h"

namespace pcl_bv {
namespace {

// Carlson's symmetric integrals R_F and R_D by duplication (Carlson 1995), their series without the terms of
// fifth order, which are below 1e-14 of what is added last. All arguments not negative, z > 0, at most one of
// the others 0.
double carlson_rf(double x, double y, double z) {
  for (int i = 0; i < 60; ++i) {
    const double mean = (x + y + z) / 3;
    if (std::max({std::abs(x - mean), std::abs(y - mean), std::abs(z - mean)}) < 1e-3 * mean) break;
    const double step = std::sqrt(x * y) + std::sqrt(y * z) + std::sqrt(z * x);
    x = (x + step) / 4;
    y = (y + step) / 4;
    z = (z + step) / 4;
  }
  const double mean = (x + y + z) / 3;
  const double a = 1 - x / mean, b = 1 - y / mean, c = -a - b;
  const double e2 = a * b - c * c, e3 = a * b * c;
  return (1 - e2 / 10 + e3 / 14 + e2 * e2 / 24) / std::sqrt(mean);
}

double carlson_rd(double x, double y, double z) {
  double sum = 0, factor = 1;
  for (int i = 0; i < 60; ++i) {
    const double mean = (x + y + 3 * z) / 5;
    if (std::max({std::abs(x - mean), std::abs(y - mean), std::abs(z - mean)}) < 1e-3 * mean) break;
    const double step = std::sqrt(x * y) + std::sqrt(y * z) + std::sqrt(z * x);
    sum += factor / (std::sqrt(z) * (z + step));
    factor /= 4;
    x = (x + step) / 4;
    y = (y + step) / 4;
    z = (z + step) / 4;
  }
  const double mean = (x + y + 3 * z) / 5;
  const double a = 1 - x / mean, b = 1 - y / mean, c = -(a + b) / 3;
  const double e2 = a * b - 6 * c * c, e3 = (3 * a * b - 8 * c * c) * c, e4 = 3 * (a * b - c * c) * c * c;
  const double series = 1 - 3 * e2 / 14 + e3 / 6 + 9 * e2 * e2 / 88 - 3 * e4 / 22;
  return 3 * sum + factor * series / (mean * std::sqrt(mean));
}

// The greatest t with sum (r_i y_i / (r_i^2 + t))^2 = 1, for a point y >= 0 outside: then r_i^2 y_i / (r_i^2
// + t) is the nearest point (Eberly 2013). In units of the greatest radius.
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
  std::sort(r.begin(), r.end());  // r[2] is the greatest
  if (r[1] == 0) return 0;
  if (r[0] == 0) return 2 * std::numbers::pi * r[1] * r[2];
  const double unit = r[2], a = r[0] / unit, b = r[1] / unit;
  // 4 pi R_G(b^2, a^2, a^2 b^2), with the greatest radius 1 and R_G in terms of the other two integrals.
  const double x = b * b, y = a * a, z = a * a * b * b;
  const double lost = x == z || y == z ? 0 : (x - z) * (y - z) * carlson_rd(x, y, z) / 3;
  const double rg = (z * carlson_rf(x, y, z) - lost + 1) / 2;  // sqrt(x y / z) = 1
  return 4 * std::numbers::pi * rg * unit * unit;
}

double Ellipsoid::distance(const Eigen::Vector3d& point) const {
  const FloatEnvironment environment;
  if (point.hasNaN()) return kNan;
  if (empty()) return kInfinity;
  if (contains(point)) return 0;
  const Eigen::Vector3d q = point - center_;
  const double unit = radii_.maxCoeff();
  if (unit == 0) return q.stableNorm();
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
  std::vector<volumes_internal::Ring> rings;
  for (int i = 1 - steps; i < steps; ++i) {
    const double angle = std::numbers::pi / 2 * i / steps;
    rings.push_back({Eigen::Vector3d(0, 0, std::sin(angle)), std::cos(angle)});
  }
  Mesh mesh = volumes_internal::ring_mesh(rings, volumes_internal::Triad(Eigen::Vector3d::UnitZ()), sides);
  for (Eigen::Vector3d& v : mesh.vertices)
    v = center_ + axes_ * radii_.cwiseProduct(v);
  if (axes_.determinant() < 0) {
    for (auto& face : mesh.faces)
      std::reverse(face.begin(), face.end());
  }
  return mesh;
}

}  // namespace pcl_bv
