// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Lines of values that are separated by commas or semicolons. Blanks and quotes around a value do not belong
// to it. Blanks inside a value do, and separators in double quotes, too.
#pragma once

#include <cstddef>
#include <string_view>

#include "text.h"

namespace pcl_bv::detail {

/// Returns the text without blanks around it.
std::string_view without_blanks_around(std::string_view text);

/// Returns ';' or ',' if the line has this character, otherwise ' '.
char separator_of(std::string_view line);

/// Returns the values of a line, which are separated by `separator` or, if it is ' ', by any blanks.
Words split_all_columns(std::string_view line, char separator);

/// Like split_all_columns(), but without empty values at the end of the line.
Words split_columns(std::string_view line, char separator);

/// Stands for a blank inside of a value in the text of separate_by_blanks(). Alone, it is an empty value.
inline constexpr char kInnerBlank = '\x1F';

/// Returns whether only separators have to be replaced by blanks, which is true for most files: no value is
/// empty, quoted or has a blank inside.
bool has_plain_values(std::string_view text, char separator);

/// Writes whole lines to `to`, which has 2 * text.size() + 2 bytes, with blanks between their values. Lines
/// without a value become empty. Empty values at the end of a line are written only up to `columns` values.
/// Returns the end of the written text.
char* separate_by_blanks(std::string_view text, char separator, std::size_t columns, char* to);

}  // namespace pcl_bv::detail
