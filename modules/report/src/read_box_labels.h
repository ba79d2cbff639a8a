// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Reads boxes in the formats of box_labels.h.
#pragma once

#include <string_view>
#include <vector>

#include "pcl_bv/io/read_json.h"
#include "pcl_bv/volumes/any_volume.h"

namespace pcl_bv::detail {

/// Appends the boxes if the value is in a format of nuScenes, OpenLABEL or SUSTechPOINTS; otherwise returns
/// false. Throws std::invalid_argument, which names the entry, if one of its boxes cannot be read.
bool read_box_labels(const UntrustedJson& json, std::vector<AnyVolume>& volumes);

/// Returns whether the first line that is not blank has the columns of KITTI's labels.
bool has_kitti_labels(std::string_view text);

/// Returns the boxes of KITTI's labels without those of the type DontCare, which have no position. Throws
/// IoError, which names the line, if a line cannot be read.
std::vector<AnyVolume> read_kitti_labels(std::string_view text);

}  // namespace pcl_bv::detail
