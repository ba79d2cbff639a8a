// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Scores of ground and clusters next to SemanticKITTI's labels (Behley et al. 2019).
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "ground_score.h"
#include "pcl_bv/points/point_view.h"

namespace pcl_bv::bench {

/// Points of one sweep by what they are and what they were found to be.
struct GroundCounts {
  std::size_t true_positive = 0, false_positive = 0, false_negative = 0, true_negative = 0;

  /// Shares from 0 to 1; 1 if there is nothing to divide by.
  double recall() const;
  double precision() const;
  double f1() const;
  double accuracy() const;
};

/// Counts the points of a sweep. A label's lower 16 bits are the class. Road, parking, sidewalk, other
/// ground, lane marking and terrain are ground. Unlabelled points and outliers do not count. `vegetation`
/// tells what vegetation is: ground if its z is below `low` and no ground otherwise; no ground; or not
/// counted. `found` is 1 for points found to be ground. All spans have one entry a point.
GroundCounts count_ground(std::span<const std::uint32_t> labels, std::span<const float> z,
                          std::span<const std::uint8_t> found, Vegetation vegetation, double low);

/// Returns the true segment of each point, from 1 on, and 0 for points in none. As in the evaluation of
/// TRAVEL (Oh et al. 2022) and continuous clustering (Reich and Wuensche 2023), segments are the Euclidean
/// clusters of points with the same class and instance: tolerance 1 m, 10 to 300 000 points. Ground and
/// unlabelled points are in no segment; vegetation is.
std::vector<std::uint32_t> true_segments(const PointView& points, std::span<const std::uint32_t> labels);

/// Under- and over-segmentation of a sweep. 0 is perfect, and there is no upper limit.
struct SegmentEntropy {
  /// USE: the sum, over the found clusters, of the entropy of the true segments of their points, in nats.
  /// Points in no segment form one more, so clusters of only such points add nothing.
  double under = 0;
  /// OSE: the sum, over the true segments, of the entropy of the clusters of their points. Points in no
  /// cluster form one more.
  double over = 0;
};

/// `truth` and `found` have one entry a point; 0 is no segment and no cluster.
SegmentEntropy segment_entropy(std::span<const std::uint32_t> truth, std::span<const std::uint32_t> found);

/// Mean and standard deviation over sweeps.
class SweepMean {
 public:
  void add(double value);
  std::size_t sweeps() const { return sweeps_; }
  double mean() const;
  double deviation() const;

 private:
  std::size_t sweeps_ = 0;
  double sum_ = 0, squares_ = 0;
};

}  // namespace pcl_bv::bench
