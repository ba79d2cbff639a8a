// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Adaptive arithmetic coding as in A. Said, Introduction to Arithmetic Coding - Theory and Practice,
// HPL-2004-76, with the constants of LASzip. A number is coded as its difference to the number before: first
// the length of an interval around 0 that contains it, 2^k, then the position in the interval.

#include "laz_chunk_table.h"

#include <algorithm>
#include <array>
#include <vector>

namespace pcl_bv::detail {
namespace {

constexpr std::uint32_t kShortestInterval = 1U << 24U;

// Probabilities of the numbers 0 ... n - 1, from how often each was seen.
class SymbolModel {
 public:
  explicit SymbolModel(std::uint32_t symbols)
      : counts_(symbols, 1), sums_(symbols), total_(symbols), until_update_((symbols + 6) / 2) {
    cycle_ = until_update_;
    sum_up();
  }

  std::uint32_t size() const { return static_cast<std::uint32_t>(counts_.size()); }

  // The lower bound of a symbol's interval, in units of 2^-15.
  std::uint32_t lower(std::uint32_t symbol) const { return sums_[symbol]; }

  void count(std::uint32_t symbol) {
    ++counts_[symbol];
    if (--until_update_ > 0) return;
    total_ += cycle_;
    if (total_ > 1U << 15U) {
      total_ = 0;
      for (std::uint32_t& count : counts_)
        total_ += count = (count + 1) / 2;
    }
    sum_up();
    cycle_ = std::min(cycle_ * 5 / 4, (size() + 6) * 8);
    until_update_ = cycle_;
  }

 private:
  void sum_up() {
    const std::uint32_t scale = (1U << 31U) / total_;
    std::uint32_t sum = 0;
    for (std::uint32_t i = 0; i < size(); ++i) {
      sums_[i] = scale * sum >> 16U;
      sum += counts_[i];
    }
  }

  std::vector<std::uint32_t> counts_, sums_;
  std::uint32_t total_, cycle_ = 0, until_update_;
};

// Probability of the bit 0, in units of 2^-13.
class BitModel {
 public:
  std::uint32_t zero() const { return zero_; }

  void count(std::uint32_t bit) {
    zeros_ += 1 - bit;
    if (--until_update_ > 0) return;
    total_ += cycle_;
    if (total_ > 1U << 13U) {
      total_ = (total_ + 1) / 2;
      zeros_ = (zeros_ + 1) / 2;
      if (zeros_ == total_) ++total_;
    }
    zero_ = zeros_ * ((1U << 31U) / total_) >> 18U;
    cycle_ = std::min(cycle_ * 5 / 4, 64U);
    until_update_ = cycle_;
  }

 private:
  std::uint32_t zero_ = 1U << 12U, zeros_ = 1, total_ = 2, cycle_ = 4, until_update_ = 4;
};

}  // namespace

class ChunkTableReader::Decoder {
 public:
  Decoder(const InputFile& file, std::size_t offset) : file_(file), offset_(offset) {
    for (int i = 0; i < 4; ++i)
      value_ = value_ << 8U | next_byte();
    for (std::uint32_t bits = 1; bits < 32; ++bits)
      positions_.emplace_back(1U << std::min(bits, kModelledBits));
  }

  // Returns the number that follows `last` in a column of the table.
  std::uint32_t next_number(std::uint32_t last, unsigned column) {
    const std::uint32_t bits = symbol(lengths_[column]);
    if (bits == 0) return last + bit(zero_or_one_);
    if (bits == 32) return last + (1U << 31U);
    SymbolModel& model = positions_[bits - 1];
    std::uint32_t at = symbol(model);
    if (bits > kModelledBits) at = at << (bits - kModelledBits) | plain_bits(bits - kModelledBits);
    // The upper half of the interval is positive and begins with 2^(k-1) + 1.
    return at >= 1U << (bits - 1) ? last + at + 1 : last + at - ((1U << bits) - 1);
  }

 private:
  static constexpr std::uint32_t kModelledBits = 8;

  std::uint32_t symbol(SymbolModel& model) {
    const std::uint32_t unit = length_ >> 15U;
    std::uint32_t low = 0, high = model.size();
    while (high - low > 1) {
      const std::uint32_t middle = (low + high) / 2;
      (std::uint64_t{unit} * model.lower(middle) > value_ ? high : low) = middle;
    }
    const std::uint32_t begin = unit * model.lower(low);
    const std::uint32_t end = high < model.size() ? unit * model.lower(high) : length_;
    narrow(begin, end);
    model.count(low);
    return low;
  }

  std::uint32_t bit(BitModel& model) {
    const std::uint32_t middle = model.zero() * (length_ >> 13U);
    const std::uint32_t read = value_ >= middle ? 1 : 0;
    read == 0 ? narrow(0, middle) : narrow(middle, length_);
    model.count(read);
    return read;
  }

  // Bits of equal probability, at most 16 at a time, the lowest first.
  std::uint32_t plain_bits(std::uint32_t bits) {
    if (bits > 19) {
      const std::uint32_t low = plain_bits(16);
      return plain_bits(bits - 16) << 16U | low;
    }
    const std::uint32_t unit = length_ >> bits, read = value_ / unit;
    if (read >> bits != 0) throw IoError("corrupt: the table of chunks cannot be decoded");
    narrow(unit * read, unit * (read + 1));
    return read;
  }

  void narrow(std::uint32_t begin, std::uint32_t end) {
    value_ -= begin;
    length_ = end - begin;
    if (length_ == 0 || value_ > length_) throw IoError("corrupt: the table of chunks cannot be decoded");
    for (; length_ < kShortestInterval; length_ <<= 8U)
      value_ = value_ << 8U | next_byte();
  }

  std::uint32_t next_byte() {
    if (at_ == filled_) {
      filled_ = std::min(bytes_.size(), file_.size() - offset_);
      if (filled_ == 0) throw IoError("truncated: the table of chunks ends early");
      file_.read(offset_, bytes_.data(), filled_);
      offset_ += filled_;
      at_ = 0;
    }
    return bytes_[at_++];
  }

  const InputFile& file_;
  std::size_t offset_, at_ = 0, filled_ = 0;
  std::array<std::uint8_t, 4096> bytes_{};
  std::uint32_t value_ = 0, length_ = 0xFFFFFFFF;
  std::array<SymbolModel, 2> lengths_{SymbolModel(33), SymbolModel(33)};
  std::vector<SymbolModel> positions_;  // for each length of an interval above 1
  BitModel zero_or_one_;
};

ChunkTableReader::ChunkTableReader(const InputFile& file, std::size_t offset, bool with_points)
    : with_points_(with_points) {
  std::uint32_t head[2];
  if (offset > file.size() || file.size() - offset < sizeof head)
    throw IoError("truncated: the table of chunks is missing");
  file.read(offset, head, sizeof head);
  if (head[0] != 0)
    throw IoError("corrupt: the table of chunks has the unknown version " + std::to_string(head[0]));
  size_ = head[1];
  if (size_ > 0) decoder_ = std::make_unique<Decoder>(file, offset + sizeof head);
}

ChunkTableReader::~ChunkTableReader() = default;

ChunkTableReader::Entry ChunkTableReader::next() {
  if (with_points_) last_.points = decoder_->next_number(last_.points, 0);
  last_.bytes = decoder_->next_number(last_.bytes, 1);
  return last_;
}

}  // namespace pcl_bv::detail
