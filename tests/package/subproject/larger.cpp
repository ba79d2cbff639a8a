// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include <pcl_bv/volumes/aabb.h>

int main() {
  pcl_bv::Aabb box;
  box.extend(Eigen::Vector3d(1, 2, 3));
  return box.empty() ? 1 : 0;
}
