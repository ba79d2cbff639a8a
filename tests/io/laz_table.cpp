// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "laz_table.h"

#include <algorithm>
#include <numeric>

namespace pcl_bv {
namespace {

// An adaptive model of the symbols 0 ... n - 1; with n = 0, of a bit.
struct Model {
  explicit Model(std::uint32_t symbols)
      : is_bit(symbols == 0),
        counts(is_bit ? 2 : symbols, 1),
        cycle(is_bit ? 4 : (symbols + 6) / 2),
        left(cycle),
        shift(is_bit ? 13 : 15) {
    update_bounds(static_cast<std::uint32_t>(counts.size()));
  }

  void update_bounds(std::uint32_t total) {
    bounds.assign(1, 0);
    std::uint32_t sum = 0;
    for (const std::uint32_t count : counts)
      bounds.push_back(
          static_cast<std::uint32_t>(std::uint64_t{0x80000000U / total} * (sum += count) >> (31 - shift)));
  }

  void see(std::uint32_t symbol) {
    ++counts[symbol];
    if (--left > 0) return;
    std::uint32_t total = std::accumulate(counts.begin(), counts.end(), 0U);
    if (total > 1U << shift) {
      if (is_bit) {
        total = (total + 1) / 2;
        counts[0] = (counts[0] + 1) / 2;
        total += counts[0] == total ? 1 : 0;
        counts[1] = total - counts[0];
      } else {
        for (std::uint32_t& count : counts)
          count = (count + 1) / 2;
        total = std::accumulate(counts.begin(), counts.end(), 0U);
      }
    }
    update_bounds(total);
    const auto most = is_bit ? 64U : (static_cast<std::uint32_t>(counts.size()) + 6) * 8;
    left = cycle = std::min(cycle * 5 / 4, most);
  }

  bool is_bit;
  std::vector<std::uint32_t> counts, bounds;
  std::uint32_t cycle, left, shift;
};

class Encoder {
 public:
  void put(Model& model, std::uint32_t symbol) {
    const std::uint32_t unit = length_ >> model.shift;
    const bool last = symbol + 1 == model.counts.size();
    narrow(unit * model.bounds[symbol], last ? length_ : unit * model.bounds[symbol + 1]);
    model.see(symbol);
  }

  void put_plain(std::uint32_t value, std::uint32_t bits) {
    if (bits > 19) {
      put_plain(value & 0xFFFF, 16);
      return put_plain(value >> 16, bits - 16);
    }
    const std::uint32_t unit = length_ >> bits;
    narrow(unit * value, unit * (value + 1));
  }

  std::string finish() {
    for (int i = 3; i >= 0; --i)
      bytes_ += static_cast<char>(base_ >> (8 * i));
    return bytes_ + std::string(4, '\0');
  }

 private:
  void narrow(std::uint32_t begin, std::uint32_t end) {
    const std::uint32_t before = base_;
    base_ += begin;
    length_ = end - begin;
    for (std::size_t i = bytes_.size(); base_ < before && i-- > 0;)  // the carry
      if (++bytes_[i] != 0) break;
    for (; length_ < 1U << 24U; length_ <<= 8U, base_ <<= 8U)
      bytes_ += static_cast<char>(base_ >> 24U);
  }

  std::string bytes_;
  std::uint32_t base_ = 0, length_ = 0xFFFFFFFF;
};

class Differences {
 public:
  Differences() {
    for (std::uint32_t bits = 1; bits < 32; ++bits)
      positions_.emplace_back(1U << std::min(bits, 8U));
  }

  void put(Encoder& encoder, std::uint32_t from, std::uint32_t to, unsigned column) {
    const std::int64_t difference = static_cast<std::int32_t>(to - from);
    std::uint32_t bits = 0;
    while (difference < -((std::int64_t{1} << bits) - 1) || difference > std::int64_t{1} << bits)
      ++bits;
    encoder.put(lengths_[column], bits);
    if (bits == 0) return encoder.put(bit_, static_cast<std::uint32_t>(difference));
    if (bits == 32) return;
    const auto at = static_cast<std::uint32_t>(difference > 0 ? difference - 1
                                                              : difference + (std::int64_t{1} << bits) - 1);
    const std::uint32_t plain = bits > 8 ? bits - 8 : 0;
    encoder.put(positions_[bits - 1], at >> plain);
    if (plain > 0) encoder.put_plain(at & ((1U << plain) - 1), plain);
  }

 private:
  std::vector<Model> lengths_{Model(33), Model(33)}, positions_;
  Model bit_{0};
};

}  // namespace

std::string laz_table(const std::vector<LazTableEntry>& entries, bool with_points) {
  const std::uint32_t head[] = {0, static_cast<std::uint32_t>(entries.size())};
  Encoder encoder;
  Differences differences;
  LazTableEntry last{0, 0};
  for (const LazTableEntry& entry : entries) {
    if (with_points) differences.put(encoder, last.points, entry.points, 0);
    differences.put(encoder, last.bytes, entry.bytes, 1);
    last = entry;
  }
  return std::string(reinterpret_cast<const char*>(head), sizeof head) + encoder.finish();
}

}  // namespace pcl_bv
