// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <stdexcept>
#include <string>
#include <string_view>

namespace [[gnu::visibility("default")]] pcl_bv {

/// Error: a file cannot be read or written. what() is the reason in one line, without the file's name: the
/// caller adds the name as the user gave it.
class IoError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Returns a text for an error message: in quotes, cut to 40 characters ("...'"), with `?` for each byte that
/// is not printable ASCII.
std::string in_quotes(std::string_view text);

}  // namespace pcl_bv
