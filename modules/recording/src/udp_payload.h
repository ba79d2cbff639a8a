// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Finds the IPv4 packet in a captured network packet, and the UDP payload in an IPv4 packet.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
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

/// An IPv4 packet with UDP: a whole datagram or a fragment of one.
struct IpPacket {
  const std::byte* data = nullptr;  ///< Bytes after the IP header.
  std::size_t size = 0;             ///< Captured bytes of data, without padding of the link layer.
  std::uint32_t source = 0, destination = 0;
  std::uint16_t identification = 0;  ///< Equal in all fragments of a datagram.
  std::size_t offset = 0;            ///< Position of data in the datagram, in bytes.
  bool more = false;                 ///< Whether further fragments follow.
  bool cut = false;                  ///< Whether the capture has only the first bytes of the packet.

  bool is_fragment() const { return more || offset > 0; }
};

/// Returns the IPv4 packet with UDP in a frame of this link type. Returns nullopt for other protocols and
/// unsupported link types.
std::optional<IpPacket> find_ip_packet(unsigned link, const std::byte* data, std::size_t size);

/// Sets all members of `payload` except the time from a datagram, which begins with the UDP header. Returns
/// false if the datagram is too short.
bool read_datagram(const std::byte* data, std::size_t size, std::uint32_t source, Payload& payload);

}  // namespace pcl_bv::detail
