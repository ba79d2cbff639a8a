// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "device_tree.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <stdexcept>
#include <string>

#include "pcl_bv/kernels/packed_tree.h"
#include "pcl_bv/points/point_source.h"
#include "radix_sort.h"

namespace pcl_bv::detail {
namespace {

constexpr std::uint32_t kGroupPoints = kTreeWidth * kTreeWidth;

// Push constants of the shaders.
struct MortonPush {
  float low[3], scale[3];
  std::uint32_t bits[3], axes[2], first_word, points, invalid_key;
};
struct PacketPush {
  float center[3];
  std::uint32_t first_word, points;
};
struct LevelPush {
  std::uint32_t first_below, below, first;
};

constexpr std::uint32_t groups_for(std::size_t items, std::size_t each) {
  return static_cast<std::uint32_t>((items + each - 1) / each);
}

// Bits of the sort keys. The first one separates points that are not valid. With six bits more than the
// number of points needs, few points of a surface share a key.
std::uint32_t key_bits_for(std::size_t points) {
  const auto wanted = static_cast<std::uint32_t>(std::bit_width(points)) + 7;
  return std::clamp<std::uint32_t>((wanted + 7) / 8 * 8, 16, 32);
}

// The box in which the sort distinguishes points.
struct KeyBox {
  std::array<double, 3> low, high;
};

// Returns a box around nearly all points, by a sample of 256. A few points far away would make all cells too
// large. Points outside the box count as points on its sides.
KeyBox key_box(const DevicePoints& points, const DeviceExtremes& extremes) {
  constexpr std::size_t samples = 256, tail = samples / 32;
  std::vector<PointView> views;
  for (std::size_t i = 0; i < samples; ++i)
    views.push_back(points.points().slice(points.size() * i / samples, 1));
  if (points.kept() && points.points().source != nullptr) views.clear();  // slow to read
  std::vector<std::byte> storage;
  views = points.in_memory(std::move(views), storage);
  KeyBox box{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    std::vector<double> sorted;
    for (const PointView& view : views) {
      const Coordinates p = load_point(view, 0);
      if (is_valid(p)) sorted.push_back(p[axis]);
    }
    std::sort(sorted.begin(), sorted.end());
    box.low[axis] = extremes.low[axis];
    box.high[axis] = extremes.high[axis];
    if (sorted.size() <= 4 * tail) continue;
    const double low = sorted[tail], high = sorted[sorted.size() - 1 - tail], margin = 2 * (high - low);
    if (margin == 0) continue;
    box.low[axis] = std::max(box.low[axis], low - margin);
    box.high[axis] = std::min(box.high[axis], high + margin);
  }
  return box;
}

// Divides the bits of a key among the axes.
void choose_bits(const KeyBox& box, std::uint32_t bits, MortonPush& push) {
  constexpr std::uint32_t most_bits = 23;  // finer cells are below the rounding of floats
  std::array<double, 3> cell;
  for (std::size_t axis = 0; axis < 3; ++axis)
    cell[axis] = box.high[axis] - box.low[axis];
  const std::array<double, 3> extent = cell;
  for (std::uint32_t b = 0; b < bits; ++b) {
    const auto axis = static_cast<std::uint32_t>(std::max_element(cell.begin(), cell.end()) - cell.begin());
    push.axes[b / 16] |= axis << (2 * (b % 16));
    cell[axis] = ++push.bits[axis] < most_bits ? cell[axis] / 2 : 0;
  }
  for (std::size_t axis = 0; axis < 3; ++axis) {
    push.low[axis] = static_cast<float>(box.low[axis]);
    constexpr double most = std::numeric_limits<float>::max();
    if (extent[axis] > 0)
      push.scale[axis] = static_cast<float>(std::min(std::ldexp(1 / extent[axis], push.bits[axis]), most));
  }
}

void require_usable(const GpuCloud& cloud) {
  constexpr std::size_t most = std::numeric_limits<std::int32_t>::max();
  const PointView points = cloud.points();
  if (cloud.on_device().rounded())
    throw std::invalid_argument("GpuTree: the points must be floats, not doubles");
  if (points.first > most - points.count)
    throw std::invalid_argument("GpuTree: point indices must be from 0 to 2147483646, not up to " +
                                std::to_string(points.first + points.count - 1));
}

// Returns the points in memory: those of the view, or copies in `storage`.
PointView loaded(const PointView& points, std::vector<float>& storage) {
  if (points.source == nullptr) return points;
  storage.resize(3 * points.count);
  for (std::size_t chunk = 0; chunk < chunk_count(points.count); ++chunk) {
    const LoadedPoints part = load_chunk(points, chunk);
    for (std::size_t i = 0; i < part.view().count; ++i) {
      float p[3];
      load_point(part.view(), i, p);
      std::memcpy(&storage[3 * (chunk * kChunkPoints + i)], p, sizeof p);
    }
  }
  return packed_points(reinterpret_cast<const std::byte*>(storage.data()), ScalarType::float32, points.count,
                       points.first);
}

}  // namespace

TreePart::TreePart(GpuContext& context, const PointPart& points) : first(points.first), count(points.count) {
  std::uint32_t groups = groups_for(count, kGroupPoints);
  const std::size_t places = std::size_t{groups} * kGroupPoints;
  while (true) {
    first_group[levels + 1] = first_group[levels] + groups;
    ++levels;
    if (groups == 1) break;
    groups = groups_for(groups, kTreeWidth);
  }
  order = std::make_unique<DeviceBuffer>(context, 4 * count, BufferUse::device);
  packets = std::make_unique<DeviceBuffer>(context, 12 * places, BufferUse::device);
  numbers = std::make_unique<DeviceBuffer>(context, 4 * places, BufferUse::device);
  boxes = std::make_unique<DeviceBuffer>(context, sizeof(BoxGroup) * first_group[levels], BufferUse::device);
}

DeviceTree::DeviceTree(const GpuCloud& cloud) : cloud_(cloud) {
  require_usable(cloud);
  const DevicePoints& points = cloud.on_device();
  GpuContext& context = *points.context();
  context.require_alive();
  if (cloud.empty()) return;
  const DeviceExtremes extremes = find_extremes(points, DirectionSet::dop6, false);
  const SortBuffers sort(context, points.parts().front().count);
  const std::uint32_t key_bits = key_bits_for(points.parts().front().count);
  MortonPush push{};
  choose_bits(key_box(points, extremes), key_bits - 1, push);
  push.invalid_key = std::uint32_t{1} << (key_bits - 1);
  const ComputePipeline& morton = context.pipeline(Shader::morton, {points.stride_words()});
  Submission submission(points.context());
  for (const PointPart& part : points.parts()) {
    const TreePart& made = parts_.emplace_back(context, part);
    push.first_word = part.first_word;
    push.points = static_cast<std::uint32_t>(part.count);
    submission.dispatch(morton, {part.binding, {&sort.keys()}, {made.order.get()}}, push,
                        groups_for(part.count, kBlockPoints));
    sort_by_keys(submission, context, sort, *made.order, push.points, key_bits);
  }
  fill_packets(submission, points);
  submission.run();
  take_extremes(extremes);
}

void DeviceTree::refit(const GpuCloud& cloud) {
  require_usable(cloud);
  const DevicePoints& points = cloud.on_device();
  if (points.context() != cloud_.on_device().context())
    throw std::invalid_argument("GpuTree: refit() takes a cloud on the tree's device");
  if (points.size() != cloud_.size() || points.stride_words() != cloud_.on_device().stride_words())
    throw std::invalid_argument("GpuTree: refit() takes a cloud of " + std::to_string(cloud_.size()) +
                                " points of the tree's stride, not one of " + std::to_string(points.size()));
  points.context()->require_alive();
  if (cloud.empty()) return;
  const DeviceExtremes extremes = find_extremes(points, DirectionSet::dop6, false);
  Submission submission(points.context());
  fill_packets(submission, points);
  cloud_ = cloud;
  host_.reset();
  take_extremes(extremes);
  submission.run();
}

void DeviceTree::take_extremes(const DeviceExtremes& extremes) {
  dropped_ = extremes.dropped;
  extent_ = 0;
  if (size() == 0) return;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double center = this->center()[axis];
    extent_ =
        std::max({extent_, std::abs(extremes.low[axis] - center), std::abs(extremes.high[axis] - center)});
  }
}

// Adds commands that copy the points of all parts to packets, and find their boxes.
void DeviceTree::fill_packets(Submission& submission, const DevicePoints& points) const {
  GpuContext& context = *points.context();
  const ComputePipeline& packets = context.pipeline(Shader::packets, {points.stride_words()});
  const ComputePipeline& levels = context.pipeline(Shader::levels, {});
  const std::array<float, 3>& center = points.center();
  for (std::size_t p = 0; p < parts_.size(); ++p) {
    const TreePart& part = parts_[p];
    const PointPart& from = points.parts()[p];
    const PacketPush push{
        {center[0], center[1], center[2]}, from.first_word, static_cast<std::uint32_t>(part.count)};
    submission.dispatch(
        packets,
        {from.binding, {part.order.get()}, {part.packets.get()}, {part.numbers.get()}, {part.boxes.get()}},
        push, part.first_group[1]);
    for (std::uint32_t level = 1; level < part.levels; ++level) {
      const std::uint32_t below = part.first_group[level - 1], first = part.first_group[level];
      submission.dispatch(levels, {{part.boxes.get()}}, LevelPush{below, first - below, first},
                          part.first_group[level + 1] - first);
    }
  }
}

const PointTree& DeviceTree::on_host(const Execution& execution) const {
  const std::lock_guard lock(mutex_);
  if (!host_) {
    std::vector<float> storage;
    host_ = std::make_unique<PointTree>(loaded(cloud_.points(), storage), execution);
  }
  return *host_;
}

}  // namespace pcl_bv::detail
