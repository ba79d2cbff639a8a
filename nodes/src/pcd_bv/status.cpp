// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// How the command ends.

#include "status.h"

#include <initializer_list>

namespace pcl_bv {

Status worse(Status a, Status b) {
  for (const Status status : {Status::misuse, Status::outside, Status::failed}) {
    if (a == status || b == status) return status;
  }
  return Status::done;
}

}  // namespace pcl_bv
