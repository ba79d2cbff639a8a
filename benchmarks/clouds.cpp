// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Scenes of datasets-synth, laid out in memory as callers lay them out.

#include "clouds.h"

#include <limits>
#include <numeric>
#include <span>
#include <stdexcept>

#include "meshes.h"
#include "pcl_bv/estimation/fit_cloud.h"
#include "pcl_bv/points/point_groups.h"
#include "pcl_bv/synth/synth.h"
#include "program.h"
#include "shapes.h"

namespace pcl_bv::bench {
using namespace detail;
namespace {

using Coordinates = std::span<const float>;

std::vector<float> make_scene(const std::string& scene, std::size_t points) {
  if (const Mesh* mesh = find_mesh(scene)) return mesh->first_points(points);
  if (std::vector<float> shape = make_shape(scene, points); !shape.empty()) return shape;
  const std::string count = std::to_string(points);
  const std::string spec = scene == "paper"  ? "paper-" + count
                           : scene == "cube" ? "box:" + count
                                             : scene + ":" + count;
  return make_synth(parse_synth(spec)).xyz;
}

void spoil(const std::string& bad, std::vector<float>& xyz) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const std::size_t points = xyz.size() / 3;
  if (bad == "one-nan") xyz[3 * (points / 2) + 1] = nan;
  if (bad == "1pc-nan") {
    for (std::size_t i = 50; i < points; i += 100)
      xyz[3 * i + i % 3] = nan;
  }
}

template <typename PointT>
std::shared_ptr<pcl::PointCloud<PointT>> pcl_cloud(Coordinates xyz) {
  auto points = std::make_shared<pcl::PointCloud<PointT>>();
  points->resize(xyz.size() / 3);
  for (std::size_t i = 0; i < points->size(); ++i) {
    PointT& p = (*points)[i];
    p.x = xyz[3 * i], p.y = xyz[3 * i + 1], p.z = xyz[3 * i + 2];
  }
  return points;
}

void lay_out_xyz(Coordinates xyz, Cloud& out) {
  const auto points = pcl_cloud<pcl::PointXYZ>(xyz);
  out.view = point_view(*points);
  out.pcl = points;
}

void lay_out_xyzi(Coordinates xyz, Cloud& out) {
  const auto points = pcl_cloud<pcl::PointXYZI>(xyz);
  out.view = point_view(*points);
  out.memory = points;
}

template <typename T>
void lay_out_packed(Coordinates xyz, Cloud& out) {
  const auto copy = std::make_shared<std::vector<T>>(xyz.begin(), xyz.end());
  out.view = PointView::of(copy->data(), 3 * sizeof(T), copy->size() / 3);
  out.memory = copy;
}

void lay_out_groups(Coordinates xyz, Cloud& out) {
  const auto groups =
      std::make_shared<PointGroups>(PointView::of(xyz.data(), 3 * sizeof(float), xyz.size() / 3));
  out.view = groups->view();
  out.memory = groups;
}

void lay_out_indices(Coordinates xyz, Cloud& out) {
  struct Both {
    std::shared_ptr<pcl::PointCloud<pcl::PointXYZ>> points;
    pcl::Indices indices;
  };
  const auto both = std::make_shared<Both>();
  both->points = pcl_cloud<pcl::PointXYZ>(xyz);
  both->indices.resize(both->points->size());
  std::iota(both->indices.begin(), both->indices.end(), 0);
  out.view = point_view(*both->points, both->indices);
  out.memory = both;
}

struct LayoutEntry {
  std::string name;
  void (*lay_out)(Coordinates, Cloud&);
};

const std::vector<LayoutEntry>& layout_table() {
  static const std::vector<LayoutEntry> table = {
      {"xyz", lay_out_xyz},         {"packed", lay_out_packed<float>},  {"xyzi", lay_out_xyzi},
      {"indices", lay_out_indices}, {"double", lay_out_packed<double>}, {"groups", lay_out_groups},
  };
  return table;
}

std::size_t bytes_read(const PointView& view) {
  const std::size_t record = view.order == PointOrder::groups ? 3 * size_of(view.scalar) : view.stride;
  return view.count * (record + (view.indices ? sizeof(*view.indices) : 0));
}

// The last scene, in case the next cloud is another layout or, of points drawn one after another, a part of
// it.
Coordinates scene_of(const CloudName& name) {
  static CloudName made;
  static std::vector<float> xyz;
  const bool part = name.scene == "gauss" && name.points < made.points;
  if (made.scene != name.scene || made.bad != name.bad || (made.points != name.points && !part) ||
      (part && name.bad != "no-nan")) {
    xyz = {};  // before the next one is made: memory holds one
    xyz = make_scene(name.scene, name.points);
    if (xyz.size() != 3 * name.points) throw std::logic_error(name.text() + ": another number of points");
    spoil(name.bad, xyz);
    made = name;
  }
  return Coordinates(xyz).first(3 * name.points);
}

}  // namespace

std::string CloudName::text() const {
  return scene + '/' + layout + '/' + bad + "/n:" + std::to_string(points);
}

const std::vector<std::string>& layouts() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all;
    for (const LayoutEntry& entry : layout_table())
      all.push_back(entry.name);
    return all;
  }();
  return names;
}

Cloud& cloud(const CloudName& wanted) {
  static Cloud last;
  CloudName name = wanted;
  name.points = wanted.scene == "paper" && tiny() ? kPaperSizes[0] : points_in_this_run(wanted.points);
  if (last.name == name) return last;
  last = Cloud();
  for (const LayoutEntry& entry : layout_table()) {
    if (entry.name != name.layout) continue;
    entry.lay_out(scene_of(name), last);
    last.bytes = bytes_read(last.view);
    last.name = name;
    return last;
  }
  throw std::logic_error("no layout " + name.layout);
}

}  // namespace pcl_bv::bench
