// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// SplitMix64, compiled once so that every user draws the same bits.
#include "pcl_bv/synth/random.h"

#include <cmath>
#include <numbers>

namespace pcl_bv::detail {

SplitMix64::SplitMix64(std::initializer_list<std::uint64_t> keys) : state_(0) {
  for (const std::uint64_t key : keys)
    state_ = next() ^ key;
  // Mix the last key, too. Otherwise keys that differ by a multiple of the increment in next() could give
  // overlapping streams.
  state_ = next();
}

std::uint64_t SplitMix64::next() {
  state_ += 0x9e3779b97f4a7c15u;
  std::uint64_t z = state_;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
  return z ^ (z >> 31);
}

double SplitMix64::uniform() {
  return static_cast<double>(next() >> 11) * 0x1p-53;
}

double SplitMix64::uniform(double low, double high) {
  return low + uniform() * (high - low);
}

double SplitMix64::normal() {
  const double u = 1.0 - uniform();  // in (0, 1], so that the logarithm is finite
  const double angle = 2.0 * std::numbers::pi * uniform();
  return std::sqrt(-2.0 * std::log(u)) * std::cos(angle);
}

}  // namespace pcl_bv::detail
