// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "merged_cloud.h"

#include <algorithm>
#include <limits>

#include "pcl_bv/io/untrusted_text.h"
#include "pcl_bv/kernels/transform_points.h"
#include "pcl_bv/numeric/float_environment.h"
#include "pipeline/deskew/visit_numbers.h"

namespace pcl_bv::detail {
namespace {

RigidTransform rows_of(const Pose& pose) {
  RigidTransform rows{};
  for (std::size_t i = 0; i < rows.size(); ++i)
    for (std::size_t k = 0; k < rows[i].size(); ++k)
      rows[i][k] = pose(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(k));
  return rows;
}

// Writes the points as doubles. Used if the clouds of a rig have different scalar types, which is rare.
void transform_to_double(UsableIsa isa, const PointView& points, const RigidTransform& transform,
                         std::byte* xyz) {
  std::vector<double> doubles(3 * points.count);
  for (std::size_t i = 0; i < points.count; ++i) {
    const Coordinates p = load_point(points, i);
    doubles[3 * i] = p.x;
    doubles[3 * i + 1] = p.y;
    doubles[3 * i + 2] = p.z;
  }
  transform_points(isa, PointView::of(doubles.data(), 3 * sizeof(double), points.count), transform, xyz);
}

ScalarType widest_scalar(const std::vector<MountedCloud>& clouds) {
  const bool has_doubles = std::any_of(clouds.begin(), clouds.end(), [](const MountedCloud& cloud) {
    return cloud.frame != nullptr && cloud.frame->points.scalar == ScalarType::float64;
  });
  return has_doubles ? ScalarType::float64 : ScalarType::float32;
}

template <typename Has>
bool all_have(const std::vector<MountedCloud>& clouds, const Has& has) {
  return std::all_of(clouds.begin(), clouds.end(), [&](const MountedCloud& cloud) {
    return cloud.frame == nullptr || cloud.frame->points.empty() || has(*cloud.frame);
  });
}

// Returns one part for each sensor, with ascending point numbers.
std::vector<SensorPart> parts_of(const std::vector<MountedCloud>& clouds, std::size_t& total) {
  std::vector<SensorPart> parts;
  total = 0;
  for (const MountedCloud& cloud : clouds) {
    const Frame* const frame = cloud.frame;
    const std::size_t count = frame == nullptr ? 0 : frame->points.count;
    const std::int64_t stamp = frame == nullptr ? 0 : frame->header.stamp_ns;
    parts.push_back({cloud.name, total, count, stamp, cloud.pose.translation()});
    total += count;
  }
  return parts;
}

// Ground zones have one centre. The mean position of the sensors is surrounded by the points of all.
std::optional<Eigen::Vector3d> mean_position(const std::vector<SensorPart>& parts) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  double count = 0;
  for (const SensorPart& part : parts) {
    if (part.count == 0) continue;
    sum += part.position;
    count += 1;
  }
  return count > 0 ? stored_sensor_position(sum / count) : std::nullopt;
}

}  // namespace

// New memory costs a page fault for each 4096 bytes, which takes longer than the transform.
std::shared_ptr<CloudMerger::Memory> CloudMerger::take_memory() {
  std::unique_ptr<Memory> memory;
  {
    const std::lock_guard lock(pool_->mutex);
    if (!pool_->unused.empty()) {
      memory = std::move(pool_->unused.back());
      pool_->unused.pop_back();
    }
  }
  if (memory == nullptr) memory = std::make_unique<Memory>();
  return {memory.release(), [pool = pool_](Memory* done) {
            std::unique_ptr<Memory> owned(done);
            constexpr std::size_t max_unused = 8;
            const std::lock_guard lock(pool->mutex);
            if (pool->unused.size() < max_unused) pool->unused.push_back(std::move(owned));
          }};
}

// Warns once for each sensor. FrameWarnings names the sensors whose times cannot be used.
void CloudMerger::warn_of_times(const MountedCloud& cloud, const DeskewTimes& times) {
  const std::string warning = times_warning(times);
  if (warning.empty() || !warned_.insert(cloud.name).second) return;
  warnings_.push_back(message_line(cloud.name + ": " + warning));
}

// Writes the seconds of each point after the stamp of the merged cloud.
void CloudMerger::write_times(const MountedCloud& cloud, std::int64_t stamp_ns, float* seconds) {
  const Frame& frame = *cloud.frame;
  const auto offset = static_cast<float>(1e-9 * static_cast<double>(frame.header.stamp_ns - stamp_ns));
  bool known = false;
  if (frame.times) {
    const DeskewTimes times =
        point_times_.read(isa_, *frame.times, frame.points, frame.header.stamp_ns, seconds);
    known = times.problem == DeskewTimes::Problem::none;
    warn_of_times(cloud, times);
  }
  if (!known) {
    std::fill_n(seconds, frame.points.count, offset);
  } else if (offset != 0) {
    for (std::size_t i = 0; i < frame.points.count; ++i)
      seconds[i] += offset;
  }
}

// Copies a cloud to its part of the merged cloud.
void CloudMerger::copy(const MountedCloud& cloud, const SensorPart& part, ScalarType scalar, Memory& memory) {
  const PointView& points = cloud.frame->points;
  const RigidTransform transform = rows_of(cloud.pose);
  std::byte* const xyz = reinterpret_cast<std::byte*>(memory.xyz.data()) + part.first * 3 * size_of(scalar);
  if (points.scalar == scalar) {
    transform_points(isa_, points, transform, xyz);
  } else {
    transform_to_double(isa_, points, transform, xyz);
  }
  if (memory.has_intensity) {
    float* const values = memory.intensity.data() + part.first;
    visit_numbers(*cloud.frame->intensity, part.count,
                  [&](std::size_t i, double value) { values[i] = static_cast<float>(value); });
  }
  if (memory.has_classes)
    memory.classes.insert(memory.classes.end(), cloud.frame->classes->begin(), cloud.frame->classes->end());
}

void CloudMerger::merge(const std::vector<MountedCloud>& clouds, Frame& merged) {
  const FloatEnvironment environment;
  std::size_t total = 0;
  merged.sensors = parts_of(clouds, total);
  merged.sensor = mean_position(merged.sensors);
  const ScalarType scalar = widest_scalar(clouds);
  const std::shared_ptr<Memory> memory = take_memory();
  memory->has_intensity = all_have(clouds, [](const Frame& frame) { return frame.intensity.has_value(); });
  memory->has_classes = all_have(clouds, [](const Frame& frame) { return frame.classes != nullptr; });
  memory->xyz.resize((total * 3 * size_of(scalar) + sizeof(double) - 1) / sizeof(double));
  if (times_) memory->seconds.resize(total);
  if (memory->has_intensity) memory->intensity.resize(total);
  memory->classes.clear();
  for (std::size_t k = 0; k < clouds.size(); ++k) {
    const SensorPart& part = merged.sensors[k];
    if (part.count == 0) continue;
    copy(clouds[k], part, scalar, *memory);
    if (times_) write_times(clouds[k], merged.header.stamp_ns, memory->seconds.data() + part.first);
  }
  merged.points = packed_points(reinterpret_cast<const std::byte*>(memory->xyz.data()), scalar, total);
  merged.seconds = times_ ? memory->seconds.data() : nullptr;
  merged.intensity.reset();
  if (memory->has_intensity && total > 0)
    merged.intensity =
        FieldView{reinterpret_cast<const std::byte*>(memory->intensity.data()), sizeof(float), 'F', 4};
  merged.classes.reset();
  if (memory->has_classes) merged.classes = {memory, &memory->classes};
  merged.owner = memory;
}

}  // namespace pcl_bv::detail
