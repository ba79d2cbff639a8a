// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Transforms between the coordinate frames of a robot.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "pcl_bv/nodes/frame.h"

namespace pcl_bv {
namespace [[gnu::visibility("default")]] detail {

/// A pose and its time, nanoseconds.
using StampedPose = std::pair<std::int64_t, Pose>;

/// Returns the pose at a time, interpolated between the poses before and after it. `poses` are sorted by
/// time. Returns nullopt outside their times, and if the two poses are more than 0.5 s apart.
std::optional<Pose> pose_at(const std::vector<StampedPose>& poses, std::int64_t stamp_ns);

/// A stamp or time of recording that is earlier than the latest one by more than this, nanoseconds, begins
/// anew: a recording is repeated, or a simulation was reset.
inline constexpr std::int64_t kRestart = 1'000'000'000;

/// Returns a time as "1.250 s".
std::string seconds_text(std::int64_t nanoseconds);

/// Result of Transforms::find().
struct FoundTransform {
  std::optional<Pose> pose;
  std::string problem;   ///< Why there is no pose.
  bool pending = false;  ///< A transform that is added later may give the pose.
};

/// A tree of coordinate frames. Each frame has a pose in its parent, which is fixed or changes over time.
/// Names are compared without a leading slash, which ROS 1 allowed.
class Transforms {
 public:
  /// Sets the fixed pose of `child` in `parent`. Replaces an earlier pose, unless that pose is `final`: then
  /// a pose that differs from it is ignored with a warning. Transforms that would give a frame a second
  /// parent or make a cycle, and names that are empty, are ignored with a warning.
  void add_fixed(const std::string& parent, const std::string& child, const Pose& pose, bool final = false);

  /// Adds the pose of `child` in `parent` at a time. Otherwise like add_fixed(). Poses more than 10 s older
  /// than the newest one are forgotten. A pose that is older by more than kRestart begins anew. After the
  /// first `preferred` pose of `child`, its other poses and its other parent are dropped.
  void add(const std::string& parent, const std::string& child, std::int64_t stamp_ns, const Pose& pose,
           bool preferred = false);

  /// Returns the pose of the frame `source` in the frame `target` at a time: a point p of `source` is at
  /// pose * p in `target`. O(depth of the tree).
  FoundTransform find(const std::string& target, const std::string& source, std::int64_t stamp_ns) const;

  /// Returns the warnings since the last call, one line each, at most one for each frame and one about
  /// the number of frames.
  std::vector<std::string> take_warnings() { return std::exchange(warnings_, {}); }

 private:
  struct Node {
    std::string name;
    std::optional<std::size_t> parent;
    std::optional<Pose> fixed;
    std::map<std::int64_t, Pose> timed;
    bool final = false, warned = false, preferred = false;
  };

  Node* edge(const std::string& parent, const std::string& child);
  std::optional<std::size_t> index_of(const std::string& name) const;
  std::optional<std::size_t> make_node(const std::string& name);
  void prefer(const std::string& parent, const std::string& child);
  void warn(Node& node, const std::string& what);
  std::vector<std::size_t> ancestors(std::size_t node) const;
  std::optional<Pose> pose_in(const std::vector<std::size_t>& chain, std::size_t ancestor,
                              std::int64_t stamp_ns, FoundTransform& found) const;

  std::vector<Node> nodes_;
  std::map<std::string, std::size_t> numbers_;  // by name
  std::vector<std::string> warnings_;
  bool warned_of_frames_ = false;
};

}  // namespace detail
}  // namespace pcl_bv
