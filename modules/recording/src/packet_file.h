// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "pcl_bv/io/posix_file.h"

namespace pcl_bv {

/// What a UDP packet carries.
struct Payload {
  std::int64_t time_ns = 0;  ///< When it was captured, nanoseconds since 1970.
  const std::byte* data = nullptr;
  std::size_t size = 0;
  std::uint32_t address = 0;  ///< Of its sender.
  std::uint16_t from_port = 0, to_port = 0;

  /// What tells senders apart.
  std::uint64_t key() const {
    return std::uint64_t{address} << 32U | std::uint64_t{from_port} << 16U | to_port;
  }
  std::string source() const;  ///< "192.168.1.201:2368": the port is the one that it is sent to.
};

/// Whether a file begins as pcap or pcapng.
bool is_packet_file(std::string_view start);

/// The UDP packets over IPv4 of a .pcap (either byte order, micro- or nanoseconds) or .pcapng, of links of
/// Ethernet (also with VLAN tags), Linux' "any" (SLL, SLL2), raw IP and BSD's loopback. Fragments of IP and
/// what is no UDP are passed over.
class PacketFile {
 public:
  /// Throws IoError if it is neither.
  explicit PacketFile(const std::filesystem::path& file);

  /// Good until the next call; false at the end, and where the file is cut. What is damaged is passed over.
  bool next(Payload& payload);

  /// What was not whole, a line each.
  const std::vector<std::string>& remarks() const { return remarks_; }

 private:
  struct Interface {
    unsigned link = 0;
    std::int64_t ticks = 1'000'000;  // a second
  };

  const std::byte* need(std::size_t bytes);
  const std::byte* need_at(std::uint64_t at, std::size_t bytes);
  std::uint16_t u16(const std::byte* at) const;
  std::uint32_t u32(const std::byte* at) const;
  bool next_pcap(Payload& payload);
  bool next_block(Payload& payload);
  bool packet_of_block(const std::byte* block, std::uint32_t length, std::uint32_t type, Payload& payload);
  void add_interface(const std::byte* body, std::size_t size);
  bool begin_section(const std::byte* head);
  bool go_on();
  bool begins_packet();
  static bool unwrap(unsigned link, const std::byte* data, std::size_t size, Payload& payload);

  InputFile file_;
  std::vector<std::byte> window_;
  std::uint64_t window_at_ = 0, at_ = 0;
  std::int64_t last_seconds_ = 0;
  bool swapped_ = false, blocks_ = false;
  std::vector<Interface> interfaces_;
  std::vector<std::string> remarks_;
};

}  // namespace pcl_bv
