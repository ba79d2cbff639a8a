// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// How well ground is told from the rest, where the truth is known.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace pcl_bv::bench {

/// Low vegetation may be called ground or not: as truth it is ground, no ground, or not counted.
enum class Vegetation : std::uint8_t { ground, no_ground, not_counted };

/// Points of one sweep, one entry each in all of them. Points without a return have a range of 0.
struct LabelledSweep {
  std::span<const double> range;  // horizontal, metres
  std::span<const std::uint32_t> object, ground, vegetation;
  std::span<const std::uint8_t> found;  // 1: called ground
};

/// Sums over sweeps, in bands of range; the last one is for all together.
class GroundScore {
 public:
  static constexpr std::array<double, 5> edges{0, 10, 20, 40, 60};  // metres
  static constexpr std::size_t bands = edges.size() - 1, all = bands;

  explicit GroundScore(Vegetation vegetation) : vegetation_(vegetation) {}

  /// Points from 60 m on count in no band and not in `all`.
  void add(const LabelledSweep& sweep);

  /// Of the true ground points, the share that was called so; 1 without any.
  double recall(std::size_t band) const;

  /// Of the points called ground, the share that are; 1 without any.
  double precision(std::size_t band) const;

  std::size_t objects(std::size_t band) const { return objects_[band]; }

  /// Of the objects with at least 10 points, in the band of their nearest: those of whose points more than
  /// half were called ground.
  std::size_t lost(std::size_t band) const { return lost_[band]; }

 private:
  using Counts = std::array<std::size_t, bands + 1>;

  void add_objects(const LabelledSweep& sweep);

  Vegetation vegetation_;
  Counts right_{}, wrong_{}, missed_{}, objects_{}, lost_{};
};

}  // namespace pcl_bv::bench
