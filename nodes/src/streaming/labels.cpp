// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "pcl_bv/nodes/labels.h"

#include <algorithm>

#include "pcl_bv/report/picture.h"

namespace pcl_bv {

std::vector<std::uint32_t> labels_of(const Frame& frame, const FrameResult& result) {
  std::size_t size = frame.points.first + frame.points.count;
  if (const std::int32_t* numbers = frame.points.indices; numbers != nullptr && frame.points.count > 0)
    size = static_cast<std::size_t>(*std::max_element(numbers, numbers + frame.points.count)) + 1;
  std::vector<std::uint32_t> labels(size, label_none);
  for (const std::int32_t i : result.ground.ground)
    labels[static_cast<std::size_t>(i)] = label_ground;
  for (std::size_t id = 0; id < result.clusters.size(); ++id) {
    const std::int32_t* points = result.clusters.cluster(id);
    for (std::size_t i = 0; i < result.clusters.cluster_size(id); ++i)
      labels[static_cast<std::size_t>(points[i])] = static_cast<std::uint32_t>(id);
  }
  return labels;
}

}  // namespace pcl_bv
