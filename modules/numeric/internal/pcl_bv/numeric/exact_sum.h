// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Exact sums of three doubles: what decides where the slab of a k-DOP lies.
#pragma once

namespace [[gnu::visibility("default")]] pcl_bv {

/// The exact sum of three doubles, kept unevaluated as head + tail + rest with head the rounded sum. Valid
/// for |terms| <= 1e100.
struct ExactSum {
  double head, tail, rest;
};

ExactSum exact_sum(double x, double y, double z);

/// The greatest double <= and the least double >= the exact value; equal if it is a double itself. Never -0.
double round_down(const ExactSum& sum);
double round_up(const ExactSum& sum);

/// -1, 0 or 1: the sign of a - b, exactly.
int compare(const ExactSum& a, const ExactSum& b);

}  // namespace pcl_bv
