// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "packet_file.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace pcl_bv {
namespace {

constexpr std::uint64_t kWindow = 1U << 20U;
constexpr std::int64_t kSecond = 1'000'000'000;
constexpr std::uint32_t kSection = 0x0A0D0D0A, kByteOrder = 0x1A2B3C4D;

// Of networks, whatever the file has.
std::size_t big16(const std::byte* at) {
  return std::to_integer<std::size_t>(at[0]) << 8U | std::to_integer<std::size_t>(at[1]);
}

std::uint32_t reversed(std::uint32_t value) {
  return value << 24U | (value & 0xFF00U) << 8U | (value >> 8U & 0xFF00U) | value >> 24U;
}

// Magic numbers of pcap, and the ticks of a second.
struct Magic {
  std::uint32_t value;
  std::int64_t ticks;
};
constexpr Magic kMagics[] = {{0xA1B2C3D4, 1'000'000}, {0xA1B23C4D, kSecond}};

std::uint32_t first_word(std::string_view start) {
  std::uint32_t word = 0;
  if (start.size() >= 4) std::memcpy(&word, start.data(), 4);
  return word;
}

}  // namespace

bool is_packet_file(std::string_view start) {
  const std::uint32_t word = first_word(start);
  return word == kSection || std::any_of(std::begin(kMagics), std::end(kMagics), [&](const Magic& magic) {
           return word == magic.value || reversed(word) == magic.value;
         });
}

PacketFile::PacketFile(const std::filesystem::path& file) : file_(file) {
  char start[24] = {};
  const std::size_t size = std::min(sizeof start, file_.size());
  file_.read(0, start, size);
  if (!is_packet_file({start, size})) throw IoError("neither pcap nor pcapng");
  const std::uint32_t word = first_word({start, size});
  blocks_ = word == kSection;
  if (blocks_) return;
  if (size < sizeof start) throw IoError("the file ends within its header");
  for (const Magic& magic : kMagics) {
    if (word != magic.value && reversed(word) != magic.value) continue;
    swapped_ = word != magic.value;
    interfaces_ = {{u32(reinterpret_cast<const std::byte*>(start) + 20) & 0xFFFFU, magic.ticks}};
  }
  at_ = sizeof start;
}

std::uint16_t PacketFile::u16(const std::byte* at) const {
  std::uint16_t value;
  std::memcpy(&value, at, 2);
  return swapped_ ? static_cast<std::uint16_t>(value << 8U | value >> 8U) : value;
}

std::uint32_t PacketFile::u32(const std::byte* at) const {
  std::uint32_t value;
  std::memcpy(&value, at, 4);
  return swapped_ ? reversed(value) : value;
}

// So many bytes from where the file is, or null if there are not as many.
const std::byte* PacketFile::need(std::size_t bytes) {
  if (bytes > file_.size() - at_) return nullptr;
  if (at_ < window_at_ || at_ + bytes > window_at_ + window_.size()) {
    window_.resize(std::max<std::uint64_t>(bytes, std::min<std::uint64_t>(kWindow, file_.size() - at_)));
    window_at_ = at_;
    file_.read(at_, window_.data(), window_.size());
  }
  return window_.data() + (at_ - window_at_);
}

bool PacketFile::cut() {
  remarks_.push_back("the file ends within a packet, at byte " + std::to_string(at_));
  at_ = file_.size();
  return false;
}

bool PacketFile::next(Payload& payload) {
  return blocks_ ? next_block(payload) : next_pcap(payload);
}

bool PacketFile::next_pcap(Payload& payload) {
  while (at_ < file_.size()) {
    const std::byte* const head = need(16);
    if (head == nullptr) return cut();
    const std::uint32_t size = u32(head + 8);
    payload.time_ns = std::int64_t{u32(head)} * kSecond + u32(head + 4) * (kSecond / interfaces_[0].ticks);
    const std::byte* const packet = need(std::size_t{16} + size);
    if (packet == nullptr) return cut();
    at_ += 16 + size;
    if (unwrap(interfaces_[0].link, packet + 16, size, payload)) return true;
  }
  return false;
}

bool PacketFile::next_block(Payload& payload) {
  while (at_ < file_.size()) {
    const std::byte* const head = need(12);
    if (head == nullptr) return cut();
    if (u32(head) == kSection) {  // says the byte order of itself and what follows
      std::uint32_t order;
      std::memcpy(&order, head + 8, 4);
      if (order != kByteOrder && reversed(order) != kByteOrder) return cut();
      swapped_ = order != kByteOrder;
      interfaces_.clear();
    }
    const std::uint32_t type = u32(head), length = u32(head + 4);
    const std::byte* const block = length < 12 || length % 4 != 0 ? nullptr : need(length);
    if (block == nullptr) return cut();
    at_ += length;
    if (type == 1) add_interface(block + 8, length - 12);
    if (packet_of_block(block, length, type, payload)) return true;
  }
  return false;
}

// Enhanced packets (6) have times, simple ones (3) none: those keep the last one.
bool PacketFile::packet_of_block(const std::byte* block, std::uint32_t length, std::uint32_t type,
                                 Payload& payload) {
  if (type == 3 && length >= 16 && !interfaces_.empty())
    return unwrap(interfaces_[0].link, block + 12, std::min(u32(block + 8), length - 16), payload);
  if (type != 6 || length < 32) return false;
  const std::uint32_t number = u32(block + 8), size = u32(block + 20);
  if (number >= interfaces_.size() || size > length - 32) return false;
  const auto& [link, ticks] = interfaces_[number];
  const auto time = static_cast<std::int64_t>((std::uint64_t{u32(block + 12)} << 32U | u32(block + 16)) &
                                              0x7FFFFFFFFFFFFFFFU);
  payload.time_ns = time / ticks * kSecond + static_cast<std::int64_t>(static_cast<double>(time % ticks) *
                                                                       (1e9 / static_cast<double>(ticks)));
  return unwrap(link, block + 28, size, payload);
}

void PacketFile::add_interface(const std::byte* body, std::size_t size) {
  Interface made;
  if (size >= 8) made.link = u16(body);
  for (std::size_t at = 8; at + 4 <= size;) {
    const std::uint16_t code = u16(body + at), length = u16(body + at + 2);
    if (code == 0 || at + 4 + length > size) break;
    if (code == 9 && length >= 1) {  // if_tsresol: a power of ten, or of two
      const auto power = std::to_integer<unsigned>(body[at + 4]);
      const unsigned exponent = power & 0x7FU;
      if ((power & 0x80U) != 0 && exponent <= 60) made.ticks = std::int64_t{1} << exponent;
      if ((power & 0x80U) == 0 && exponent <= 18) made.ticks = std::llround(std::pow(10.0, exponent));
    }
    at += 4 + (length + 3U) / 4 * 4;
  }
  interfaces_.push_back(made);
}

// The payload of UDP in IPv4, whole, in what a link carries.
bool PacketFile::unwrap(unsigned link, const std::byte* data, std::size_t size, Payload& payload) {
  constexpr std::size_t ipv4 = 0x0800;
  std::size_t skip = 0, protocol = ipv4;
  if (link == 1) {
    skip = 14;
    for (; size >= skip; skip += 4) {
      protocol = big16(data + skip - 2);
      if (protocol != 0x8100 && protocol != 0x88A8) break;
    }
  } else if (link == 113) {
    skip = 16;
    if (size >= skip) protocol = big16(data + 14);
  } else if (link == 276) {
    skip = 20;
    if (size >= skip) protocol = big16(data);
  } else if (link == 0) {
    skip = 4;
  } else if (link != 12 && link != 101 && link != 228) {
    return false;
  }
  if (size < skip + 20 || protocol != ipv4) return false;
  const std::byte* const ip = data + skip;
  const std::size_t header = 4 * (std::to_integer<std::size_t>(ip[0]) & 15U);
  const bool whole = (big16(ip + 6) & 0x3FFFU) == 0;  // neither more fragments nor an offset
  if ((std::to_integer<unsigned>(ip[0]) >> 4U) != 4 || header < 20 || !whole ||
      std::to_integer<int>(ip[9]) != 17 || size < skip + header + 8)
    return false;
  const std::size_t udp = big16(ip + header + 4);
  if (udp < 8 || udp > size - skip - header) return false;
  payload.data = ip + header + 8;
  payload.size = udp - 8;
  return true;
}

}  // namespace pcl_bv
