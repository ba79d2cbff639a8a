// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Fast DDS, the other middleware of ROS 2, publishes clouds and reads what bv_stream makes of them.

#include <fastdds/dds/domain/DomainParticipant.hpp>
#include <fastdds/dds/domain/DomainParticipantFactory.hpp>
#include <fastdds/dds/publisher/DataWriter.hpp>
#include <fastdds/dds/publisher/Publisher.hpp>
#include <fastdds/dds/subscriber/DataReader.hpp>
#include <fastdds/dds/subscriber/SampleInfo.hpp>
#include <fastdds/dds/subscriber/Subscriber.hpp>
#include <fastdds/dds/topic/Topic.hpp>
#include <fastdds/dds/topic/TopicDataType.hpp>
#include <fastdds/rtps/transport/UDPv4TransportDescriptor.h>
#include <fastrtps/utils/IPLocator.h>

#include <cstring>
#include <memory>
#include <set>

#include "dds_test.h"
#include "pcl_bv/messages/results.h"
#include "pcl_bv/messages/serialize.h"

namespace pcl_bv::test {
namespace {

namespace dds = eprosima::fastdds::dds;
namespace rtps = eprosima::fastrtps::rtps;
using Bytes = std::vector<std::byte>;

// Serialized samples with their encapsulation.
class RawType : public dds::TopicDataType {
 public:
  explicit RawType(const char* name) {
    setName(name);
    m_typeSize = 8 << 20;
    m_isGetKeyDefined = false;
  }
  bool serialize(void* data, rtps::SerializedPayload_t* to) override {
    const Bytes& bytes = *static_cast<Bytes*>(data);
    std::memcpy(to->data, bytes.data(), bytes.size());
    to->length = static_cast<std::uint32_t>(bytes.size());
    to->encapsulation = CDR_LE;
    return true;
  }
  bool deserialize(rtps::SerializedPayload_t* from, void* data) override {
    const auto* const bytes = reinterpret_cast<const std::byte*>(from->data);
    static_cast<Bytes*>(data)->assign(bytes, bytes + from->length);
    return true;
  }
  std::function<std::uint32_t()> getSerializedSizeProvider(void* data) override {
    return [data] { return static_cast<std::uint32_t>(static_cast<Bytes*>(data)->size()); };
  }
  void* createData() override { return new Bytes(); }
  void deleteData(void* data) override { delete static_cast<Bytes*>(data); }
  bool getKey(void*, rtps::InstanceHandle_t*, bool) override { return false; }
};

class FastDds {
 public:
  FastDds() {
    dds::DomainParticipantQos qos;
    qos.transport().use_builtin_transports = false;
    const auto udp = std::make_shared<eprosima::fastdds::rtps::UDPv4TransportDescriptor>();
    udp->interfaceWhiteList = {"127.0.0.1"};
    udp->sendBufferSize = udp->receiveBufferSize = 8 << 20;
    qos.transport().user_transports.push_back(udp);
    rtps::Locator_t here;
    rtps::IPLocator::setIPv4(here, "127.0.0.1");
    qos.wire_protocol().builtin.initialPeersList.push_back(here);
    participant_ = dds::DomainParticipantFactory::get_instance()->create_participant(own_domain(), qos);
    EXPECT_NE(participant_, nullptr);
    publisher_ = participant_->create_publisher(dds::PUBLISHER_QOS_DEFAULT);
    subscriber_ = participant_->create_subscriber(dds::SUBSCRIBER_QOS_DEFAULT);
  }
  ~FastDds() {
    participant_->delete_contained_entities();
    dds::DomainParticipantFactory::get_instance()->delete_participant(participant_);
  }

  dds::DataWriter* writer(const char* topic, const char* type) {
    dds::DataWriterQos qos;
    qos.reliability().kind = dds::RELIABLE_RELIABILITY_QOS;
    qos.history().depth = 5;
    qos.endpoint().history_memory_policy = rtps::PREALLOCATED_WITH_REALLOC_MEMORY_MODE;
    // Of messages of megabytes: asynchronous, as Fast DDS wants fragments to be sent.
    qos.publish_mode().kind = dds::ASYNCHRONOUS_PUBLISH_MODE;
    return publisher_->create_datawriter(named(topic, type), qos);
  }
  dds::DataReader* reader(const char* topic, const char* type) {
    dds::DataReaderQos qos;
    qos.reliability().kind = dds::RELIABLE_RELIABILITY_QOS;
    qos.history().depth = 10;
    qos.endpoint().history_memory_policy = rtps::PREALLOCATED_WITH_REALLOC_MEMORY_MODE;
    return subscriber_->create_datareader(named(topic, type), qos);
  }

 private:
  dds::Topic* named(const char* topic, const char* type) {
    participant_->register_type(dds::TypeSupport(new RawType(type)));
    return participant_->create_topic(topic, type, dds::TOPIC_QOS_DEFAULT);
  }

  dds::DomainParticipant* participant_;
  dds::Publisher* publisher_;
  dds::Subscriber* subscriber_;
};

// 130 000 points of 16 bytes: boxes of 1000 points, 2 m apart.
Bytes street(std::uint32_t number) {
  static std::vector<float> xyzi = [] {
    std::vector<float> all;
    for (int box = 0; box < 130; ++box) {
      for (int i = 0; i < 1000; ++i) {
        const int column = box % 13, row = box / 13;
        for (const int tenths : {50 + 20 * column + i % 10, 20 * row + i / 10 % 10, i / 100, 0})
          all.push_back(0.1F * static_cast<float>(tenths));
      }
    }
    return all;
  }();
  msg::PointCloud2 cloud;
  cloud.header.frame_id = "lidar";
  cloud.header.stamp = {static_cast<std::int32_t>(number), 7};
  for (const char* name : {"x", "y", "z", "intensity"})
    cloud.fields.push_back({name, static_cast<std::uint32_t>(4 * cloud.fields.size()), msg::PointField::FLOAT32, 1});
  cloud.point_step = 16;
  cloud.width = 130'000;
  cloud.row_step = 16 * cloud.width;
  cloud.data = {reinterpret_cast<const std::byte*>(xyzi.data()), 4 * xyzi.size()};
  Bytes bytes;
  write_cdr(cloud, bytes);
  return bytes;
}

std::vector<Bytes> take(dds::DataReader* reader) {
  std::vector<Bytes> all;
  dds::SampleInfo info;
  for (Bytes bytes; reader->take_next_sample(&bytes, &info) == ReturnCode_t::RETCODE_OK;)
    if (info.valid_data) all.push_back(bytes);
  return all;
}

class FastDdsPeer : public DdsTest {};

TEST_F(FastDdsPeer, GetsTheObjectsOfItsClouds) {
  BvStream node(at("err"), {"--source", "dds:/points", "--sink", "dds:/bv", "--volume", "aabb", "--ground", "none"});
  FastDds peer;
  dds::DataWriter* const clouds = peer.writer("rt/points", "sensor_msgs::msg::dds_::PointCloud2_");
  dds::DataReader* const markers = peer.reader("rt/bv/markers", "visualization_msgs::msg::dds_::MarkerArray_");
  dds::DataReader* const objects = peer.reader("rt/bv/objects", "vision_msgs::msg::dds_::Detection3DArray_");
  dds::DataReader* const points = peer.reader("rt/bv/points", "sensor_msgs::msg::dds_::PointCloud2_");
  ASSERT_NE(clouds, nullptr);
  ASSERT_NE(markers, nullptr);
  dds::PublicationMatchedStatus matched;
  dds::SubscriptionMatchedStatus heard;
  ASSERT_TRUE(wait_for([&] {
    clouds->get_publication_matched_status(matched);
    markers->get_subscription_matched_status(heard);
    return matched.current_count > 0 && heard.current_count > 0;
  })) << node.errors();

  std::set<std::int32_t> answered, listed, drawn;
  for (std::uint32_t number = 1; number <= 20; ++number) {
    Bytes cloud = street(number);
    auto again = std::chrono::steady_clock::now();
    wait_for([&] {
      if (std::chrono::steady_clock::now() >= again) {  // best effort: one may be lost
        EXPECT_TRUE(clouds->write(&cloud));
        again += std::chrono::seconds(1);
      }
      for (const Bytes& bytes : take(markers)) {
        msg::MarkerArray array;
        read_cdr(bytes.data(), bytes.size(), array);
        EXPECT_EQ(array.markers.size(), 130U);
        drawn.insert(array.markers.front().header.stamp.sec);
      }
      for (const Bytes& bytes : take(objects)) {
        msg::Detection3DArray array;
        read_cdr(bytes.data(), bytes.size(), array);
        EXPECT_EQ(array.detections.size(), 130U);
        EXPECT_EQ(array.header.frame_id, "lidar");
        listed.insert(array.header.stamp.sec);
      }
      for (const Bytes& bytes : take(points)) {
        msg::PointCloud2 labelled;
        read_cdr(bytes.data(), bytes.size(), labelled);
        EXPECT_EQ(labelled.width, 130'000U);
        answered.insert(labelled.header.stamp.sec);
      }
      const auto now = static_cast<std::int32_t>(number);
      return drawn.count(now) > 0 && listed.count(now) > 0 && answered.count(now) > 0;
    });
  }
  EXPECT_EQ(drawn.size(), 20U);
  EXPECT_EQ(listed.size(), 20U);
  EXPECT_EQ(answered.size(), 20U);
  EXPECT_EQ(node.end(SIGINT), 0);
}

}  // namespace
}  // namespace pcl_bv::test
