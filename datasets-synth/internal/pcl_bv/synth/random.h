// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// A random number generator with fixed algorithms, because the distributions of <random> differ between
// standard libraries.
#pragma once

#include <cstdint>
#include <initializer_list>

namespace pcl_bv {
namespace [[gnu::visibility("default")]] detail {

/// SplitMix64 (Steele, Lea and Flood, "Fast Splittable Pseudorandom Number Generators", OOPSLA 2014).
///
/// A list of keys is hashed into the initial state, so each list has its own independent stream.
/// For example, the numbers of `SplitMix64({seed, frame, ray})` do not depend on how many numbers are drawn
/// for other rays.
class SplitMix64 {
 public:
  explicit SplitMix64(std::uint64_t seed) : state_(seed) {}
  explicit SplitMix64(std::initializer_list<std::uint64_t> keys);

  /// Returns the next 64 random bits.
  std::uint64_t next();

  /// Returns a number uniform in [0, 1), a multiple of 2^-53.
  double uniform();

  /// Returns a number uniform in [low, high). Rounding may yield `high`.
  double uniform(double low, double high);

  /// Returns a standard normal number (mean 0, variance 1), by the cosine formula of Box and Muller 1958.
  /// Its magnitude is at most 8.6.
  double normal();

 private:
  std::uint64_t state_;
};

}  // namespace detail
}  // namespace pcl_bv
