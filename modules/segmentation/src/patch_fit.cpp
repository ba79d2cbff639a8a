// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// A histogram of heights over the expected plane says where the ground is, least squares how it lies.
#include "patch_fit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace pcl_bv {
namespace {

constexpr double bin_height = 0.1;  // metres; a layer is two bins thick
constexpr std::size_t max_bins = 24;
constexpr std::size_t bins_above = 8;
constexpr std::uint32_t min_points = 6;

// A ramp holds so many of the points near it in a layer.
constexpr double ramp_share = 0.7;

// Points of a fit are so far below the plane at most, and half as far above it, where feet of walls and
// hedges are: of the layer, then of the first fit. A curb passes.
constexpr double layer_reach = 0.2;
constexpr double plane_reach = 0.15;

// The tilt expected is worth as much as points whose squared distances from the centre add up to this: a
// constant, so that a single scan line, which says nothing of the tilt across, keeps it; and a share per
// point, so that one patch with half a curb or hedge in it does not send its outer neighbours up. m^2.
constexpr double tilt_weight = 2;
constexpr double tilt_weight_per_point = 0.3;

// Points that are looked at together: first their heights, of which compilers make vectors.
constexpr std::size_t kBatch = 256;

void find_heights(const Slope& plane, const Patch& patch, std::size_t begin, std::size_t count,
                  double* above) {
  const float *u = patch.u + begin, *v = patch.v + begin, *height = patch.height + begin;
  for (std::size_t i = 0; i < count; ++i)
    above[i] = height[i] - plane.height(u[i], v[i]);
}

// Points by height above the expected plane less gate.
struct Histogram {
  std::array<std::uint32_t, max_bins + bins_above> count{};
  std::size_t bins;  // In which a layer may begin or end.

  std::uint32_t layer(std::size_t i) const { return count[i] + count[i + 1]; }

  // Above a layer of a wall, hedge or car are as many points as in it, and above reflections is the ground;
  // above the ground are few.
  bool is_ground(std::size_t i) const {
    std::uint32_t higher = 0;
    for (std::size_t k = i + 2; k < i + 2 + bins_above && k < count.size(); ++k)
      higher += count[k];
    return layer(i) >= higher;
  }
};

Histogram histogram(const std::vector<double>& above, double gate) {
  Histogram heights;
  heights.bins = std::min(max_bins, static_cast<std::size_t>(std::ceil(2 * gate / bin_height)));
  const auto end = static_cast<double>(heights.bins + bins_above);
  std::array<std::array<std::uint32_t, max_bins + bins_above + 1>, 2> counts{};  // neighbours share a bin
  std::array<std::int32_t, kBatch> bins;
  for (std::size_t begin = 0; begin < above.size(); begin += kBatch) {
    const std::size_t count = std::min(kBatch, above.size() - begin);
    for (std::size_t i = 0; i < count; ++i) {
      const double bin = (above[begin + i] + gate) / bin_height;
      bins[i] = static_cast<std::int32_t>(bin >= 0 && bin < end ? bin : max_bins + bins_above);
    }
    for (std::size_t i = 0; i < count; ++i)
      ++counts[i % 2][static_cast<std::size_t>(bins[i])];
  }
  for (std::size_t i = 0; i < heights.count.size(); ++i)
    heights.count[i] = counts[0][i] + counts[1][i];
  return heights;
}

// Height of the ground's layer's middle above the expected plane.
std::optional<double> lowest_layer(const Histogram& heights, double gate) {
  for (std::size_t i = 0; i + 1 < heights.bins; ++i) {
    if (heights.layer(i) < min_points) continue;
    while (i + 2 < heights.bins && heights.layer(i + 1) > heights.layer(i))
      ++i;
    if (heights.is_ground(i)) return static_cast<double>(i + 1) * bin_height - gate;
  }
  return {};
}

// Points of a fit are so far below and above the guess at most, metres; weight of the expected slopes.
struct Reach {
  double below, above, tilt_weight;
};

// A plane, and the heights of a patch's points above it.
struct Expected : Slope {
  std::vector<double>& above;

  void become(const Slope& plane, const Patch& patch) {
    Slope::operator=(plane);
    above.resize(patch.count);
    find_heights(plane, patch, 0, patch.count, above.data());
  }
};

// Least squares of the points within reach of `guess`, as a change of `expected`.
std::optional<Slope> fit(const Patch& patch, const Expected& expected, const Slope& guess,
                         const Reach& reach) {
  double n = 0, u1 = 0, v1 = 0, uu = 0, uv = 0, vv = 0, h1 = 0, uh = 0, vh = 0;
  std::array<double, kBatch> residual;
  std::array<std::uint32_t, kBatch> near;
  for (std::size_t begin = 0; begin < patch.count; begin += kBatch) {
    const std::size_t count = std::min(kBatch, patch.count - begin);
    find_heights(guess, patch, begin, count, residual.data());
    std::size_t near_count = 0;
    for (std::size_t i = 0; i < count; ++i) {
      near[near_count] = static_cast<std::uint32_t>(i);
      near_count += (residual[i] >= -reach.below) & (residual[i] <= reach.above);
    }
    n += static_cast<double>(near_count);
    for (std::size_t k = 0; k < near_count; ++k) {
      const std::size_t i = near[k];
      const double u = patch.u[begin + i] - patch.center_u, v = patch.v[begin + i] - patch.center_v;
      const double h = expected.above[begin + i];
      u1 += u, v1 += v, h1 += h;
      uu += u * u, uv += u * v, vv += v * v;
      uh += u * h, vh += v * h;
    }
  }
  if (n < min_points) return {};
  const double mean_u = u1 / n, mean_v = v1 / n, mean_h = h1 / n;
  const double weight = tilt_weight + reach.tilt_weight * n;
  uu += weight - u1 * mean_u;
  vv += weight - v1 * mean_v;
  uv -= u1 * mean_v;
  uh -= u1 * mean_h;
  vh -= v1 * mean_h;
  const double determinant = uu * vv - uv * uv;
  const double du = (uh * vv - vh * uv) / determinant;
  const double dv = (vh * uu - uh * uv) / determinant;
  const double offset = (mean_h - du * (patch.center_u + mean_u)) - dv * (patch.center_v + mean_v);
  return Slope{expected.offset + offset, expected.slope_u + du, expected.slope_v + dv};
}

// The plane of the ground where it starts to climb or sink, so that the patch's points lie in no layer: that
// of all points within the gate, if most of them lie in it.
std::optional<Slope> fit_ramp(const Patch& patch, Expected& expected, double gate) {
  const std::optional<Slope> all = fit(patch, expected, expected, {gate, gate, 0});
  if (!all) return {};
  expected.become(*all, patch);
  const std::optional<Slope> ramp = fit(patch, expected, *all, {layer_reach, layer_reach, 0});
  if (!ramp) return {};
  expected.become(*ramp, patch);
  const Histogram heights = histogram(expected.above, gate);
  std::uint32_t near = 0;
  for (std::size_t i = 0; i < heights.bins; ++i)
    near += heights.count[i];
  const std::size_t middle = heights.bins / 2 - 1;
  if (!(heights.layer(middle) >= ramp_share * near && heights.is_ground(middle))) return {};
  return ramp;
}

std::optional<Slope> fit_layer(const Patch& patch, const Expected& expected, double gate) {
  const std::optional<double> layer = lowest_layer(histogram(expected.above, gate), gate);
  if (!layer) return {};
  const Slope level{expected.offset + *layer, expected.slope_u, expected.slope_v};
  const std::optional<Slope> plane =
      fit(patch, expected, level, {layer_reach, 0.5 * layer_reach, tilt_weight_per_point});
  if (!plane) return {};
  return fit(patch, expected, *plane, {plane_reach, 0.5 * plane_reach, tilt_weight_per_point});
}

}  // namespace

std::optional<Slope> fit_patch(const Patch& patch, const Slope& expected, double gate, double max_slope,
                               std::vector<double>& above) {
  if (patch.count < min_points) return {};
  Expected measured{expected, above};
  measured.become(expected, patch);
  std::optional<Slope> plane = fit_layer(patch, measured, gate);
  if (!plane) plane = fit_ramp(patch, measured, gate);
  if (!plane) return {};
  const double step =
      plane->height(patch.center_u, patch.center_v) - expected.height(patch.center_u, patch.center_v);
  const double slope2 = plane->slope_u * plane->slope_u + plane->slope_v * plane->slope_v;
  if (!(std::abs(step) <= gate && slope2 <= max_slope * max_slope)) return {};
  return plane;
}

}  // namespace pcl_bv
