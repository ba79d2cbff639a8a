// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "pcl_bv/trees/volume_tree.h"

#include <limits>
#include <sstream>
#include <stdexcept>

#include "pcl_bv/numeric/float_environment.h"
#include "pcl_bv/parallel/for_each_chunk.h"
#include "volume_nodes.h"

namespace pcl_bv {
using namespace detail;
namespace {

// Returns whether the rounding errors of the interval that intersect() computes may exceed
// VolumeBoxes::margin().
bool is_too_flat_for_rays(const AnyVolume& volume) {
  const auto* const ellipsoid = std::get_if<Ellipsoid>(&volume);
  return ellipsoid != nullptr && !ellipsoid->empty() &&
         !(ellipsoid->radii().maxCoeff() <= 0x1p20 * ellipsoid->radii().minCoeff());
}

void require_usable(const std::vector<AnyVolume>& volumes) {
  if (volumes.size() > std::numeric_limits<std::int32_t>::max()) {
    std::ostringstream what;
    what << "VolumeTree: takes 0 to 2147483647 volumes, not " << volumes.size();
    throw std::invalid_argument(what.str());
  }
}

}  // namespace

void VolumeTree::Nodes::measure(bool new_order, const Execution& execution) {
  std::vector<PositionBounds> extents(volumes.size());
  for_each_range(execution.parallel, volumes.size(), kVolumesOfChunk,
                 [&](std::size_t begin, std::size_t end) {
                   for (std::size_t i = begin; i < end; ++i)
                     extents[i] = extent_of(volumes[i]);
                 });
  if (new_order) {
    boxes.build(extents, execution.parallel);
  } else {
    boxes.refit(extents);
  }
  too_flat_for_rays.clear();
  for (std::uint32_t i = 0; i < volumes.size(); ++i) {
    if (is_too_flat_for_rays(volumes[i])) too_flat_for_rays.push_back(i);
  }
}

VolumeTree::VolumeTree() : nodes_(std::make_shared<Nodes>()) {}

VolumeTree::VolumeTree(std::vector<AnyVolume> volumes, const Execution& execution)
    : nodes_(std::make_shared<Nodes>()) {
  const FloatEnvironment environment;
  require_usable(volumes);
  nodes_->volumes = std::move(volumes);
  nodes_->measure(true, execution);
}

void VolumeTree::refit(std::vector<AnyVolume> volumes, const Execution& execution) {
  const FloatEnvironment environment;
  require_usable(volumes);
  if (volumes.size() != size()) {
    std::ostringstream what;
    what << "VolumeTree: refit() takes " << size() << " volumes, as many as the tree has, not "
         << volumes.size();
    throw std::invalid_argument(what.str());
  }
  auto nodes = std::make_shared<Nodes>();
  nodes->volumes = std::move(volumes);
  nodes->boxes = nodes_->boxes;
  nodes->measure(false, execution);
  nodes_ = std::move(nodes);
}

std::size_t VolumeTree::size() const {
  return nodes_->volumes.size();
}

const std::vector<AnyVolume>& VolumeTree::volumes() const {
  return nodes_->volumes;
}

void VolumeTree::first_hits(const std::vector<Ray>& rays, std::vector<VolumeHit>& hits,
                            const Execution& execution) const {
  constexpr std::size_t rays_of_chunk = 256;
  hits.resize(rays.size());
  for_each_range(execution.parallel, rays.size(), rays_of_chunk, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      hits[i] = first_hit(rays[i].origin, rays[i].direction).value_or(VolumeHit{-1, {}});
  });
}

}  // namespace pcl_bv
