// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "udp_payload.h"

#include <arpa/inet.h>

#include <algorithm>
#include <cstring>

namespace pcl_bv::detail {
namespace {

// Reads a number in network byte order, which does not depend on the byte order of the capture file.
std::size_t big16(const std::byte* at) {
  return std::to_integer<std::size_t>(at[0]) << 8U | std::to_integer<std::size_t>(at[1]);
}

std::uint32_t big32(const std::byte* at) {
  return static_cast<std::uint32_t>(big16(at) << 16U | big16(at + 2));
}

// Returns the size of the frame's header if an IP packet of at least 20 bytes follows it.
std::optional<std::size_t> link_header(unsigned link, const std::byte* data, std::size_t size) {
  constexpr std::size_t ipv4 = 0x0800, ipv6 = 0x86DD;
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
  } else if (link != 12 && link != 101 && link != 228 && link != 229) {  // not raw IP
    return std::nullopt;
  }
  if (size < skip + 20 || (protocol != ipv4 && protocol != ipv6)) return std::nullopt;
  return skip;
}

IpAddress address_at(const std::byte* at, std::size_t size) {
  IpAddress address;
  address.is_v6 = size == address.bytes.size();
  std::memcpy(address.bytes.data(), at, size);
  return address;
}

constexpr int kUdp = 17;

std::optional<IpPacket> ipv4_packet(const std::byte* ip, std::size_t captured) {
  const std::size_t header = 4 * (std::to_integer<std::size_t>(ip[0]) & 15U);
  if (header < 20 || captured < header || std::to_integer<int>(ip[9]) != kUdp) return std::nullopt;
  IpPacket packet;
  const std::size_t fragment = big16(ip + 6);
  packet.more = (fragment & 0x2000U) != 0;
  packet.offset = 8 * (fragment & 0x1FFFU);
  packet.identification = static_cast<std::uint32_t>(big16(ip + 4));
  packet.source = address_at(ip + 12, 4);
  packet.destination = address_at(ip + 16, 4);
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

// Returns the size of an extension header of this type, or 0 for other types.
std::size_t extension_size(int type, const std::byte* at) {
  const auto length = std::to_integer<std::size_t>(at[1]);
  if (type == 0 || type == 43 || type == 60) return 8 * (length + 1);  // hop by hop, routing, destination
  if (type == 51) return 4 * (length + 2);                             // authentication
  return type == 44 ? 8 : 0;                                           // fragment
}

std::optional<IpPacket> ipv6_packet(const std::byte* ip, std::size_t captured) {
  constexpr std::size_t header = 40, shortest_extension = 8;
  if (captured < header) return std::nullopt;
  IpPacket packet;
  packet.source = address_at(ip + 8, 16);
  packet.destination = address_at(ip + 24, 16);
  int type = std::to_integer<int>(ip[6]);
  std::size_t at = header;
  while (type != kUdp) {
    if (captured < at + shortest_extension) return std::nullopt;
    const std::byte* const extension = ip + at;
    const std::size_t size = extension_size(type, extension);
    if (size == 0 || captured < at + size) return std::nullopt;
    if (type == 44) {
      const std::size_t fragment = big16(extension + 2);
      packet.more = (fragment & 1U) != 0;
      packet.offset = fragment & 0xFFF8U;
      packet.identification = big32(extension + 4);
    }
    type = std::to_integer<int>(extension[0]);
    at += size;
    if (packet.is_fragment() && type != kUdp) return std::nullopt;  // data that begin with another header
  }
  packet.data = ip + at;
  packet.size = captured - at;
  const std::size_t total = header + big16(ip + 4);
  if (packet.is_fragment()) {
    packet.cut = total > captured;
    packet.size = std::min(captured, std::max(total, at)) - at;
  }
  return packet;
}

}  // namespace

std::optional<IpPacket> find_ip_packet(unsigned link, const std::byte* data, std::size_t size) {
  const std::optional<std::size_t> skip = link_header(link, data, size);
  if (!skip) return std::nullopt;
  const std::byte* const ip = data + *skip;
  const unsigned version = std::to_integer<unsigned>(ip[0]) >> 4U;
  if (version == 4) return ipv4_packet(ip, size - *skip);
  return version == 6 ? ipv6_packet(ip, size - *skip) : std::nullopt;
}

bool read_datagram(const std::byte* data, std::size_t size, const IpAddress& source, Payload& payload) {
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
  char text[INET6_ADDRSTRLEN] = "";
  inet_ntop(address.is_v6 ? AF_INET6 : AF_INET, address.bytes.data(), text, sizeof text);
  const std::string name = address.is_v6 ? '[' + std::string(text) + ']' : text;
  return name + ':' + std::to_string(destination_port);
}

}  // namespace pcl_bv::detail
