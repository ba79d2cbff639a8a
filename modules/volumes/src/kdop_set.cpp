// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The built-in direction sets and the checks of a user's own.
#include "pcl_bv/volumes/kdop_set.h"

#include <Eigen/Geometry>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

namespace pcl_bv {
namespace {

using Directions = std::vector<Eigen::Vector3d>;
using Pointer = std::shared_ptr<const KdopSet>;

Directions axes() {
  return {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
}
Directions diagonals() {
  return {{1, 1, 1}, {1, 1, -1}, {1, -1, 1}, {1, -1, -1}};
}
Directions edges() {
  return {{1, 1, 0}, {1, -1, 0}, {1, 0, 1}, {1, 0, -1}, {0, 1, 1}, {0, 1, -1}};
}

Directions operator+(Directions a, const Directions& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

// Shares no ownership: the set is a static.
Pointer unowned(const KdopSet& set) {
  return {std::shared_ptr<void>(), &set};
}

void check(const Directions& directions) {
  const std::size_t n = directions.size();
  if (n < KdopSet::min_size || n > KdopSet::max_size) {
    throw std::invalid_argument("KdopSet: " + std::to_string(n) + " directions, must be 3 to 49");
  }
  for (std::size_t i = 0; i < n; ++i) {
    const double largest = directions[i].cwiseAbs().maxCoeff();
    if (!directions[i].allFinite() || largest < 1e-30 || largest > 1e30) {
      throw std::invalid_argument("KdopSet: direction " + std::to_string(i) +
                                  " must be finite with its largest component from 1e-30 to 1e30");
    }
  }
}

// Index of the first greatest score(direction) / |direction|^2.
template <typename Score>
std::size_t best(const Directions& directions, const Score& score) {
  std::size_t winner = 0;
  double best_value = -1;
  for (std::size_t i = 0; i < directions.size(); ++i) {
    const double value = score(directions[i]) / directions[i].squaredNorm();
    if (value > best_value) {
      best_value = value;
      winner = i;
    }
  }
  return winner;
}

std::array<std::size_t, 3> find_basis(const Directions& directions) {
  const Eigen::Vector3d a = directions[0].normalized();
  const std::size_t second = best(directions, [&](const auto& n) { return a.cross(n).squaredNorm(); });
  const Eigen::Vector3d normal = a.cross(directions[second].normalized());
  const auto height2 = [&](const Eigen::Vector3d& n) { return normal.dot(n) * normal.dot(n); };
  const std::size_t third = best(directions, height2);
  if (std::sqrt(height2(directions[third].normalized())) < 1e-6) {
    throw std::invalid_argument(
        "KdopSet: directions must span space (some three unit directions with a determinant of at least "
        "1e-6)");
  }
  return {0, second, third};
}

}  // namespace

KdopSet::KdopSet(std::vector<Eigen::Vector3d> directions) : directions_(std::move(directions)) {
  check(directions_);
  basis_ = find_basis(directions_);
}

const Pointer& KdopSet::dop6() {
  static const KdopSet set(axes());
  static const Pointer pointer = unowned(set);
  return pointer;
}

const Pointer& KdopSet::dop14() {
  static const KdopSet set(axes() + diagonals());
  static const Pointer pointer = unowned(set);
  return pointer;
}

const Pointer& KdopSet::dop18() {
  static const KdopSet set(axes() + edges());
  static const Pointer pointer = unowned(set);
  return pointer;
}

const Pointer& KdopSet::dop26() {
  static const KdopSet set(axes() + diagonals() + edges());
  static const Pointer pointer = unowned(set);
  return pointer;
}

bool operator==(const KdopSet& a, const KdopSet& b) {
  if (a.size() != b.size()) return false;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (a.direction(i) != b.direction(i)) return false;
  }
  return true;
}

}  // namespace pcl_bv
