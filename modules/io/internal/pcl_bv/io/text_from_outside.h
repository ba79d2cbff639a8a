// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Texts that somebody else wrote: how large and how deeply nested they may be is checked before any library
// reads them.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

#include "pcl_bv/io/io_error.h"

namespace [[gnu::visibility("default")]] pcl_bv {

inline constexpr std::size_t kMaxConfigBytes = std::size_t{1} << 20;  ///< Of settings as YAML.
inline constexpr std::size_t kMaxMetadataBytes = std::size_t{16}
                                                 << 20;  ///< Of metadata.yaml: types have definitions.
inline constexpr std::size_t kMaxVolumesBytes = std::size_t{1} << 30;   ///< Of JSON with volumes.
inline constexpr std::size_t kMaxHeadingBytes = std::size_t{64} << 20;  ///< Of a file of partial results.
inline constexpr std::size_t kMaxPosesBytes = std::size_t{1} << 30;     ///< Of poses and calibrations.
inline constexpr int kMaxJsonDepth = 64;  ///< Reports nest 8 deep. What walks a value may recurse.

/// The whole of a file or a pipe. Throws IoError, "cannot be read" or "has more than 1048576 bytes"; it reads
/// no more than these.
std::string read_text_from_outside(const std::filesystem::path& path, std::size_t max_bytes);

/// The value of JSON, in whatever syntax, that begins at `text[at]` or behind the white space there; `at` is
/// set behind it. Empty at the end of the text. Throws IoError where a value is nested more than
/// kMaxJsonDepth deep. O(n), and needs no memory.
std::string_view next_json_value(std::string_view text, std::size_t& at);

/// "line 2, column 7" of the byte `at`, both from 1.
std::string position_in(std::string_view text, std::size_t at);

}  // namespace pcl_bv
