// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The bounds that docs/numerics.md derives.

#include "support_plan.h"

#include <cmath>
#include <cstring>
#include <limits>

#include "pcl_bv/kernels/chunks.h"
#include "pcl_bv/numeric/constants.h"
#include "pcl_bv/numeric/directed.h"
#include "pcl_bv/numeric/vector3.h"
#include "preconditions.h"

namespace pcl_bv {
bool central_point(const PointView& points, Coordinates& center) {
  for (std::size_t i = 0; i < points.count; ++i) {
    center = load_point(points, (points.count / 2 + i) % points.count);
    if (is_valid(center)) return true;
  }
  return false;
}

SupportPlan::SupportPlan(const SupportDirections& set, std::size_t direction, const Spread& spread,
                         ScalarType scalar)
    : scaled_(set.scaled[direction]), center_(spread.center), is_float_(scalar == ScalarType::float32) {
  const double unit = is_float_ ? 0x1p-24 : kU;
  const double least = is_float_ ? 0x1p-149 : 0x1p-1074;
  const double greatest = is_float_ ? static_cast<double>(std::numeric_limits<float>::max()) : 1e300;
  const auto& s = spread.greatest;
  const auto flat = [&](std::size_t axis) { return set.exact[direction][axis] == 0 || s[axis] == 0; };
  constant_ = flat(0) && flat(1) && flat(2);  // p - c is 0 only if p is c
  size_ = dot3(magnitudes(scaled_), s);
  overflow_ = !(size_ <= 0.99 * greatest);  // of infinite spreads it may be NaN
  if (set.cube) {
    // Only additions. A single term cannot swap two points, since x - c is monotone.
    const double terms = taxicab3(scaled_);
    error_ = 4 * unit * size_;
    pair_error_ = (terms == 1 ? 0 : terms == 2 ? 5.2 : 7.2) * unit * size_;
  } else {
    error_ = 5.1 * unit * size_ + least * ((s[0] + s[1]) + s[2] + 4);
    pair_error_ = 2 * error_ + unit * size_;
  }
}

bool SupportPlan::reaches(bool high, double top, double reached) const {
  if (reached == -kInfinity) return true;
  const double offset = dot3(scaled_, center_);
  const double error = error_ + 0x1p-49 * size_ + double_error(scaled_, center_);
  return !(top + (high ? offset : -offset) + error < reached);
}

EndSearch SupportPlan::of(bool high, double top, double reached) const {
  if (constant_) return {EndSearch::Kind::every, 0};
  if (overflow_) return {EndSearch::Kind::some, -kInfinity};  // sums say nothing
  if (!reaches(high, top, reached)) return {EndSearch::Kind::none, 0};
  const double threshold = top - pair_error_;
  return {EndSearch::Kind::some, is_float_ ? float_down(threshold) : threshold};
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

template <typename T>
SupportLook<T>::SupportLook(const PointView& points, const SupportDirections& set, std::size_t end,
                            const RoundedFilter& filter)
    : points_(points), direction_(set.end_direction(end)), threshold_(static_cast<T>(filter.threshold)) {
  const Direction scaled = set.scaled_end_direction(end);
  const Coordinates& center = filter.center;
  for (std::size_t axis = 0; axis < 3; ++axis)
    scaled_[axis] = static_cast<T>(scaled[axis]);
  center_ = {static_cast<T>(center.x), static_cast<T>(center.y), static_cast<T>(center.z)};
}

// Nearly no point passes, so the loop over the others is what counts. `address` gives where a point's x is,
// `gap` the bytes from there to y and on to z.
template <typename T>
template <typename Address>
void SupportLook<T>::find_passing(const Address& address, std::size_t gap, std::size_t first,
                                  std::size_t step, std::size_t last, SupportPoint& best) const {
  const T a = scaled_[0], b = scaled_[1], c = scaled_[2];
  const T x = center_[0], y = center_[1], z = center_[2];
  const T threshold = threshold_;
  T p[3];
  const auto rejects = [&](std::size_t i) {
    for (std::size_t axis = 0; axis < 3; ++axis)
      std::memcpy(&p[axis], address(i) + axis * gap, sizeof(T));
    return (a * (p[0] - x) + b * (p[1] - y)) + c * (p[2] - z) < threshold;  // an overflown sum may be NaN
  };
  for (std::size_t i = first; i < last; i += step) {
    // A loop of its own: the calls below would keep the filter out of registers.
    while (rejects(i)) {
      i += step;
      if (i >= last) return;
    }
    const Coordinates point{p[0], p[1], p[2]};
    if (is_valid(point)) keep_farther(direction_, {true, point, points_.index(i)}, best);
  }
}

template <typename T>
void SupportLook<T>::operator()(std::size_t first, std::size_t step, std::size_t last,
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

template class SupportLook<float>;
template class SupportLook<double>;

void chunk_supports(UsableIsa isa, const PointView& chunk, const SupportDirections& set,
                    const ReachedSupports& reached, ChunkSupports& out) {
  require_in_memory(chunk, kChunkPoints);
  require_at_most(kMaxSupportDirections, set.count, "directions");
  out = ChunkSupports();
  (set.cube ? cube_supports : own_supports)(isa, chunk, set, reached, out);
}

}  // namespace pcl_bv
