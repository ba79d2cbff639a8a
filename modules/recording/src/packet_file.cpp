// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "packet_file.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <utility>

#include "search.h"

namespace pcl_bv::detail {
namespace {

constexpr std::uint64_t kWindow = 1U << 20U;
constexpr std::uint64_t kLookBehind = 1U << 16U;  // bytes before the position at_ that stay in the window
constexpr std::int64_t kSecond = 1'000'000'000;
constexpr std::int64_t kMaxSeconds = 9 * kSecond;  // 9e9 s since 1970; more could overflow in nanoseconds
// Maximum bytes of a pcap packet, and of a pcapng block in a search for the next block.
constexpr std::uint32_t kMaxPacket = 1U << 20U;
// Maximum seconds between two packets. A larger jump is accepted only if the times of the two packets after
// the jump differ by at most this number of seconds.
constexpr std::int64_t kMaxTimeGap = std::int64_t{24} * 3600;
constexpr std::uint32_t kSection = 0x0A0D0D0A, kByteOrder = 0x1A2B3C4D;

std::uint32_t reversed(std::uint32_t value) {
  return value << 24U | (value & 0xFF00U) << 8U | (value >> 8U & 0xFF00U) | value >> 24U;
}

// A magic number of pcap, and the number of ticks per second that it stands for.
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

// Returns the next `bytes` bytes at at_, or null if the file has fewer.
const std::byte* PacketFile::next_bytes(std::size_t bytes) {
  const std::uint64_t at = at_;
  if (at > file_.size() || bytes > file_.size() - at) return nullptr;
  if (at < window_at_ || at + bytes > window_at_ + window_.size()) {
    window_at_ = at - std::min(at, kLookBehind);
    window_.resize(std::max<std::uint64_t>(at + bytes - window_at_,
                                           std::min<std::uint64_t>(kWindow, file_.size() - window_at_)));
    file_.read(window_at_, window_.data(), window_.size());
  }
  return window_.data() + (at - window_at_);
}

// Copies bytes at any position without moving the window, because a search would otherwise move the window
// for every candidate. Returns false if the file is too short.
bool PacketFile::peek(std::uint64_t at, std::size_t bytes, std::byte* to) const {
  if (at > file_.size() || bytes > file_.size() - at) return false;
  if (at >= window_at_ && at + bytes <= window_at_ + window_.size()) {
    std::memcpy(to, window_.data() + (at - window_at_), bytes);
  } else {
    file_.read(at, to, bytes);
  }
  return true;
}

// Moves at_ to the next position where a run of packets can begin, and adds a warning. If there is none, adds
// a warning that the file is cut, and returns false. The search begins within the previous packet, because
// the length of this packet may be damaged. If the previous packet is unknown or longer than kLookBehind, the
// search begins after at_.
bool PacketFile::resynchronise() {
  const std::uint64_t damage = at_;
  const bool back = previous_ && damage - *previous_ <= kLookBehind;
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

// Returns whether a packet can begin at at_. Headers have no magic number, so the lengths of successive
// packets must be consistent. In pcap, the times of the packets must be close, too. Two packets whose times
// are close to the last accepted time are enough, and so are three packets whose times are close to each
// other.
bool PacketFile::begins_packet() {
  if (next_bytes(blocks_ ? 12 : 16) == nullptr) return false;
  if (blocks_) return is_run(2, std::nullopt);
  return (last_seconds_ && is_run(2, last_seconds_)) || is_run(3, std::nullopt);
}

// Returns whether `packets` valid packets follow each other from at_ on. At the file's end, fewer are enough.
// `seconds` is the time of the packet before at_, if known.
bool PacketFile::is_run(int packets, std::optional<std::int64_t> seconds) const {
  std::uint64_t at = at_;
  for (int i = 0; i < packets && at < file_.size(); ++i) {
    at = blocks_ ? end_of_block(at) : end_of_packet(at, seconds);
    if (at == 0) return false;
  }
  return true;
}

// Returns the end of the pcap packet at `at`, or 0 if there is none. `seconds` is the time of the previous
// packet, if known. The time of this packet must be close to `seconds` and is then stored in `seconds`.
std::uint64_t PacketFile::end_of_packet(std::uint64_t at, std::optional<std::int64_t>& seconds) const {
  std::byte head[16];
  if (!peek(at, sizeof head, head)) return 0;
  const std::int64_t time = u32(head);
  const std::uint32_t size = u32(head + 8), original = u32(head + 12);
  if (size > original || original > kMaxPacket || size > file_.size() - at - sizeof head ||
      u32(head + 4) >= interfaces_[0].ticks || (seconds && std::abs(time - *seconds) > kMaxTimeGap))
    return 0;
  seconds = time;
  return at + sizeof head + size;
}

// Returns the end of the pcapng block at `at`, or 0 if there is none.
std::uint64_t PacketFile::end_of_block(std::uint64_t at) const {
  std::byte head[8], end[4];
  if (!peek(at, sizeof head, head)) return 0;
  const std::uint32_t type = u32(head), length = u32(head + 4);
  if (type < 1 || type > 6 || length < 12 || length % 4 != 0 || length > kMaxPacket ||
      !peek(at + length - 4, sizeof end, end) || u32(end) != length)
    return 0;
  return at + length;
}

bool PacketFile::next(Payload& payload) {
  if (blocks_ ? next_block(payload) : next_pcap(payload)) return true;
  if (!std::exchange(ended_, true) && fragments_.lost() > 0)
    warnings_.add("fragments are missing of " + std::to_string(fragments_.lost()) + " UDP datagrams");
  return false;
}

// Reads the payload of a captured frame. Returns false if the frame has no UDP, or if its fragment does not
// complete a datagram.
bool PacketFile::payload_of(unsigned link, const std::byte* data, std::size_t size, Payload& payload) {
  const std::optional<IpPacket> packet = find_ip_packet(link, data, size);
  if (!packet) return false;
  if (!packet->is_fragment()) return read_datagram(packet->data, packet->size, packet->source, payload);
  const std::vector<std::byte>* const datagram = fragments_.add(*packet, payload.time_ns);
  return datagram != nullptr && read_datagram(datagram->data(), datagram->size(), packet->source, payload);
}

bool PacketFile::next_pcap(Payload& payload) {
  while (at_ < file_.size()) {
    // A jump of the time, as in merged captures, is accepted if the packet after the jump and its successor
    // have close times.
    if (next_bytes(16) == nullptr || !(is_run(1, last_seconds_) || is_run(2, std::nullopt))) {
      if (!resynchronise()) return false;
      continue;
    }
    const std::uint32_t size = u32(next_bytes(16) + 8);
    const std::byte* const packet = next_bytes(std::size_t{16} + size);
    last_seconds_ = u32(packet);
    payload.time_ns = *last_seconds_ * kSecond + u32(packet + 4) * (kSecond / interfaces_[0].ticks);
    previous_ = at_;
    at_ += 16 + size;
    if (payload_of(interfaces_[0].link, packet + 16, size, payload)) return true;
  }
  return false;
}

bool PacketFile::next_block(Payload& payload) {
  while (at_ < file_.size()) {
    const std::uint32_t length = block_length();
    if (length == 0) {
      if (!resynchronise()) return false;
      continue;
    }
    const std::byte* const block = next_bytes(length);
    previous_ = at_;
    at_ += length;
    const std::uint32_t type = u32(block);
    if (type == 1) add_interface(block + 8, length - 12);
    if (packet_of_block(block, length, type, payload)) return true;
  }
  return false;
}

// Returns the length of the pcapng block at at_, or 0 for a damaged block. A block stores its length at its
// beginning and at its end. The two lengths must be equal.
std::uint32_t PacketFile::block_length() {
  const std::byte* const head = next_bytes(12);
  if (head == nullptr || (u32(head) == kSection && !begin_section(head))) return 0;
  const std::uint32_t length = u32(head + 4);
  std::byte end[4];
  if (length < 12 || length % 4 != 0 || !peek(at_ + length - 4, sizeof end, end) || u32(end) != length)
    return 0;
  return length;
}

// Reads a section header, which defines the byte order of the section. Clears the list of interfaces. Returns
// false if the byte order is invalid.
bool PacketFile::begin_section(const std::byte* head) {
  std::uint32_t order;
  std::memcpy(&order, head + 8, 4);
  if (order != kByteOrder && reversed(order) != kByteOrder) return false;
  swapped_ = order != kByteOrder;
  interfaces_.clear();
  return true;
}

// Reads the payload of a packet block. Enhanced packet blocks (6) have a time. Simple packet blocks (3) have
// none, and payload.time_ns stays unchanged.
bool PacketFile::packet_of_block(const std::byte* block, std::uint32_t length, std::uint32_t type,
                                 Payload& payload) {
  if (type == 3 && length >= 16 && !interfaces_.empty())
    return payload_of(interfaces_[0].link, block + 12, std::min(u32(block + 8), length - 16), payload);
  if (type != 6 || length < 32) return false;
  const std::uint32_t number = u32(block + 8), size = u32(block + 20);
  if (number >= interfaces_.size() || size > length - 32) return false;
  const auto& [link, ticks] = interfaces_[number];
  const auto time = static_cast<std::int64_t>((std::uint64_t{u32(block + 12)} << 32U | u32(block + 16)) &
                                              0x7FFFFFFFFFFFFFFFU);
  payload.time_ns =
      std::min(time / ticks, kMaxSeconds) * kSecond +
      static_cast<std::int64_t>(static_cast<double>(time % ticks) * (1e9 / static_cast<double>(ticks)));
  return payload_of(link, block + 28, size, payload);
}

void PacketFile::add_interface(const std::byte* body, std::size_t size) {
  Interface made;
  if (size >= 8) made.link = u16(body);
  for (std::size_t at = 8; at + 4 <= size;) {
    const std::uint16_t code = u16(body + at), length = u16(body + at + 2);
    if (code == 0 || at + 4 + length > size) break;
    if (code == 9 && length >= 1) {  // if_tsresol gives ticks per second as a power of ten or two
      const auto power = std::to_integer<unsigned>(body[at + 4]);
      const unsigned exponent = power & 0x7FU;
      if ((power & 0x80U) != 0 && exponent <= 60) made.ticks = std::int64_t{1} << exponent;
      if ((power & 0x80U) == 0 && exponent <= 18) made.ticks = std::llround(std::pow(10.0, exponent));
    }
    at += 4 + (length + 3U) / 4 * 4;
  }
  interfaces_.push_back(made);
}

}  // namespace pcl_bv::detail
