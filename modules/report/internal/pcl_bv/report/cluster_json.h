// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Clusters with their volumes as text, to be read back.
#pragma once

#include <string>
#include <string_view>

#include "pcl_bv/report/report.h"

namespace pcl_bv {
namespace [[gnu::visibility("default")]] detail {

/// Returns a cluster as one JSON object on one line. Volumes have exactly the numbers of report_json().
std::string cluster_json(const ClusterEntry& cluster);

/// Reads the text of cluster_json(). Volumes are equal to those that were written, bit for bit. Throws
/// IoError for any other text.
ClusterEntry read_cluster_json(std::string_view text);

}  // namespace detail
}  // namespace pcl_bv
