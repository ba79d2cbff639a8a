// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The exit status of pcd_bv.
#pragma once

#include <initializer_list>

namespace pcl_bv::detail {

/// Exit statuses of pcd_bv.
enum class Status { done = 0, failed = 1, misuse = 2, outside = 3 };

/// Returns `a` or `b`, whichever comes first in the order misuse, outside, failed, done.
constexpr Status worse(Status a, Status b) {
  for (const Status status : {Status::misuse, Status::outside, Status::failed}) {
    if (a == status || b == status) return status;
  }
  return Status::done;
}

}  // namespace pcl_bv::detail
