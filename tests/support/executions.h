// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Every way to run a fit on this machine; none may change a bit.
#pragma once

#include <string>
#include <vector>

#include "pcl_bv/fitting/execution.h"

namespace pcl_bv::test {

struct NamedExecution {
  std::string name;
  Execution execution;
};

inline std::vector<NamedExecution> every_execution() {
  std::vector<NamedExecution> all;
  for (const Isa isa : usable_isas()) {
    const std::string name(isa_name(isa));
    all.push_back({name + " serial", {Serial{}, isa}});
    for (const unsigned threads : {2U, 3U, 5U}) {
      all.push_back({name + " std::thread " + std::to_string(threads), {Threads{threads}, isa}});
      all.push_back({name + " OpenMP " + std::to_string(threads), {OpenMP{threads}, isa}});
    }
  }
  return all;
}

}  // namespace pcl_bv::test
