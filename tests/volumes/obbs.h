// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Oriented boxes to try claims on, and their exact judge.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "exact.h"
#include "pcl_bv/volumes/obb.h"

namespace pcl_bv::testing {

inline Obb random_obb(Random& random, const Scale& scale) {
  const Eigen::Vector3d size = random.vector(scale.extent).cwiseAbs();
  return {random.point(scale), random.isometry(1).linear(), size};
}

/// With the predicate of the stored numbers, for Obb and FloatObb.
template <typename Axes, typename Center, typename HalfExtents>
bool inside_slabs(const Axes& axes, const Center& center, const HalfExtents& half_extents,
                  const ExactPoint& p) {
  for (int i = 0; i < 3; ++i) {
    Rational s = 0;
    for (int k = 0; k < 3; ++k)
      s += Rational(axes(k, i)) * (p[static_cast<std::size_t>(k)] - Rational(center[k]));
    if (abs(s) > Rational(half_extents[i])) return false;
  }
  return true;
}

inline bool inside(const Obb& box, const ExactPoint& p) {
  return inside_slabs(box.axes(), box.center(), box.half_extents(), p);
}

inline bool inside(const FloatObb& box, const ExactPoint& p) {
  if (!box.half_extents.allFinite()) return true;
  return inside_slabs(box.axes, box.center, box.half_extents, p);
}

/// The least half extents in double that hold the point.
inline Eigen::Vector3d exact_half_extents(const Obb& frame, const Eigen::Vector3d& p) {
  Eigen::Vector3d result;
  for (int i = 0; i < 3; ++i) {
    const ExactPoint at = exact(p), c = exact(frame.center());
    const Rational s = abs(Rational(dot(frame.axis(i), at) - dot(frame.axis(i), c)));
    double h = static_cast<double>(s);
    while (Rational(h) < s)
      h = std::nextafter(h, std::numeric_limits<double>::infinity());
    while (h > 0 && Rational(std::nextafter(h, 0)) >= s)
      h = std::nextafter(h, 0);
    result[i] = h;
  }
  return result;
}

/// The vertices of the body of the predicate: with A q = s, s = +-h, by Cramer's rule.
inline std::array<ExactPoint, 8> exact_corners(const Obb& box) {
  const auto a = [&](int axis, int k) { return Rational(box.axes()(k, axis)); };
  const auto cofactor = [&](int axis, int k) -> Rational {
    const int i = (axis + 1) % 3, j = (axis + 2) % 3, l = (k + 1) % 3, m = (k + 2) % 3;
    return a(i, l) * a(j, m) - a(i, m) * a(j, l);
  };
  const Rational determinant = a(0, 0) * cofactor(0, 0) + a(0, 1) * cofactor(0, 1) + a(0, 2) * cofactor(0, 2);
  std::array<ExactPoint, 8> corners;
  for (unsigned n = 0; n < 8; ++n) {
    for (int k = 0; k < 3; ++k) {
      Rational q = 0;
      for (int axis = 0; axis < 3; ++axis) {
        const Rational h(box.half_extents()[axis]);
        q += cofactor(axis, k) * (n >> axis & 1 ? h : Rational(-h));
      }
      corners[n][static_cast<std::size_t>(k)] = Rational(box.center()[k]) + q / determinant;
    }
  }
  return corners;
}

/// Distance of two boxes by alternating projections, to about 1e-7 of their size: an independent judge.
inline double nearest_gap(const Obb& a, const Obb& b) {
  const auto nearest_in = [](const Obb& box, const Eigen::Vector3d& p) -> Eigen::Vector3d {
    const Eigen::Vector3d q = box.axes().transpose() * (p - box.center());
    return box.center() + box.axes() * q.cwiseMax(-box.half_extents()).cwiseMin(box.half_extents());
  };
  Eigen::Vector3d p = a.center(), r = p;
  for (int i = 0; i < 20'000; ++i) {
    r = nearest_in(b, p);
    const Eigen::Vector3d next = nearest_in(a, r);
    if ((next - p).stableNorm() <= 1e-13 * (next - r).stableNorm()) break;
    p = next;
  }
  return (p - r).stableNorm();
}

inline bool faces_separate(const Obb& a, const Obb& b) {
  const auto separates = [&](const Eigen::Vector3d& n) {
    const auto reach = [&](const Obb& box) {
      return box.half_extents().dot((box.axes().transpose() * n).cwiseAbs());
    };
    return std::abs(n.dot(b.center() - a.center())) > reach(a) + reach(b);
  };
  for (int i = 0; i < 3; ++i) {
    if (separates(a.axis(i)) || separates(b.axis(i))) return true;
  }
  return false;
}

}  // namespace pcl_bv::testing
