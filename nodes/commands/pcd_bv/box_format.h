// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The names of output formats, and the options that formats of boxes need.
#pragma once

#include <optional>
#include <string>

#include "options.h"
#include "pcl_bv/report/box_labels.h"

namespace pcl_bv::detail {

/// Returns the format of this name. Throws std::invalid_argument, which lists all names.
OutputFormat read_output_format(const std::string& name);

/// Returns the format of boxes, or nothing for formats that have more than boxes.
std::optional<BoxLabelFormat> box_label_format(OutputFormat format);

/// Returns the value of --object-type. Throws UsageError if it is not a word or if the format has no types.
std::string checked_object_type(const std::string& type, OutputFormat format);

/// For formats of boxes and 3D Tiles: throws UsageError if no method of the options makes volumes that the
/// format can have, or if the format would lose an origin.
void check_box_format(const std::string& name, const Options& options);

}  // namespace pcl_bv::detail
