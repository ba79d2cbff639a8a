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
constexpr std::uint32_t kLongest = 1U << 20U;  // bytes of a packet, where lengths are doubted
constexpr std::int64_t kNear = 24 * 3600;      // seconds from the last packet, where times are doubted
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

const std::byte* PacketFile::need(std::size_t bytes) {
  return need_at(at_, bytes);
}

// So many bytes of the file, or null if there are not as many.
const std::byte* PacketFile::need_at(std::uint64_t at, std::size_t bytes) {
  if (at > file_.size() || bytes > file_.size() - at) return nullptr;
  if (at < window_at_ || at + bytes > window_at_ + window_.size()) {
    window_.resize(std::max<std::uint64_t>(bytes, std::min<std::uint64_t>(kWindow, file_.size() - at)));
    window_at_ = at;
    file_.read(at, window_.data(), window_.size());
  }
  return window_.data() + (at - window_at_);
}

// Goes on at the next place where two packets in a row can be; where there is none the file is cut.
bool PacketFile::go_on() {
  const std::uint64_t damage = at_;
  const std::string where = ", at byte " + std::to_string(damage);
  for (++at_; at_ < file_.size(); ++at_) {
    if (begins_packet()) {
      remarks_.push_back("passed over " + std::to_string(at_ - damage) + " bytes that are no packet" + where);
      return true;
    }
  }
  remarks_.push_back("the file ends within a packet" + where);
  return false;
}

// Headers have no mark: lengths that agree with one another and with what follows, and a time near the last
// one.
bool PacketFile::begins_packet() {
  std::uint64_t at = at_;
  for (int packet = 0; packet < 2 && at < file_.size(); ++packet) {
    const std::byte* const head = need_at(at, blocks_ ? 12 : 16);
    if (head == nullptr) return false;
    const std::uint32_t length = blocks_ ? u32(head + 4) : u32(head + 8);
    if (blocks_) {
      const bool known = u32(head) >= 1 && u32(head) <= 6;
      if (!known || length < 12 || length % 4 != 0 || length > kLongest) return false;
      const std::byte* const end = need_at(at + length - 4, 4);
      if (end == nullptr || u32(end) != length) return false;
      at += length;
    } else {
      const std::int64_t seconds = u32(head);
      if (length > u32(head + 12) || u32(head + 12) > kLongest || length == 0 ||
          std::abs(seconds - last_seconds_) > kNear || u32(head + 4) >= interfaces_[0].ticks)
        return false;
      at += 16 + std::uint64_t{length};
    }
  }
  return at <= file_.size();
}

bool PacketFile::next(Payload& payload) {
  return blocks_ ? next_block(payload) : next_pcap(payload);
}

bool PacketFile::next_pcap(Payload& payload) {
  while (at_ < file_.size()) {
    const std::byte* const head = need(16);
    const std::uint32_t size = head == nullptr ? 0 : u32(head + 8);
    const std::byte* const packet =
        head == nullptr || size > kLongest ? nullptr : need(std::size_t{16} + size);
    if (packet == nullptr) {
      if (!go_on()) return false;
      continue;
    }
    last_seconds_ = u32(packet);
    payload.time_ns = last_seconds_ * kSecond + u32(packet + 4) * (kSecond / interfaces_[0].ticks);
    at_ += 16 + size;
    if (unwrap(interfaces_[0].link, packet + 16, size, payload)) return true;
  }
  return false;
}

bool PacketFile::next_block(Payload& payload) {
  while (at_ < file_.size()) {
    const std::byte* const head = need(12);
    const bool section = head != nullptr && u32(head) == kSection;
    if (section && !begin_section(head)) {
      if (!go_on()) return false;
      continue;
    }
    const std::uint32_t type = head == nullptr ? 0 : u32(head), length = head == nullptr ? 0 : u32(head + 4);
    const std::byte* const block = length < 12 || length % 4 != 0 ? nullptr : need(length);
    if (block == nullptr || u32(block + length - 4) != length) {
      if (!go_on()) return false;
      continue;
    }
    at_ += length;
    if (type == 1) add_interface(block + 8, length - 12);
    if (packet_of_block(block, length, type, payload)) return true;
  }
  return false;
}

// Says the byte order of itself and what follows.
bool PacketFile::begin_section(const std::byte* head) {
  std::uint32_t order;
  std::memcpy(&order, head + 8, 4);
  if (order != kByteOrder && reversed(order) != kByteOrder) return false;
  swapped_ = order != kByteOrder;
  interfaces_.clear();
  return true;
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
  const std::size_t most = size - skip - header;
  std::size_t udp = big16(ip + header + 4);
  if (udp < 8 || udp > most) udp = most;  // what is there counts
  payload.data = ip + header + 8;
  payload.size = udp - 8;
  payload.address = static_cast<std::uint32_t>(big16(ip + 12) << 16U | big16(ip + 14));
  payload.from_port = static_cast<std::uint16_t>(big16(ip + header));
  payload.to_port = static_cast<std::uint16_t>(big16(ip + header + 2));
  return true;
}

std::string Payload::source() const {
  std::string text;
  for (unsigned shift = 32; shift > 0; shift -= 8)
    text += (text.empty() ? "" : ".") + std::to_string(address >> (shift - 8) & 0xFFU);
  return text + ':' + std::to_string(to_port);
}

}  // namespace pcl_bv
