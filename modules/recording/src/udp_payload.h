// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Finds the IP packet in a captured network packet, and the UDP payload in an IP packet.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>

namespace pcl_bv::detail {

/// An address of IPv4 or IPv6. IPv4 addresses are ordered before those of IPv6.
struct IpAddress {
  bool is_v6 = false;
  std::array<std::uint8_t, 16> bytes{};  ///< In network order; an IPv4 address has only the first four.

  friend bool operator==(const IpAddress& a, const IpAddress& b) {
    return a.is_v6 == b.is_v6 && a.bytes == b.bytes;
  }
  friend bool operator<(const IpAddress& a, const IpAddress& b) {
    return a.is_v6 != b.is_v6 ? b.is_v6 : a.bytes < b.bytes;
  }
};

/// The payload of a UDP packet.
struct Payload {
  std::int64_t time_ns = 0;  ///< Capture time, nanoseconds since 1970.
  const std::byte* data = nullptr;
  std::size_t size = 0;
  IpAddress address{};                 ///< Source address.
  std::uint16_t destination_port = 0;  ///< Destination port.

  /// Returns the key of the sender, which is the source address and destination port. The source port is not
  /// used, because a relay may send each packet from another port.
  std::pair<IpAddress, std::uint16_t> key() const { return {address, destination_port}; }
  /// Returns the key as text, such as "192.168.1.201:2368" or "[fe80::1]:2368".
  std::string source() const;
};

/// An IP packet with UDP: a whole datagram or a fragment of one.
struct IpPacket {
  const std::byte* data = nullptr;  ///< Bytes after the IP headers.
  std::size_t size = 0;             ///< Captured bytes of data, without padding of the link layer.
  IpAddress source{}, destination{};
  std::uint32_t identification = 0;  ///< Equal in all fragments of a datagram.
  std::size_t offset = 0;            ///< Position of data in the datagram, in bytes.
  bool more = false;                 ///< Whether further fragments follow.
  bool cut = false;                  ///< Whether the capture has only the first bytes of the packet.

  bool is_fragment() const { return more || offset > 0; }
};

/// Returns the IPv4 or IPv6 packet with UDP in a frame of this link type. Returns nullopt for other protocols
/// and unsupported link types.
std::optional<IpPacket> find_ip_packet(unsigned link, const std::byte* data, std::size_t size);

/// Sets all members of `payload` except the time from a datagram, which begins with the UDP header. Returns
/// false if the datagram is too short.
bool read_datagram(const std::byte* data, std::size_t size, const IpAddress& source, Payload& payload);

}  // namespace pcl_bv::detail
