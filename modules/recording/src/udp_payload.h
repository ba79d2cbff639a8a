// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Finds the UDP payload in a captured network packet.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

namespace pcl_bv::detail {

/// The payload of a UDP packet.
struct Payload {
  std::int64_t time_ns = 0;  ///< Capture time, nanoseconds since 1970.
  const std::byte* data = nullptr;
  std::size_t size = 0;
  std::uint32_t address = 0;           ///< Source address.
  std::uint16_t destination_port = 0;  ///< Destination port.

  /// Returns the key of the sender, which is the source address and destination port. The source port is not
  /// used, because a relay may send each packet from another port.
  std::uint64_t key() const { return std::uint64_t{address} << 16U | destination_port; }
  /// Returns the key as text, such as "192.168.1.201:2368".
  std::string source() const;
};

/// Sets all members except the time from the UDP packet in a frame of this link type. Returns false for IP
/// fragments, other protocols and unsupported link types.
bool unwrap_udp(unsigned link, const std::byte* data, std::size_t size, Payload& payload);

}  // namespace pcl_bv::detail
