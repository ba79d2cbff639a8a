// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "rig_source.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <set>
#include <stdexcept>
#include <thread>
#include <utility>

#include "pcl_bv/io/untrusted_text.h"
#include "pipeline/config/check.h"

namespace pcl_bv::detail {
namespace {

constexpr std::int64_t kSecond = 1'000'000'000;
// A sensor that was absent from so many frames is not waited for.
constexpr std::uint64_t kAbsentFrames = 3;
// A live cloud that no other sensor's clouds catch up with for this time is dropped.
constexpr std::chrono::seconds kLongestWait{1};
constexpr std::chrono::milliseconds kPollRigInterval{1};

std::string seconds_of(std::int64_t nanoseconds) {
  char text[40];
  std::snprintf(text, sizeof text, "%.3f s", 1e-9 * static_cast<double>(nanoseconds));
  return text;
}

bool is_power_of_ten(std::uint64_t number) {
  while (number % 10 == 0 && number > 0)
    number /= 10;
  return number == 1;
}

}  // namespace

RigSource::RigSource(RigInputs inputs, const RigConfig& rig, const ReplayOptions& options)
    : rig_(rig),
      feeds_(std::move(inputs.feeds)),
      transforms_(std::move(inputs.transforms)),
      merger_(options.point_times),
      own_stamps_(options.own_stamps),
      sync_ns_(std::llround(1e6 * rig.sync_ms)) {
  throw_if_any(problems_of(rig));
  for (SensorInput& input : inputs.sensors)
    sensors_.emplace_back().input = std::move(input);
  if (!options.poses.empty()) poses_ = Poses(options.poses, std::nullopt);
}

// Returns whether the cloud belongs to a frame that has been returned. A cloud that is much earlier than the
// one before begins a repetition.
bool RigSource::is_late(const Sensor& sensor, const Frame& cloud) const {
  const std::int64_t stamp = cloud.header.stamp_ns;
  if (sensor.last && stamp <= *sensor.last) return *sensor.last - stamp <= kSecond;
  if (!last_stamp_) return false;
  if (stamp <= *last_stamp_) return *last_stamp_ - stamp <= kSecond;
  return live_ && sensor.absent > 0 && stamp - *last_stamp_ < sync_ns_;
}

void RigSource::drop_late(Sensor& sensor, const Frame& cloud) {
  if (!is_power_of_ten(++sensor.late)) return;
  warnings_.push_back(printable(sensor.input.name + ": " + std::to_string(sensor.late) +
                                " clouds did not belong to the next frame and were dropped, now that of " +
                                seconds_of(cloud.header.stamp_ns)));
}

void RigSource::read_head(Sensor& sensor, std::chrono::milliseconds timeout) {
  Frame cloud;
  const Next next = sensor.input.source->next(cloud, timeout);
  sensor.ended = next == Next::end;
  live_ = live_ || next == Next::timeout;
  if (next != Next::frame) return;
  ++sensor.clouds;
  if (is_late(sensor, cloud)) return drop_late(sensor, cloud);
  if (sensor.last && cloud.header.stamp_ns < *sensor.last) last_stamp_.reset();
  sensor.last = cloud.header.stamp_ns;
  sensor.arrival = Clock::now();
  sensor.head = std::move(cloud);
}

// Reads the next cloud of each sensor that has none. Sleeps for a moment if none comes.
void RigSource::read_heads(Clock::time_point until) {
  bool waits = false;
  for (Sensor& sensor : sensors_) {
    // A dropped cloud of a file is followed by the next one at once.
    while (!sensor.head && !sensor.ended) {
      const std::uint64_t clouds = sensor.clouds;
      read_head(sensor, std::chrono::milliseconds(0));
      if (sensor.clouds == clouds) break;
    }
    waits = waits || (!sensor.head && !sensor.ended);
  }
  if (waits && !(is_complete() && has_transforms()))
    std::this_thread::sleep_until(std::min(until, Clock::now() + kPollRigInterval));
}

bool RigSource::all_ended() const {
  return std::all_of(sensors_.begin(), sensors_.end(),
                     [](const Sensor& sensor) { return sensor.ended && !sensor.head; });
}

std::int64_t RigSource::first_stamp() const {
  std::optional<std::int64_t> first;
  for (const Sensor& sensor : sensors_)
    if (sensor.head && (!first || sensor.head->header.stamp_ns < *first))
      first = sensor.head->header.stamp_ns;
  return first.value_or(0);
}

bool RigSource::is_member(const Sensor& sensor, std::int64_t stamp_ns) const {
  return sensor.head && sensor.head->header.stamp_ns - stamp_ns < sync_ns_;
}

// Returns whether no further cloud of the next frame is waited for.
bool RigSource::is_complete() const {
  std::optional<Clock::time_point> arrival;
  bool missing = false;
  for (const Sensor& sensor : sensors_) {
    if (sensor.head && (!arrival || sensor.arrival < *arrival)) arrival = sensor.arrival;
    missing = missing || (!sensor.head && !sensor.ended && !sensor.silent);
  }
  if (!arrival) return false;
  return !missing || Clock::now() - *arrival >= std::chrono::nanoseconds(sync_ns_);
}

// A head waits for clouds of other sensors with earlier stamps. With clocks that differ, it would wait for
// ever.
void RigSource::drop_stuck_heads() {
  if (!live_) return;
  const std::int64_t stamp = first_stamp();
  for (Sensor& sensor : sensors_) {
    if (!sensor.head || is_member(sensor, stamp) || Clock::now() - sensor.arrival < kLongestWait) continue;
    drop_late(sensor, *sensor.head);
    sensor.head.reset();
  }
}

FoundTransform RigSource::find_pose(const Sensor& sensor) {
  if (sensor.input.pose) return {sensor.input.pose, {}, false};
  const Frame& cloud = *sensor.head;
  for (const std::unique_ptr<TransformFeed>& feed : feeds_)
    feed->read(cloud.recorded_ns, transforms_);
  const std::string& frame = sensor.input.frame.empty() ? cloud.header.frame_id : sensor.input.frame;
  if (frame.empty()) {
    return {{}, "its clouds have no frame id; give one as `frame` of the sensor in rig.sensors", false};
  }
  return transforms_.find(rig_.frame, frame, cloud.header.stamp_ns);
}

// Returns whether the transforms of the next frame are there or are not waited for.
bool RigSource::has_transforms() {
  if (!live_) return true;
  const std::int64_t stamp = first_stamp();
  return std::all_of(sensors_.begin(), sensors_.end(), [&](Sensor& sensor) {
    if (!is_member(sensor, stamp) || !find_pose(sensor).pending) return true;
    return Clock::now() - sensor.arrival >= std::chrono::nanoseconds(sync_ns_);
  });
}

std::optional<Pose> RigSource::pose_of_rig(const Frame& frame) {
  if (const std::optional<Pose> pose = poses_.at(seq_, frame.header.stamp_ns)) return pose;
  if (rig_.fixed_frame.empty()) return std::nullopt;
  for (const std::unique_ptr<TransformFeed>& feed : feeds_)
    feed->read(frame.recorded_ns, transforms_);
  return transforms_.find(rig_.fixed_frame, rig_.frame, frame.header.stamp_ns).pose;
}

void RigSource::note_presence(Sensor& sensor, bool present, std::int64_t stamp_ns) {
  sensor.absent = present ? 0 : sensor.absent + 1;
  const bool silent = sensor.absent >= kAbsentFrames;
  if (silent == sensor.silent) return;
  sensor.silent = silent;
  const std::string what =
      silent ? ": no clouds; the frames from " + seconds_of(stamp_ns) + " on have only the other sensors'"
             : ": sends clouds again, at " + seconds_of(stamp_ns);
  warnings_.push_back(printable(sensor.input.name + what));
}

// Compares stamps with times of recording or arrival, which one machine has measured for all sensors.
void RigSource::compare_clocks() {
  if (clocks_differ_ || !own_stamps_) return;
  const Sensor* first = nullptr;
  for (const Sensor& sensor : sensors_) {
    if (!sensor.head || sensor.head->recorded_ns == 0) continue;
    if (first == nullptr) first = &sensor;
    const auto ahead = [](const Sensor& of) { return of.head->header.stamp_ns - of.head->recorded_ns; };
    const std::int64_t difference = ahead(sensor) - ahead(*first);
    if (std::abs(difference) <= kSecond) continue;
    clocks_differ_ = true;
    warnings_.push_back(printable("the clocks of " + sensor.input.name + " and " + first->input.name +
                                  " differ by " + seconds_of(difference) +
                                  "; their clouds cannot be merged until the clocks are synchronized"));
    return;
  }
}

void RigSource::merge(Frame& frame) {
  compare_clocks();
  const std::int64_t stamp = first_stamp();
  std::vector<MountedCloud> clouds;
  for (Sensor& sensor : sensors_) {
    clouds.push_back({nullptr, sensor.input.name, {}});
    if (!is_member(sensor, stamp)) continue;
    const FoundTransform found = find_pose(sensor);
    if (found.pose) {
      clouds.back() = {&*sensor.head, sensor.input.name, *found.pose};
      continue;
    }
    sensor.problem = printable("no pose in " + rig_.frame + ": " + found.problem);
    Frame lost = std::move(*sensor.head);
    sensor.head.reset();
    lost.file = sensor.input.name;
    throw FrameError(std::move(lost), sensor.problem);
  }
  const auto begin = Clock::now();
  frame = Frame();
  frame.header = {seq_, stamp, rig_.frame, 0};
  frame.file = "rig";
  merger_.merge(clouds, frame);
  for (std::size_t k = 0; k < sensors_.size(); ++k) {
    Sensor& sensor = sensors_[k];
    const bool present = clouds[k].frame != nullptr;
    note_presence(sensor, present, stamp);
    if (!present) continue;
    const Frame& cloud = *sensor.head;
    ++sensor.used;
    frame.decode_ms += cloud.decode_ms;
    frame.recorded_ns = std::max(frame.recorded_ns, cloud.recorded_ns);
    const bool earlier = frame.taken == Clock::time_point() || cloud.taken < frame.taken;
    if (earlier) frame.taken = cloud.taken;
    if (!cloud.note.empty())
      frame.note += (frame.note.empty() ? "" : "; ") + sensor.input.name + ": " + cloud.note;
    sensor.head.reset();
  }
  frame.pose = pose_of_rig(frame);
  frame.fixed_frame = rig_.fixed_frame;
  frame.decode_ms += std::chrono::duration<double, std::milli>(Clock::now() - begin).count();
  last_stamp_ = stamp;
  ++seq_;
}

// A sensor whose clouds were all lost is a mistake in the rig, although the other sensors' frames went on.
void RigSource::report_unused() const {
  for (const Sensor& sensor : sensors_)
    if (sensor.clouds > 0 && sensor.used == 0 && !sensor.problem.empty())
      throw std::runtime_error(sensor.input.name + ": none of its clouds was used: " + sensor.problem);
}

Next RigSource::next(Frame& frame, std::chrono::milliseconds timeout) {
  const Clock::time_point until = Clock::now() + timeout;
  for (;;) {
    read_heads(until);
    if (all_ended()) {
      report_unused();
      return Next::end;
    }
    drop_stuck_heads();
    if (is_complete() && has_transforms()) {
      merge(frame);
      return Next::frame;
    }
    if (Clock::now() >= until) return Next::timeout;
  }
}

std::vector<std::string> RigSource::take_warnings() {
  std::vector<std::string> all = std::exchange(warnings_, {});
  // The sources of all sensors may have the same warning, for example about the network.
  std::set<std::string> known;
  const auto append = [&](const std::vector<std::string>& lines, const std::string& prefix) {
    for (const std::string& line : lines)
      if (known.insert(line).second) all.push_back(prefix.empty() ? line : prefix + ": " + line);
  };
  for (Sensor& sensor : sensors_)
    append(sensor.input.source->take_warnings(), sensor.input.name);
  for (const std::unique_ptr<TransformFeed>& feed : feeds_)
    append(feed->take_warnings(), "");
  append(transforms_.take_warnings(), "");
  append(merger_.take_warnings(), "");
  return all;
}

}  // namespace pcl_bv::detail
