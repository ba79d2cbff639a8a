// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The bytes of a Partial. All numbers are little-endian, as in memory on every machine that pcl_bv supports.
//   "PCLBVPRT"  version: u32  scalar: u32 (4 or 8 bytes)  used, dropped: u64  26 support points
//   loose points, extreme points, nodes of moments: for each list u64 count, then the elements
//   CRC-32 of all bytes before: u32

// The member functions of Partial that need no kernels are also defined in this file. Therefore the fuzzer of
// the bytes needs no kernels.

#include <algorithm>
#include <boost/crc.hpp>
#include <cstdint>
#include <cstring>
#include <limits>
#include <stdexcept>
#include <string>

#include "partial/partial_state.h"

namespace pcl_bv {
using namespace detail;

void detail::require_apart(const PartialState& state) {
  bool apart = true;
  std::size_t free = 0;
  for (const MomentNode& node : state.blocks) {
    const NumberedPoint first{node.first * kBlockPoints, {}};
    const auto loose = std::lower_bound(state.loose.begin(), state.loose.end(), first);
    apart = apart && node.first >= free;
    free = node.first + node.blocks;
    apart = apart && (loose == state.loose.end() || block_of_number(loose->number) >= free);
  }
  require_disjoint(apart);
}

namespace {

constexpr char kMagic[8] = {'P', 'C', 'L', 'B', 'V', 'P', 'R', 'T'};
constexpr std::uint32_t kVersion = 1;

void require(bool good, const char* what) {
  if (!good) throw std::invalid_argument(std::string("partial results: ") + what);
}

std::uint32_t checksum(const std::byte* bytes, std::size_t size) {
  boost::crc_32_type sum;
  sum.process_bytes(bytes, size);
  return sum.checksum();
}

class Writer {
 public:
  template <typename T>
  void operator()(const T& value) {
    static_assert(std::is_arithmetic_v<T>);
    const auto* const first = reinterpret_cast<const std::byte*>(&value);
    bytes_.insert(bytes_.end(), first, first + sizeof value);
  }

  std::vector<std::byte> finish() {
    (*this)(checksum(bytes_.data(), bytes_.size()));
    return std::move(bytes_);
  }

 private:
  std::vector<std::byte> bytes_;
};

class Reader {
 public:
  Reader(const std::byte* bytes, std::size_t size) : next_(bytes), left_(size) {}

  template <typename T>
  void operator()(T& value) {
    static_assert(std::is_arithmetic_v<T>);
    require(left_ >= sizeof value, "truncated");
    std::memcpy(&value, next_, sizeof value);
    next_ += sizeof value;
    left_ -= sizeof value;
  }

  std::size_t left() const { return left_; }

 private:
  const std::byte* next_;
  std::size_t left_;
};

// The transfer functions both write and read. Io is Writer or Reader. For a Writer the other arguments are
// const.

template <typename Io, typename Point>
void transfer_point(Io& io, Point& p) {
  io(p.x);
  io(p.y);
  io(p.z);
}

template <typename Io, typename Node>
void transfer_node(Io& io, Node& node) {
  io(node.first);
  io(node.blocks);
  io(node.moments.count);
  transfer_point(io, node.moments.origin);
  io(node.moments.exponent);
  for (auto& sum : node.moments.sum)
    io(sum);
  for (auto& product : node.moments.product)
    io(product);
}

template <typename Io, typename State>
void transfer_head(Io& io, State& state) {
  io(state.used);
  io(state.dropped);
  for (auto& p : state.support_points) {
    io(p.index);
    transfer_point(io, p.point);
  }
}

template <typename Io, typename Point>
void transfer_numbered(Io& io, Point& p) {
  io(p.number);
  transfer_point(io, p.point);
}

void write(const NumberedPoints& points, Writer& out) {
  out(points.size());
  for (const NumberedPoint& p : points)
    transfer_numbered(out, p);
}

// Reads the number of elements that follow. Each element has `element` bytes.
std::size_t read_count(Reader& in, std::size_t element) {
  std::size_t count = 0;
  in(count);
  require(count <= in.left() / element, "truncated");
  return count;
}

NumberedPoints read_points(Reader& in) {
  NumberedPoints points(read_count(in, 32));
  for (NumberedPoint& p : points) {
    transfer_numbered(in, p);
    const bool ascending = &p == points.data() || (&p)[-1] < p;
    require(ascending, "point numbers are not ascending");
  }
  return points;
}

// The largest number of blocks such that the number of every point fits in a std::size_t.
constexpr std::size_t kMostBlocks = std::numeric_limits<std::size_t>::max() / kBlockPoints;

MomentTree read_tree(Reader& in) {
  MomentTree tree;
  for (std::size_t left = read_count(in, 124); left > 0; --left) {
    MomentNode node{};
    transfer_node(in, node);
    const bool aligned = node.blocks > 0 && node.blocks <= kMostBlocks &&
                         node.first <= kMostBlocks - node.blocks && (node.blocks & (node.blocks - 1)) == 0 &&
                         node.first % node.blocks == 0;
    require(aligned, "a moment node has misaligned blocks");
    const int exponent = node.moments.exponent;
    require(exponent == 0 || exponent == 500 || exponent == 1000,
            "a moment node has an unknown exponent (allowed: 0, 500, 1000)");
    tree.append(node);
  }
  return tree;
}

PartialState read_state(Reader& in, ScalarType scalar) {
  PartialState state;
  state.scalar = scalar;
  transfer_head(in, state);
  state.loose = read_points(in);
  state.extreme = read_points(in);
  state.blocks = read_tree(in);
  require(in.left() == 0, "unexpected bytes at the end");
  require(state.used <= std::numeric_limits<std::size_t>::max() - state.dropped, "inconsistent point counts");
  require(state.stores_all() ? state.loose.size() <= Partial::kMaxStored : state.size() > Partial::kMaxStored,
          "inconsistent point counts");
  require((state.used > 0) != state.extreme.empty(), "inconsistent point counts");
  for (const NumberedPoint& p : state.extreme)
    require(is_valid(p.point), "an extreme point is not finite");
  for (SupportPoint& p : state.support_points) {
    p.found = state.used > 0;
    require(is_valid(p.point), "an extreme point is not finite");
  }
  require_apart(state);
  return state;
}

}  // namespace

Partial::Partial() : state_(std::make_shared<PartialState>()) {}

std::size_t Partial::size() const {
  return state_->size();
}

std::vector<std::byte> Partial::to_bytes() const {
  Writer out;
  for (const char c : kMagic)
    out(c);
  out(kVersion);
  out(static_cast<std::uint32_t>(size_of(state_->scalar)));
  transfer_head(out, *state_);
  write(state_->loose, out);
  write(state_->extreme, out);
  out(static_cast<std::size_t>(state_->blocks.end() - state_->blocks.begin()));
  for (const MomentNode& node : state_->blocks)
    transfer_node(out, node);
  return out.finish();
}

Partial Partial::from_bytes(const std::byte* bytes, std::size_t size) {
  constexpr std::size_t sum_size = sizeof(std::uint32_t);
  require(size >= sizeof kMagic + sum_size && std::memcmp(bytes, kMagic, sizeof kMagic) == 0,
          "the header PCLBVPRT is missing");
  std::uint32_t sum = 0, version = 0, scalar = 0;
  std::memcpy(&sum, bytes + size - sum_size, sum_size);
  Reader in(bytes + sizeof kMagic, size - sizeof kMagic - sum_size);
  in(version);
  require(version == kVersion, "unsupported version (allowed: 1)");
  require(sum == checksum(bytes, size - sum_size), "wrong checksum");
  in(scalar);
  require(scalar == 4 || scalar == 8, "unknown scalar size (allowed: 4 or 8 bytes)");
  Partial partial;
  const ScalarType type = scalar == 4 ? ScalarType::float32 : ScalarType::float64;
  partial.state_ = std::make_shared<PartialState>(read_state(in, type));
  return partial;
}

}  // namespace pcl_bv
