// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "udp_payload.h"

namespace pcl_bv::detail {
namespace {

// Reads a number in network byte order, which does not depend on the byte order of the capture file.
std::size_t big16(const std::byte* at) {
  return std::to_integer<std::size_t>(at[0]) << 8U | std::to_integer<std::size_t>(at[1]);
}

}  // namespace

bool unwrap_udp(unsigned link, const std::byte* data, std::size_t size, Payload& payload) {
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
    return false;
  }
  if (size < skip + 20 || protocol != ipv4) return false;
  const std::byte* const ip = data + skip;
  const std::size_t header = 4 * (std::to_integer<std::size_t>(ip[0]) & 15U);
  const bool whole = (big16(ip + 6) & 0x3FFFU) == 0;  // neither more fragments nor an offset
  if ((std::to_integer<unsigned>(ip[0]) >> 4U) != 4 || header < 20 || !whole ||
      std::to_integer<int>(ip[9]) != 17 || size < skip + header + 8)
    return false;
  const std::size_t available = size - skip - header;
  std::size_t udp = big16(ip + header + 4);
  if (udp < 8 || udp > available) udp = available;  // the length is invalid, so take all captured bytes
  payload.data = ip + header + 8;
  payload.size = udp - 8;
  payload.address = static_cast<std::uint32_t>(big16(ip + 12) << 16U | big16(ip + 14));
  payload.destination_port = static_cast<std::uint16_t>(big16(ip + header + 2));
  return true;
}

std::string Payload::source() const {
  std::string text;
  for (unsigned shift = 32; shift > 0; shift -= 8)
    text += (text.empty() ? "" : ".") + std::to_string(address >> (shift - 8) & 0xFFU);
  return text + ':' + std::to_string(destination_port);
}

}  // namespace pcl_bv::detail
