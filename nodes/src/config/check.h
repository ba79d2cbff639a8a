// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <string>
#include <vector>

#include "pcl_bv/nodes/stream_config.h"

namespace pcl_bv {

/// A value that is not allowed.
struct ConfigProblem {
  std::string key;
  std::string what;  ///< The value and what is allowed.
};

std::vector<ConfigProblem> problems_of(const StreamConfig& config);

}  // namespace pcl_bv
