// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// How the command ends, and what it says about problems.

#include "status.h"

#include <cstdio>

namespace pcl_bv {

Status worse(Status a, Status b) {
  for (const Status status : {Status::misuse, Status::outside, Status::failed}) {
    if (a == status || b == status) return status;
  }
  return Status::done;
}

void complain(const std::string& problem) {
  const std::string line = "pcd_bv: " + problem + '\n';
  std::fwrite(line.data(), 1, line.size(), stderr);
}

}  // namespace pcl_bv
