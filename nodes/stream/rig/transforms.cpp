// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "transforms.h"

#include <algorithm>
#include <iterator>

#include "pcl_bv/io/number_text.h"
#include "pcl_bv/io/untrusted_text.h"

namespace pcl_bv::detail {
namespace {

constexpr std::int64_t kMaxPoseGap = 500'000'000;           // nanoseconds
constexpr std::int64_t kStoredTransforms = 10'000'000'000;  // nanoseconds
constexpr std::size_t kMaxFrames = 10'000;

std::string without_slash(const std::string& name) {
  return name.starts_with('/') ? name.substr(1) : name;
}

// Returns the pose at a time. `after` is the first of the poses that is not earlier.
template <typename Poses>
std::optional<Pose> interpolated(const Poses& poses, typename Poses::const_iterator after,
                                 std::int64_t stamp_ns) {
  if (after != poses.end() && after->first == stamp_ns) return after->second;
  if (after == poses.begin() || after == poses.end()) return std::nullopt;
  const auto before = std::prev(after);
  if (after->first - before->first > kMaxPoseGap) return std::nullopt;
  const double part =
      static_cast<double>(stamp_ns - before->first) / static_cast<double>(after->first - before->first);
  const Eigen::Quaterniond from(before->second.linear()), to(after->second.linear());
  Pose pose = Pose::Identity();
  pose.linear() = from.slerp(part, to).normalized().toRotationMatrix();
  pose.translation() = (1 - part) * before->second.translation() + part * after->second.translation();
  return pose;
}

}  // namespace

std::string seconds_text(std::int64_t nanoseconds) {
  return fixed_text(1e-9 * static_cast<double>(nanoseconds), 3) + " s";
}

std::optional<Pose> pose_at(const std::vector<StampedPose>& poses, std::int64_t stamp_ns) {
  return interpolated(poses, std::ranges::lower_bound(poses, stamp_ns, {}, &StampedPose::first), stamp_ns);
}

std::optional<std::size_t> Transforms::index_of(const std::string& name) const {
  const auto found = numbers_.find(without_slash(name));
  return found == numbers_.end() ? std::nullopt : std::optional(found->second);
}

std::optional<std::size_t> Transforms::make_node(const std::string& name) {
  if (const auto known = index_of(name)) return known;
  if (nodes_.size() >= kMaxFrames) return std::nullopt;
  nodes_.push_back({without_slash(name), {}, {}, {}, false, false, false});
  return numbers_.emplace(nodes_.back().name, nodes_.size() - 1).first->second;
}

void Transforms::warn(Node& node, const std::string& what) {
  if (!std::exchange(node.warned, true))
    warnings_.push_back(message_line("frame " + node.name + ": " + what));
}

std::vector<std::size_t> Transforms::ancestors(std::size_t node) const {
  std::vector<std::size_t> chain{node};
  while (nodes_[chain.back()].parent)
    chain.push_back(*nodes_[chain.back()].parent);
  return chain;
}

// Returns the node of `child` after it has got its parent, or null if the transform is ignored.
Transforms::Node* Transforms::edge(const std::string& parent, const std::string& child) {
  if (without_slash(parent).empty() || without_slash(child).empty()) {
    const std::size_t any = make_node("(no name)").value_or(0);
    warn(nodes_[any], "a transform between frames without names is ignored");
    return nullptr;
  }
  const auto above = make_node(parent), below = make_node(child);
  if (!above || !below) {
    if (!std::exchange(warned_of_frames_, true))
      warnings_.push_back("more than 10000 frames: transforms of further ones are ignored");
    return nullptr;
  }
  Node& node = nodes_[*below];
  if (node.parent == above) return &node;
  if (node.parent) {
    warn(node, "has two parents, " + nodes_[*node.parent].name + " and " + nodes_[*above].name +
                   "; the transforms to the second one are ignored");
    return nullptr;
  }
  const std::vector<std::size_t> chain = ancestors(*above);
  if (std::find(chain.begin(), chain.end(), *below) != chain.end()) {
    warn(node, "would form a cycle with its parent " + nodes_[*above].name + "; this transform is ignored");
    return nullptr;
  }
  node.parent = above;
  return &node;
}

void Transforms::add_fixed(const std::string& parent, const std::string& child, const Pose& pose,
                           bool final) {
  Node* const node = edge(parent, child);
  if (node == nullptr) return;
  if (node->final) {
    if (!pose.isApprox(*node->fixed, 1e-3))
      warn(*node, "has another pose in the transforms than in the URDF, which is used");
    return;
  }
  node->final = final;
  node->fixed = pose;
  node->timed.clear();
}

// Drops what is known of the pose of `child`, unless it is fixed or already from a preferred source.
void Transforms::prefer(const std::string& parent, const std::string& child) {
  if (without_slash(child).empty()) return;
  const auto made = make_node(child);
  if (!made || nodes_[*made].fixed || nodes_[*made].preferred) return;
  const auto old_parent = std::exchange(nodes_[*made].parent, std::nullopt);
  if (Node* const node = edge(parent, child)) {
    node->preferred = true;
    node->timed.clear();
  } else {
    nodes_[*made].parent = old_parent;
  }
}

void Transforms::add(const std::string& parent, const std::string& child, std::int64_t stamp_ns,
                     const Pose& pose, bool preferred) {
  if (preferred) prefer(parent, child);
  Node* const node = edge(parent, child);
  if (node == nullptr || node->fixed || node->preferred != preferred) return;
  std::map<std::int64_t, Pose>& poses = node->timed;
  if (!poses.empty() && stamp_ns < poses.rbegin()->first - kRestart) poses.clear();
  poses.insert_or_assign(poses.end(), stamp_ns, pose);
  // Twice the length is stored before the old half is erased, so that the pose of a late cloud is still known.
  if (poses.rbegin()->first - poses.begin()->first < 2 * kStoredTransforms) return;
  poses.erase(poses.begin(), poses.lower_bound(poses.rbegin()->first - kStoredTransforms));
}

// Returns the pose of the first frame of `chain` in `ancestor`, a frame of the chain.
std::optional<Pose> Transforms::pose_in(const std::vector<std::size_t>& chain, std::size_t ancestor,
                                        std::int64_t stamp_ns, FoundTransform& found) const {
  Pose pose = Pose::Identity();
  for (std::size_t i = 0; chain[i] != ancestor; ++i) {
    const Node& node = nodes_[chain[i]];
    const std::optional<Pose> step =
        node.fixed ? node.fixed : interpolated(node.timed, node.timed.lower_bound(stamp_ns), stamp_ns);
    if (!step) {
      found.pending = node.timed.empty() || stamp_ns > node.timed.rbegin()->first;
      found.problem =
          "no pose of " + node.name + " in " + nodes_[*node.parent].name + " at " + seconds_text(stamp_ns);
      if (!node.timed.empty())
        found.problem += "; they are known from " + seconds_text(node.timed.begin()->first) + " to " +
                         seconds_text(node.timed.rbegin()->first) +
                         "; gaps longer than 0.5 s are not interpolated";
      return std::nullopt;
    }
    pose = *step * pose;
  }
  return pose;
}

FoundTransform Transforms::find(const std::string& target, const std::string& source,
                                std::int64_t stamp_ns) const {
  FoundTransform found;
  if (without_slash(target) == without_slash(source)) {
    found.pose = Pose::Identity();
    return found;
  }
  found.pending = true;
  const auto from = index_of(source), to = index_of(target);
  if (!from || !to) {
    found.problem = "no transform names the frame " + (from ? target : source);
    if (warned_of_frames_) found.problem += ", of the first " + std::to_string(kMaxFrames) + " frames";
    return found;
  }
  const std::vector<std::size_t> above_source = ancestors(*from), above_target = ancestors(*to);
  std::vector<bool> is_above_target(nodes_.size());
  for (const std::size_t node : above_target)
    is_above_target[node] = true;
  const auto common = std::ranges::find_if(above_source, [&](auto node) { return is_above_target[node]; });
  if (common == above_source.end()) {
    found.problem = "the frames " + source + " and " + target + " are not connected; their root frames are " +
                    nodes_[above_source.back()].name + " and " + nodes_[above_target.back()].name;
    return found;
  }
  const auto up = pose_in(above_source, *common, stamp_ns, found);
  const auto down = up ? pose_in(above_target, *common, stamp_ns, found) : std::nullopt;
  if (!down) return found;
  found.pose = down->inverse() * *up;
  found.pending = false;
  return found;
}

}  // namespace pcl_bv::detail
