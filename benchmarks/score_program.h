// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The main() of programs that score results.
#pragma once

#include <cstdio>
#include <exception>
#include <stdexcept>

namespace pcl_bv::bench {

/// Wrong arguments of a program.
struct UsageError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Calls run() and returns the exit status. An error is one line on standard error; the status is 2 for
/// wrong arguments and 1 otherwise.
template <typename Run>
int run_scores(const char* name, const Run& run) {
  try {
    return run();
  } catch (const UsageError& error) {
    std::fprintf(stderr, "%s: %s\n", name, error.what());
    return 2;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s: %s\n", name, error.what());
    return 1;
  }
}

}  // namespace pcl_bv::bench
