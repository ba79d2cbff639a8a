// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "pcl_bv/report/report.h"

namespace pcl_bv {

using Json = nlohmann::ordered_json;

/// Throw std::domain_error if a number is not finite, once written by to_text().
Json volumes_json(const ClusterEntry& cluster);
Json counts_json(const Counts& counts);

/// On one line; the fewest digits that read back exactly, never -0.
std::string to_text(const Json& json);

}  // namespace pcl_bv
