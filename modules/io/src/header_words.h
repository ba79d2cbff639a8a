// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Lines of headers, cut into words; in_quotes() is for messages about them.
#pragma once

#include <string_view>
#include <vector>

#include "pcl_bv/io/io_error.h"

namespace pcl_bv {

using Words = std::vector<std::string_view>;

/// The words of a line, between blanks.
Words split(std::string_view line);

}  // namespace pcl_bv
