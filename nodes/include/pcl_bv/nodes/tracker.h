// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Which object of this frame is which of the last one.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "pcl_bv/nodes/pipeline_config.h"
#include "pcl_bv/report/report.h"
#include "pcl_bv/volumes/aabb.h"

namespace [[gnu::visibility("default")]] pcl_bv {

class BoxGrid;

/// Gives objects ids that stay while they are seen, and are never given twice.
///
/// Each track expects its box where constant velocity takes it. Box and track may be the same object if their
/// centres are nearer than the gate; where their sizes differ, because an object came into view or was split,
/// half of that difference more, but no more than another gate. Of all such pairs the nearest are joined
/// first. A track is born with its birth-th sighting and dies after `death` frames without one; a gap does
/// not cost it its id.
class Tracker {
 public:
  /// A box's place in the tracker: stays while the track lives, and is used again afterwards.
  struct Assignment {
    std::size_t slot = 0;
    bool fresh = false;                 ///< The first sighting.
    std::optional<TrackEntry> track{};  ///< None until the track is born.
  };

  Tracker();
  ~Tracker();
  Tracker(Tracker&&) noexcept;
  Tracker& operator=(Tracker&&) noexcept;

  /// Replaces `assignments` by one for each box. `stamp_ns` is the time of the boxes; where it does not
  /// advance (or by more than a second), tracks are expected where they were. O(n log n), and the pairs
  /// within the gate.
  void update(std::int64_t stamp_ns, const std::vector<Aabb>& boxes, const TrackConfig& config,
              std::vector<Assignment>& assignments);

  /// Forgets all tracks, but not which ids were given.
  void reset();

 private:
  struct Track {
    Eigen::Vector3d center = Eigen::Vector3d::Zero(), size = Eigen::Vector3d::Zero(),
                    velocity = Eigen::Vector3d::Zero();
    double unseen = 0;  // seconds since the last sighting
    std::size_t seen = 0, missed = 0, age = 0;
    bool alive = false;
    std::optional<std::uint32_t> id;
  };
  struct Pair {
    double cost;
    std::size_t track, box;
  };

  void find_pairs(double seconds, const std::vector<Aabb>& boxes, double gate);
  void join(double seconds, const std::vector<Aabb>& boxes, std::vector<Assignment>& assignments);
  void correct(Track& track, const Aabb& box, double seconds) const;
  std::size_t free_slot();

  std::vector<Track> tracks_;
  std::vector<Pair> pairs_;
  std::unique_ptr<BoxGrid> grid_;
  std::vector<std::size_t> free_;
  std::vector<char> track_taken_, box_taken_;
  std::int64_t last_stamp_ns_ = 0;
  bool started_ = false;
  std::uint32_t next_id_ = 0;
};

}  // namespace pcl_bv
