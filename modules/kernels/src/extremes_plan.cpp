// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "extremes_plan.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "pcl_bv/numeric/constants.h"
#include "pcl_bv/numeric/directed.h"
#include "pcl_bv/numeric/vector3.h"

namespace pcl_bv {
namespace {

// The rounded difference of two points' rounded projections may be off by this many u times the sum of the
// magnitudes: for each point the subtraction of the centre and one or two additions; for doubles also the
// difference itself. One term: no rounding can swap two points, since x - c is monotone.
double doubt(int terms) {
  return terms == 1 ? 0 : terms == 2 ? 5.2 : 7.2;
}

// The mean of a few valid points: inside their hull, in its box exactly.
class SampleMean {
 public:
  void add(const Coordinates& p) {
    if (!is_valid(p)) return;
    ++count_;
    low_ = {std::min(low_.x, p.x), std::min(low_.y, p.y), std::min(low_.z, p.z)};
    high_ = {std::max(high_.x, p.x), std::max(high_.y, p.y), std::max(high_.z, p.z)};
    sum_ = {sum_.x + p.x, sum_.y + p.y, sum_.z + p.z};
  }
  bool empty() const { return count_ == 0; }
  Coordinates value() const {
    return {std::clamp(sum_.x / count_, low_.x, high_.x), std::clamp(sum_.y / count_, low_.y, high_.y),
            std::clamp(sum_.z / count_, low_.z, high_.z)};
  }

 private:
  double count_ = 0;
  Coordinates low_{kInfinity, kInfinity, kInfinity};
  Coordinates high_{-kInfinity, -kInfinity, -kInfinity};
  Coordinates sum_{0, 0, 0};
};

}  // namespace

bool chunk_center(const PointView& chunk, Coordinates& center) {
  constexpr std::size_t samples = 16;
  SampleMean mean;
  const std::size_t taken = std::min(samples, chunk.count);
  for (std::size_t s = 0; s < taken; ++s)
    mean.add(load_point(chunk, (2 * s + 1) * chunk.count / (2 * taken)));
  for (std::size_t i = 0; mean.empty() && i < chunk.count; ++i)
    mean.add(load_point(chunk, i));
  if (mean.empty()) return false;
  center = mean.value();
  if (chunk.scalar == ScalarType::float32) {
    center = {static_cast<float>(center.x), static_cast<float>(center.y), static_cast<float>(center.z)};
  }
  return true;
}

SearchPlan::SearchPlan(DirectionSet set, const RoundedEnds& top, const Coordinates& center, ScalarType scalar)
    : set_(set), top_(top), center_(center), is_float_(scalar == ScalarType::float32), magnitude_(0) {
  for (std::size_t axis = 0; axis < 3; ++axis)
    magnitude_ += std::max(top[2 * axis], top[2 * axis + 1]);
  // Of the rounded projections, then of adding the centre's.
  const double unit = is_float_ ? 0x1p-24 : kU;
  const double far = taxicab3(center) + magnitude_;
  offset_error_ = 4 * unit * magnitude_ + 0x1p-49 * far;
}

EndSearch SearchPlan::of(std::size_t end, double reached) const {
  const CubeDirection d = end_direction(set_, end);
  const double offset = dot3(d, center_);
  if (top_[end] + offset + offset_error_ < reached) return {EndSearch::Kind::none, 0};
  const int terms = term_count(d);
  // x - c is 0 only if x is c; so are sums of such.
  if (magnitude_ == 0 || (terms == 1 && top_[end] == 0 && top_[end ^ 1U] == 0)) {
    return {EndSearch::Kind::every, 0};
  }
  const bool overflow = is_float_ && !(magnitude_ <= static_cast<double>(std::numeric_limits<float>::max()));
  // Rounded, the centre may lie beyond all points of a flat chunk (never along an axis).
  const bool beyond = top_[end] == 0 && terms > 1;
  if (overflow || beyond) return {EndSearch::Kind::some, -kInfinity};
  const double threshold = top_[end] - doubt(terms) * (is_float_ ? 0x1p-24 : kU) * magnitude_;
  return {EndSearch::Kind::some, is_float_ ? float_down(threshold) : threshold};
}

bool first_valid_point(const PointView& points, Coordinates& point, std::size_t& index) {
  bool found = false;
  for (std::size_t i = 0; i < points.count; ++i) {
    const Coordinates p = load_point(points, i);
    if (!is_valid(p) || (found && index < points.index(i))) continue;
    point = p;
    index = points.index(i);
    found = true;
    if (points.indices == nullptr) break;
  }
  return found;
}

}  // namespace pcl_bv
