// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "rig_source.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>
#include <thread>
#include <utility>

#include "pcl_bv/io/untrusted_text.h"
#include "pipeline/config/check.h"

namespace pcl_bv::detail {
namespace {

// After so many frames without a pose of the robot, frames do not wait for it.
constexpr std::uint64_t kAwaitedPoses = 10;
// A live cloud that no other sensor's clouds catch up with for this time is dropped.
constexpr std::chrono::seconds kLongestWait{1};
constexpr std::chrono::milliseconds kPollRigInterval{1};

}  // namespace

RigSource::RigSource(RigInputs inputs, const RigConfig& rig, const ReplayOptions& options)
    : rig_(rig),
      poses_(std::move(inputs.feeds), std::move(inputs.transforms), rig, options),
      merger_(options.point_times),
      own_stamps_(options.own_stamps),
      sync_ns_(std::llround(1e6 * rig.sync_ms)),
      clocks_(inputs.sensors.size(), 1e6 * rig.sync_ms) {
  throw_if_any(problems_of(rig));
  for (SensorInput& input : inputs.sensors)
    sensors_.emplace_back().input = std::move(input);
}

// Returns whether the cloud belongs to a frame that has been returned.
bool RigSource::is_late(const Sensor& sensor, const Frame& cloud) const {
  const std::int64_t stamp = cloud.header.stamp_ns;
  if (sensor.last && stamp <= *sensor.last) return true;
  if (!last_stamp_) return false;
  const bool was_absent = live_ && !sensor.presence.in_last_frame();
  return stamp <= *last_stamp_ || (was_absent && stamp - *last_stamp_ < sync_ns_);
}

void RigSource::drop_late(Sensor& sensor, const Frame& cloud) {
  if (!is_power_of_ten(++sensor.late)) return;
  warn(sensor, std::to_string(sensor.late) + " late clouds dropped; the last one has the stamp " +
                   seconds_text(cloud.header.stamp_ns));
}

// A recording that is sent again begins at its first stamp. The waiting clouds are from its end.
void RigSource::begin_repetition() {
  last_stamp_.reset();
  clocks_.restart();
  for (Sensor& sensor : sensors_) {
    sensor.next.reset();
    sensor.last.reset();
    sensor.presence.restart();
  }
}

void RigSource::throw_lost(Sensor& sensor, Frame cloud, const std::string& problem) {
  sensor.problem = message_line(problem);
  cloud.file = sensor.input.name;
  cloud.header.seq = seq_++;
  throw FrameError(std::move(cloud), sensor.problem);
}

// The number of the cloud in its source helps to find it; frames are numbered by the rig.
void RigSource::throw_unreadable(Sensor& sensor, const FrameError& error) {
  ++sensor.clouds;
  const std::string& file = error.frame.file;
  std::string name = "cloud " + std::to_string(error.frame.header.seq);
  if (!file.empty() && !file.ends_with(sensor.input.name)) name += " (" + file + ")";
  throw_lost(sensor, error.frame, name + ": " + error.reason);
}

void RigSource::check_clock(Sensor& sensor, const Frame& cloud) {
  const bool live = cloud.taken != Clock::time_point();
  if (!live && (!own_stamps_ || cloud.recorded_ns == 0)) return;
  const std::int64_t measured =
      live ? std::chrono::nanoseconds(cloud.taken.time_since_epoch()).count() : cloud.recorded_ns;
  const auto number = static_cast<std::size_t>(&sensor - sensors_.data());
  const SensorClocks::Found found = clocks_.note(number, cloud.header.stamp_ns, measured);
  if (found.jumped) drop_jumped(sensors_[*found.jumped]);
  if (!found.reference) return;
  const std::string text = found.text(sensors_[*found.reference].input.name);
  if (found.unusable)
    throw_lost(sensor, cloud, text + "; the clouds can be merged when the clocks are synchronized");
  warn(sensor, text + ": clouds of the same moment get into different frames");
}

// Drops a cloud whose stamp is of another time. It would wait for the other sensors' clouds until then.
void RigSource::drop_jumped(Sensor& sensor) {
  if (!sensor.next) return;
  warn(sensor, "a cloud is dropped: its stamp " + seconds_text(sensor.next->header.stamp_ns) +
                   " is of another time than those of the other sensors");
  sensor.next.reset();
  sensor.last.reset();
}

void RigSource::warn(const Sensor& sensor, const std::string& what) {
  if (!what.empty()) warnings_.push_back(message_line(sensor.input.name + ": " + what));
}

void RigSource::read_cloud(Sensor& sensor) {
  Frame cloud;
  Next next = Next::timeout;
  try {
    next = sensor.input.source->next(cloud, std::chrono::milliseconds(0));
  } catch (const FrameError& error) {
    throw_unreadable(sensor, error);
  }
  sensor.ended = next == Next::end;
  live_ = live_ || next == Next::timeout;
  if (next != Next::frame) return;
  ++sensor.clouds;
  const std::int64_t stamp = cloud.header.stamp_ns;
  if (live_ && sensor.last && *sensor.last - stamp > kRestart) begin_repetition();
  check_clock(sensor, cloud);
  if (live_) warn(sensor, sensor.presence.end_silence(stamp));
  if (is_late(sensor, cloud)) return drop_late(sensor, cloud);
  if (sensor.last) sensor.presence.note_gap(stamp - *sensor.last);
  sensor.last = stamp;
  sensor.arrival = Clock::now();
  sensor.next = std::move(cloud);
}

// Reads the next cloud of each sensor that has none. Sleeps for a moment if the next frame still lacks a
// cloud or a transform.
void RigSource::read_clouds(Clock::time_point until) {
  for (Sensor& sensor : sensors_) {
    // A dropped cloud of a file is followed by the next one at once.
    while (!sensor.next && !sensor.ended) {
      const std::uint64_t clouds = sensor.clouds;
      read_cloud(sensor);
      if (sensor.clouds == clouds) break;
    }
  }
  if (live_ && !(is_complete() && has_transforms()))
    std::this_thread::sleep_until(std::min(until, Clock::now() + kPollRigInterval));
}

bool RigSource::all_ended() const {
  return std::all_of(sensors_.begin(), sensors_.end(),
                     [](const Sensor& sensor) { return sensor.ended && !sensor.next; });
}

std::int64_t RigSource::first_stamp() const {
  std::optional<std::int64_t> first;
  for (const Sensor& sensor : sensors_)
    if (sensor.next && (!first || sensor.next->header.stamp_ns < *first))
      first = sensor.next->header.stamp_ns;
  return first.value_or(0);
}

bool RigSource::is_member(const Sensor& sensor, std::int64_t stamp_ns) const {
  return sensor.next && sensor.next->header.stamp_ns - stamp_ns < sync_ns_;
}

// Returns whether no further cloud of the next frame is waited for.
bool RigSource::is_complete() const {
  std::optional<Clock::time_point> arrival;
  bool missing = false;
  for (const Sensor& sensor : sensors_) {
    if (sensor.next && (!arrival || sensor.arrival < *arrival)) arrival = sensor.arrival;
    missing = missing || (!sensor.next && !sensor.ended && !sensor.presence.silent());
  }
  if (!arrival) return false;
  return !missing || Clock::now() - *arrival >= std::chrono::nanoseconds(sync_ns_);
}

// A cloud waits for clouds of other sensors with earlier stamps. With clocks that differ, it would wait for
// ever.
void RigSource::drop_unmatched() {
  if (!live_) return;
  const std::int64_t stamp = first_stamp();
  for (Sensor& sensor : sensors_) {
    if (!sensor.next || is_member(sensor, stamp) || Clock::now() - sensor.arrival < kLongestWait) continue;
    if (is_power_of_ten(++sensor.unmatched))
      warn(sensor, std::to_string(sensor.unmatched) +
                       " clouds dropped that are ahead of the other sensors'; the last one has the stamp " +
                       seconds_text(sensor.next->header.stamp_ns));
    sensor.next.reset();
  }
}

// Returns whether the transforms of the next frame are there or are not waited for.
bool RigSource::has_transforms() {
  if (!live_) return true;
  const std::int64_t stamp = first_stamp();
  const bool robot_is_pending = frames_without_pose_ < kAwaitedPoses && poses_.of_rig(stamp, 0).pending;
  return std::all_of(sensors_.begin(), sensors_.end(), [&](Sensor& sensor) {
    if (!is_member(sensor, stamp) || !(robot_is_pending || find_pose(sensor).pending)) return true;
    return Clock::now() - sensor.arrival >= std::chrono::nanoseconds(sync_ns_);
  });
}

// A sensor whose clouds were all lost is a mistake in the rig, although the other sensors' frames went on.
void RigSource::end() {
  for (Sensor& sensor : sensors_) {
    if (sensor.late > 0 && !is_power_of_ten(sensor.late))
      warn(sensor, std::to_string(std::exchange(sensor.late, 0)) + " late clouds dropped in all");
    if (sensor.clouds > 0 && sensor.used == 0)
      throw std::runtime_error(sensor.input.name + ": none of its clouds was used" +
                               (sensor.problem.empty() ? "" : ": " + sensor.problem));
  }
}

Next RigSource::next(Frame& frame, std::chrono::milliseconds timeout) {
  const Clock::time_point until = Clock::now() + timeout;
  for (;;) {
    read_clouds(until);
    if (all_ended()) {
      end();
      return Next::end;
    }
    drop_unmatched();
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
      if (known.insert(line).second)
        all.push_back(std::string(prefix).append(prefix.empty() ? "" : ": ").append(line));
  };
  for (Sensor& sensor : sensors_)
    append(sensor.input.source->take_warnings(), sensor.input.name);
  append(poses_.take_warnings(), "");
  append(merger_.take_warnings(), "");
  return all;
}

}  // namespace pcl_bv::detail
