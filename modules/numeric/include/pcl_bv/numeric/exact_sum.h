// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Exact values of c0 x + c1 y + c2 z for c in {-1, 0, 1}: what decides where a k-DOP's slab lies.
#pragma once

#include "pcl_bv/numeric/coordinates.h"
#include "pcl_bv/numeric/directions.h"

namespace [[gnu::visibility("default")]] pcl_bv {

/// The exact sum of three doubles, kept unevaluated as head + tail + rest with head the rounded sum. Valid
/// for |terms| <= 1e100.
struct ExactSum {
  double head, tail, rest;
};

ExactSum exact_sum(double x, double y, double z);

/// The exact projection of p onto a direction with coefficients in {-1, 0, 1}.
ExactSum exact_projection(const CubeDirection& direction, const Coordinates& p);

/// The greatest double <= and the least double >= the exact value; equal if it is a double itself. Never -0.
double round_down(const ExactSum& sum);
double round_up(const ExactSum& sum);

/// -1, 0 or 1: the sign of a - b, exactly.
int compare(const ExactSum& a, const ExactSum& b);

}  // namespace pcl_bv
