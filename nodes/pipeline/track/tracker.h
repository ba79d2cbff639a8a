// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Which object of this frame is which of the last one.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "pcl_bv/nodes/frame.h"
#include "pcl_bv/nodes/pipeline_config.h"
#include "pcl_bv/report/report.h"
#include "pcl_bv/volumes/aabb.h"

namespace [[gnu::visibility("default")]] pcl_bv {

/// Gives objects ids that stay while they are seen, and are never given twice.
///
/// Each track is a place and a velocity with their covariance (Kalman 1960), in the fixed frame where the
/// sensor's poses are known. Where they are not, the frame is one that follows from how the sensor moved
/// between frames, in the plane of x and y, found from boxes that stood still; with fewer than six boxes that
/// agree, the sensor is taken to go on as it did. A box may be a track's if the least shift of its faces and
/// the change of its size are likely; a track known well is not farther than the gate from where it is
/// expected. All pairs are joined at once, at the least sum of costs (Kuhn 1955). A track is born with its
/// birth-th sighting and dies after `death` frames without one; frames in which its place is inside another
/// object's box count a quarter. A gap does not cost it its id.
class Tracker {
 public:
  /// A box's place in the tracker: stays while the track lives, and is used again afterwards.
  struct Assignment {
    std::size_t slot = 0;
    bool fresh = false;                                  ///< The first sighting.
    std::optional<TrackEntry> track{};                   ///< None until the track is born.
    bool moving = false;                                 ///< As in TrackEntry, also before its birth.
    Eigen::Vector3d velocity = Eigen::Vector3d::Zero();  ///< Over the ground, in the sensor's axes; m/s.
    /// The box likely holds several objects: a born track without a box of its own is expected inside it.
    bool merged = false;
    /// A track split from this box and was seen alone five times: earlier boxes held two objects. Set once.
    bool separated = false;
  };

  Tracker();
  ~Tracker();
  Tracker(Tracker&&) noexcept;
  Tracker& operator=(Tracker&&) noexcept;

  /// Replaces `assignments` by one for each box. `stamp_ns` is the time of the boxes, which are in the
  /// sensor's frame, metres; where it does not advance (or by more than a second), tracks are expected where
  /// they were. `pose`: of the sensor in a fixed frame. O(n log n), and the pairs within three gates.
  void update(std::int64_t stamp_ns, const std::vector<Aabb>& boxes, const TrackConfig& config,
              std::vector<Assignment>& assignments, const std::optional<Pose>& pose = std::nullopt);

  /// Where the sensor was in the last update: the pose that was given, or the one found.
  const Pose& sensor() const;

  /// Forgets all tracks, but not which ids were given.
  void reset();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace pcl_bv
