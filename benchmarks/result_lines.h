// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Tracked boxes in the lines of JSON that bv_stream writes.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "ground_box.h"

namespace pcl_bv::bench {

/// A box with a track, in the sensor's frame, metres.
struct FoundBox {
  std::uint32_t track = 0;
  GroundBox base;
  double low = 0, high = 0;  ///< z
};

struct ResultFrame {
  std::size_t number = 0;  ///< The number in the name of the cloud's file (000012.bin), else `seq`.
  std::vector<FoundBox> boxes;
};

/// Reads the frames of a file of bv_stream. Clusters without a track are skipped. A line with `error` is a
/// frame without boxes. `method` selects the boxes; if it is empty, the first volume of each cluster is used.
/// It must be an axis-aligned box or an upright one with its third axis along z. Throws std::runtime_error
/// with the file, the line and the reason.
std::vector<ResultFrame> read_result_lines(const std::filesystem::path& file, const std::string& method);

}  // namespace pcl_bv::bench
