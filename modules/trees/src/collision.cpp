// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "pcl_bv/trees/collision.h"

#include <algorithm>
#include <bit>
#include <stdexcept>

#include "inflated.h"
#include "pcl_bv/numeric/directed.h"
#include "pcl_bv/numeric/float_environment.h"
#include "pcl_bv/parallel/execution.h"
#include "pcl_bv/trees/argument_checks.h"
#include "pcl_bv/volumes/pair_queries.h"
#include "rotatable.h"
#include "sphere_around.h"
#include "transformed_point.h"
#include "tree_overlap.h"
#include "vectors.h"
#include "volume_boxes.h"
#include "volume_walk.h"

namespace pcl_bv {
using namespace detail;
namespace {

void require(const Eigen::Isometry3d& pose, double margin) {
  if (!pose.matrix().allFinite()) throw std::invalid_argument("within(): the pose must be finite");
  if (!(margin >= 0 && margin <= kMaxCoordinate))
    throw_out_of_range_value("within(): the margin must be from 0 to 1e100", margin);
}

struct Prepared {
  ConvexBody body;
  AnyVolume rotatable_volume;  // the volume, or a larger volume, of a type that can be rotated
  Sphere bounding_sphere;      // a sphere around the volume; empty if none is known

  explicit Prepared(const AnyVolume& volume)
      : body(volume),
        rotatable_volume(rotatable(volume)),
        bounding_sphere(sphere_around(extent_of(volume))) {}
};

// Returns whether a point may be within `margin` of a moved volume. The result is true for every volume that
// is within the margin, and may be true for other volumes. This test runs before is_within(), because it
// takes only a fiftieth of the time.
bool may_be_within(const PointTree& points, const Prepared& volume, const Eigen::Isometry3d& pose,
                   double stretch, double margin) {
  if (volume.body.empty()) return false;
  if (volume.bounding_sphere.empty()) return true;
  const TransformedPoint center = transform_point(pose, coordinates(volume.bounding_sphere.center()));
  return any_within(points, center, volume.bounding_sphere.radius() * stretch + margin);
}

// Returns whether a point is within `margin` of a moved volume.
bool is_within(const PointTree& points, const Prepared& volume, const Eigen::Isometry3d& pose,
               double margin) {
  const ConvexBody body = volume.body.transformed(pose);
  const PointView view = packed_tree(points).view();
  return walk_inside(points.isa(), packed_tree(points),
                     inflated(transformed(volume.rotatable_volume, pose), margin),
                     [&](std::size_t packet, std::uint32_t bits) {
                       for (; bits != 0; bits &= bits - 1) {
                         const auto lane = static_cast<std::size_t>(std::countr_zero(bits));
                         const Coordinates p = load_point(view, packet * kTreeWidth + lane);
                         if (distance(body, vector(p)) <= margin) return true;
                       }
                       return false;
                     });
}

// Returns a box around all points within `margin` of a moved volume.
PositionBounds extent_near(const AnyVolume& volume, const Eigen::Isometry3d& pose, double margin) {
  PositionBounds box = extent_of(transformed(volume, pose));
  box.low = {-add_up(-box.low.x, margin), -add_up(-box.low.y, margin), -add_up(-box.low.z, margin)};
  box.high = {add_up(box.high.x, margin), add_up(box.high.y, margin), add_up(box.high.z, margin)};
  return box;
}

}  // namespace

struct MovingVolumes::State {
  std::vector<AnyVolume> volumes;
  std::vector<Prepared> prepared;
  VolumeBoxes boxes;
};

MovingVolumes::MovingVolumes(std::vector<AnyVolume> volumes) {
  const FloatEnvironment environment;
  auto state = std::make_shared<State>();
  state->volumes = std::move(volumes);
  std::vector<PositionBounds> extents;
  for (const AnyVolume& volume : state->volumes) {
    state->prepared.emplace_back(volume);
    extents.push_back(extent_of(volume));
  }
  state->boxes.build(extents, Serial{});
  state_ = std::move(state);
}

const std::vector<AnyVolume>& MovingVolumes::volumes() const {
  return state_->volumes;
}

namespace {

// Calls found(i) for each volume i that is within `margin` of a point, in ascending order. Stops and returns
// true when found() returns true.
template <typename Found>
bool each_within(const PointTree& points, const MovingVolumes& volumes, const Eigen::Isometry3d& pose,
                 double margin, const Found& found) {
  const FloatEnvironment environment;
  require(pose, margin);
  const std::vector<Prepared>& prepared = volumes.state().prepared;
  const double stretch = max_stretch(pose);
  for (std::size_t i = 0; i < prepared.size(); ++i) {
    if (may_be_within(points, prepared[i], pose, stretch, margin) &&
        is_within(points, prepared[i], pose, margin) && found(static_cast<std::int32_t>(i))) {
      return true;
    }
  }
  return false;
}

// Calls found(i, j) for each pair of volumes within `margin` of each other, in ascending order of j and any
// order of i. Stops and returns true when found() returns true.
template <typename Found>
bool each_pair(const MovingVolumes& volumes, const MovingVolumes& others, const Eigen::Isometry3d& pose,
               double margin, const Found& found) {
  const FloatEnvironment environment;
  require(pose, margin);
  const MovingVolumes::State &state = volumes.state(), &moving = others.state();
  for (std::size_t j = 0; j < moving.prepared.size(); ++j) {
    const Prepared& other = moving.prepared[j];
    if (other.body.empty()) continue;
    const PositionBounds near = extent_near(other.rotatable_volume, pose, margin);
    const ConvexBody body = other.body.transformed(pose);
    const bool ended = state.boxes.visit(state.boxes.query(near.low, near.high), [&](std::uint32_t i) {
      return within(state.prepared[i].body, body, margin) &&
             found(static_cast<std::int32_t>(i), static_cast<std::int32_t>(j));
    });
    if (ended) return true;
  }
  return false;
}

}  // namespace

bool within(const PointTree& points, const PointTree& others, const Eigen::Isometry3d& pose, double margin) {
  const FloatEnvironment environment;
  require(pose, margin);
  return !points.empty() && !others.empty() && trees_within(points, others, pose, margin);
}

bool within(const PointTree& points, const MovingVolumes& volumes, const Eigen::Isometry3d& pose,
            double margin) {
  return each_within(points, volumes, pose, margin, [](std::int32_t) { return true; });
}

void list_within(const PointTree& points, const MovingVolumes& volumes, const Eigen::Isometry3d& pose,
                 double margin, std::vector<std::int32_t>& indices) {
  indices.clear();
  each_within(points, volumes, pose, margin, [&](std::int32_t i) {
    indices.push_back(i);
    return false;
  });
}

bool within(const MovingVolumes& volumes, const MovingVolumes& others, const Eigen::Isometry3d& pose,
            double margin) {
  return each_pair(volumes, others, pose, margin, [](std::int32_t, std::int32_t) { return true; });
}

void list_within(const MovingVolumes& volumes, const MovingVolumes& others, const Eigen::Isometry3d& pose,
                 double margin, std::vector<std::pair<std::int32_t, std::int32_t>>& pairs) {
  pairs.clear();
  each_pair(volumes, others, pose, margin, [&](std::int32_t i, std::int32_t j) {
    pairs.emplace_back(i, j);
    return false;
  });
  std::sort(pairs.begin(), pairs.end());
}

}  // namespace pcl_bv
