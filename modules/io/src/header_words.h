// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Text of headers: cut into words, and quoted in messages.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace pcl_bv {

using Words = std::vector<std::string_view>;

/// The words of a line, between blanks.
Words split(std::string_view line);

/// Text of a file in an error message: shortened, in quotes, without control characters.
std::string in_quotes(std::string_view text);

}  // namespace pcl_bv
