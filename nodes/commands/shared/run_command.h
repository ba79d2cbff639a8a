// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The common part of all main functions, which handles standard streams, errors and the exit status.
#pragma once

#include <functional>
#include <string_view>

namespace pcl_bv::detail {

/// Prepares the standard streams, runs `work` and returns its exit status. If `work` throws, prints one line
/// on standard error, "<command>: text", and returns 2 for a UsageError or 1 for any other std::exception.
int run_command(std::string_view command, const std::function<int()>& work);

/// Prints a text on standard output. Returns 0, also if standard output has no reader. Throws IoError, whose
/// text begins with "standard output", for any other failure.
int print_text(std::string_view text);

}  // namespace pcl_bv::detail
