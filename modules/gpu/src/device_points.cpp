// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "device_points.h"

#include <algorithm>
#include <cstring>
#include <limits>
#include <optional>
#include <utility>

#include "pcl_bv/parallel/for_each_chunk.h"
#include "pcl_bv/points/select_points.h"

namespace pcl_bv::detail {
namespace {

// Chunks that are copied at a time to a device with memory of its own: 12 MiB.
constexpr std::size_t kStagedChunks = 32;

// Bytes that are copied at a time from the device.
constexpr std::size_t kDownloadedBytes = std::size_t{16} << 20;

// Returns a valid point from the middle of the cloud; the origin if that chunk has none. Every choice gives
// the same volumes, but rejects more or fewer points.
Coordinates middle_point(const PointView& points) {
  if (points.count == 0) return {};
  const LoadedPoints middle = load_chunk(points, chunk_count(points.count) / 2);
  for (std::size_t i = middle.view().count / 2; i < middle.view().count; ++i) {
    const Coordinates p = load_point(middle.view(), i);
    if (is_valid(p)) return p;
  }
  return {};
}

void pack_floats(const PointView& points, float* to) {
  if (points.order == PointOrder::records && points.indices == nullptr && points.stride == 12) {
    std::memcpy(to, points.data, 12 * points.count);
    return;
  }
  for (std::size_t i = 0; i < points.count; ++i) {
    float p[3];
    load_point(points, i, p);
    std::memcpy(to + 3 * i, p, sizeof p);
  }
}

// A valid coordinate stays finite, so that the device counts the same points as valid.
float rounded_difference(double x, double origin) {
  constexpr double largest = std::numeric_limits<float>::max();
  return static_cast<float>(std::clamp(x - origin, -largest, largest));
}

void pack_doubles(const PointView& points, const Coordinates& origin, float* to) {
  constexpr float nan = std::numeric_limits<float>::quiet_NaN();
  for (std::size_t i = 0; i < points.count; ++i, to += 3) {
    const Coordinates p = load_point(points, i);
    const bool valid = is_valid(p);
    to[0] = valid ? rounded_difference(p.x, origin.x) : nan;
    to[1] = valid ? rounded_difference(p.y, origin.y) : nan;
    to[2] = valid ? rounded_difference(p.z, origin.z) : nan;
  }
}

// Writes chunks of the cloud as packed floats, in parallel.
void pack(const PointView& points, std::size_t first_chunk, std::size_t chunks, const Coordinates& origin,
          const Execution& execution, std::byte* to) {
  for_each_chunk(execution.parallel, chunks, [&](std::size_t chunk) {
    const LoadedPoints loaded = load_chunk(points, first_chunk + chunk);
    float* const floats = reinterpret_cast<float*>(to + chunk * kChunkPoints * 12);
    if (points.scalar == ScalarType::float32) {
      pack_floats(loaded.view(), floats);
    } else {
      pack_doubles(loaded.view(), origin, floats);
    }
  });
}

std::size_t needed_bytes(const ImportedPoints& layout) {
  return layout.count == 0 ? 0 : layout.offset + (layout.count - 1) * layout.stride + 12;
}

void check_layout(const ImportedPoints& layout) {
  const auto refuse = [](const std::string& what) { throw std::invalid_argument("ImportedPoints: " + what); };
  if (layout.stride % 4 != 0 || layout.stride < 12 || layout.stride > 1024)
    refuse("stride is " + std::to_string(layout.stride) + ", must be a multiple of 4 from 12 to 1024 bytes");
  if (layout.offset % 4 != 0)
    refuse("offset is " + std::to_string(layout.offset) + ", must be a multiple of 4 bytes");
  if (layout.count > GpuCloud::max_points)
    refuse("count is " + std::to_string(layout.count) + ", must be at most 2^30");
  if (layout.offset > layout.bytes || needed_bytes(layout) > layout.bytes)
    refuse(std::to_string(layout.bytes) + " bytes are too few for " + std::to_string(layout.count) +
           " points");
}

}  // namespace

DevicePoints::DevicePoints(std::shared_ptr<GpuContext> context, const PointView& points, HostPoints host,
                           const Execution& execution)
    : context_(std::move(context)),
      size_(points.count),
      rounded_(points.scalar == ScalarType::float64),
      kept_(host == HostPoints::keep) {
  if (size_ > GpuCloud::max_points)
    throw std::invalid_argument("GpuCloud: " + std::to_string(size_) + " points, must be at most 2^30");
  if (rounded_ && !kept_)
    throw std::invalid_argument(
        "GpuCloud: double points need HostPoints::keep, because the device has only floats");
  if (kept_) host_ = points;
  const Coordinates origin = middle_point(points);
  if (!rounded_)
    center_ = {static_cast<float>(origin.x), static_cast<float>(origin.y), static_cast<float>(origin.z)};
  divide(0);
  upload(points, origin, execution);
}

DevicePoints::DevicePoints(std::shared_ptr<GpuContext> context, int fd, const ImportedPoints& layout)
    : context_(std::move(context)), size_(layout.count), stride_(layout.stride) {
  check_layout(layout);
  buffers_.push_back(DeviceBuffer::import(*context_, fd, layout.bytes, needed_bytes(layout)));
  divide(layout.offset);
  const Coordinates origin = middle_point(points());
  center_ = {static_cast<float>(origin.x), static_cast<float>(origin.y), static_cast<float>(origin.z)};
}

// Divides the points into parts. Uploaded points get a buffer for each part; imported ones are in one buffer,
// in which a part begins at an aligned byte before its first point.
void DevicePoints::divide(std::size_t offset) {
  const bool imported = !buffers_.empty();
  const std::size_t alignment = context_->binding_alignment();
  const std::size_t block_bytes = kBlockPoints * stride_;
  std::size_t blocks = (context_->max_binding() - alignment) / block_bytes;
  if (blocks * kBlockPoints > kChunkPoints) blocks -= blocks % (kChunkPoints / kBlockPoints);
  const std::size_t most = std::max<std::size_t>(blocks, 1) * kBlockPoints;
  for (std::size_t first = 0; first < size_; first += most) {
    const std::size_t count = std::min(most, size_ - first);
    if (!imported)
      buffers_.push_back(std::make_unique<DeviceBuffer>(*context_, copied_bytes(count), BufferUse::device));
    const std::size_t byte = imported ? offset + first * stride_ : 0;
    const std::size_t begin = byte / alignment * alignment;
    parts_.push_back({{buffers_.back().get(), begin, byte - begin + copied_bytes(count)},
                      static_cast<std::uint32_t>((byte - begin) / 4),
                      first,
                      count,
                      byte});
  }
}

void DevicePoints::upload(const PointView& points, const Coordinates& origin, const Execution& execution) {
  std::optional<ScratchBuffer> staging;
  for (const PointPart& part : parts_) {
    const std::size_t first_chunk = part.first / kChunkPoints, chunks = chunk_count(part.count);
    if (std::byte* const mapped = part.binding.buffer->mapped()) {
      pack(points, first_chunk, chunks, origin, execution, mapped);
      continue;
    }
    for (std::size_t chunk = 0; chunk < chunks; chunk += kStagedChunks) {
      const std::size_t taken = std::min(kStagedChunks, chunks - chunk);
      const std::size_t begin = chunk * kChunkPoints * 12;
      if (!staging)
        staging.emplace(*context_, std::min(kStagedChunks, chunks) * kChunkPoints * 12, BufferUse::upload);
      pack(points, first_chunk + chunk, taken, origin, execution, staging->mapped());
      Submission submission(context_);
      submission.copy(*staging, 0, *part.binding.buffer, begin,
                      std::min(taken * kChunkPoints * 12, copied_bytes(part.count) - begin));
      submission.run();
    }
  }
}

PointView DevicePoints::points() const {
  return kept_ ? host_ : view_of(*this, size_, ScalarType::float32);
}

const PointPart& DevicePoints::part_of(std::size_t point) const {
  const std::size_t most = parts_.front().count;  // all parts but the last one have as many
  return parts_[point / most];
}

PointView DevicePoints::view_of_bytes(const std::byte* bytes, std::size_t first, std::size_t count) const {
  PointView view;
  view.data = bytes;
  view.stride = stride_;
  view.readable = 12;
  view.count = count;
  view.first = first;
  return view;
}

void DevicePoints::download(const std::vector<PointView>& slices, std::byte* to) const {
  const std::size_t most_points = kDownloadedBytes / stride_;
  std::vector<Download> batch;
  std::size_t bytes = 0;
  const auto run = [&] {
    run_downloads(batch, bytes, to);
    to += bytes;
    bytes = 0;
    batch.clear();
  };
  for (const PointView& slice : slices) {
    for (std::size_t first = slice.first, end = slice.first + slice.count; first < end;) {
      const PointPart& part = part_of(first);
      const std::size_t count = std::min({end - first, part.first + part.count - first, most_points});
      if (bytes + count * stride_ > kDownloadedBytes) run();
      batch.push_back({&part, part.byte + (first - part.first) * stride_, bytes, copied_bytes(count)});
      bytes += count * stride_;
      first += count;
    }
  }
  if (!batch.empty()) run();
}

// Copies the ranges, and then all bytes that they are in, also those between points.
void DevicePoints::run_downloads(const std::vector<Download>& batch, std::size_t bytes, std::byte* to) const {
  const ScratchBuffer buffer(*context_, bytes, BufferUse::download);
  Submission submission(context_);
  for (const Download& range : batch)
    submission.copy(*range.part->binding.buffer, range.from, buffer, range.to, range.bytes,
                    Order::beside_previous);
  submission.run();
  std::memcpy(to, buffer.mapped(), bytes);
}

std::vector<PointView> DevicePoints::blocks(const std::vector<std::uint32_t>& numbers,
                                            std::vector<std::byte>& storage) const {
  std::vector<PointView> views;
  views.reserve(numbers.size());
  for (const std::uint32_t number : numbers)
    views.push_back(block_of(points(), number));
  return in_memory(std::move(views), storage);
}

std::vector<PointView> DevicePoints::in_memory(std::vector<PointView> views,
                                               std::vector<std::byte>& storage) const {
  std::size_t total = 0;
  for (const PointView& view : views)
    total += view.count * stride_;
  if (kept_ || total == 0) return views;
  storage.resize(total);
  download(views, storage.data());
  const std::byte* at = storage.data();
  for (PointView& view : views) {
    view = view_of_bytes(at, view.first, view.count);
    at += view.count * stride_;
  }
  return views;
}

PointView DevicePoints::select(std::vector<std::int32_t>& positions) const {
  for (std::int32_t& position : positions)
    position = static_cast<std::int32_t>(host_.index(static_cast<std::size_t>(position)));
  return select_points(host_, positions);
}

PointView DevicePoints::load(std::size_t first, std::size_t count, std::vector<std::byte>& buffer) const {
  if (count == 0) return view_of_bytes(nullptr, first, 0);
  buffer.resize(count * stride_);
  download({points().slice(first, count)}, buffer.data());
  return view_of_bytes(buffer.data(), first, count);
}

}  // namespace pcl_bv::detail
