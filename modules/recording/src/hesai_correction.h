// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The angle correction file of a Hesai sensor.
#pragma once

#include <filesystem>
#include <string_view>
#include <vector>

#include "hesai_model.h"

namespace pcl_bv::detail {

/// Parses an angle correction file, as the sensor and Hesai's tools give it: a row
/// `channel,elevation,azimuth` for each channel, in order, channels counted from 1, angles in degrees. Lines
/// before the first row and after the last row that have other content, such as names of columns or a
/// checksum, are skipped. Throws IoError if there is no row, if channels are missing or repeated, and for
/// angles out of range.
std::vector<HesaiAngles> parse_hesai_correction(std::string_view csv);

/// Returns where the correction file of this capture should be: its name with the extension .csv or, for a
/// sensor with mirrors, .dat.
std::filesystem::path own_hesai_correction(const std::filesystem::path& capture, bool has_mirrors = false);

}  // namespace pcl_bv::detail
