// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <stdexcept>
#include <string>
#include <string_view>

namespace [[gnu::visibility("default")]] pcl_bv {

/// A file that cannot be read or written. what() is the reason in one line; the file's name is added
/// by those who know what the user called it.
class IoError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Text of a file or a path for an error message: in quotes, at most 40 characters, `?` for what is not
/// printable ASCII.
std::string in_quotes(std::string_view text);

}  // namespace pcl_bv
