// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// What the commands say to wrong use.
#pragma once

#include <stdexcept>

namespace pcl_bv {

/// Wrong use: what() is the line for standard error, and the exit status is 2.
class UsageError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace pcl_bv
