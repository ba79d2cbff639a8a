// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// A hash table that numbers the keys of blocks in the order in which they first occur.
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

namespace pcl_bv::detail {

/// Maps the key of a block to its number. Numbering the blocks costs less than sorting the points. In scan
/// order consecutive points are mostly in the same block, so number() is called only once for many points.
template <typename Key>
class BlockIndex {
 public:
  /// Removes all keys. Retains the number of slots, but clamps it to a range that suits the number of points.
  void reset(std::size_t points) {
    const std::size_t min_slots = std::bit_ceil(std::max<std::size_t>(points / 4, 64));
    count_ = 0;
    allocate_slots(std::clamp(slots_.size(), min_slots, 16 * min_slots));
  }

  /// Returns the number of a key. New keys get the next of the numbers 0, 1, 2, ...
  std::uint32_t number(Key key) {
    Slot* slot = find(key);
    if (slot->number == none) {
      if (2 * (count_ + 1) > slots_.size()) slot = grow(key);
      *slot = {key, count_++};
    }
    return slot->number;
  }

  /// Returns the number of a key; nullopt if number() was not called for it.
  std::optional<std::uint32_t> find_number(Key key) const {
    const Slot& slot = slots_[position(key)];
    return slot.number == none ? std::nullopt : std::optional(slot.number);
  }

 private:
  struct Slot {
    Key key;
    std::uint32_t number;
  };
  static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

  void allocate_slots(std::size_t slots) {
    slots_.assign(slots, {0, none});
    old_.reserve(slots / 2);  // enough for a later grow() to this number of slots
    shift_ = 64U - static_cast<unsigned>(std::bit_width(slots - 1));
  }

  Slot* find(Key key) { return &slots_[position(key)]; }

  std::size_t position(Key key) const {
    std::uint64_t folded = static_cast<std::uint64_t>(key);
    if constexpr (sizeof(Key) > sizeof folded)
      folded ^= static_cast<std::uint64_t>(key >> 64) * 0xff51afd7ed558ccdU;
    std::size_t i = folded * 0x9e3779b97f4a7c15U >> shift_;  // 2^64 / golden ratio
    while (slots_[i].number != none && slots_[i].key != key)
      i = (i + 1) & (slots_.size() - 1);
    return i;
  }

  Slot* grow(Key key) {
    old_ = slots_;
    allocate_slots(2 * old_.size());
    for (const Slot& slot : old_) {
      if (slot.number != none) *find(slot.key) = slot;
    }
    return find(key);
  }

  std::vector<Slot> slots_, old_;
  unsigned shift_ = 0;
  std::uint32_t count_ = 0;
};

}  // namespace pcl_bv::detail
