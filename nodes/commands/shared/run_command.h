// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// From main() to exit status, the same for every command.
#pragma once

#include <functional>
#include <string_view>

namespace pcl_bv {

/// Prepares the standard streams and does the work, which gives the exit status. What it throws is one line
/// on standard error, "<command>: text", and a status: UsageError 2, anything else 1.
int run_command(std::string_view command, const std::function<int()>& work);

/// Writes a text that was asked for instead of work: 0, also if nobody reads it; throws IoError, naming
/// standard output, if it cannot be written.
int print(std::string_view text);

}  // namespace pcl_bv
