// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "object_list.h"

#include <algorithm>
#include <utility>

#include "object_files.h"
#include "pcl_bv/nodes/frame_result.h"

namespace pcl_bv::detail {

void ObjectList::add(std::unique_ptr<StoredClusters> clusters, std::vector<Object> objects) {
  Counts& counts = report_.counts;
  counts.small += clusters->counts().small;
  counts.large += clusters->counts().large;
  counts.noise += clusters->counts().noise;
  for (std::size_t i = 0; i < objects.size(); ++i) {
    objects[i].first_number = clusters->first_number(i);
    objects[i].clusters = clusters.get();
    objects[i].cluster = i;
    const ExtentVerdict verdict = objects[i].verdict;
    if (verdict == ExtentVerdict::small) counts.small += clusters->point_count(i);
    if (verdict == ExtentVerdict::large) counts.large += clusters->point_count(i);
    if (verdict == ExtentVerdict::keep) objects_.push_back(std::move(objects[i]));
  }
  if (options_.objects || options_.labels) kept_.push_back(std::move(clusters));
}

void ObjectList::write_report() {
  std::sort(objects_.begin(), objects_.end(), [](const Object& a, const Object& b) {
    return a.entry.points != b.entry.points ? a.entry.points > b.entry.points
                                            : a.first_number < b.first_number;
  });
  report_.clusters.clear();
  for (Object& object : objects_) {
    object.entry.id = report_.clusters.size();
    if (options_.labels) {
      std::vector<std::uint32_t>& id_of = ids_[object.clusters];
      id_of.resize(object.clusters->size(), kLabelNone);
      id_of[object.cluster] = static_cast<std::uint32_t>(object.entry.id);
    }
    report_.clusters.push_back(std::move(object.entry));
  }
}

std::vector<std::uint32_t> ObjectList::labels(std::size_t first, std::size_t count) const {
  std::vector<std::uint32_t> labels(count, kLabelNone);
  for (const auto& clusters : kept_) {
    if (!ids_.contains(clusters.get())) continue;  // no object
    const std::vector<std::uint32_t>& id_of = ids_.at(clusters.get());
    const std::vector<std::uint32_t> found = clusters->labels(first, count);
    for (std::size_t i = 0; i < count; ++i)
      if (found[i] != StoredClusters::kNoCluster) labels[i] = id_of[found[i]];
  }
  return labels;
}

std::vector<std::uint32_t> ObjectList::check_sums(std::size_t first, std::size_t count) const {
  std::vector<std::uint32_t> sums(count);
  for (const auto& clusters : kept_) {
    const std::vector<std::uint32_t> found = clusters->check_sums(first, count);
    for (std::size_t i = 0; i < count; ++i)
      if (found[i] != 0) sums[i] = found[i];
  }
  return sums;
}

Status ObjectList::write_points(const std::filesystem::path& folder) const {
  return write_objects(folder, objects_.size(), options_.pipeline.execution().parallel, [&](std::size_t id) {
    write_object(folder, id, objects_[id].clusters->points(objects_[id].cluster).view());
  });
}

}  // namespace pcl_bv::detail
