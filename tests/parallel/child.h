// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Claims about a forked child, which has no threads yet: also for those about the first call of a process.
#pragma once

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <latch>

#include "pcl_bv/parallel/for_each_chunk.h"

namespace pcl_bv::test {
using namespace detail;

/// A child that hangs is ended by the system after so many seconds, of which it needs a few hundredths.
inline constexpr unsigned kHangs = 120;

inline testing::AssertionResult ends_well(pid_t child) {
  int status = 0;
  if (::waitpid(child, &status, 0) != child) return testing::AssertionFailure() << "there is no child";
  if (WIFSIGNALED(status)) return testing::AssertionFailure() << "ended by signal " << WTERMSIG(status);
  return testing::AssertionResult(WEXITSTATUS(status) == 0) << "exit code " << WEXITSTATUS(status);
}

/// Whether no expectation of `body` failed in a child, and the child came to its end.
template <typename Body>
testing::AssertionResult passes_in_child(Body&& body) {
  std::fflush(nullptr);
  const pid_t child = ::fork();
  if (child != 0) return ends_well(child);
  ::alarm(kHangs);
  body();
  std::fflush(nullptr);
  ::_exit(testing::Test::HasFailure() ? 1 : 0);
}

/// Returns when `threads` of our own have been in a body at the same time; body(0) is not special. Each does
/// `first` before any of them can leave.
template <typename First, typename Body>
void meet(unsigned threads, First&& first, Body&& body) {
  std::latch all(threads);
  for_each_chunk(Threads{threads}, threads, [&](std::size_t) {
    first();
    all.arrive_and_wait();
    body();
  });
}

template <typename Body>
void meet(unsigned threads, Body&& body) {
  meet(
      threads, [] {}, body);
}

}  // namespace pcl_bv::test
