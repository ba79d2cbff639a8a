// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The exit status of the command.
#pragma once

#include <initializer_list>

namespace pcl_bv {

/// Exit statuses.
enum class Status { done = 0, failed = 1, misuse = 2, outside = 3 };

/// Returns the status that has priority, in the order misuse, outside, failed, done.
constexpr Status worse(Status a, Status b) {
  for (const Status status : {Status::misuse, Status::outside, Status::failed}) {
    if (a == status || b == status) return status;
  }
  return Status::done;
}

}  // namespace pcl_bv
