// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Others who bound points, run on the same clouds: PCL, Eigen, FCL, plain loops for the 26-DOP, and kernels
// that check nothing.
#pragma once

#include <string>
#include <vector>

#include "clouds.h"
#include "rivals.h"

namespace pcl_bv::bench {
using namespace detail;

/// A peer runs on layouts "xyz" and "packed" as it would in its own home: the clouds that it takes are given.
struct Peer {
  std::string name;
  std::string layout;  ///< That it reads.
  void (*run)(const Cloud&);
  /// Runs it once; how many finite points lie outside its answer, by arithmetic in double. Throws if the
  /// answer is further than float rounding from ours.
  std::size_t (*outside)(Cloud&);
};

/// "pcl-dense", "pcl-non-dense" (pcl::getMinMax3D as is_dense says), "eigen-minmax" (rowwise minCoeff and
/// maxCoeff), "eigen-box" (AlignedBox3f::extend), "naive-aabb", "naive-dop14", "naive-dop26" (-O2),
/// "plain-dop26"
/// (-O3, shared sums, not vectorised), and with FCL "fcl-kdop18", "fcl-kdop24" (fcl::fit).
const std::vector<Peer>& peers();

const Peer& peer(const std::string& name);

/// A kernel of rivals.h.
struct Unchecked {
  std::string name;  ///< "unchecked-aabb", "unchecked-dop26", "tested-dop26".
  std::string work;  ///< Ours that it is held against.
  UncheckedExtents (*run)(Isa, const PointView&);
  std::size_t directions;

  /// Throws unless it gives what the plain loop gives. Layout "xyz", no NaN.
  void check(Isa isa, const Cloud& cloud) const;
};

const std::vector<Unchecked>& unchecked();

}  // namespace pcl_bv::bench
