// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "made_packets.h"
#include "packet_file.h"
#include "recording_files.h"

namespace pcl_bv::detail {
namespace {

std::string payload_of(std::size_t size, unsigned seed) {
  std::mt19937 random(seed);
  std::string payload(size, '\0');
  for (char& byte : payload)
    byte = static_cast<char>(random());
  return payload;
}

class Fragments : public RecordingFiles {
 protected:
  std::vector<std::string> payloads_of(const std::string& file) {
    put("a.pcap", file);
    PacketFile packets(at("a.pcap"));
    std::vector<std::string> payloads;
    for (Payload packet; packets.next(packet);)
      payloads.emplace_back(reinterpret_cast<const char*>(packet.data), packet.size);
    warnings_ = packets.warnings().lines();
    return payloads;
  }
  std::vector<std::string> payloads_of_ip(const std::vector<std::string>& ip) {
    return payloads_of(pcap_of_ip(ip));
  }
  std::vector<std::string> warnings_;
};

TEST_F(Fragments, InAnyOrderAndRepeatedGiveTheDatagramOnce) {
  constexpr unsigned seed = 7;
  std::mt19937 random(seed);
  for (const std::size_t size : {1473U, 3000U, 24'896U, 33'024U, 65'507U}) {
    SCOPED_TRACE(testing::Message() << "size " << size << ", seed " << seed);
    const std::string payload = payload_of(size, seed);
    std::vector<std::string> all = fragments_of(udp(payload), 5);
    EXPECT_GT(all.size(), 1U);
    EXPECT_EQ(payloads_of_ip(all), std::vector{payload});
    std::reverse(all.begin(), all.end());
    EXPECT_EQ(payloads_of_ip(all), std::vector{payload});
    const std::vector<std::string> again = all;
    all.insert(all.end(), again.begin(), again.end());
    for (int i = 0; i < 5; ++i) {
      std::shuffle(all.begin(), all.end(), random);
      EXPECT_EQ(payloads_of_ip(all), std::vector{payload});
      EXPECT_THAT(warnings_, testing::IsEmpty());
    }
  }
}

TEST_F(Fragments, OfIpv6GiveTheDatagramOnceInAnyOrder) {
  constexpr unsigned seed = 8;
  std::mt19937 random(seed);
  for (const std::size_t size : {1'473U, 24'896U, 65'527U}) {
    SCOPED_TRACE(testing::Message() << "size " << size << ", seed " << seed);
    const std::string payload = payload_of(size, seed);
    const std::string ip = udp_over_ipv6(payload);
    std::vector<std::string> all = ipv6_fragments_of(ip, 0xABCD0005);
    // An incomplete datagram whose identification has the same lower 16 bits.
    for (const std::string& fragment : ipv6_fragments_of(udp_over_ipv6(payload_of(size, 1)), 5))
      all.push_back(fragment);
    all.pop_back();
    for (int i = 0; i < 5; ++i) {
      std::shuffle(all.begin(), all.end(), random);
      EXPECT_EQ(payloads_of_ip(all), std::vector{payload});
      EXPECT_THAT(warnings_, testing::ElementsAre("fragments are missing of 1 UDP datagrams"));
    }
  }
}

TEST_F(Fragments, WholeDatagramsOfIpv6AreReadOnEveryLink) {
  const std::string payload = payload_of(900, 3);
  const std::string options = std::string("\x2B\x00\x01\x04", 4) + std::string(4, '\0') +
                              std::string("\x2C\x01", 2) + std::string(14, '\0') +
                              std::string("\x11\x00\x00\x00\x00\x00\x00\x09", 8);
  for (const unsigned link : {1U, 10'001U, 113U, 276U, 0U, 12U, 101U, 229U}) {
    SCOPED_TRACE(link);
    EXPECT_EQ(payloads_of(pcap_of_ip({udp_over_ipv6(payload)}, link)), std::vector{payload});
    const std::string extended = udp_over_ipv6(payload, options, 0);
    EXPECT_EQ(payloads_of(pcap_of_ip({extended}, link)), std::vector{payload});
    EXPECT_THAT(payloads_of(pcap_of_ip({udp_over_ipv6(payload, "", 58)}, link)), testing::IsEmpty());
    for (std::size_t size = 0; size < 48 + options.size(); ++size)
      EXPECT_THAT(payloads_of(pcap_of_ip({extended.substr(0, size), extended}, link)).size(), testing::Eq(1U))
          << size;
  }
}

TEST_F(Fragments, TheSenderOfIpv6IsNamedInBrackets) {
  put("a.pcap", pcap_of_ip({udp_over_ipv6("abc"), udp("def")}));
  PacketFile packets(at("a.pcap"));
  Payload packet;
  ASSERT_TRUE(packets.next(packet));
  EXPECT_EQ(packet.source(), "[fe80::7]:2368");
  const auto key = packet.key();
  ASSERT_TRUE(packets.next(packet));
  EXPECT_EQ(packet.source(), "0.0.0.0:2368");
  EXPECT_LT(packet.key(), key);
}

TEST_F(Fragments, OfInterleavedDatagramsGoToTheirOwn) {
  std::vector<std::vector<std::string>> datagrams;
  std::vector<std::string> expected, interleaved;
  for (unsigned i = 0; i < 32; ++i) {
    expected.push_back(payload_of(5000, i));
    datagrams.push_back(fragments_of(udp(expected.back()), 100 + i % 16));
    for (std::string& fragment : datagrams.back())
      fragment[15] = static_cast<char>(i / 16);  // the sender's address
  }
  for (std::size_t part = 0; part < datagrams[0].size(); ++part) {
    for (const auto& datagram : datagrams)
      interleaved.push_back(datagram[part]);
  }
  EXPECT_EQ(payloads_of_ip(interleaved), expected);
}

TEST_F(Fragments, ThatAreMissingCostTheirDatagramAndAreCounted) {
  std::vector<std::string> ip, expected;
  for (unsigned i = 0; i < 100; ++i) {
    const std::string payload = payload_of(5000, i);
    std::vector<std::string> fragments = fragments_of(udp(payload), i);
    if (i % 3 == 0) {
      fragments.erase(fragments.begin() + i % 4);
    } else {
      expected.push_back(payload);
    }
    ip.insert(ip.end(), fragments.begin(), fragments.end());
  }
  EXPECT_EQ(payloads_of_ip(ip), expected);
  EXPECT_THAT(warnings_, testing::ElementsAre("fragments are missing of 34 UDP datagrams"));
}

// A sender that gives each datagram the same identification.
TEST_F(Fragments, OfAReusedIdentificationAreNotMixed) {
  const std::string first = payload_of(5000, 1), second = payload_of(5000, 2), third = payload_of(2000, 3);
  std::vector<std::string> ip = fragments_of(udp(first), 0);
  ip.pop_back();
  for (const std::string& payload : {second, third}) {
    const std::vector<std::string> fragments = fragments_of(udp(payload), 0);
    ip.insert(ip.end(), fragments.begin(), fragments.end());
  }
  EXPECT_EQ(payloads_of_ip(ip), (std::vector{second, third}));
  EXPECT_THAT(warnings_, testing::ElementsAre("fragments are missing of 1 UDP datagrams"));
}

// After 1 s the identification may have been used again.
TEST_F(Fragments, ThatAreOldAreGivenUp) {
  const std::string payload = payload_of(2000, 1);
  const std::vector<std::string> fragments = fragments_of(udp(payload), 9);
  ASSERT_EQ(fragments.size(), 2U);
  for (const unsigned seconds : {1U, 2U}) {
    std::string file = pcap_of_ip(fragments);
    const std::size_t second = 24 + 16 + 14 + fragments[0].size();
    file.replace(second, 4, pcl_bv::bytes_of(100 + seconds, 4));
    file.replace(second + 4, 4, pcl_bv::bytes_of(0, 4));
    EXPECT_EQ(payloads_of(file).size(), seconds == 1 ? 1U : 0U);
  }
}

TEST_F(Fragments, AreReadWithoutPaddingAndChecksumOfTheLink) {
  const std::string payload = payload_of(1480 - 8 + 5, 1);  // 5 bytes in the last fragment
  const std::vector<std::string> fragments = fragments_of(udp(payload), 9);
  EXPECT_EQ(payloads_of_ip({fragments[0], fragments[1] + std::string(21, '\0')}), std::vector{payload});
  EXPECT_EQ(payloads_of_ip({fragments[0] + "FCS.", fragments[1] + "FCS."}), std::vector{payload});
}

TEST_F(Fragments, ThatOverlapWithOtherContentOrExceedADatagramGiveNothing) {
  const std::string payload = payload_of(3000, 1);
  const std::vector<std::string> good = fragments_of(udp(payload), 9, 1000);
  std::string shifted = good[1];
  shifted[7] = static_cast<char>(shifted[7] - 1);  // begins 8 bytes earlier
  EXPECT_THAT(payloads_of_ip({good[0], shifted, good[2], good[3]}), testing::IsEmpty());
  std::string beyond = good[3];
  beyond[6] = '\x1F';
  beyond[7] = '\xFF';
  EXPECT_THAT(payloads_of_ip({good[0], good[1], good[2], beyond}), testing::IsEmpty());
  std::string odd = good[1];  // shorter than the next fragment's offset tells
  odd.pop_back();
  odd.replace(2, 2, pcl_bv::bytes_of(odd.size(), 2, true));
  EXPECT_THAT(payloads_of_ip({good[0], odd, good[2], good[3]}), testing::IsEmpty());
  EXPECT_THAT(payloads_of_ip(fragments_of(udp(payload_of(65'600, 1)), 9)), testing::IsEmpty());
  for (const std::size_t number : {1U, 3U}) {
    std::vector<std::string> cut = good;  // by the capture's limit of bytes
    cut[number].pop_back();
    EXPECT_THAT(payloads_of_ip(cut), testing::IsEmpty());
  }
}

TEST_F(Fragments, AreReadFromCapturesCutAtAnyByte) {
  const std::vector<std::string> fragments = fragments_of(udp(payload_of(300, 1)), 9, 64);
  const std::string whole = pcap_of_ip(fragments);
  for (std::size_t size = 24; size <= whole.size(); ++size)
    EXPECT_EQ(payloads_of(whole.substr(0, size)).size(), size == whole.size() ? 1U : 0U) << size;
}

}  // namespace
}  // namespace pcl_bv::detail
