// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Tracks of a frame's clusters, and boxes that do not flip from one frame to the next.
#pragma once

#include <optional>
#include <vector>

#include "pcl_bv/nodes/frame_result.h"
#include "pipeline/track/box_filter.h"
#include "pipeline/track/tracker.h"

namespace pcl_bv {

/// The time of tracks: that of the stamps where they advance. Drivers write the same stamp into every
/// message, or set their clock back.
class TrackClock {
 public:
  /// Nanoseconds from the first stamp on, never less than before; a step is two seconds at most.
  std::int64_t at(std::int64_t stamp_ns, std::int64_t recorded_ns);
  TrackTime source() const { return source_; }

 private:
  bool started_ = false;
  std::int64_t now_ns_ = 0, stamp_ns_ = 0, recorded_ns_ = 0;  // of the last frame
  TrackTime source_ = TrackTime::stamps;
};

class TrackedVolumes {
 public:
  /// Fills result.tracks, and names the axes of each oriented box as those of the same object's last one; if
  /// asked for, oriented boxes are steadied.
  /// `clusters`: the points of each.
  void update(const TrackConfig& config, const std::vector<PointView>& clusters, const Frame& frame,
              FrameResult& result);

  /// Forgets all tracks, but not which ids were given.
  void reset() {
    tracker_.reset();
    clock_ = TrackClock();
  }

 private:
  void keep_axes(const Tracker::Assignment& assignment, const TrackConfig& config, std::size_t cluster,
                 const PointView& points, FrameResult& result);

  Tracker tracker_;
  TrackClock clock_;
  std::vector<Aabb> boxes_;
  std::vector<Tracker::Assignment> assignments_;
  std::vector<const Method*> methods_;  // of filters_
  std::vector<BoxFilter> filters_;      // slot by slot, by method
};

}  // namespace pcl_bv
