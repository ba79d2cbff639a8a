// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Every way to run a fit on this machine; none may change a bit.
#pragma once

#include <string>
#include <vector>

#include "few_cases.h"
#include "pcl_bv/parallel/execution.h"

namespace pcl_bv::test {

/// Points whose 26-DOP every set takes 200 us for, from where on it is threaded. Arm's sets are reckoned
/// slower.
inline constexpr std::size_t kThreadedPoints = kEmulated ? 200'000 : 1'100'000;

inline std::vector<unsigned> thread_counts() {
  return kFewCases ? std::vector{3U} : std::vector{2U, 3U, 5U};
}

struct NamedExecution {
  std::string name;
  Execution execution;
};

inline std::vector<NamedExecution> every_execution() {
  std::vector<NamedExecution> all;
  for (const Isa isa : usable_isas()) {
    const std::string name(isa_name(isa));
    all.push_back({name + " serial", {Serial{}, isa}});
    for (const unsigned threads : thread_counts()) {
      all.push_back({name + " std::thread " + std::to_string(threads), {Threads{threads}, isa}});
      all.push_back({name + " OpenMP " + std::to_string(threads), {OpenMP{threads}, isa}});
    }
  }
  return all;
}

}  // namespace pcl_bv::test
