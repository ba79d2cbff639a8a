// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The sub-algorithm of Gilbert, Johnson and Keerthi, which finds the point of a simplex that is nearest to
// the origin.
#pragma once

#include <array>
#include <optional>

#include "pcl_bv/numeric/vector3.h"

namespace pcl_bv::detail {

template <typename Real>
using Vector = std::array<Real, 3>;

template <typename Real>
Vector<Real> minus(const Vector<Real>& a, const Vector<Real>& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

template <typename Real>
Vector<Real> times(const Real& t, const Vector<Real>& a) {
  return {t * a[0], t * a[1], t * a[2]};
}

template <typename Real>
Vector<Real> plus(const Vector<Real>& a, const Vector<Real>& b) {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}

template <typename Real>
Real inner(const Vector<Real>& a, const Vector<Real>& b) {
  return (a[0] * b[0] + a[1] * b[1]) + a[2] * b[2];
}

/// A simplex of one to four points whose coordinates have a magnitude of about 1.
///
/// A part of the simplex is a vertex, an edge or a triangle. A part is a candidate if it contains the newest
/// point and also the foot of the perpendicular from the origin to the part. reduce() selects the candidate
/// whose foot is nearest to the origin, so the order of the tests does not matter. An inaccurate foot on a
/// thin part is farther away and is not selected (van den Bergen 1999 has this selection as a fallback). The
/// foot on a triangle is computed along the normal of the triangle. The accuracy of the normal depends on the
/// shape of the triangle, but not on its distance from the origin.
template <typename Real>
class Simplex {
 public:
  /// Adds a point. The simplex must have fewer than four points. After reduce() has returned a foot, it
  /// always has fewer.
  void add(const Vector<Real>& point) { points_[size_++] = point; }

  int size() const { return size_; }

  bool has(const Vector<Real>& p) const {
    for (int i = 0; i < size_; ++i) {
      const Vector<Real> d = minus(p, points_[i]);
      if (!(inner(d, d) > Real(0))) return true;
    }
    return false;
  }

  /// Reduces the simplex to the part that is nearest to the origin, and returns the foot on this part.
  /// Returns nothing if the simplex has four points that enclose the origin, and the determinant of any three
  /// of these points exceeds `margin` in magnitude.
  std::optional<Vector<Real>> reduce(double margin) {
    const int newest = size_ - 1;
    try_point(newest);
    for (int i = 0; i < newest; ++i)
      try_edge(i, newest);
    for (int i = 0; i < newest; ++i) {
      for (int j = i + 1; j < newest; ++j)
        try_triangle(i, j, newest);
    }
    if (size_ == 4 && surrounds_origin(margin)) return std::nullopt;
    keep();
    return best_;
  }

 private:
  void offer(const Vector<Real>& foot, std::array<int, 3> part, int count) {
    const Real square = inner(foot, foot);
    if (best_count_ != 0 && !(square < best_square_)) return;
    best_ = foot;
    best_square_ = square;
    best_part_ = part;
    best_count_ = count;
  }

  void try_point(int i) {
    best_count_ = 0;
    offer(points_[i], {i, 0, 0}, 1);
  }

  void try_edge(int i, int k) {
    const Vector<Real>&a = points_[i], &c = points_[k];
    const Vector<Real> e = minus(a, c);
    const Real length = inner(e, e), along = -inner(c, e);
    if (!(along > Real(0)) || !(along < length)) return;
    offer(plus(c, times(along / length, e)), {i, k, 0}, 2);
  }

  void try_triangle(int i, int j, int k) {
    const Vector<Real>&a = points_[i], &b = points_[j], &c = points_[k];
    const Vector<Real> n = cross3(minus(a, c), minus(b, c));
    const Real square = inner(n, n);
    if (!(square > Real(0))) return;
    if (!(inner(n, cross3(b, c)) > Real(0)) || !(inner(n, cross3(c, a)) > Real(0)) ||
        !(inner(n, cross3(a, b)) > Real(0))) {
      return;
    }
    offer(times(inner(n, c) / square, n), {i, j, k}, 3);
  }

  bool surrounds_origin(double margin) const {
    const Vector<Real>&a = points_[0], &b = points_[1], &c = points_[2], &d = points_[3];
    const Real limit(margin);
    std::array<Real, 4> parts{inner(b, cross3(d, c)), inner(a, cross3(c, d)), inner(a, cross3(d, b)),
                              inner(a, cross3(b, c))};
    const bool mirrored = parts[0] < Real(0);
    for (Real& part : parts) {
      if (mirrored) part = -part;
      if (!(part > limit)) return false;
    }
    return true;
  }

  void keep() {
    const std::array<Vector<Real>, 4> all = points_;
    for (int i = 0; i < best_count_; ++i)
      points_[i] = all[best_part_[i]];
    size_ = best_count_;
  }

  std::array<Vector<Real>, 4> points_;
  int size_ = 0;
  Vector<Real> best_;
  Real best_square_ = Real(0);
  std::array<int, 3> best_part_{};
  int best_count_ = 0;
};

}  // namespace pcl_bv::detail
