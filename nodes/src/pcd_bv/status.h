// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// How the command ends, and what it says about problems.
#pragma once

#include <string>

namespace pcl_bv {

/// Exit statuses.
enum class Status { done = 0, failed = 1, misuse = 2, outside = 3 };

/// The one that wins where both apply, in the order misuse, outside, failed, done.
Status worse(Status a, Status b);

/// One line on standard error: "pcd_bv: problem".
void complain(const std::string& problem);

}  // namespace pcl_bv
