// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "pcl_bv/kernels/support.h"
#include "support_plan.h"

namespace pcl_bv::detail {
namespace {

SupportDirections cube_directions(DirectionSet set) {
  SupportDirections directions;
  for (std::size_t k = 0; k < direction_count(set); ++k) {
    const CubeDirection& d = kCubeDirections[cube_direction(set, k)];
    directions.add({static_cast<double>(d[0]), static_cast<double>(d[1]), static_cast<double>(d[2])});
  }
  directions.cube = set;
  return directions;
}

Direction opposite_if(bool negative, const Direction& d) {
  return negative ? Direction{-d[0], -d[1], -d[2]} : d;
}

}  // namespace

const SupportDirections& SupportDirections::of(DirectionSet set) {
  static const SupportDirections sets[] = {
      cube_directions(DirectionSet::dop6), cube_directions(DirectionSet::dop14),
      cube_directions(DirectionSet::dop18), cube_directions(DirectionSet::dop26)};
  return sets[static_cast<std::size_t>(set)];
}

void SupportDirections::add(const Direction& direction) {
  if (count >= kMaxSupportDirections) {
    throw std::invalid_argument("a set holds at most " + std::to_string(kMaxSupportDirections) +
                                " directions");
  }
  const Direction size = magnitudes(direction);
  const double largest = std::max({size[0], size[1], size[2]});
  // std::max() may lose a NaN, but the sum does not.
  if (!(largest >= 1e-30 && largest <= 1e30) || !std::isfinite((size[0] + size[1]) + size[2])) {
    throw std::invalid_argument("direction " + std::to_string(count) +
                                " must be finite with its largest component from 1e-30 to 1e30");
  }
  const int exponent = std::ilogb(largest);
  exact[count] = direction;
  scaled[count] = {std::ldexp(direction[0], -exponent), std::ldexp(direction[1], -exponent),
                   std::ldexp(direction[2], -exponent)};
  cube.reset();
  ++count;
}

Direction SupportDirections::support_direction(std::size_t support) const {
  return opposite_if(support % 2 == 0, exact[support / 2]);
}

Direction SupportDirections::scaled_support_direction(std::size_t support) const {
  return opposite_if(support % 2 == 0, scaled[support / 2]);
}

void keep_larger_projection(const Direction& direction, const SupportPoint& other, SupportPoint& best) {
  if (!other.found) return;
  // Equal points need no arithmetic. Clouds may have many of them (beams without a return, for example).
  const int order = !best.found                 ? 1
                    : other.point == best.point ? 0
                                                : compare_along(direction, other.point, best.point);
  if (order > 0 || (order == 0 && other.index < best.index)) best = other;
}

double projection_lower_bound(const SupportDirections& set, std::size_t support, const Coordinates& point) {
  const Direction scaled = set.scaled_support_direction(support);
  return dot3(scaled, point) - double_error(scaled, point);
}

}  // namespace pcl_bv::detail
