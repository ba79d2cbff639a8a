// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Multi-object tracking, which associates objects from frame to frame.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "known_object.h"
#include "pcl_bv/nodes/frame.h"
#include "pcl_bv/nodes/pipeline_config.h"
#include "pcl_bv/report/report.h"
#include "pcl_bv/volumes/aabb.h"
#include "viewpoints.h"

namespace pcl_bv {
namespace [[gnu::visibility("default")]] detail {

/// Gives objects ids that persist from frame to frame. An id is never reused.
///
/// A track has a position and a velocity with their covariance (Kalman 1960). If sensor poses are given,
/// position and velocity are in the fixed frame of these poses. Otherwise the tracker estimates the planar
/// motion of the sensor (x, y, yaw) between frames from static boxes. If too few boxes agree
/// (EgoMotion::estimate()), the tracker assumes that the sensor continues its last motion.
///
/// A box may belong to a track if its shift from the expected box (BoxDifference::shift) and its change of
/// size are plausible. For a track whose position is well known, the shift is at most about
/// TrackConfig::gate. All boxes are assigned jointly at minimum total cost (Kuhn 1955).
///
/// A track gets its id when it has TrackConfig::birth detections. A track is deleted after TrackConfig::death
/// frames in a row without a detection. A track is occluded if its expected centre is inside the box of
/// another object. A track with an id is also occluded if a box is between each sensor and this centre
/// (Viewpoints::occluded()). Four frames in which a track is occluded are counted as one frame without a
/// detection.
class Tracker {
 public:
  /// The track to which a box is assigned.
  struct Assignment {
    /// Index of the track. It is constant while the track is active and reused after the track's deletion.
    std::size_t slot = 0;
    bool fresh = false;                                  ///< First detection of the track.
    std::optional<TrackEntry> track{};                   ///< Set when the track has its id.
    bool moving = false;                                 ///< As in TrackEntry, also without an id.
    Eigen::Vector3d velocity = Eigen::Vector3d::Zero();  ///< Over the ground, along the sensor's axes, m/s.
    /// The box probably contains several objects, because the expected centre of another track is inside it.
    /// That track has an id and no box in this frame. Tracks of parts of this object do not count.
    bool merged = false;
    /// A split of this track is confirmed in this frame: earlier boxes of this track contained two objects. A
    /// split begins when the centre of a new track's first box is inside the expected box of this track. The
    /// split is confirmed when the new track has had five detections since its start or its last occlusion.
    bool separated = false;
  };

  Tracker();
  ~Tracker();
  Tracker(Tracker&&) noexcept;
  Tracker& operator=(Tracker&&) noexcept;

  /// Assigns a track to each box and replaces `assignments` by one entry per box. `boxes` are in the sensor's
  /// frame, metres, measured at `stamp_ns`. If the time does not advance, or advances by more than a second,
  /// tracks are expected at their last positions. `pose` is the pose of the sensor in a fixed frame. Takes
  /// O(n log n) time, plus the time of the assignment. Computes one cost for each pair of a track and a box
  /// near the track (BoxGrid with cells of three times TrackConfig::gate).
  void update(std::int64_t stamp_ns, const std::vector<Aabb>& boxes, const TrackConfig& config,
              std::vector<Assignment>& assignments, const std::optional<Pose>& pose = std::nullopt,
              const Viewpoints& viewpoints = Viewpoints::single());

  /// The two halves of update(), for callers that refine the boxes in between. predict() moves the tracks and
  /// the sensor to the time of the frame; `boxes` need not be those of assign().
  void predict(std::int64_t stamp_ns, const std::vector<Aabb>& boxes,
               const std::optional<Pose>& pose = std::nullopt);
  void assign(const std::vector<Aabb>& boxes, const TrackConfig& config, std::vector<Assignment>& assignments,
              const Viewpoints& viewpoints = Viewpoints::single());

  /// Replaces `known` by the objects that predict() expects, sorted by the x of their centres.
  void list_known(std::vector<KnownObject>& known) const;
  /// Tells where the object of a track is in this frame: its box in the fixed frame, and what changed its
  /// cluster. Call it after assign(), for clusters that hold one object only.
  void know(std::size_t slot, const Eigen::AlignedBox3d& box, Refinement refinement);

  /// Returns the pose of the sensor at the last predict(): the given pose or, without one, the estimated
  /// pose.
  const Pose& sensor() const;

  /// Replaces `ids` by the ids of the active tracks that have one, ascending.
  void list_active(std::vector<std::uint32_t>& ids) const;

  /// Deletes all tracks. The ids of deleted tracks are not reused.
  void reset();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace detail
}  // namespace pcl_bv
