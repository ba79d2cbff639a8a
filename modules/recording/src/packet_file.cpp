// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "packet_file.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "search.h"

namespace pcl_bv {
namespace {

constexpr std::uint64_t kWindow = 1U << 20U;
constexpr std::uint64_t kBack = 1U << 16U;  // bytes that the window keeps before its position
constexpr std::int64_t kSecond = 1'000'000'000;
constexpr std::int64_t kMaxSeconds = 9 * kSecond;  // since 1970; more may overflow in nanoseconds
// Longest packet that is accepted while searching for the next valid header.
constexpr std::uint32_t kLongest = 1U << 20U;
constexpr std::int64_t kNear = 24 * 3600;  // seconds between two packets, unless the next ones confirm more
constexpr std::uint32_t kSection = 0x0A0D0D0A, kByteOrder = 0x1A2B3C4D;

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

// So many bytes from here on, or null if there are not as many.
const std::byte* PacketFile::need(std::size_t bytes) {
  const std::uint64_t at = at_;
  if (at > file_.size() || bytes > file_.size() - at) return nullptr;
  if (at < window_at_ || at + bytes > window_at_ + window_.size()) {
    window_at_ = at - std::min(at, kBack);
    window_.resize(std::max<std::uint64_t>(at + bytes - window_at_,
                                           std::min<std::uint64_t>(kWindow, file_.size() - window_at_)));
    file_.read(window_at_, window_.data(), window_.size());
  }
  return window_.data() + (at - window_at_);
}

// The same without moving the window, which a search would else read again for each candidate.
bool PacketFile::peek(std::uint64_t at, std::size_t bytes, std::byte* to) const {
  if (at > file_.size() || bytes > file_.size() - at) return false;
  if (at >= window_at_ && at + bytes <= window_at_ + window_.size()) {
    std::memcpy(to, window_.data() + (at - window_at_), bytes);
  } else {
    file_.read(at, to, bytes);
  }
  return true;
}

// Goes on at the next position where packets in a row can be; where there is none the file is cut. The length
// of the packet before may be what is damaged, so the search begins within it.
bool PacketFile::go_on() {
  const std::uint64_t damage = at_;
  const bool back = previous_ && damage - *previous_ <= kBack;
  const std::uint64_t from = (back ? *previous_ : damage) + 1;
  for (at_ = from; at_ < file_.size(); ++at_) {
    if (!begins_packet()) continue;
    warnings_.add(skipped_bytes(at_ > damage ? damage : from - 1, at_));
    previous_.reset();
    return true;
  }
  warnings_.add("the file ends within a packet, at byte " + std::to_string(damage));
  return false;
}

// Headers have no mark: lengths that agree with one another and with what follows, and times near the last
// one or, of three packets, near one another.
bool PacketFile::begins_packet() {
  if (need(blocks_ ? 12 : 16) == nullptr) return false;
  if (blocks_) return is_run(2, std::nullopt);
  return (last_seconds_ && is_run(2, last_seconds_)) || is_run(3, std::nullopt);
}

// Whether so many packets, or those up to the file's end, follow one another here.
bool PacketFile::is_run(int packets, std::optional<std::int64_t> seconds) const {
  std::uint64_t at = at_;
  for (int i = 0; i < packets && at < file_.size(); ++i) {
    at = blocks_ ? end_of_block(at) : end_of_packet(at, seconds);
    if (at == 0) return false;
  }
  return true;
}

// 0 if there can be no packet of pcap; `seconds` becomes its time, which must be near the one before.
std::uint64_t PacketFile::end_of_packet(std::uint64_t at, std::optional<std::int64_t>& seconds) const {
  std::byte head[16];
  if (!peek(at, sizeof head, head)) return 0;
  const std::int64_t time = u32(head);
  const std::uint32_t size = u32(head + 8), original = u32(head + 12);
  if (size > original || original > kLongest || size > file_.size() - at - sizeof head ||
      u32(head + 4) >= interfaces_[0].ticks || (seconds && std::abs(time - *seconds) > kNear))
    return 0;
  seconds = time;
  return at + sizeof head + size;
}

// 0 if there can be no block of pcapng.
std::uint64_t PacketFile::end_of_block(std::uint64_t at) const {
  std::byte head[8], end[4];
  if (!peek(at, sizeof head, head)) return 0;
  const std::uint32_t type = u32(head), length = u32(head + 4);
  if (type < 1 || type > 6 || length < 12 || length % 4 != 0 || length > kLongest ||
      !peek(at + length - 4, sizeof end, end) || u32(end) != length)
    return 0;
  return at + length;
}

bool PacketFile::next(Payload& payload) {
  return blocks_ ? next_block(payload) : next_pcap(payload);
}

bool PacketFile::next_pcap(Payload& payload) {
  while (at_ < file_.size()) {
    // Times may jump, as in captures that were joined, if the next packet confirms it.
    if (need(16) == nullptr || !(is_run(1, last_seconds_) || is_run(2, std::nullopt))) {
      if (!go_on()) return false;
      continue;
    }
    const std::uint32_t size = u32(need(16) + 8);
    const std::byte* const packet = need(std::size_t{16} + size);
    last_seconds_ = u32(packet);
    payload.time_ns = *last_seconds_ * kSecond + u32(packet + 4) * (kSecond / interfaces_[0].ticks);
    previous_ = at_;
    at_ += 16 + size;
    if (unwrap_udp(interfaces_[0].link, packet + 16, size, payload)) return true;
  }
  return false;
}

bool PacketFile::next_block(Payload& payload) {
  while (at_ < file_.size()) {
    const std::uint32_t length = block_length();
    if (length == 0) {
      if (!go_on()) return false;
      continue;
    }
    const std::byte* const block = need(length);
    previous_ = at_;
    at_ += length;
    const std::uint32_t type = u32(block);
    if (type == 1) add_interface(block + 8, length - 12);
    if (packet_of_block(block, length, type, payload)) return true;
  }
  return false;
}

// 0 if it is not the one at the block's end, too: checked before so much is read.
std::uint32_t PacketFile::block_length() {
  const std::byte* const head = need(12);
  if (head == nullptr || (u32(head) == kSection && !begin_section(head))) return 0;
  const std::uint32_t length = u32(head + 4);
  std::byte end[4];
  if (length < 12 || length % 4 != 0 || !peek(at_ + length - 4, sizeof end, end) || u32(end) != length)
    return 0;
  return length;
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
    return unwrap_udp(interfaces_[0].link, block + 12, std::min(u32(block + 8), length - 16), payload);
  if (type != 6 || length < 32) return false;
  const std::uint32_t number = u32(block + 8), size = u32(block + 20);
  if (number >= interfaces_.size() || size > length - 32) return false;
  const auto& [link, ticks] = interfaces_[number];
  const auto time = static_cast<std::int64_t>((std::uint64_t{u32(block + 12)} << 32U | u32(block + 16)) &
                                              0x7FFFFFFFFFFFFFFFU);
  payload.time_ns =
      std::min(time / ticks, kMaxSeconds) * kSecond +
      static_cast<std::int64_t>(static_cast<double>(time % ticks) * (1e9 / static_cast<double>(ticks)));
  return unwrap_udp(link, block + 28, size, payload);
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

}  // namespace pcl_bv
