// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "rig_reader.h"

#include <chrono>
#include <exception>
#include <utility>

#include "pcl_bv/io/untrusted_text.h"
#include "stream/rig/open_live_rig.h"

namespace pcl_bv {
namespace {

constexpr std::chrono::milliseconds kPollInterval{50};

std::unique_ptr<FrameSource> open_sensors(Middleware& topics, const StreamConfig& config) {
  RigConfig rig = config.rig;
  if (rig.sensors.empty()) rig.sensors.push_back({"points"});
  ReplayOptions options;
  options.point_times = config.pipeline.deskew != Deskew::off;
  if (const auto& field = config.pipeline.cluster.class_field) options.class_field = field->name;
  return open_live_rig(topics, rig, options);
}

}  // namespace

RigReader::RigReader(const ros::NodeHandle& topics, const StreamConfig& config, StreamRunner& runner,
                     std::function<void(const std::string&)> warn)
    : topics_(topics), source_(open_sensors(topics_, config)), runner_(runner), warn_(std::move(warn)) {
  thread_ = std::thread([this] { read(); });
}

RigReader::~RigReader() {
  ended_ = true;
  thread_.join();
}

void RigReader::subscribe(bool wanted) {
  wanted_ = wanted;
  topics_.subscribe_to_clouds(wanted);
}

void RigReader::read() {
  while (!ended_) {
    Frame frame;
    try {
      const Next next = source_->next(frame, kPollInterval);
      for (const std::string& line : source_->take_warnings())
        warn_(line);
      if (next == Next::frame) {
        runner_.push(std::move(frame));
      } else if (!wanted_) {
        std::this_thread::sleep_for(kPollInterval);
      }
    } catch (const FrameError& error) {
      runner_.report_unreadable(error.frame, error.reason);
    } catch (const std::exception& error) {
      warn_("the clouds cannot be merged any more: " + detail::reason_of(error));
      return;
    }
  }
}

}  // namespace pcl_bv
