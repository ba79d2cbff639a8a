// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "udp_payload.h"

#include <algorithm>

namespace pcl_bv::detail {
namespace {

// Reads a number in network byte order, which does not depend on the byte order of the capture file.
std::size_t big16(const std::byte* at) {
  return std::to_integer<std::size_t>(at[0]) << 8U | std::to_integer<std::size_t>(at[1]);
}

std::uint32_t big32(const std::byte* at) {
  return static_cast<std::uint32_t>(big16(at) << 16U | big16(at + 2));
}

// Returns the size of the frame's header if an IPv4 packet of at least 20 bytes follows it.
std::optional<std::size_t> link_header(unsigned link, const std::byte* data, std::size_t size) {
  constexpr std::size_t ipv4 = 0x0800;
  std::size_t skip = 0, protocol = ipv4;
  if (link == 1) {  // Ethernet
    skip = 14;
    for (; size >= skip; skip += 4) {
      protocol = big16(data + skip - 2);
      if (protocol != 0x8100 && protocol != 0x88A8) break;  // no VLAN tag
    }
  } else if (link == 113) {  // Linux SLL
    skip = 16;
    if (size >= skip) protocol = big16(data + 14);
  } else if (link == 276) {  // Linux SLL2
    skip = 20;
    if (size >= skip) protocol = big16(data);
  } else if (link == 0) {  // BSD loopback
    skip = 4;
  } else if (link != 12 && link != 101 && link != 228) {  // not raw IP
    return std::nullopt;
  }
  if (size < skip + 20 || protocol != ipv4) return std::nullopt;
  return skip;
}

}  // namespace

std::optional<IpPacket> find_ip_packet(unsigned link, const std::byte* data, std::size_t size) {
  const std::optional<std::size_t> skip = link_header(link, data, size);
  if (!skip) return std::nullopt;
  const std::byte* const ip = data + *skip;
  const std::size_t captured = size - *skip;
  const std::size_t header = 4 * (std::to_integer<std::size_t>(ip[0]) & 15U);
  if ((std::to_integer<unsigned>(ip[0]) >> 4U) != 4 || header < 20 || captured < header ||
      std::to_integer<int>(ip[9]) != 17)
    return std::nullopt;
  IpPacket packet;
  const std::size_t fragment = big16(ip + 6);
  packet.more = (fragment & 0x2000U) != 0;
  packet.offset = 8 * (fragment & 0x1FFFU);
  packet.identification = static_cast<std::uint16_t>(big16(ip + 4));
  packet.source = big32(ip + 12);
  packet.destination = big32(ip + 16);
  packet.data = ip + header;
  packet.size = captured - header;
  // For a whole datagram, the UDP length tells where the padding begins. The total length may be 0 there,
  // because the network card has not set it yet.
  const std::size_t total = big16(ip + 2);
  if (packet.is_fragment()) {
    packet.cut = total > captured;
    packet.size = std::min(captured, std::max(total, header)) - header;
  }
  return packet;
}

bool read_datagram(const std::byte* data, std::size_t size, std::uint32_t source, Payload& payload) {
  if (size < 8) return false;
  std::size_t udp = big16(data + 4);
  if (udp < 8 || udp > size) udp = size;  // the length is invalid, so take all captured bytes
  payload.data = data + 8;
  payload.size = udp - 8;
  payload.address = source;
  payload.destination_port = static_cast<std::uint16_t>(big16(data + 2));
  return true;
}

std::string Payload::source() const {
  std::string text;
  for (unsigned shift = 32; shift > 0; shift -= 8)
    text += (text.empty() ? "" : ".") + std::to_string(address >> (shift - 8) & 0xFFU);
  return text + ':' + std::to_string(destination_port);
}

}  // namespace pcl_bv::detail
