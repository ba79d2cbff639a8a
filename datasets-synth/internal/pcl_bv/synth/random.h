// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Random numbers with a named algorithm, since the distributions of the standard library differ between
// libraries.
#pragma once

#include <cstdint>
#include <initializer_list>

namespace [[gnu::visibility("default")]] pcl_bv {

/// SplitMix64 (Steele, Lea and Flood, "Fast Splittable Pseudorandom Number Generators", OOPSLA 2014).
///
/// Keys are hashed into the starting state, so that streams of their own cost nothing: the numbers of
/// `SplitMix64({seed, frame, ray})` do not depend on what any other ray has drawn.
class SplitMix64 {
 public:
  explicit SplitMix64(std::uint64_t seed) : state_(seed) {}
  explicit SplitMix64(std::initializer_list<std::uint64_t> keys);

  std::uint64_t next();

  /// Uniform in [0, 1), a multiple of 2^-53.
  double uniform();

  /// Uniform in [low, high]; `high` itself only by rounding.
  double uniform(double low, double high);

  /// Normal with mean 0 and variance 1, by the cosine half of Box and Muller 1958. At most 8.6 in magnitude.
  double normal();

 private:
  std::uint64_t state_;
};

}  // namespace pcl_bv
