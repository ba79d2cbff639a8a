// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "pcl_bv/volumes/kdop.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

#include "pcl_bv/numeric/float_environment.h"
#include "pcl_bv/volumes/kdop_sets.h"

namespace pcl_bv {
using namespace detail;
namespace {

using Directions = std::vector<Eigen::Vector3d>;
using Pointer = std::shared_ptr<const KdopSet>;

Directions directions_of(DirectionSet set) {
  Directions directions;
  for (std::size_t k = 0; k < direction_count(set); ++k) {
    const CubeDirection& d = kCubeDirections[cube_direction(set, k)];
    directions.emplace_back(d[0], d[1], d[2]);
  }
  return directions;
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

// Returns the index of the direction with the largest score(direction) / |direction|^2. If several are equal,
// returns the first.
template <typename Score>
std::size_t best(const Directions& directions, const Score& score) {
  const auto value = [&](const Eigen::Vector3d& n) { return score(n) / n.squaredNorm(); };
  const auto less = [&](const Eigen::Vector3d& a, const Eigen::Vector3d& b) { return value(a) < value(b); };
  return std::max_element(directions.begin(), directions.end(), less) - directions.begin();
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

const Pointer& detail::kdop_set_of(DirectionSet set) {
  static const std::array<KdopSet, 4> sets{
      KdopSet(directions_of(DirectionSet::dop6)), KdopSet(directions_of(DirectionSet::dop14)),
      KdopSet(directions_of(DirectionSet::dop18)), KdopSet(directions_of(DirectionSet::dop26))};
  const auto unowned = [](const KdopSet& s) { return Pointer(std::shared_ptr<void>(), &s); };
  static const std::array<Pointer, 4> pointers{unowned(sets[0]), unowned(sets[1]), unowned(sets[2]),
                                               unowned(sets[3])};
  return pointers[static_cast<std::size_t>(set)];
}

const Pointer& KdopSet::dop6() {
  return kdop_set_of(DirectionSet::dop6);
}

const Pointer& KdopSet::dop14() {
  return kdop_set_of(DirectionSet::dop14);
}

const Pointer& KdopSet::dop18() {
  return kdop_set_of(DirectionSet::dop18);
}

const Pointer& KdopSet::dop26() {
  return kdop_set_of(DirectionSet::dop26);
}

bool operator==(const KdopSet& a, const KdopSet& b) {
  const FloatEnvironment environment;
  if (a.size() != b.size()) return false;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (a.direction(i) != b.direction(i)) return false;
  }
  return true;
}

}  // namespace pcl_bv
