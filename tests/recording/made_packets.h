// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Captures as a Velodyne would give.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace pcl_bv {

inline std::string bytes_of(std::uint64_t value, std::size_t size, bool big = false) {
  std::string text;
  for (std::size_t i = 0; i < size; ++i) {
    const std::size_t byte = big ? size - 1 - i : i;
    text += static_cast<char>(byte < 8 ? value >> (8 * byte) & 0xFFU : 0);
  }
  return text;
}

// Blocks a `step` of hundredths of a degree apart from `azimuth` on; laser i returns at 1000 + i steps, or at
// `second` more in every other block of a dual one.
inline std::string packet(unsigned azimuth, unsigned step, std::uint8_t mode, std::uint8_t factory,
                          unsigned second = 0) {
  std::string payload;
  for (unsigned block = 0; block < 12; ++block) {
    const bool dual = mode == 0x39;
    payload += bytes_of(0xEEFF, 2) + bytes_of((azimuth + step * (dual ? block / 2 : block)) % 36'000, 2);
    for (unsigned laser = 0; laser < 32; ++laser)
      payload += bytes_of(1000 + laser + (dual && block % 2 == 1 ? second : 0), 2) + bytes_of(laser, 1);
  }
  return payload + bytes_of(0, 4) + bytes_of(mode, 1) + bytes_of(factory, 1);
}

inline std::string udp(const std::string& payload) {
  const std::string head = bytes_of(2368, 2, true) + bytes_of(2368, 2, true) +
                           bytes_of(payload.size() + 8, 2, true) + bytes_of(0, 2);
  const std::size_t all = 20 + head.size() + payload.size();
  return bytes_of(0x45, 1) + bytes_of(0, 1) + bytes_of(all, 2, true) + bytes_of(0, 2) + bytes_of(0, 2) +
         bytes_of(64, 1) + bytes_of(17, 1) + bytes_of(0, 10) + head + payload;
}

// The same over IPv6, with `extensions` before the UDP header, of which the first has the type `first`.
inline std::string udp_over_ipv6(const std::string& payload, const std::string& extensions = "",
                                 unsigned first = 17) {
  const std::string datagram = udp(payload).substr(20);
  return bytes_of(0x60000000, 4, true) + bytes_of(extensions.size() + datagram.size(), 2, true) +
         bytes_of(first, 1) + bytes_of(64, 1) + bytes_of(0xFE80, 2, true) + std::string(13, '\0') + '\x07' +
         bytes_of(0xFF02, 2, true) + std::string(13, '\0') + '\x01' + extensions + datagram;
}

// The fragments of a packet that udp_over_ipv6() returns without extensions.
inline std::vector<std::string> ipv6_fragments_of(const std::string& ip, unsigned identification,
                                                  std::size_t size = 1448) {
  std::vector<std::string> fragments;
  const std::string data = ip.substr(40);
  for (std::size_t at = 0; at < data.size(); at += size) {
    const std::string part = data.substr(at, size);
    const std::size_t more = at + size < data.size() ? 1 : 0;
    fragments.push_back(ip.substr(0, 4) + bytes_of(8 + part.size(), 2, true) + bytes_of(44, 1) +
                        ip.substr(7, 33) + bytes_of(17, 1) + bytes_of(0, 1) + bytes_of(at | more, 2, true) +
                        bytes_of(identification, 4, true) + part);
  }
  return fragments;
}

// How packets are wrapped: by the number of the link.
inline std::string linked(unsigned link, const std::string& ip) {
  const unsigned type = (ip[0] & 0x60) == 0x60 ? 0x86DD : 0x0800;
  if (link == 1) return std::string(12, 'm') + bytes_of(type, 2, true) + ip;
  if (link == 10'001)
    return std::string(12, 'm') + bytes_of(0x81000001, 4, true) + bytes_of(type, 2, true) + ip;
  if (link == 113) return std::string(14, 'm') + bytes_of(type, 2, true) + ip;
  if (link == 276) return bytes_of(type, 2, true) + std::string(18, 'm') + ip;
  if (link == 0) return bytes_of(2, 4) + ip;
  return ip;
}

// A capture of these IP packets.
inline std::string pcap_of_ip(const std::vector<std::string>& ip_packets, unsigned link = 1, bool big = false,
                              bool nano = false) {
  std::string file = bytes_of(nano ? 0xA1B23C4D : 0xA1B2C3D4, 4, big) + bytes_of(2, 2, big) +
                     bytes_of(4, 2, big) + bytes_of(0, 8) + bytes_of(65'535, 4, big) +
                     bytes_of(link % 10'000, 4, big);
  unsigned microseconds = 0;
  for (const std::string& ip : ip_packets) {
    const std::string frame = linked(link, ip);
    const unsigned fraction = microseconds % 1'000'000;
    file += bytes_of(100 + microseconds / 1'000'000, 4, big) +
            bytes_of(nano ? fraction * 1000 : fraction, 4, big) + bytes_of(frame.size(), 4, big) +
            bytes_of(frame.size(), 4, big) + frame;
    microseconds += 1327;
  }
  return file;
}

inline std::string block(unsigned type, const std::string& body, bool big) {
  const std::string padded = body + std::string((4 - body.size() % 4) % 4, '\0');
  const std::string length = bytes_of(12 + padded.size(), 4, big);
  return bytes_of(type, 4, big) + length + padded + length;
}

inline std::string pcap(const std::vector<std::string>& payloads, unsigned link = 1, bool big = false,
                        bool nano = false) {
  std::vector<std::string> ip_packets;
  for (const std::string& payload : payloads)
    ip_packets.push_back(udp(payload));
  return pcap_of_ip(ip_packets, link, big, nano);
}

// The fragments of a whole IP packet, each with at most `size` bytes (a multiple of 8) after its IP header.
inline std::vector<std::string> fragments_of(const std::string& ip, unsigned identification,
                                             std::size_t size = 1480) {
  std::vector<std::string> fragments;
  const std::string data = ip.substr(20);
  for (std::size_t at = 0; at < data.size(); at += size) {
    const std::string part = data.substr(at, size);
    const std::size_t more = at + size < data.size() ? 0x2000 : 0;
    fragments.push_back(ip.substr(0, 2) + bytes_of(20 + part.size(), 2, true) +
                        bytes_of(identification, 2, true) + bytes_of(more | at / 8, 2, true) +
                        ip.substr(8, 12) + part);
  }
  return fragments;
}

// Times count `time` on, in units of the power of ten `resolution`.
// A capture of packets from these addresses of 192.168.1.0/24.
inline std::string pcap_of(const std::vector<std::pair<std::uint8_t, std::string>>& packets) {
  std::string file = pcap({});
  unsigned microseconds = 0;
  for (const auto& [address, payload] : packets) {
    std::string one = pcap({payload}).substr(24);
    one.replace(4, 4, bytes_of(microseconds, 4));
    one.replace(16 + 14 + 12, 4, std::string("\xC0\xA8\x01", 3) + static_cast<char>(address));
    file += one;
    microseconds += 663;
  }
  return file;
}

inline std::string pcapng(const std::vector<std::string>& payloads, bool big, unsigned resolution = 9,
                          std::uint64_t time = 100'000'000'000) {
  std::string file =
      block(0x0A0D0D0A,
            bytes_of(0x1A2B3C4D, 4, big) + bytes_of(1, 2, big) + bytes_of(0, 2) + std::string(8, '\xFF'),
            big) +
      block(1,
            bytes_of(1, 2, big) + bytes_of(0, 6) + bytes_of(9, 2, big) + bytes_of(1, 2, big) +
                bytes_of(resolution, 1) + std::string(3, '\0') + bytes_of(0, 4),
            big) +
      block(5, "statistics", big);
  for (const std::string& payload : payloads) {
    const std::string frame = linked(1, udp(payload));
    file += block(6,
                  bytes_of(0, 4) + bytes_of(time >> 32U, 4, big) + bytes_of(time & 0xFFFFFFFFU, 4, big) +
                      bytes_of(frame.size(), 4, big) + bytes_of(frame.size(), 4, big) + frame,
                  big);
    time += 1'327'000;
  }
  return file;
}

}  // namespace pcl_bv
