// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "server.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <random>
#include <thread>

#include "client.h"
#include "page.h"
#include "pcl_bv/io/raw_cloud.h"
#include "pcl_bv/io/untrusted_text.h"
#include "pcl_bv/nodes/frame_pipeline.h"
#include "pcl_bv/nodes/frame_sink.h"

namespace pcl_bv::test {
using namespace detail;
namespace {

using live::Server;
using live::Viewer;
using testing::HasSubstr;

constexpr const char* kCloud = "sensor_msgs/msg/PointCloud2";

std::vector<std::byte> bytes_of(std::size_t count, unsigned char value) {
  return std::vector<std::byte>(count, std::byte{value});
}

class LiveServer : public testing::Test {
 protected:
  LiveServer() {
    const std::string shows = server_.take_warnings().at(0);  // "viewer page: http://127.0.0.1:41234/"
    port_ = static_cast<std::uint16_t>(std::stoul(shows.substr(shows.rfind(':') + 1)));
    points_ = server_.add_topic({"/bv/points", kCloud});
    frames_ = server_.add_topic({"/bv/frames", "pcl_bv.Frame", "json"});
  }

  static void subscribe(Client& client, std::initializer_list<std::size_t> channels) {
    Json all = Json::array();
    for (const std::size_t channel : channels)
      all.push_back({{"id", 100 + channel}, {"channelId", channel}});
    client.say({{"op", "subscribe"}, {"subscriptions", all}});
  }

  template <class Condition>
  static bool wait_for(const Condition& condition) {
    for (int i = 0; i < 2000; ++i) {
      if (condition()) return true;
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    return false;
  }

  void send(std::size_t channel, int number, std::size_t size = 100) {
    server_.send(channel, number, bytes_of(size, static_cast<unsigned char>(number)));
  }

  Server server_{"0"};
  std::uint16_t port_ = 0;
  std::size_t points_ = 0, frames_ = 0;
};

TEST_F(LiveServer, EveryMessageReachesAReaderUnderBothNames) {
  for (const char* name : {"foxglove.sdk.v1", "foxglove.websocket.v1"}) {
    Client client(port_);
    client.open(name);
    EXPECT_EQ(client.response()[http::field::sec_websocket_protocol], name);
    EXPECT_THAT(client.await("serverInfo")["capabilities"], testing::Contains("parameters"));
    EXPECT_EQ(client.await("advertise")["channels"].size(), 2U);
    subscribe(client, {points_, frames_});
    ASSERT_TRUE(
        wait_for([&] { return server_.has_subscribers(points_) && server_.has_subscribers(frames_); }));
    for (int i = 0; i < 100; ++i) {
      send(points_, i, 300'000);
      send(frames_, i);
    }
    std::int64_t last_time = -1;
    for (int i = 0; i < 200;) {
      const Received received = client.next();
      if (received.opcode() == 2) last_time = static_cast<std::int64_t>(received.number(1, 8));
      if (received.opcode() != 1) continue;
      EXPECT_EQ(received.number(1, 4), 100 + (i % 2 == 0 ? points_ : frames_));
      EXPECT_EQ(received.number(5, 8), i / 2);
      EXPECT_EQ(last_time, i / 2);
      ASSERT_EQ(received.bytes.size(), i % 2 == 0 ? 300'013U : 113U);
      EXPECT_EQ(received.bytes.back(), static_cast<char>(i / 2));
      ++i;
    }
  }
  EXPECT_TRUE(wait_for([&] { return !server_.has_subscribers(points_); }));
}

TEST_F(LiveServer, WhatNobodyReadsIsNotWanted) {
  EXPECT_FALSE(server_.has_subscribers(points_));
  Client client(port_);
  client.open();
  subscribe(client, {points_});
  EXPECT_TRUE(wait_for([&] { return server_.has_subscribers(points_); }));
  EXPECT_FALSE(server_.has_subscribers(frames_));
  client.say({{"op", "unsubscribe"}, {"subscriptionIds", {100 + points_}}});
  EXPECT_TRUE(wait_for([&] { return !server_.has_subscribers(points_); }));
  subscribe(client, {frames_, frames_, 77});
  EXPECT_THAT(client.await("status")["message"].get<std::string>(), HasSubstr("subscribed already"));
  EXPECT_THAT(client.await("status")["message"].get<std::string>(), HasSubstr("no channel 77"));
  client.say({{"op", "unsubscribe"}, {"subscriptionIds", {5}}});
  EXPECT_THAT(client.await("status")["message"].get<std::string>(), HasSubstr("no subscription 5"));
}

TEST_F(LiveServer, AReaderThatHangsCostsOthersNothingAndMemoryOnlyItsShare) {
  Client hangs(port_), reads(port_);
  hangs.open();
  reads.open();
  subscribe(hangs, {points_});
  subscribe(reads, {frames_});
  ASSERT_TRUE(wait_for([&] { return server_.has_subscribers(points_) && server_.has_subscribers(frames_); }));
  const auto resident = [] {
    std::ifstream status("/proc/self/statm");
    std::size_t all = 0, pages = 0;
    status >> all >> pages;
    return pages * 4096;
  };
  const std::size_t before = resident();
  constexpr int count = 300;  // of 2 MB: 600 MB
  for (int i = 0; i < count; ++i) {
    send(points_, i, 2'000'000);
    send(frames_, i);
    EXPECT_EQ(reads.await_message().number(5, 8), i);
  }
#if defined(__SANITIZE_ADDRESS__)
  constexpr std::size_t quarantine = std::size_t{256} << 20;  // what AddressSanitizer keeps of what is freed
#else
  constexpr std::size_t quarantine = 0;
#endif
  EXPECT_LT(resident(), before + 3 * Viewer::kMaxQueuedBytes + quarantine);
  EXPECT_FALSE(server_.has_subscribers(points_));
  // Once it reads again, it gets what is new, and is told what it has not got.
  std::uint64_t last = 0;
  int got = 0;
  std::string told;
  while (told.empty()) {
    const Received received = hangs.next();
    if (received.op() == "status") told = received.json()["message"].get<std::string>();
    if (received.opcode() != 1) continue;
    EXPECT_GE(received.number(5, 8), last);
    last = received.number(5, 8);
    ++got;
  }
  ASSERT_TRUE(wait_for([&] { return server_.has_subscribers(points_); }));
  send(points_, count);
  while (hangs.await_message().number(5, 8) != count)
    ;
  EXPECT_LT(got, count);
  EXPECT_THAT(told, HasSubstr("messages were dropped: this client reads too slowly"));
}

TEST_F(LiveServer, SettingsAreReadWatchedAndChanged) {
  FramePipeline pipeline;
  server_.offer_settings(remote_settings(pipeline));
  Client changes(port_), watches(port_);
  changes.open();
  watches.open();
  watches.say({{"op", "subscribeParameterUpdates"}, {"parameterNames", {"cluster.tolerance"}}});
  watches.say({{"op", "getParameters"}, {"parameterNames", {"cluster.tolerance"}}, {"id", "now"}});
  EXPECT_EQ(watches.await("parameterValues")["parameters"],
            Json::parse(R"([{"name":"cluster.tolerance","type":"float64","value":0.5}])"));
  const auto set = [&](const Json& value, const char* id) {
    changes.say({{"op", "setParameters"},
                 {"parameters", {{{"name", "cluster.tolerance"}, {"value", value}}}},
                 {"id", id}});
  };
  set(0.75, "a");
  const Json answer = changes.await("parameterValues");
  EXPECT_EQ(answer["id"], "a");
  EXPECT_EQ(answer["parameters"][0]["value"], 0.75);
  EXPECT_EQ(pipeline.config().cluster.tolerance, 0.75);
  const Json update = watches.await("parameterValues");
  const auto tolerance = std::find_if(update["parameters"].begin(), update["parameters"].end(),
                                      [](const Json& p) { return p["name"] == "cluster.tolerance"; });
  ASSERT_NE(tolerance, update["parameters"].end());
  EXPECT_EQ((*tolerance)["value"], 0.75);
  set(-1, "b");
  EXPECT_THAT(changes.await("status")["message"].get<std::string>(),
              HasSubstr("cluster.tolerance: -1 is not"));
  EXPECT_EQ(changes.await("parameterValues")["parameters"][0]["value"], 0.75);
}

TEST_F(LiveServer, ServesThePageAndTheDescriptionOfSettings) {
  const auto page = Client(port_).get("/");
  EXPECT_EQ(page.result(), http::status::ok);
  EXPECT_EQ(page.body(), live_page());
  EXPECT_LT(page.body().size(), 100'000U);
  EXPECT_EQ(Client(port_).get("/settings").body(), "[]");
  FramePipeline pipeline;
  server_.offer_settings(remote_settings(pipeline));
  EXPECT_GT(Json::parse(Client(port_).get("/settings").body()).size(), 20U);
  const auto head = Client(port_).get("/", "localhost", "", http::verb::head);
  EXPECT_EQ(head[http::field::content_length], std::to_string(live_page().size()));
  EXPECT_EQ(Client(port_).get("/../etc/passwd").result(), http::status::not_found);
  EXPECT_EQ(Client(port_).get("/", "localhost", "", http::verb::post).result(),
            http::status::method_not_allowed);
}

TEST_F(LiveServer, RefusesPagesOfOthersAndSaysSo) {
  EXPECT_EQ(Client(port_).get("/settings", "evil.example").result(), http::status::forbidden);
  Client client(port_);
  EXPECT_THROW(client.open("foxglove.sdk.v1", "localhost", "http://evil.example"),
               boost::system::system_error);
  EXPECT_EQ(client.response().result(), http::status::forbidden);
  EXPECT_THAT(server_.take_warnings(),
              testing::ElementsAre(HasSubstr("'evil.example'"), HasSubstr("'http://evil.example'")));
  Client without(port_);
  EXPECT_THROW(without.open("chat"), boost::system::system_error);
  EXPECT_EQ(without.response().result(), http::status::bad_request);
}

TEST_F(LiveServer, MoreViewersThanItTakesAreRefused) {
  std::vector<std::unique_ptr<Client>> all;
  for (std::size_t i = 0; i < Viewer::kMaxViewers; ++i) {
    all.push_back(std::make_unique<Client>(port_));
    all.back()->open();
    all.back()->await("advertise");
  }
  Client late(port_);
  EXPECT_THROW(late.open(), boost::system::system_error);
  EXPECT_EQ(late.response().result(), http::status::service_unavailable);
  all.pop_back();
  EXPECT_TRUE(wait_for([&] {
    try {
      Client next(port_);
      next.open();
      return true;
    } catch (const boost::system::system_error&) {
      return false;
    }
  }));
}

TEST_F(LiveServer, HostileClientsAreCutOffAndOthersGoOn) {
  Client good(port_);
  good.open();
  subscribe(good, {frames_});
  ASSERT_TRUE(wait_for([&] { return server_.has_subscribers(frames_); }));
  std::mt19937 random(7);
  int number = 0;
  const auto others_go_on = [&] {
    send(frames_, ++number);
    return good.await_message().number(5, 8) == static_cast<std::uint64_t>(number);
  };
  for (int i = 0; i < 400; ++i) {  // instead of HTTP, and instead of frames of a WebSocket
    std::string bytes(random() % 3000 + 2, '\0');
    for (char& byte : bytes)
      byte = static_cast<char>(random());
    try {
      Client bad(port_);
      if (i >= 200) bad.open();  // refused while the server still thinks that too many are there
      bad.send_raw(bytes);
    } catch (const boost::system::system_error&) {
    }
    EXPECT_TRUE(i % 100 != 99 || others_go_on());
  }
  Client long_header(port_);
  try {
    long_header.send_raw("GET / HTTP/1.1\r\nHost: localhost\r\nX: " + std::string(100'000, 'x'));
  } catch (const boost::system::system_error&) {  // it may be cut off before it has said all
  }
  EXPECT_TRUE(long_header.is_closed());
  Client long_request(port_);
  long_request.open();
  try {
    long_request.send(std::string(Viewer::kMaxRequestBytes + 1, ' '), true);
  } catch (const boost::system::system_error&) {
  }
  EXPECT_TRUE(long_request.is_closed());
  Client chatty(port_);
  chatty.open();
  try {
    for (std::size_t i = 0; i <= 10 * Viewer::kMaxRequestsPerSecond; ++i)
      chatty.send("{}", true);
  } catch (const boost::system::system_error&) {
  }
  EXPECT_TRUE(chatty.is_closed());
  Client publishes(port_);
  publishes.open();
  publishes.send("\1\1\1\1\1", false);
  EXPECT_THAT(publishes.await("status")["message"].get<std::string>(), HasSubstr("cannot publish"));
  publishes.send("[1]", true);
  EXPECT_THAT(publishes.await("status")["message"].get<std::string>(), HasSubstr("must be a JSON object"));
  publishes.send("{\"op\":\"\xff\"}", true);
  EXPECT_TRUE(publishes.is_closed());
  EXPECT_TRUE(others_go_on());
}

TEST_F(LiveServer, NoRequestEndsItOrKeepsOthersWaiting) {
  FramePipeline pipeline;
  server_.offer_settings(remote_settings(pipeline));
  Client good(port_);
  good.open();
  subscribe(good, {frames_});
  ASSERT_TRUE(wait_for([&] { return server_.has_subscribers(frames_); }));
  int number = 0;
  const auto others_go_on = [&] {
    send(frames_, ++number);
    return good.await_message().number(5, 8) == static_cast<std::uint64_t>(number);
  };
  const auto deep = [](std::size_t depth) {
    return R"({"op":"setParameters","parameters":[{"name":"x","value":)" + std::string(depth, '[') +
           std::string(depth, ']') + "}]}";
  };
  std::string many = R"({"op":"setParameters","parameters":[)";
  for (int i = 0; i < 60'000; ++i)
    many += (i == 0 ? "" : ",") + std::string(R"({"name":"n)") + std::to_string(i) + R"("})";
  many += "]}";
  for (const std::string& text : {deep(100'000), many, R"({"op":")" + std::string(100'000, '[') + "\"}"}) {
    Client bad(port_);  // more bytes than a request may have
    bad.open();
    try {
      bad.send(text, true);
    } catch (const boost::system::system_error&) {
    }
    EXPECT_TRUE(bad.is_closed());
    EXPECT_TRUE(others_go_on());
  }
  Client bad(port_);  // as long as it may be
  bad.open();
  for (const std::string& text : {deep(30'000), many.substr(0, many.find(R"({"name":"n2000")") - 1) + "]}"}) {
    ASSERT_LT(text.size(), Viewer::kMaxRequestBytes);
    bad.send(text, true);
    EXPECT_THAT(bad.await("status")["message"].get<std::string>(),
                testing::AnyOf(HasSubstr("nested more than 64 deep"), HasSubstr("may name at most 100")));
    EXPECT_TRUE(others_go_on());
  }
  bad.say({{"op", "setParameters"}, {"parameters", {{{"name", std::string(60'000, 'x')}, {"value", 1}}}}});
  EXPECT_LE(bad.await("status")["message"].get<std::string>().size(), detail::kMaxMessageBytes);
  EXPECT_TRUE(others_go_on());
}

TEST_F(LiveServer, SettingsChangeSoOftenASecondAndNoOftener) {
  FramePipeline pipeline;
  server_.offer_settings(remote_settings(pipeline));
  Client client(port_);
  client.open();
  const std::size_t requests = 2 * live::Hub::kMaxChangesPerSecond;
  for (std::size_t i = 0; i < requests; ++i)
    client.say(
        {{"op", "setParameters"},
         {"parameters", {{{"name", "cluster.tolerance"}, {"value", 0.5 + 0.001 * static_cast<double>(i)}}}},
         {"id", "x"}});
  std::size_t done = 0, refused = 0;
  while (done + refused < requests) {
    const std::string op = client.next().op();
    done += op == "parameterValues";
    refused += op == "status";
  }
  EXPECT_GE(done, live::Hub::kMaxChangesPerSecond);
  EXPECT_GT(refused, 0U);
}

TEST_F(LiveServer, AClientThatSaysTooManyBytesASecondIsCutOff) {
  Client client(port_);
  client.open();
  try {
    for (std::size_t bytes = 0; bytes <= 4 * Viewer::kMaxRequestBytesPerSecond;
         bytes += Viewer::kMaxRequestBytes)
      client.send(std::string(Viewer::kMaxRequestBytes, ' '), true);
  } catch (const boost::system::system_error&) {
  }
  EXPECT_TRUE(client.is_closed());
}

TEST_F(LiveServer, SaysWhatIsLostOnceASecondAtMost) {
  Client client(port_);
  client.open();
  client.await("advertise");
  for (int i = 0; i < 1000; ++i)
    server_.notify("frame " + std::to_string(i) + " is lost");
  EXPECT_EQ(client.await("status")["message"], "frame 0 is lost");
  std::this_thread::sleep_for(std::chrono::milliseconds(1100));
  server_.notify("frame 1000 is lost");
  EXPECT_EQ(client.await("status")["message"], "frame 1000 is lost; 999 more before");
}

TEST_F(LiveServer, TheEndComesAfterTheLastMessage) {
  Client client(port_);
  client.open();
  subscribe(client, {points_});
  ASSERT_TRUE(wait_for([&] { return server_.has_subscribers(points_); }));
  for (int i = 0; i < 10; ++i)
    send(points_, i, 1'000'000);
  std::thread ends([&] { server_.close(); });
  for (int i = 0; i < 10; ++i)
    EXPECT_EQ(client.await_message().number(5, 8), i);
  EXPECT_TRUE(client.is_closed());
  ends.join();
}

TEST(LiveServers, APortThatIsTakenIsAnError) {
  Server first("0");
  const std::string shows = first.take_warnings().at(0);
  const std::string port = shows.substr(shows.rfind(':') + 1);
  EXPECT_THROW(Server(port.substr(0, port.find('/'))), IoError);
  EXPECT_THROW(Server("no.such.host.invalid:1"), IoError);
  EXPECT_THROW(Server("eight"), std::invalid_argument);
}

}  // namespace
}  // namespace pcl_bv::test
