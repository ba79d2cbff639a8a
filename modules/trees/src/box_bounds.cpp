// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// All sums in this file are in double, and their terms are below a few times 1 + |point|. So the errors of
// the sums are below 2^-45 (1 + |point|). VolumeBoxes::margin() is 2^-20 (1 + |point|) and covers these
// errors, so the bounds need no other margin.

#include "box_bounds.h"

#include <algorithm>
#include <cmath>

#include "pcl_bv/numeric/constants.h"
#include "vectors.h"

namespace pcl_bv::detail {
namespace {

// Clips [enter, exit] to the t with low <= start + t slope <= high.
void clip(double start, double slope, double low, double high, double& enter, double& exit) {
  if (slope == 0) {
    if (start < low || start > high) exit = -kInfinity;
    return;
  }
  const double a = (low - start) / slope, b = (high - start) / slope;
  enter = std::max(enter, std::min(a, b));
  exit = std::min(exit, std::max(a, b));
}

// Returns the t >= 0 at which the ray enters the box, or infinity if the interval from `enter` to `exit` is
// empty. ray.underflow_margin covers the error that underflow in intersect() may cause.
double entered(const FrameRay& ray, double enter, double exit) {
  return enter - ray.underflow_margin <= exit + ray.underflow_margin
             ? std::max(0.0, enter - ray.underflow_margin)
             : kInfinity;
}

}  // namespace

FramePoint::FramePoint(const VolumeBoxes& boxes, const Coordinates& point) {
  at = (vector(point) - vector(boxes.levels().origin)) * boxes.levels().scale;
  margin = VolumeBoxes::margin(at.cwiseAbs().maxCoeff());
}

FrameRay::FrameRay(const VolumeBoxes& boxes, const Coordinates& origin, const Coordinates& direction)
    : from(boxes, origin) {
  const int length = std::ilogb(vector(direction).cwiseAbs().maxCoeff());
  u = vector(direction).unaryExpr([&](double x) { return std::ldexp(x, -length); });
  exponent = length + std::ilogb(boxes.levels().scale);
  underflow_margin = std::ldexp(0x1p-1020, exponent);
}

double FrameRay::time(double t) const {
  return std::ldexp(t, exponent);
}

double distance_to_box(const FramePoint& point, const BoxGroup& group, std::size_t k) {
  double squares = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double at = point.at[axis],
                 gap = std::max(0.0, std::max(group.low[axis][k] - at, at - group.high[axis][k]));
    squares += gap * gap;
  }
  return std::max(0.0, std::sqrt(squares) - 2 * point.margin);
}

double enter_box(const FrameRay& ray, const BoxGroup& group, std::size_t k) {
  if (group.low[0][k] > group.high[0][k]) return kInfinity;  // empty
  double enter = 0, exit = kInfinity;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    clip(ray.from.at[axis], ray.u[axis], group.low[axis][k] - ray.from.margin,
         group.high[axis][k] + ray.from.margin, enter, exit);
  }
  return entered(ray, enter, exit);
}

}  // namespace pcl_bv::detail
