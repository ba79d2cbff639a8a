// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "access.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace pcl_bv::live {
namespace {

TEST(LiveAccess, ReadsHostsAndPorts) {
  const auto read = [](const char* text) {
    const Address address = parse_address(text);
    return address.host + ' ' + std::to_string(address.port);
  };
  EXPECT_EQ(read("8765"), "127.0.0.1 8765");
  EXPECT_EQ(read("0"), "127.0.0.1 0");
  EXPECT_EQ(read("robot.local:65535"), "robot.local 65535");
  EXPECT_EQ(read("0.0.0.0:80"), "0.0.0.0 80");
  EXPECT_EQ(read("[::1]:8765"), "::1 8765");
  for (const char* bad : {"", ":", "65536", "-1", "8765x", "host:", ":8765", "host", "1:2:", "8765 "})
    EXPECT_THROW(parse_address(bad), std::invalid_argument) << bad;
}

TEST(LiveAccess, KnowsItselfByAddressesAndItsOwnNames) {
  const Address server{"robot.lan", 8765};
  for (const char* ours : {"localhost:8765", "127.0.0.1", "[::1]:8765", "192.168.1.7:8765", "robot.lan:8765"})
    EXPECT_TRUE(is_server_host(ours, server)) << ours;
  for (const char* other :
       {"", "evil.example:8765", "localhost.evil.example", "127.0.0.1.evil.example", "[::1", ":8765"})
    EXPECT_FALSE(is_server_host(other, server)) << other;
}

TEST(LiveAccess, LetsInOurPageThisMachinesAndFoxgloves) {
  for (const char* origin : {"", "http://192.168.1.7:8765", "http://localhost:8080", "http://127.0.0.1:3000",
                             "http://[::1]:1", "file://", "https://app.foxglove.dev"})
    EXPECT_TRUE(may_connect(origin, "192.168.1.7:8765")) << origin;
  for (const char* origin :
       {"null", "http://evil.example", "https://app.foxglove.dev.evil.example",
        "https://evil.example/https://app.foxglove.dev", "http://192.168.1.7:8766",
        "http://localhost.evil.example", "http://127.0.0.1.evil.example", "://localhost@evil"})
    EXPECT_FALSE(may_connect(origin, "192.168.1.7:8765")) << origin;
  using namespace std::string_view_literals;
  EXPECT_FALSE(may_connect("http://127.0.0.1\0.evil.example"sv, "localhost"));
  EXPECT_FALSE(is_server_host("127.0.0.1\0.evil.example"sv, {}));
}

}  // namespace
}  // namespace pcl_bv::live
