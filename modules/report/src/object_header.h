// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The headers of shares in files of objects, as JSON.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "pcl_bv/report/object_file.h"

namespace pcl_bv::detail {

/// Maximum number of bytes, most of which are paths of inputs.
inline constexpr std::uint64_t kMaxObjectHeader = 1U << 28U;

/// Returns the header without ObjectFileHeader::cloud. Throws IoError if it is too large.
std::string object_header_text(const ObjectFileHeader& header, ScalarType scalar);

/// Throws IoError.
ObjectFileHeader parse_object_header(std::string_view content, ScalarType& scalar);

}  // namespace pcl_bv::detail
