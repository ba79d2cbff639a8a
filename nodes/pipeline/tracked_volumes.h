// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Tracks of a frame's clusters, and oriented boxes whose axes do not flip from one frame to the next.
#pragma once

#include <optional>
#include <vector>

#include "pcl_bv/nodes/frame_result.h"
#include "pcl_bv/points/isa.h"
#include "pipeline/track/box_filter.h"
#include "pipeline/track/tracker.h"

namespace pcl_bv::detail {

/// The clock of the tracks. It follows the stamps. If the stamps do not advance, it follows the recording
/// times, because some drivers write the same stamp into every message or set their clock back.
class TrackClock {
 public:
  /// Returns the time of the next frame, nanoseconds. The time begins at the first stamp. It never decreases,
  /// and one step is at most two seconds.
  std::int64_t at(std::int64_t stamp_ns, std::int64_t recorded_ns);
  /// Returns which times the last step used, see TrackTime.
  TrackTime source() const { return source_; }

 private:
  bool started_ = false;
  bool distrusts_stamp_ = false;  // the last stamp did not advance, but its recording time did
  std::int64_t now_ns_ = 0, stamp_ns_ = 0, recorded_ns_ = 0;  // times of the last frame
  TrackTime source_ = TrackTime::stamps;
};

/// The tracker of a stream and the filters of its boxes.
class TrackedVolumes {
 public:
  /// Fills result.tracks and result.active_tracks. Gives the axes of each oriented box the order and
  /// directions of the object's last box. If requested, smooths the yaw of upright boxes and grows their
  /// sizes. `clusters` holds the points of each cluster, valid and at least one.
  void update(const TrackConfig& config, UsableIsa isa, const std::vector<PointView>& clusters,
              const Frame& frame, FrameResult& result);

  /// Predicts the tracks to the time of the frame, from the clusters before they are refined. Returns what
  /// the tracker expects to see, sorted by the x of the centres, in the fixed frame. Call update()
  /// afterwards.
  const std::vector<KnownObject>& predict(const std::vector<PointView>& clusters, const Frame& frame);
  /// Pose of the sensor in the fixed frame, after predict().
  const Pose& sensor() const { return tracker_.sensor(); }

  /// Deletes all tracks. The ids of deleted tracks are not reused.
  void reset() {
    tracker_.reset();
    predicted_ = false;
    clock_ = TrackClock();
  }

 private:
  void predict_tracks(const Frame& frame);
  void know_objects(UsableIsa isa, const std::vector<PointView>& clusters, const FrameResult& result);
  void filter_boxes(const Tracker::Assignment& assignment, const TrackConfig& config, std::size_t cluster,
                    const PointView& points, FrameResult& result);

  Tracker tracker_;
  TrackClock clock_;
  bool predicted_ = false;  // for the frame of the next update()
  std::vector<KnownObject> known_;
  std::vector<Aabb> boxes_;
  Viewpoints viewpoints_;
  std::vector<Tracker::Assignment> assignments_;
  std::vector<const Method*> methods_;  // methods of the last frame, for `filters_`
  // Element s * methods_.size() + m is the filter for method m of the track in slot s.
  std::vector<BoxFilter> filters_;
};

}  // namespace pcl_bv::detail
