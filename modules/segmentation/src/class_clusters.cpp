// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "pcl_bv/segmentation/class_clusters.h"

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <string>

#include "collect.h"
#include "pcl_bv/points/select_points.h"

namespace pcl_bv::detail {
namespace {

void check(const std::vector<ClassOptions>& class_options) {
  for (auto one = class_options.begin(); one != class_options.end(); ++one) {
    const auto same = [&](const ClassOptions& other) { return other.value == one->value; };
    if (std::any_of(class_options.begin(), one, same))
      throw std::invalid_argument("class " + std::to_string(one->value) + " has two entries in the settings");
  }
}

std::int64_t class_of_point(const std::vector<std::int64_t>& classes, std::size_t index) {
  if (index < classes.size()) return classes[index];
  throw std::invalid_argument("point " + std::to_string(index) + " has no class: there are classes for " +
                              std::to_string(classes.size()) + " points");
}

std::size_t count_valid(const PointView& points) {
  std::size_t valid = 0;
  for (std::size_t i = 0; i < points.count; ++i)
    valid += is_valid(load_point(points, i)) ? 1 : 0;
  return valid;
}

}  // namespace

// Makes a group for each class.
void ClassClusterer::make_groups(const PointView& points, const std::vector<std::int64_t>& classes) {
  values_.clear();
  for (std::size_t i = 0; i < points.count; ++i) {
    const std::int64_t value = class_of_point(classes, points.index(i));
    if (values_.empty() || values_.back() != value) values_.push_back(value);
  }
  std::sort(values_.begin(), values_.end());
  values_.erase(std::unique(values_.begin(), values_.end()), values_.end());
  groups_.clear();
  for (const std::int64_t value : values_)
    groups_.push_back({value, 0, 0});
}

ClassClusterer::Group& ClassClusterer::group_of(std::int64_t value) {
  return groups_[static_cast<std::size_t>(std::lower_bound(values_.begin(), values_.end(), value) -
                                          values_.begin())];
}

// Writes the point indices to numbers_, ordered by class, and within a class in the order of the view.
void ClassClusterer::sort_points(const PointView& points, const std::vector<std::int64_t>& classes) {
  make_groups(points, classes);
  for (std::size_t i = 0; i < points.count; ++i)
    ++group_of(classes[points.index(i)]).count;
  std::size_t end = 0;
  for (Group& group : groups_) {
    group.end = end;
    end += group.count;
  }
  numbers_.resize(end);
  for (std::size_t i = 0; i < points.count; ++i) {
    const std::size_t index = points.index(i);
    numbers_[group_of(classes[index]).end++] = static_cast<std::int32_t>(index);
  }
}

void ClassClusterer::extract(const PointView& points, const std::vector<std::int64_t>& classes,
                             const ClusterOptions& defaults, const std::vector<ClassOptions>& class_options,
                             Clusters& clusters, std::vector<std::int64_t>& class_of,
                             const Execution& execution) {
  check(class_options);
  sort_points(points, classes);
  clusterer_.extract(points.slice(0, 0), defaults, all_, execution);  // checks the options and empties all_
  found_class_.clear();
  for (const Group& group : groups_) {
    const auto options = std::find_if(class_options.begin(), class_options.end(),
                                      [&](const ClassOptions& one) { return one.value == group.value; });
    const PointView part = select_points(points, numbers_.data() + (group.end - group.count), group.count);
    if (options != class_options.end() && options->drop) {
      all_.class_points += count_valid(part);
      continue;
    }
    clusterer_.extract(part, options == class_options.end() ? defaults : options->clusters, found_,
                       execution);
    for (std::size_t i = 0; i < found_.size(); ++i)
      append(found_, i, all_);
    found_class_.insert(found_class_.end(), found_.size(), group.value);
    all_.small_points += found_.small_points;
    all_.large_points += found_.large_points;
    all_.noise_points += found_.noise_points;
  }
  clusters.small_points = all_.small_points;
  clusters.large_points = all_.large_points;
  clusters.noise_points = all_.noise_points;
  clusters.class_points = all_.class_points;
  write_sorted(all_, std::numeric_limits<std::size_t>::max(), order_, clusters);
  class_of.clear();
  for (const std::size_t i : order_)
    class_of.push_back(found_class_[i]);
}

}  // namespace pcl_bv::detail
