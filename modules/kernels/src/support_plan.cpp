// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The error bounds are derived in docs/numerics.md.

#include "support_plan.h"

#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>

#include "pcl_bv/numeric/constants.h"
#include "pcl_bv/numeric/directed.h"
#include "pcl_bv/numeric/vector3.h"
#include "pcl_bv/points/point_source.h"
#include "preconditions.h"

namespace pcl_bv::detail {
// Chooses, from up to eight valid samples, the one nearest to their mean. If no sample is valid, chooses the
// first valid point. A sample near the mean is rarely a support point. If the centre were a support point,
// the maximum projection would be 0. Every lane would have this maximum, and all points would have to be
// compared, which takes 0.4 us for 300 points.
bool central_point(const PointView& points, Coordinates& center) {
  constexpr std::size_t samples = 8;
  std::array<Coordinates, samples> sample;
  Coordinates sum{};
  std::size_t valid = 0;
  for (std::size_t k = 0; k < samples && k < points.count; ++k) {
    const Coordinates p = load_point(points, (2 * k + 1) * points.count / (2 * samples));
    if (!is_valid(p)) continue;
    sample[valid++] = p;
    sum = {sum.x + p.x, sum.y + p.y, sum.z + p.z};
  }
  double least = kInfinity;
  const double share = 1 / static_cast<double>(valid);
  for (std::size_t k = 0; k < valid; ++k) {
    const Coordinates& p = sample[k];
    const double distance =
        std::abs(p.x - share * sum.x) + std::abs(p.y - share * sum.y) + std::abs(p.z - share * sum.z);
    if (distance >= least) continue;
    least = distance;
    center = p;
  }
  if (valid > 0) return true;
  for (std::size_t i = 0; i < points.count; ++i) {
    center = load_point(points, i);
    if (is_valid(center)) return true;
  }
  return false;
}

SupportPlan::SupportPlan(const SupportDirections& set, std::size_t direction, const CenteredExtent& extent,
                         ScalarType scalar)
    : scaled_(set.scaled[direction]), center_(extent.center), is_float_(scalar == ScalarType::float32) {
  const double unit = is_float_ ? 0x1p-24 : kUnitRoundoff;
  const double least = is_float_ ? 0x1p-149 : 0x1p-1074;
  const double greatest = is_float_ ? static_cast<double>(std::numeric_limits<float>::max()) : 1e300;
  const auto& s = extent.max_magnitude;
  const auto flat = [&](std::size_t axis) { return set.exact[direction][axis] == 0 || s[axis] == 0; };
  constant_ = flat(0) && flat(1) && flat(2);  // p - c rounds to 0 only if p is c
  size_ = dot3(magnitudes(scaled_), s);
  overflow_ = !(size_ <= 0.99 * greatest);  // size_ may be NaN for infinite extents
  if (set.cube) {
    // Projections need additions only. Projections of one term keep the order of points, since the rounded x
    // - c never decreases if x increases.
    const double terms = taxicab3(scaled_);
    error_ = 4 * unit * size_;
    pair_error_ = (terms == 1 ? 0 : terms == 2 ? 5.2 : 7.2) * unit * size_;
  } else {
    error_ = 5.1 * unit * size_ + least * ((s[0] + s[1]) + s[2] + 4);
    pair_error_ = 2 * error_ + unit * size_;
  }
}

bool SupportPlan::may_exceed(bool high, double top, double bound) const {
  if (bound == -kInfinity) return true;
  const double offset = dot3(scaled_, center_);
  const double error = error_ + 0x1p-49 * size_ + double_error(scaled_, center_);
  return !(top + (high ? offset : -offset) + error < bound);
}

SupportCandidates SupportPlan::of(bool high, double top, double bound) const {
  if (constant_) return {SupportCandidates::Kind::every, 0};
  if (overflow_) return {SupportCandidates::Kind::some, -kInfinity};  // overflowing sums decide nothing
  if (!may_exceed(high, top, bound)) return {SupportCandidates::Kind::none, 0};
  const double threshold = top - pair_error_;
  return {SupportCandidates::Kind::some, is_float_ ? float_down(threshold) : threshold};
}

SupportPoint first_valid_point(const PointView& points) {
  SupportPoint first;
  for (std::size_t i = 0; i < points.count; ++i) {
    const Coordinates p = load_point(points, i);
    if (!is_valid(p) || (first.found && first.index < points.index(i))) continue;
    first = {true, p, points.index(i)};
    if (points.indices == nullptr) break;
  }
  return first;
}

namespace {

template <typename T>
T loaded(const std::byte* from) {
  T value;
  std::memcpy(&value, from, sizeof(T));
  return value;
}

}  // namespace

template <typename T>
ExactSupportSearch<T>::ExactSupportSearch(const PointView& points, const SupportDirections& set,
                                          std::size_t support, const RoundedFilter& filter)
    : points_(points),
      direction_(set.support_direction(support)),
      threshold_(static_cast<T>(filter.threshold)) {
  const Direction scaled = set.scaled_support_direction(support);
  const Coordinates& center = filter.center;
  for (std::size_t axis = 0; axis < 3; ++axis)
    scaled_[axis] = static_cast<T>(scaled[axis]);
  center_ = {static_cast<T>(center.x), static_cast<T>(center.y), static_cast<T>(center.z)};
}

// Tests 64 points at a time and stores the results as bits, because a branch per point costs more than the
// arithmetic. Calls compete() for the points that pass. `address` returns the address of a point's x. y is
// `gap` bytes after x, and z is `gap` bytes after y.
template <typename T>
template <typename Address>
void ExactSupportSearch<T>::find_passing(const Address& address, std::size_t gap, std::size_t first,
                                         std::size_t step, std::size_t last, SupportPoint& best) const {
  const T a = scaled_[0], b = scaled_[1], c = scaled_[2];
  const T x = center_[0], y = center_[1], z = center_[2];
  const T threshold = threshold_;
  const auto passes = [&](std::size_t i) {
    const std::byte* p = address(i);
    const T sum = (a * (loaded<T>(p) - x) + b * (loaded<T>(p + gap) - y)) + c * (loaded<T>(p + 2 * gap) - z);
    return !(sum < threshold);  // an overflowing sum may be NaN
  };
  for (std::size_t begin = first; begin < last; begin += 64 * step) {
    std::uint64_t passing = 0;
    std::size_t i = begin;
    for (int bit = 0; bit < 64 && i < last; ++bit, i += step)
      passing |= static_cast<std::uint64_t>(passes(i)) << bit;
    for (; passing != 0; passing &= passing - 1)
      compete(begin + static_cast<std::size_t>(std::countr_zero(passing)) * step, best);
  }
}

template <typename T>
void ExactSupportSearch<T>::compete(std::size_t i, SupportPoint& best) const {
  const Coordinates point = load_point(points_, i);
  if (is_valid(point)) keep_larger_projection(direction_, {true, point, points_.index(i)}, best);
}

template <typename T>
void ExactSupportSearch<T>::operator()(std::size_t first, std::size_t step, std::size_t last,
                                       SupportPoint& best) const {
  if (first >= last) return;
  if (points_.order == PointOrder::records && points_.indices == nullptr) {
    const auto address = [data = points_.data, stride = points_.stride](std::size_t i) {
      return data + stride * i;
    };
    find_passing(address, sizeof(T), first, step, last, best);
  } else {
    const auto address = [&](std::size_t i) { return points_.address(i); };
    find_passing(address, points_.step(), first, step, last, best);
  }
}

template class ExactSupportSearch<float>;
template class ExactSupportSearch<double>;

void chunk_supports(UsableIsa isa, const PointView& chunk, const SupportDirections& set,
                    const SupportBounds& bounds, ChunkSupports& out) {
  require_in_memory(chunk, kChunkPoints);
  require_at_most(kMaxSupportDirections, set.count, "directions");
  out = ChunkSupports();
  (set.cube ? cube_supports : general_supports)(isa, chunk, set, bounds, out);
}

}  // namespace pcl_bv::detail
