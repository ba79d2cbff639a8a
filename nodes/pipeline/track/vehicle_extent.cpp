// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "vehicle_extent.h"

#include <algorithm>
#include <cmath>

namespace pcl_bv::detail {
namespace {

// Sizes of what may be a visible side of a vehicle, metres.
constexpr double kLowestSide = 0.9, kHighestSide = 2.6;
constexpr double kNarrowestSide = 1.2;  // narrower: a person or a two-wheeler
constexpr double kLongestTwoWheeler = 2.5;
constexpr double kWidestFront = 2.1, kWidestVehicle = 2.6, kLongestVehicle = 6;
constexpr double kLeastLength = 3.9, kLeastWidth = 1.6;  // of a small car
constexpr double kLeastUpZ = 0.9;   // z of axis 2: sensors and boxes are compared in the plane of x and y
constexpr double kBeyondEnd = 0.4;  // distance beyond an end at which occlusion is tested

// Returns whether another object occludes the place beyond an end of the visible side.
bool is_occluded(const ObjectSlabs& seen, int axis, bool high, const Surroundings& around) {
  if (around.boxes == nullptr) return false;
  Eigen::Vector3d at = (seen.low + seen.high) / 2;
  at[axis] = high ? seen.high[axis] + kBeyondEnd : seen.low[axis] - kBeyondEnd;
  const int depth = 1 - axis;
  const double away = high_face_share(seen, depth, *around.viewpoints);
  at[depth] = (1 - away) * seen.high[depth] + away * seen.low[depth];  // on the visible side
  return around.viewpoints->occluded(seen.origin + seen.axes * at, *around.boxes, around.own);
}

void extend_moving(ObjectSlabs& seen, const Eigen::Vector3d& velocity, const Viewpoints& viewpoints) {
  const bool first = std::abs(seen.axes.col(0).dot(velocity)) >= std::abs(seen.axes.col(1).dot(velocity));
  const int along = first ? 0 : 1, across = 1 - along;
  const bool two_wheeler = seen.size(across) < kNarrowestSide && seen.size(along) < kLongestTwoWheeler;
  if (two_wheeler || seen.size(across) > kWidestVehicle) return;
  seen.grow(along, kLeastLength, high_face_share(seen, along, viewpoints));
  seen.grow(across, kLeastWidth, high_face_share(seen, across, viewpoints));
}

void extend_standing(ObjectSlabs& seen, const Surroundings& around) {
  const int side = seen.size(0) >= seen.size(1) ? 0 : 1, depth = 1 - side;
  if (seen.size(2) < kLowestSide || seen.size(side) < kNarrowestSide) return;
  const bool low_occluded = is_occluded(seen, side, false, around),
             high_occluded = is_occluded(seen, side, true, around);
  const double away = high_face_share(seen, depth, *around.viewpoints);
  if (low_occluded || high_occluded) {
    seen.grow(side, kLeastLength, low_occluded && high_occluded ? 0.5 : high_occluded ? 1 : 0);
    seen.grow(depth, kLeastWidth, away);
  } else if (seen.size(side) <= kWidestFront) {
    seen.grow(side, kLeastWidth, 0.5);
    seen.grow(depth, kLeastLength, away);
  } else {
    seen.grow(depth, kLeastWidth, away);
  }
}

}  // namespace

void ObjectSlabs::grow(int axis, double wanted, double above) {
  const double more = std::max(0.0, wanted - size(axis));
  high[axis] += above * more;
  low[axis] -= (1 - above) * more;
}

double high_face_share(const ObjectSlabs& slabs, int axis, const Viewpoints& viewpoints) {
  const VisibleFace visible =
      viewpoints.visible_face(slabs.axes.col(axis), slabs.origin, slabs.low[axis], slabs.high[axis]);
  return visible == VisibleFace::low ? 1 : visible == VisibleFace::high ? 0 : 0.5;
}

void extend_vehicle(ObjectSlabs& seen, const Eigen::Vector3d& velocity, const Surroundings& around) {
  if (!(seen.axes(2, 2) > kLeastUpZ)) return;
  const auto [shorter, longer] = std::minmax({seen.size(0), seen.size(1)});
  if (seen.size(2) > kHighestSide || longer > kLongestVehicle || shorter > kWidestVehicle) return;
  if (velocity.head<2>().isZero(0)) {
    extend_standing(seen, around);
  } else {
    extend_moving(seen, velocity, *around.viewpoints);
  }
}

}  // namespace pcl_bv::detail
