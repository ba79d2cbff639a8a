// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "spatial_order.h"

#include <algorithm>
#include <utility>

#include "pcl_bv/parallel/parts.h"

namespace pcl_bv {
namespace {

constexpr unsigned kBits = 10;          // of a cell's number along an axis
constexpr std::size_t kCrowd = 64;      // points that a cell may hold unsorted
constexpr int kDepth = 8;               // cubes in cubes
constexpr std::size_t kFew = 1024;      // what std::sort does in less time than three passes over 1024 counters

// The number, on Hilbert's curve, of a cell. Skilling 2004: AxestoTranspose, then the bits of the three in turn.
inline std::uint32_t hilbert_number(std::uint32_t x, std::uint32_t y, std::uint32_t z) {
  for (std::uint32_t q = 1U << (kBits - 1); q > 1; q >>= 1) {
    const std::uint32_t below = q - 1;
    const auto turn = [&](std::uint32_t& axis) {
      const std::uint32_t invert = (axis & q) != 0 ? below : 0;
      const std::uint32_t swap = (x ^ axis) & below & ~invert;
      x ^= invert | swap;
      axis ^= swap;
    };
    x ^= (x & q) != 0 ? below : 0;
    turn(y);
    turn(z);
  }
  y ^= x;
  z ^= y;
  std::uint32_t flip = 0;
  for (std::uint32_t q = 1U << (kBits - 1); q > 1; q >>= 1)
    flip ^= (z & q) != 0 ? q - 1 : 0;
  const auto spread = [&](std::uint32_t axis) {
    std::uint32_t v = axis ^ flip;
    v = (v | v << 16) & 0x030000FFU;
    v = (v | v << 8) & 0x0300F00FU;
    v = (v | v << 4) & 0x030C30C3U;
    return (v | v << 2) & 0x09249249U;
  };
  return spread(x) << 2 | spread(y) << 1 | spread(z);
}

// Cells of a cube around places.
struct Cube {
  Coordinates low;
  double cells;  // a unit of length

  explicit Cube(const PlaceBounds& bounds) : low(bounds.low) {
    const double extent = std::max({bounds.high.x - low.x, bounds.high.y - low.y, bounds.high.z - low.z});
    cells = extent > 1e-290 ? ((1U << kBits) - 0x1p-20) / extent : 0;
  }

  // Of a valid place within the bounds. `place` by value: so the loop over places is one of vectors.
  std::uint32_t cell(double x, double y, double z) const {
    return hilbert_number(static_cast<std::uint32_t>(static_cast<std::int32_t>((x - low.x) * cells)),
                          static_cast<std::uint32_t>(static_cast<std::int32_t>((y - low.y) * cells)),
                          static_cast<std::uint32_t>(static_cast<std::int32_t>((z - low.z) * cells)));
  }
};

std::uint64_t keyed(std::uint32_t key, std::uint32_t number) {
  return std::uint64_t{key} << 32 | number;
}

std::uint32_t key_of(std::uint64_t keyed) {
  return static_cast<std::uint32_t>(keyed >> 32);
}

std::uint32_t number_of(std::uint64_t keyed) {
  return static_cast<std::uint32_t>(keyed);
}

struct SortPart {
  std::size_t begin = 0, end = 0;
  std::array<std::uint32_t, 1U << kBits> places{};
};

// By `kBits` bits of the key from `shift` on; what is equal there stays as it is.
void sort_pass(const std::uint64_t* from, std::uint64_t* to, unsigned shift, Parts<SortPart>& parts,
               const ParallelPolicy& policy) {
  const auto digit = [shift](std::uint64_t keyed) { return keyed >> (32 + shift) & ((1U << kBits) - 1); };
  parts.for_each(policy, [&](SortPart& part) {
    part.places.fill(0);
    for (std::size_t i = part.begin; i < part.end; ++i)
      ++part.places[digit(from[i])];
  });
  std::uint32_t place = 0;
  for (std::size_t value = 0; value < 1U << kBits; ++value) {
    for (SortPart& part : parts)
      place += std::exchange(part.places[value], place);
  }
  parts.for_each(policy, [&](SortPart& part) {
    for (std::size_t i = part.begin; i < part.end; ++i)
      to[part.places[digit(from[i])]++] = from[i];
  });
}

void sort_keyed(std::uint64_t* keyed, std::uint64_t* buffer, std::size_t count, const ParallelPolicy& policy) {
  if (count <= kFew) {
    std::sort(keyed, keyed + count);
    return;
  }
  Parts<SortPart> parts;
  parts.cut(count, policy);
  sort_pass(keyed, buffer, 0, parts, policy);
  sort_pass(buffer, keyed, kBits, parts, policy);
  sort_pass(keyed, buffer, 2 * kBits, parts, policy);
  parts.for_each(policy, [&](const SortPart& part) {
    std::copy(buffer + part.begin, buffer + part.end, keyed + part.begin);
  });
}

// Calls run(begin, end) for the cells that hold more than kCrowd.
template <typename Run>
void for_each_crowd(const std::uint64_t* keyed, std::size_t begin, std::size_t end, const Run& run) {
  for (std::size_t i = begin; i < end;) {
    std::size_t next = i + 1;
    while (next < end && key_of(keyed[next]) == key_of(keyed[i]))
      ++next;
    if (next - i > kCrowd) run(i, next);
    i = next;
  }
}

template <typename T>
PlaceBounds bounds_of(const ItemPlaces<T>& places, const std::uint64_t* keyed, std::size_t count) {
  T low[3], high[3];
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const T* const at = places.axis[axis];
    low[axis] = high[axis] = at[number_of(keyed[0])];
    for (std::size_t i = 1; i < count; ++i) {
      low[axis] = std::min(low[axis], at[number_of(keyed[i])]);
      high[axis] = std::max(high[axis], at[number_of(keyed[i])]);
    }
  }
  return {{low[0], low[1], low[2]}, {high[0], high[1], high[2]}};
}

// Sorts places that are in one cell, in the order of their numbers, by the cells of a cube around them.
template <typename T>
void sort_crowd(const ItemPlaces<T>& places, std::uint64_t* crowd, std::uint64_t* buffer, std::size_t count,
                int depth) {
  const Cube cube(bounds_of(places, crowd, count));
  if (cube.cells == 0 || depth == kDepth) return;
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint32_t number = number_of(crowd[i]);
    crowd[i] = keyed(cube.cell(places.axis[0][number], places.axis[1][number], places.axis[2][number]), number);
  }
  sort_keyed(crowd, buffer, count, Serial{});
  for_each_crowd(crowd, 0, count, [&](std::size_t begin, std::size_t end) {
    sort_crowd(places, crowd + begin, buffer + begin, end - begin, depth + 1);
  });
}

}  // namespace

template <typename T>
void SpatialOrder::sort(const ItemPlaces<T>& places, const PlaceBounds& bounds, const ParallelPolicy& policy) {
  count_ = places.count;
  keyed_.resize(count_);
  buffer_.resize(count_);
  Parts<SortPart> parts;
  parts.cut(count_, policy);
  const Cube cube(bounds);
  parts.for_each(policy, [&](const SortPart& part) {
    const T* const x = places.axis[0];
    const T* const y = places.axis[1];
    const T* const z = places.axis[2];
    for (std::size_t i = part.begin; i < part.end; ++i)
      keyed_[i] = keyed(cube.cell(x[i], y[i], z[i]), static_cast<std::uint32_t>(i));
  });
  sort_keyed(keyed_.data(), buffer_.data(), count_, policy);
  std::vector<std::pair<std::size_t, std::size_t>> crowds;
  for_each_crowd(keyed_.data(), 0, count_,
                 [&](std::size_t begin, std::size_t end) { crowds.emplace_back(begin, end); });
  for_each_chunk(policy, crowds.size(), [&](std::size_t c) {
    const auto [begin, end] = crowds[c];
    sort_crowd(places, keyed_.data() + begin, buffer_.data() + begin, end - begin, 1);
  });
}

template void SpatialOrder::sort(const ItemPlaces<float>&, const PlaceBounds&, const ParallelPolicy&);
template void SpatialOrder::sort(const ItemPlaces<double>&, const PlaceBounds&, const ParallelPolicy&);

}  // namespace pcl_bv
