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

constexpr std::int64_t kSecond = 1'000'000'000;
// A live cloud that no other sensor's clouds catch up with for this time is dropped.
constexpr std::chrono::seconds kLongestWait{1};
constexpr std::chrono::milliseconds kPollRigInterval{1};

}  // namespace

RigSource::RigSource(RigInputs inputs, const RigConfig& rig, const ReplayOptions& options)
    : rig_(rig),
      poses_(std::move(inputs.feeds), std::move(inputs.transforms), rig, options),
      merger_(options.point_times),
      own_stamps_(options.own_stamps),
      sync_ns_(std::llround(1e6 * rig.sync_ms)) {
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
  clock_.reset();
  for (Sensor& sensor : sensors_) {
    sensor.head.reset();
    sensor.last.reset();
  }
}

void RigSource::lose(Sensor& sensor, Frame cloud, const std::string& problem) {
  sensor.problem = printable(problem);
  cloud.file = sensor.input.name;
  cloud.header.seq = seq_++;
  throw FrameError(std::move(cloud), sensor.problem);
}

// The number of the cloud in its source helps to find it; frames are numbered by the rig.
void RigSource::lose_unreadable(Sensor& sensor, const FrameError& error) {
  ++sensor.clouds;
  const std::string& file = error.frame.file;
  std::string name = "cloud " + std::to_string(error.frame.header.seq);
  if (!file.empty() && !file.ends_with(sensor.input.name)) name += " (" + file + ")";
  lose(sensor, error.frame, name + ": " + error.reason);
}

// Compares the stamp with the time of recording or arrival, which one machine has measured for all sensors.
// Clouds of clocks that differ would be merged with clouds of another moment.
void RigSource::check_clock(Sensor& sensor, const Frame& cloud) {
  const bool live = cloud.taken != Clock::time_point();
  if (!live && (!own_stamps_ || cloud.recorded_ns == 0)) return;
  const std::int64_t measured =
      live ? std::chrono::nanoseconds(cloud.taken.time_since_epoch()).count() : cloud.recorded_ns;
  const std::int64_t ahead = cloud.header.stamp_ns - measured;
  // Simulated time may run faster or slower than real time, so each cloud is compared with the latest one of
  // the sensor whose clock decides. If that sensor is silent, another one takes its part.
  constexpr std::uint64_t max_clouds_of_others = 20;
  if (!clock_ || clock_->owner == &sensor || ++clock_->clouds_of_others > max_clouds_of_others)
    clock_ = SensorClock{&sensor, ahead, 0};
  const std::int64_t difference = ahead - clock_->ahead;
  if (std::abs(difference) <= kSecond) return;
  lose(sensor, cloud,
       "its clock is " + seconds_text(difference) + " ahead of that of " + clock_->owner->input.name +
           "; the clouds can be merged when the clocks are synchronized");
}

void RigSource::warn(const Sensor& sensor, const std::string& what) {
  if (!what.empty()) warnings_.push_back(printable(sensor.input.name + ": " + what));
}

void RigSource::read_head(Sensor& sensor, std::chrono::milliseconds timeout) {
  Frame cloud;
  Next next = Next::timeout;
  try {
    next = sensor.input.source->next(cloud, timeout);
  } catch (const FrameError& error) {
    lose_unreadable(sensor, error);
  }
  sensor.ended = next == Next::end;
  live_ = live_ || next == Next::timeout;
  if (next != Next::frame) return;
  ++sensor.clouds;
  const std::int64_t stamp = cloud.header.stamp_ns;
  if (live_ && sensor.last && *sensor.last - stamp > kSecond) begin_repetition();
  check_clock(sensor, cloud);
  if (live_) warn(sensor, sensor.presence.end_silence(stamp));
  if (is_late(sensor, cloud)) return drop_late(sensor, cloud);
  if (sensor.last) sensor.presence.note_gap(stamp - *sensor.last);
  sensor.last = stamp;
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
    missing = missing || (!sensor.head && !sensor.ended && !sensor.presence.silent());
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
  return poses_.of_sensor(sensor.input.frame, *sensor.head);
}

// Returns whether the transforms of the next frame are there or are not waited for.
bool RigSource::has_transforms() {
  if (!live_) return true;
  const std::int64_t stamp = first_stamp();
  const bool robot_is_pending = poses_.of_rig(stamp, 0).pending;
  return std::all_of(sensors_.begin(), sensors_.end(), [&](Sensor& sensor) {
    if (!is_member(sensor, stamp) || !(robot_is_pending || find_pose(sensor).pending)) return true;
    return Clock::now() - sensor.arrival >= std::chrono::nanoseconds(sync_ns_);
  });
}

void RigSource::merge(Frame& frame) {
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
    Frame lost = std::move(*sensor.head);
    sensor.head.reset();
    lose(sensor, std::move(lost), "no pose in " + rig_.frame + ": " + found.problem);
  }
  const auto begin = Clock::now();
  frame = Frame();
  frame.header = {seq_, stamp, rig_.frame, 0};
  frame.file = "rig";
  merger_.merge(clouds, frame);
  for (std::size_t k = 0; k < sensors_.size(); ++k) {
    Sensor& sensor = sensors_[k];
    const bool present = clouds[k].frame != nullptr;
    warn(sensor, sensor.presence.note_frame(present, stamp));
    if (!present) continue;
    const Frame& cloud = *sensor.head;
    ++sensor.used;
    frame.decode_ms += cloud.decode_ms;
    frame.recorded_ns = std::max(frame.recorded_ns, cloud.recorded_ns);
    const bool earlier = frame.taken == Clock::time_point() || cloud.taken < frame.taken;
    if (earlier) frame.taken = cloud.taken;
    if (!cloud.note.empty())
      frame.note.append(frame.note.empty() ? "" : "; ")
          .append(sensor.input.name)
          .append(": ")
          .append(cloud.note);
    sensor.head.reset();
  }
  frame.pose = poses_.of_rig(stamp, frame.recorded_ns).pose;
  frame.fixed_frame = rig_.fixed_frame;
  frame.decode_ms += std::chrono::duration<double, std::milli>(Clock::now() - begin).count();
  last_stamp_ = stamp;
  ++seq_;
}

// A sensor whose clouds were all lost is a mistake in the rig, although the other sensors' frames went on.
void RigSource::report_unused() const {
  for (const Sensor& sensor : sensors_)
    if (sensor.clouds > 0 && sensor.used == 0)
      throw std::runtime_error(sensor.input.name + ": none of its clouds was used" +
                               (sensor.problem.empty() ? "" : ": " + sensor.problem));
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
