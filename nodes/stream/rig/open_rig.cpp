// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Makes a rig from the names of its sources.

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "mounting_pose.h"
#include "open_live_rig.h"
#include "pcl_bv/io/untrusted_text.h"
#include "pipeline/config/check.h"
#include "rig_source.h"
#include "stream/middleware.h"
#include "stream/sources/cloud_message.h"
#include "stream/sources/message_source.h"
#include "urdf.h"

namespace pcl_bv {
using namespace detail;
namespace {

constexpr std::string_view kDdsPrefix = "dds:";

// A topic of clouds and the name of its source. A source without topics has one by its own name.
struct NamedTopic {
  std::string source, topic;
};

bool is_recorded(const std::string& source) {
  return source_kind(source).times == FrameTimes::messages;
}

bool is_for(const RigSensor& row, const NamedTopic& named) {
  return row.topic == named.topic && (row.source.empty() || row.source == named.source);
}

// Returns the row of rig.sensors for the topic, or null.
const RigSensor* row_of(const NamedTopic& named, const RigConfig& rig) {
  const auto row = std::find_if(rig.sensors.begin(), rig.sensors.end(),
                                [&](const RigSensor& sensor) { return is_for(sensor, named); });
  return row == rig.sensors.end() ? nullptr : &*row;
}

// Returns the topics of all sources. A recording has those of `rig.sensors`, else the given one, else all.
std::vector<NamedTopic> topics_of(const std::vector<std::string>& sources, const RigConfig& rig,
                                  const ReplayOptions& options) {
  std::vector<NamedTopic> all;
  for (const std::string& source : sources) {
    if (source.starts_with(kDdsPrefix)) {
      all.push_back({source, source.substr(kDdsPrefix.size())});
    } else if (!is_recorded(source)) {
      all.push_back({source, source});
    } else if (rig.sensors.empty() && !options.topic.empty()) {
      all.push_back({source, options.topic});
    } else {
      std::vector<std::string> recorded = recorded_cloud_topics(source);
      if (recorded.empty()) recorded.push_back(source);  // packets of one sensor
      for (std::string& topic : recorded) {
        NamedTopic named{source, std::move(topic)};
        if (rig.sensors.empty() || row_of(named, rig)) all.push_back(std::move(named));
      }
    }
  }
  return all;
}

// Returns the sensor without its source.
SensorInput mounted(const RigSensor& sensor) {
  SensorInput input;
  input.name = sensor.topic;
  input.frame = sensor.frame;
  if (!sensor.pose.empty()) input.pose = mounting_pose(sensor.pose);
  return input;
}

SensorInput open_sensor(const NamedTopic& named, const RigConfig& rig, ReplayOptions options) {
  const RigSensor* const row = row_of(named, rig);
  if (row == nullptr && !rig.sensors.empty())
    throw std::invalid_argument(named.topic + ": rig.sensors has no sensor with this topic");
  SensorInput input = mounted(row == nullptr ? RigSensor{named.topic} : *row);
  options.topic = is_recorded(named.source) && named.topic != named.source ? named.topic : "";
  options.poses.clear();
  input.source = open_source(named.source, options);
  return input;
}

// Each sensor opens its recording.
void require_few_sensors(std::size_t sensors) {
  constexpr std::size_t most = 256;
  if (sensors > most)
    throw std::invalid_argument("rig.sensors: the rig has " + std::to_string(sensors) +
                                " topics with clouds; at most " + std::to_string(most) +
                                " are allowed: name them in rig.sensors");
}

void check_rig(const RigConfig& rig) {
  throw_if_any(problems_of(rig));
  require_few_sensors(rig.sensors.size());
  if (rig.frame.empty()) throw std::invalid_argument("rig.frame is empty");
}

// Transforms have the times and frame ids of messages.
void check_replay(const std::vector<std::string>& sources, const ReplayOptions& options) {
  if (options.loops > 1) throw std::invalid_argument("the sources of a rig cannot be repeated");
  if (!options.frame_id.empty())
    throw std::invalid_argument("a rig has the frame ids of its clouds and no options.frame_id");
  for (const std::string& source : sources)
    if (source_kind(source).times != source_kind(sources.front()).times)
      throw std::invalid_argument("the sources of a rig are of different kinds and have no common stamps: " +
                                  sources.front() + ", " + source);
}

// One pose cannot be that of two sensors.
void check_sensors_have_one_source(const RigConfig& rig, const std::vector<NamedTopic>& topics) {
  for (const RigSensor& sensor : rig.sensors) {
    std::vector<std::string> having;
    for (const NamedTopic& named : topics)
      if (is_for(sensor, named)) having.push_back(named.source);
    if (having.size() == 1) continue;
    if (having.size() > 1)
      throw std::invalid_argument(message_line("rig.sensors: " + having[0] + " and " + having[1] +
                                               " have the topic " + sensor.topic +
                                               "; give each of them a row with `source`"));
    std::vector<std::string> known;
    for (const NamedTopic& named : topics)
      known.push_back(named.topic);
    throw std::invalid_argument(message_line("rig.sensors: no source has the topic " + sensor.topic +
                                             (known.empty() ? "" : "; there are " + name_list(known))));
  }
}

void check_recorded_odometry(const std::vector<std::string>& sources, const std::string& odometry) {
  std::vector<std::string> known;
  for (const std::string& source : sources) {
    for (const std::string& topic : recorded_odometry_topics(source)) {
      if (topic == odometry) return;
      known.push_back(topic);
    }
  }
  throw std::invalid_argument(message_line("rig.odometry: no recording has the topic " + odometry +
                                           " of type nav_msgs/msg/Odometry" +
                                           (known.empty() ? "" : "; there are " + name_list(known))));
}

// Adds the fixed joints of the URDF and the transforms of recordings and live topics.
void add_transforms_of(const std::vector<std::string>& sources, const RigConfig& rig, RigInputs& inputs) {
  if (!rig.urdf.empty()) read_urdf(rig.urdf, UrdfContent::joints).add_joints(inputs.transforms);
  bool live = false;
  std::vector<std::string> recordings;
  for (const std::string& source : sources) {
    if (source.starts_with(kDdsPrefix)) {
      live = true;
    } else if (is_recorded(source)) {
      recordings.push_back(source);
      if (auto feed = recorded_transforms(source, rig.odometry)) inputs.feeds.push_back(std::move(feed));
    }
  }
  if (live) inputs.feeds.push_back(live_transforms(middleware("dds"), rig.odometry));
  if (!live && !rig.odometry.empty()) check_recorded_odometry(recordings, rig.odometry);
}

}  // namespace

std::optional<RegionConfig> robot_body(const RigConfig& rig, std::vector<std::string>& warnings) {
  if (!rig.self_filter) return std::nullopt;
  throw_if_any(problems_of(rig));
  const Urdf urdf = read_urdf(rig.urdf);
  warnings.insert(warnings.end(), urdf.warnings.begin(), urdf.warnings.end());
  RegionConfig body;
  try {
    body.volumes = urdf.volumes_in(rig.frame, warnings);
    if (body.volumes.empty()) throw IoError("the robot has no collision shape that can be read");
  } catch (const IoError& error) {
    throw IoError(rig.urdf + ": " + error.what());
  }
  body.padding = *rig.self_filter;
  return body;
}

std::unique_ptr<FrameSource> open_rig(const std::vector<std::string>& sources, const RigConfig& rig,
                                      const ReplayOptions& given) {
  check_rig(rig);
  check_replay(sources, given);
  ReplayOptions options = given;
  options.own_stamps = given.own_stamps || (!sources.empty() && is_recorded(sources.front()));
  const std::vector<NamedTopic> topics = topics_of(sources, rig, options);
  require_few_sensors(topics.size());
  check_sensors_have_one_source(rig, topics);
  if (topics.empty()) throw std::invalid_argument("open_rig: no source");
  RigInputs inputs;
  for (const NamedTopic& named : topics)
    inputs.sensors.push_back(open_sensor(named, rig, options));
  add_transforms_of(sources, rig, inputs);
  return std::make_unique<RigSource>(std::move(inputs), rig, options);
}

std::unique_ptr<FrameSource> detail::open_live_rig(Middleware& middleware, const RigConfig& rig,
                                                   const ReplayOptions& options) {
  check_rig(rig);
  if (rig.sensors.empty()) throw std::invalid_argument("rig.sensors is empty");
  RigInputs inputs;
  if (!rig.urdf.empty()) read_urdf(rig.urdf, UrdfContent::joints).add_joints(inputs.transforms);
  inputs.feeds.push_back(live_transforms(middleware, rig.odometry));
  ReplayOptions clouds;
  clouds.class_field = options.class_field;
  for (const RigSensor& sensor : rig.sensors) {
    SensorInput input = mounted(sensor);
    input.source =
        make_message_source(middleware.receiver(sensor.topic, cloud_type_names()), sensor.topic, clouds);
    inputs.sensors.push_back(std::move(input));
  }
  return std::make_unique<RigSource>(std::move(inputs), rig, options);
}

}  // namespace pcl_bv
