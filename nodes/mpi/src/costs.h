// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The costs of a run on ranks (--timings).
#pragma once

#include <cstddef>
#include <optional>

#include "ranks.h"

namespace pcl_bv::detail {

/// The costs of one rank.
struct RankCosts {
  double seconds = 0;                         ///< Wall time.
  double cpu_seconds = 0;                     ///< CPU time without waiting for other ranks.
  std::size_t messages = 0, bytes = 0;        ///< What it has sent.
  std::optional<std::size_t> query_rounds{};  ///< Of the smallest sphere; not for objects.
};

/// Returns the CPU time of this process.
double processor_seconds();

/// Prints one line: CPU time and messages, summed over all ranks, and the maximum memory of a rank. A
/// collective call.
void print_costs(Ranks& ranks, const RankCosts& own);

}  // namespace pcl_bv::detail
