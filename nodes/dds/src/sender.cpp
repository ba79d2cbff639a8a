// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include <algorithm>
#include <cstring>
#include <map>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "cdr_type.h"
#include "endpoints.h"
#include "participant.h"
#include "pcl_bv/io/raw_cloud.h"

namespace pcl_bv::dds {
using namespace detail;
namespace {

constexpr dds_duration_t kMaxBlockingTime = DDS_MSECS(10);

// Returns the RIHS01 hash (REP 2011) of a type's definition, or "" for types that are not in the table.
// rosbag2 and `ros2 topic info` of Iron and later identify a type by this hash. The hashes are those of the
// definitions of Humble and later.
std::string_view hash_of(const std::string& type) {
  static const std::map<std::string_view, std::string_view> hashes{
      {"sensor_msgs/msg/PointCloud2", "9198cabf7da3796ae6fe19c4cb3bdd3525492988c70522628af5daa124bae2b5"},
      {"visualization_msgs/msg/MarkerArray",
       "86cb8800b6fb05b5eff1abd7a56f62a5641d3ae9a1c29e78e67e704f1d067dcf"},
      {"vision_msgs/msg/Detection3DArray",
       "793f5eab9595ac1c0da07873cc859db42eae51f0ee76056db8562515d830e018"},
      {"diagnostic_msgs/msg/DiagnosticArray",
       "5a8a36efb05fb25070fa0fb3810290c0e6cd4862b54a8fb975a1ee8dc55a333e"},
      {"moveit_msgs/msg/PlanningScene", "0f58540ad5eab4b9ea827d53b763c793d8cabd202b3b301fcee25afa4ce1bd80"},
      {"moveit_msgs/msg/CollisionObject", "74b0acd6d56be032bf4f764b2c2633f50588b5fb2bd71e97206c59052747cf7e"},
      {"nav2_dynamic_msgs/msg/ObstacleArray",
       "30bef8eb1da85ccb8d8fd860be402b7710dd81b368d1622325aa617436b0cb2a"},
      {"geometry_msgs/msg/PolygonInstanceStamped",
       "802f37ea4398d7ce547936aab1fd278923716a13c63373887cd896957434ce2f"},
      {"geometry_msgs/msg/PolygonStamped",
       "b7cf07932f1523d4b4088075945c1a0141f7cd21da87cc940fc61652e9138b46"},
      {"vision_msgs/msg/BoundingBox3DArray",
       "a81938db9576b10c2eecd7c5a5da3eac496efd00221b25ed051dfbc81fb56da6"},
      {"vision_msgs/msg/LabelInfo", "3d37df4015cdf660cc851c51897f2acd957e1ca6205ba0a99aebffb9406b0783"}};
  const auto found = hashes.find(type);
  return found == hashes.end() ? std::string_view() : found->second;
}

Qos writer_qos(const std::string& type, bool latched, std::size_t history) {
  Qos qos = make_qos();
  dds_qset_reliability(qos.get(), DDS_RELIABILITY_RELIABLE, kMaxBlockingTime);
  dds_qset_history(qos.get(), DDS_HISTORY_KEEP_LAST, latched ? 1 : static_cast<std::int32_t>(history));
  if (latched) dds_qset_durability(qos.get(), DDS_DURABILITY_TRANSIENT_LOCAL);
  dds_qset_writer_data_lifecycle(qos.get(), false);
  if (const std::string_view hash = hash_of(type); !hash.empty()) {
    const std::string text = "typehash=RIHS01_" + std::string(hash) + ';';
    dds_qset_userdata(qos.get(), text.data(), text.size());
  }
  return qos;
}

class Sender final : public MessageSender {
 public:
  std::size_t add_topic(const MessageTopic& added) override {
    const auto& [name, type, encoding, latched, history] = added;
    if (encoding != "cdr") throw std::invalid_argument(name + ": DDS carries CDR only");
    const ddsi_sertype* known = nullptr;
    Entity topic(create_cdr_topic(participant_->get(), dds_topic(name), dds_type(type), &known), name);
    const Qos qos = writer_qos(type, latched, history);
    Entity writer(dds_create_writer(participant_->get(), topic.get(), qos.get(), nullptr), name);
    topics_.push_back({name, known, std::move(topic), std::move(writer)});
    return topics_.size() - 1;
  }

  bool has_subscribers(std::size_t topic) const override {
    dds_publication_matched_status_t matched{};
    return dds_get_publication_matched_status(topics_.at(topic).writer.get(), &matched) >= 0 &&
           matched.current_count > 0;
  }

  void send(std::size_t topic, std::int64_t, const std::vector<std::byte>& cdr) override {
    Topic& to = topics_.at(topic);
    if (cdr.size() < 4 || cdr.size() > UINT32_MAX - 4)
      throw std::invalid_argument(to.name + ": not a valid CDR message (4 bytes to 4 GiB)");
    const std::size_t padding = (4 - cdr.size() % 4) % 4;
    CdrSample* const sample = make_sample(to.type, SDK_DATA, cdr.size() + padding);
    if (sample == nullptr) throw std::bad_alloc();
    std::memcpy(sample->bytes.get(), cdr.data(), cdr.size());
    std::memset(sample->bytes.get() + cdr.size(), 0, padding);
    sample->bytes[3] |= static_cast<std::byte>(padding);  // number of padding bytes (DDSI-RTPS 2.3)
    sample->timestamp.v = dds_time();
    const dds_return_t status = dds_writecdr(to.writer.get(), sample);
    if (status == DDS_RETCODE_TIMEOUT) {
      ++to.timed_out;
    } else if (status != DDS_RETCODE_OK) {
      throw IoError(to.name + ": " + dds_strretcode(status));
    }
  }

  std::vector<std::string> take_warnings() override {
    std::vector<std::string> all = participant_->take_log();
    for (Topic& topic : topics_) {
      if (topic.timed_out > 0)
        all.push_back(topic.name + ": " + std::to_string(std::exchange(topic.timed_out, 0)) +
                      " messages dropped: a reader blocked the writer for more than 10 ms");
    }
    return all;
  }

  // Waits at most 1 s in total for the readers to acknowledge the last messages.
  void close() override {
    const dds_time_t until = dds_time() + DDS_SECS(1);
    for (const Topic& topic : topics_)
      dds_wait_for_acks(topic.writer.get(), std::max<dds_duration_t>(until - dds_time(), 0));
    topics_.clear();
  }

 private:
  struct Topic {
    std::string name;
    const ddsi_sertype* type;
    Entity topic, writer;         // the writer is destroyed before its topic
    std::uint64_t timed_out = 0;  // writes that timed out since the last take_warnings()
  };

  std::shared_ptr<Participant> participant_ = Participant::shared();
  std::vector<Topic> topics_;
};

}  // namespace

std::unique_ptr<MessageSender> make_sender() {
  return std::make_unique<Sender>();
}

}  // namespace pcl_bv::dds
