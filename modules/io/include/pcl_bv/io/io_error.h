// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <stdexcept>
#include <string>
#include <string_view>

namespace [[gnu::visibility("default")]] pcl_bv {

/// Error thrown if a file cannot be read or written. what() is the reason in one line, without the file's
/// name. The caller adds the name as the user gave it.
class IoError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Returns the text in quotes, for an error message. Texts of more than 40 characters are cut and end in
/// "...'". Each byte that is not printable ASCII becomes `?`.
std::string in_quotes(std::string_view text);

}  // namespace pcl_bv
