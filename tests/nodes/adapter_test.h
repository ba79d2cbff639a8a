// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Cubes that come and go, and a sender that keeps what an adapter sends.
#pragma once

#include <map>
#include <random>
#include <set>

#include "frames.h"
#include "pcl_bv/nodes/frame_pipeline.h"
#include "stream/topics/message_adapter.h"

namespace pcl_bv::test {

class Sent final : public MessageSender {
 public:
  std::size_t add_topic(const MessageTopic& topic) override {
    topics.push_back(topic);
    return topics.size() - 1;
  }
  bool has_subscribers(std::size_t topic) const override { return silent.count(topics[topic].name) == 0; }
  bool takes_ros1() const override { return ros1; }
  void send(std::size_t topic, std::int64_t stamp_ns, const std::vector<std::byte>& message) override {
    stamps.push_back(stamp_ns);
    messages[topics[topic].name].push_back(message);
  }

  /// The messages of a topic since the last call.
  template <class Message>
  std::vector<Message> take(const std::string& topic) {
    std::vector<Message> all;
    const auto known =
        std::find_if(topics.begin(), topics.end(), [&](const MessageTopic& t) { return t.name == topic; });
    EXPECT_TRUE(known != topics.end() && known->type == Message::ros_type) << topic;
    kept_ = std::exchange(messages[topic], {});  // what msg::Bytes refer to
    for (const std::vector<std::byte>& bytes : kept_)
      all.push_back(read_message<Message>(bytes.data(), bytes.size(), ros1));
    return all;
  }

  std::vector<MessageTopic> topics;
  std::set<std::string> silent;
  std::map<std::string, std::vector<std::vector<std::byte>>> messages;
  std::vector<std::int64_t> stamps;
  bool ros1 = false;

 private:
  std::vector<std::vector<std::byte>> kept_;
};

/// Frames with cubes of 200 points, 1 m wide, around these centres.
class Cubes {
 public:
  explicit Cubes(std::vector<std::string> volumes) {
    config.volumes = std::move(volumes);
    config.ground.method = GroundMethod::none;
    config.cluster.tolerance = 0.6;
    config.track.enabled = true;
    config.track.birth = 1;
    config.track.death = 3;
  }

  void process(const std::vector<Eigen::Vector3d>& centres) {
    xyz.clear();
    std::mt19937 random(7);
    std::uniform_real_distribution<float> side(-0.5F, 0.5F);
    for (const Eigen::Vector3d& centre : centres)
      for (int i = 0; i < 200; ++i)
        for (int axis = 0; axis < 3; ++axis)
          xyz.push_back(static_cast<float>(centre[axis]) + side(random));
    frame = third_orientation(xyz, number++);
    frame.header.frame_id = "base";
    if (!pipeline) pipeline = std::make_unique<FramePipeline>(config);
    pipeline->process(frame, result);
  }
  std::string id(std::size_t cluster) const { return std::to_string(result.tracks.at(cluster)->id); }

  PipelineConfig config;
  std::unique_ptr<FramePipeline> pipeline;
  std::vector<float> xyz;
  std::size_t number = 0;
  Frame frame;
  FrameResult result;
};

}  // namespace pcl_bv::test
