// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Reassembles datagrams from fragments of IPv4 (RFC 791, section 3.2) and IPv6 (RFC 8200, section 4.5).
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "udp_payload.h"

namespace pcl_bv::detail {

/// The fragments of up to 32 datagrams, which may be interleaved and in any order. The memory is at most
/// 32 datagrams of 64 KiB.
///
/// A datagram is given up if a fragment is still missing 1 s after its first captured fragment, or if 32
/// newer datagrams arrive. A repeated fragment is ignored. A fragment that overlaps others of its datagram in
/// any other way begins a new datagram, because the sender has reused the identification.
class FragmentBuffer {
 public:
  /// Adds a fragment that was captured at `time_ns`. Returns the datagram if this fragment completes it. The
  /// datagram is valid until the next call. Returns null otherwise.
  const std::vector<std::byte>* add(const IpPacket& fragment, std::int64_t time_ns);

  /// Returns the number of datagrams that were given up or are still incomplete.
  std::uint64_t lost() const;

 private:
  struct Datagram {
    bool used = false, complete = false;
    IpAddress source{}, destination{};
    std::uint32_t identification = 0;
    std::int64_t first_ns = 0;           // capture time of the first captured fragment
    std::uint64_t order = 0;             // number of the datagram
    std::optional<std::size_t> whole{};  // size of the whole, known from its last fragment
    std::vector<std::byte> bytes{};      // [0, largest end of a fragment)
    std::vector<std::pair<std::size_t, std::size_t>> parts{};  // received [begin, end), sorted and merged

    bool is_of(const IpPacket& fragment) const;
    bool holds(std::size_t first, std::size_t last) const;
    bool overlaps(std::size_t first, std::size_t last) const;
    void insert(std::size_t first, std::size_t last);
  };

  Datagram& datagram_of(const IpPacket& fragment, std::int64_t time_ns);
  void begin(Datagram& datagram, const IpPacket& fragment, std::int64_t time_ns);

  std::array<Datagram, 32> datagrams_{};
  std::uint64_t begun_ = 0, given_up_ = 0;
};

}  // namespace pcl_bv::detail
