// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// How the command ends, and what it says about problems.

#include "status.h"

#include <algorithm>
#include <cstdio>

namespace pcl_bv {

Status worse(Status a, Status b) {
  for (const Status status : {Status::misuse, Status::outside, Status::failed}) {
    if (a == status || b == status) return status;
  }
  return Status::done;
}

void complain(const std::string& problem) {
  std::string line = "pcd_bv: " + problem + '\n';
  // A name may hold anything: one problem stays one line, and no terminal is steered.
  std::replace_if(
      line.begin(), line.end() - 1, [](char c) { return (c >= 0 && c < ' ') || c == 0x7F; }, '?');
  std::fwrite(line.data(), 1, line.size(), stderr);
}

}  // namespace pcl_bv
