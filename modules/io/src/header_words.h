// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// What headers of all text formats have in common.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "posix_file.h"

namespace pcl_bv {

/// A header must end within this many bytes; those of real files have some 200 to 400.
inline constexpr std::size_t max_header_size = 65536;

/// The first max_header_size bytes of a file; fewer only if it ends there. Throws IoError.
std::string read_start(const InputFile& file);

using Words = std::vector<std::string_view>;

/// The words of a line, between blanks.
Words split(std::string_view line);

/// Whether the text has no blanks or line ends and is not empty, so that it can be the name of a field.
bool is_word(std::string_view text);

}  // namespace pcl_bv
