// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Reads the UDP packets of .pcap and .pcapng captures.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string_view>
#include <vector>

#include "ip_fragments.h"
#include "pcl_bv/io/posix_file.h"
#include "pcl_bv/recording/recording.h"
#include "udp_payload.h"

namespace pcl_bv::detail {

/// Returns whether a file with this beginning is a pcap or pcapng file.
bool is_packet_file(std::string_view start);

/// Reads the UDP packets over IPv4 of a .pcap or .pcapng file. A .pcap file may have any byte order, and its
/// times may be in micro- or nanoseconds. Supported link types are raw IP, BSD's loopback, Linux' "any" (SLL,
/// SLL2) and Ethernet (also with VLAN tags). IP fragments are reassembled (see FragmentBuffer). Packets of
/// other protocols are skipped.
class PacketFile {
 public:
  /// Opens the file. Throws IoError if it is neither pcap nor pcapng.
  explicit PacketFile(const std::filesystem::path& file);

  /// Reads the next payload, which is valid until the next call of next(). Returns false at the end, also if
  /// the file is cut. Damaged parts are skipped with a warning. The time of a payload that came in fragments
  /// is the time of the last of them.
  bool next(Payload& payload);

  /// Returns the warnings about damaged parts and, after the end, about missing fragments.
  const WarningList& warnings() const { return warnings_; }

 private:
  struct Interface {
    unsigned link = 0;
    std::int64_t ticks = 1'000'000;  // per second
  };

  const std::byte* next_bytes(std::size_t bytes);
  bool peek(std::uint64_t at, std::size_t bytes, std::byte* to) const;
  std::uint16_t u16(const std::byte* at) const;
  std::uint32_t u32(const std::byte* at) const;
  bool next_pcap(Payload& payload);
  bool next_block(Payload& payload);
  bool payload_of(unsigned link, const std::byte* data, std::size_t size, Payload& payload);
  bool packet_of_block(const std::byte* block, std::uint32_t length, std::uint32_t type, Payload& payload);
  void add_interface(const std::byte* body, std::size_t size);
  bool begin_section(const std::byte* head);
  bool resynchronise();
  bool begins_packet();
  bool is_run(int packets, std::optional<std::int64_t> seconds) const;
  std::uint64_t end_of_packet(std::uint64_t at, std::optional<std::int64_t>& seconds) const;
  std::uint64_t end_of_block(std::uint64_t at) const;
  std::uint32_t block_length();

  InputFile file_;
  std::vector<std::byte> window_;
  std::uint64_t window_at_ = 0, at_ = 0;
  std::optional<std::uint64_t> previous_;     // position of the packet or block that ends at at_, if known
  std::optional<std::int64_t> last_seconds_;  // time of the last accepted packet
  bool swapped_ = false, blocks_ = false;
  std::vector<Interface> interfaces_;
  FragmentBuffer fragments_;
  bool ended_ = false;
  WarningList warnings_;
};

}  // namespace pcl_bv::detail
