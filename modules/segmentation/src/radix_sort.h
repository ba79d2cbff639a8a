// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Stable radix sort by key.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace pcl_bv::detail {

template <typename Key>
struct KeyedPoint {
  Key key;
  std::uint32_t point;
};

/// Sorts by key. Items with equal keys retain their order. `items` must not be empty. Only the low `key_bits`
/// bits of the keys may be set. `spare` is a buffer. Takes O(n) for each digit of 11 bits, beginning with the
/// least significant digit. Digits that are equal in all items are skipped.
template <typename Key>
void radix_sort(std::vector<KeyedPoint<Key>>& items, std::vector<KeyedPoint<Key>>& spare, unsigned key_bits) {
  constexpr unsigned digit_bits = 11;
  constexpr std::uint32_t digit_mask = (1U << digit_bits) - 1;
  spare.resize(items.size());
  for (unsigned shift = 0; shift < key_bits; shift += digit_bits) {
    const auto digit = [shift](const KeyedPoint<Key>& item) {
      return static_cast<std::uint32_t>(item.key >> shift) & digit_mask;
    };
    std::array<std::uint32_t, digit_mask + 1> next{};
    for (const KeyedPoint<Key>& item : items)
      ++next[digit(item)];
    if (next[digit(items.front())] == items.size()) continue;
    std::uint32_t begin = 0;
    for (std::uint32_t& n : next) {
      const std::uint32_t count = n;
      n = begin;
      begin += count;
    }
    for (const KeyedPoint<Key>& item : items)
      spare[next[digit(item)]++] = item;
    items.swap(spare);
  }
}

}  // namespace pcl_bv::detail
