// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include <utility>

#include "pcl_bv/messages/schema.h"
#include "pcl_bv/recording/mcap_writer.h"
#include "pcl_bv/recording/rosbag2_writer.h"
#include "sinks.h"
#include "stream/topics/message_sink.h"

namespace pcl_bv::detail {
namespace {

// The QoS that rosbag2 stores for a topic. It is reliable, has a history of the last 10 messages, and is
// volatile: late subscribers get no old messages.
constexpr const char* kQos =
    "- history: 1\n  depth: 10\n  reliability: 1\n  durability: 2\n  deadline:\n    sec: 9223372036\n    "
    "nsec: "
    "854775807\n  lifespan:\n    sec: 9223372036\n    nsec: 854775807\n  liveliness: 1\n  "
    "liveliness_lease_duration:\n    sec: 9223372036\n    nsec: 854775807\n  "
    "avoid_ros_namespace_conventions: false";

constexpr std::string_view kVolatile = "durability: 2";

class Recorder final : public MessageSender {
 public:
  explicit Recorder(std::unique_ptr<RecordingWriter> writer) : writer_(std::move(writer)) {}
  std::size_t add_topic(const MessageTopic& topic) override {
    std::string qos = kQos;
    if (topic.latched) qos.replace(qos.find(kVolatile), kVolatile.size(), "durability: 1");
    return writer_->add_topic(
        {topic.name, topic.type, schema_of(topic.type), {{"offered_qos_profiles", qos}}});
  }
  void send(std::size_t topic, std::int64_t stamp_ns, const std::vector<std::byte>& cdr) override {
    writer_->write(topic, stamp_ns, stamp_ns, cdr.data(), cdr.size());
  }
  void announce_settings(const std::string& yaml, std::int64_t stamp_ns) override {
    writer_->attach("config.yaml", "application/yaml", yaml, stamp_ns);
  }
  void close() override { writer_->close(); }

 private:
  std::unique_ptr<RecordingWriter> writer_;
};

template <class Writer>
std::unique_ptr<FrameSink> open_recording_sink(const SinkOptions& description) {
  MessageTopics topics;
  topics.points = description.points;
  topics.adapters = description.adapters;
  return make_message_sink(std::make_unique<Recorder>(std::make_unique<Writer>(description.target)), topics);
}

}  // namespace

std::vector<SinkKind> recording_sinks() {
  return {{"mcap", "FILE[,points][,moveit][,nav2][,vision]", "", open_recording_sink<McapWriter>},
          {"rosbag2", "FOLDER[,points][,moveit][,nav2][,vision]", "", open_recording_sink<Rosbag2Writer>}};
}

}  // namespace pcl_bv::detail
