// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Exact sums of three doubles. The slabs of k-DOPs with built-in directions are computed with these sums.
#pragma once

namespace pcl_bv {
namespace [[gnu::visibility("default")]] detail {

/// The exact sum of three doubles, stored as the unevaluated sum head + tail + rest. `head` is the sum
/// rounded to the nearest double.
struct ExactSum {
  double head, tail, rest;
};

/// Returns x + y + z exactly. Each term must be at most 1e100 in magnitude.
ExactSum exact_sum(double x, double y, double z);

/// Returns the largest double <= the sum or the smallest double >= the sum. Never returns -0.
double round_down(const ExactSum& sum);
double round_up(const ExactSum& sum);

/// Returns the exact sign (-1, 0 or 1) of a - b.
int compare(const ExactSum& a, const ExactSum& b);

}  // namespace detail
}  // namespace pcl_bv
