// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "ip_fragments.h"

#include <algorithm>
#include <cstring>

namespace pcl_bv::detail {
namespace {

constexpr std::size_t kMaxIpv4Datagram = 65'535 - 20;  // bytes after the IP header
constexpr std::size_t kMaxIpv6Datagram = 65'535;
constexpr std::int64_t kMaxFragmentWait = 1'000'000'000;  // nanoseconds

// Returns whether a datagram can have the fragment.
bool is_valid_fragment(const IpPacket& fragment) {
  const std::size_t limit = fragment.source.is_v6 ? kMaxIpv6Datagram : kMaxIpv4Datagram;
  return !fragment.cut && fragment.size > 0 && fragment.offset + fragment.size <= limit;
}

}  // namespace

bool FragmentBuffer::Datagram::is_of(const IpPacket& fragment) const {
  return used && identification == fragment.identification && source == fragment.source &&
         destination == fragment.destination;
}

bool FragmentBuffer::Datagram::holds(std::size_t first, std::size_t last) const {
  return std::any_of(parts.begin(), parts.end(),
                     [&](const auto& part) { return part.first <= first && last <= part.second; });
}

bool FragmentBuffer::Datagram::overlaps(std::size_t first, std::size_t last) const {
  return std::any_of(parts.begin(), parts.end(),
                     [&](const auto& part) { return first < part.second && part.first < last; });
}

void FragmentBuffer::Datagram::insert(std::size_t first, std::size_t last) {
  const auto after = std::lower_bound(parts.begin(), parts.end(), std::pair{first, last});
  const auto at = parts.insert(after, {first, last});
  if (const auto next = at + 1; next != parts.end() && next->first == last) {
    at->second = next->second;
    parts.erase(next);
  }
  if (at != parts.begin() && (at - 1)->second == at->first) {
    (at - 1)->second = at->second;
    parts.erase(at);
  }
}

void FragmentBuffer::begin(Datagram& datagram, const IpPacket& fragment, std::int64_t time_ns) {
  if (datagram.used && !datagram.complete) ++given_up_;
  datagram.used = true;
  datagram.complete = false;
  datagram.source = fragment.source;
  datagram.destination = fragment.destination;
  datagram.identification = fragment.identification;
  datagram.first_ns = time_ns;
  datagram.order = begun_++;
  datagram.whole.reset();
  datagram.bytes.clear();  // keeps its memory for the next datagram
  datagram.parts.clear();
}

// Returns the datagram of the fragment. A new one replaces the oldest, complete or not. A complete datagram
// is retained as long as possible, so that repeated fragments are recognised.
FragmentBuffer::Datagram& FragmentBuffer::datagram_of(const IpPacket& fragment, std::int64_t time_ns) {
  const auto found = std::find_if(datagrams_.begin(), datagrams_.end(),
                                  [&](const Datagram& datagram) { return datagram.is_of(fragment); });
  if (found != datagrams_.end()) {
    const std::int64_t age = time_ns - found->first_ns;  // times are at most 9e18
    if (age > kMaxFragmentWait || age < -kMaxFragmentWait) begin(*found, fragment, time_ns);
    return *found;
  }
  const auto oldest =
      std::min_element(datagrams_.begin(), datagrams_.end(), [](const Datagram& a, const Datagram& b) {
        return std::pair{a.used, a.order} < std::pair{b.used, b.order};
      });
  begin(*oldest, fragment, time_ns);
  return *oldest;
}

const std::vector<std::byte>* FragmentBuffer::add(const IpPacket& fragment, std::int64_t time_ns) {
  if (!is_valid_fragment(fragment)) return nullptr;
  Datagram& datagram = datagram_of(fragment, time_ns);
  const std::size_t first = fragment.offset, last = first + fragment.size;
  const bool beyond =
      datagram.whole && (last > *datagram.whole || (!fragment.more && last != *datagram.whole));
  const bool too_short = !fragment.more && last < datagram.bytes.size();
  if (datagram.holds(first, last) && !beyond && !too_short &&
      std::memcmp(datagram.bytes.data() + first, fragment.data, fragment.size) == 0)
    return nullptr;
  if (beyond || too_short || datagram.overlaps(first, last)) begin(datagram, fragment, time_ns);
  if (datagram.bytes.size() == first) {  // the usual order
    datagram.bytes.insert(datagram.bytes.end(), fragment.data, fragment.data + fragment.size);
  } else {
    if (datagram.bytes.size() < last) datagram.bytes.resize(last);
    std::memcpy(datagram.bytes.data() + first, fragment.data, fragment.size);
  }
  datagram.insert(first, last);
  if (!fragment.more) datagram.whole = last;
  datagram.complete = datagram.whole && datagram.parts.size() == 1 && datagram.holds(0, *datagram.whole);
  return datagram.complete ? &datagram.bytes : nullptr;
}

std::uint64_t FragmentBuffer::lost() const {
  return given_up_ + static_cast<std::uint64_t>(std::count_if(
                         datagrams_.begin(), datagrams_.end(),
                         [](const Datagram& datagram) { return datagram.used && !datagram.complete; }));
}

}  // namespace pcl_bv::detail
