// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "protocol.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "pcl_bv/io/untrusted_text.h"

namespace pcl_bv::live {
using namespace detail;
namespace {

using Json = nlohmann::json;
using testing::ElementsAre;
using testing::Pair;

TEST(LiveProtocol, TakesTheFirstNameThatItKnows) {
  EXPECT_EQ(known_subprotocol("foxglove.websocket.v1"), "foxglove.websocket.v1");
  EXPECT_EQ(known_subprotocol("x, foxglove.sdk.v1 ,foxglove.websocket.v1"), "foxglove.sdk.v1");
  for (const char* other : {"", ",", " , ", "foxglove.sdk.v2", "foxglove.sdk.v1x"})
    EXPECT_EQ(known_subprotocol(other), std::nullopt) << other;
}

TEST(LiveProtocol, ReadsWhatClientsAskFor) {
  const auto subscribe = std::get<Subscribe>(parse_request(
      R"({"op":"subscribe","subscriptions":[{"id":4294967295,"channelId":3},{"id":0,"channelId":0}]})"));
  EXPECT_THAT(subscribe.subscriptions, ElementsAre(Pair(4294967295U, 3U), Pair(0U, 0U)));
  EXPECT_THAT(
      std::get<Unsubscribe>(parse_request(R"({"op":"unsubscribe","subscriptionIds":[7,8]})")).subscriptions,
      ElementsAre(7U, 8U));
  const auto get =
      std::get<GetParameters>(parse_request(R"({"op":"getParameters","parameterNames":["a"],"id":"x"})"));
  EXPECT_THAT(get.names, ElementsAre("a"));
  EXPECT_EQ(get.id, "x");
  const auto set = std::get<SetParameters>(
      parse_request(R"({"op":"setParameters","parameters":[{"name":"a","value":1.5},{"name":"b"}]})"));
  EXPECT_EQ(Json::parse(set.object), Json::parse(R"({"a":1.5,"b":"null"})"));
  EXPECT_TRUE(std::get<WatchParameters>(parse_request(R"({"op":"subscribeParameterUpdates"})")).watch);
  EXPECT_FALSE(std::get<WatchParameters>(parse_request(R"({"op":"unsubscribeParameterUpdates"})")).watch);
}

TEST(LiveProtocol, AnythingElseIsSaidToBeUnknown) {
  const std::string deep(200'000, '[');
  for (const std::string& text :
       {std::string(), std::string("null"), std::string("[]"), std::string("{}"), std::string(R"({"op":1})"),
        std::string(R"({"op":"fly"})"), std::string(R"({"op":"subscribe"})"),
        std::string("{\"op\":\"\xff\"}"),
        std::string(R"({"op":"subscribe","subscriptions":[{"id":"1","channelId":0}]})"),
        std::string(R"({"op":"getParameters","parameterNames":[1]})"),
        std::string(R"({"op":"setParameters","parameters":[{"value":1}]})"),
        std::string(R"({"op":"setParameters","parameters":{"name":"x"}})"), deep})
    EXPECT_TRUE(std::holds_alternative<InvalidRequest>(parse_request(text))) << text.substr(0, 60);
}

TEST(LiveProtocol, ValuesThatAreNestedWithoutEndAreRefused) {
  for (const std::size_t depth : {std::size_t{65}, std::size_t{20'000}, std::size_t{100'000}}) {
    const std::string open =
        R"({"op":"setParameters","parameters":[{"name":"x","value":)" + std::string(depth, '[');
    for (const std::string& text : {open, open + std::string(depth, ']') + "}]}"}) {
      const Request request = parse_request(text);
      ASSERT_TRUE(std::holds_alternative<InvalidRequest>(request));
      EXPECT_THAT(std::get<InvalidRequest>(request).why, testing::HasSubstr("nested more than 64 deep"));
    }
  }
}

TEST(LiveProtocol, ARequestNamesSoManyThingsAndNoMore) {
  const auto list = [](std::size_t count, const std::string& of) {
    std::string all;
    for (std::size_t i = 0; i < count; ++i)
      all += (i == 0 ? "" : ",") + of;
    return '[' + all + ']';
  };
  const auto requests = [&](std::size_t count) {
    return std::vector<std::string>{
        R"({"op":"setParameters","parameters":)" + list(count, R"({"name":"x","value":1})") + "}",
        R"({"op":"getParameters","parameterNames":)" + list(count, "\"x\"") + "}",
        R"({"op":"subscribe","subscriptions":)" + list(count, R"({"id":1,"channelId":0})") + "}",
        R"({"op":"unsubscribe","subscriptionIds":)" + list(count, "1") + "}"};
  };
  for (const std::string& text : requests(kMaxNames))
    EXPECT_FALSE(std::holds_alternative<InvalidRequest>(parse_request(text))) << text.substr(0, 40);
  for (const std::string& text : requests(kMaxNames + 1))
    EXPECT_TRUE(std::holds_alternative<InvalidRequest>(parse_request(text))) << text.substr(0, 40);
  EXPECT_TRUE(std::holds_alternative<InvalidRequest>(
      parse_request(R"({"op":"getParameters","id":")" + std::string(kMaxIdLength + 1, 'x') + "\"}")));
}

TEST(LiveProtocol, AnAnswerIsShortWhateverWasAsked) {
  const std::string answer = status(Level::error, std::string(100'000, 'x'));
  EXPECT_LT(answer.size(), detail::kMaxMessageBytes + 100);
  const Request unknown = parse_request(R"({"op":")" + std::string(10'000, 'x') + "\"}");
  EXPECT_LT(std::get<InvalidRequest>(unknown).why.size(), 100U);
}

TEST(LiveProtocol, AMessagesHeadHasItsNumbersLittleEndian) {
  const MessageHeader head = message_header(0x01020304, 0x1112131415161718);
  EXPECT_THAT(head, ElementsAre(1, 4, 3, 2, 1, 0x18, 0x17, 0x16, 0x15, 0x14, 0x13, 0x12, 0x11));
  EXPECT_EQ(time_message(5), std::string("\2\5\0\0\0\0\0\0\0", 9));
}

TEST(LiveProtocol, AdvertisesChannelsWithTheirDefinitions) {
  const std::vector<MessageTopic> topics{{"/a", "sensor_msgs/msg/PointCloud2"},
                                         {"/b", "pcl_bv.Frame", "json"}};
  const Json channels = Json::parse(advertisement(topics, 0)).at("channels");
  ASSERT_EQ(channels.size(), 2U);
  EXPECT_EQ(channels[0]["schemaEncoding"], "ros2msg");
  EXPECT_THAT(channels[0]["schema"].get<std::string>(), testing::HasSubstr("uint32 point_step"));
  EXPECT_EQ(channels[1]["id"], 1);
  EXPECT_EQ(Json::parse(channels[1]["schema"].get<std::string>())["type"], "object");
  EXPECT_EQ(Json::parse(advertisement(topics, 1)).at("channels").size(), 1U);
}

}  // namespace
}  // namespace pcl_bv::live
