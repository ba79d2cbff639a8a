// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

namespace pcl_bv {

/// What a UDP packet carries.
struct Payload {
  std::int64_t time_ns = 0;  ///< When it was captured, nanoseconds since 1970.
  const std::byte* data = nullptr;
  std::size_t size = 0;
  std::uint32_t address = 0;  ///< Of its sender.
  std::uint16_t to_port = 0;

  /// Equal for packets of one source(): a relay may send each packet from another port.
  std::uint64_t key() const { return std::uint64_t{address} << 16U | to_port; }
  std::string source() const;  ///< "192.168.1.201:2368": the port is the one that it is sent to.
};

/// Sets all but the time from the IPv4 packet in a frame of this link type. False for fragments and for other
/// protocols and links.
bool unwrap_udp(unsigned link, const std::byte* data, std::size_t size, Payload& payload);

}  // namespace pcl_bv
