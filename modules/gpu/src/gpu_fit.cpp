// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "pcl_bv/gpu/gpu_fit.h"

#include <algorithm>
#include <optional>
#include <stdexcept>

#include "device_points.h"
#include "pcl_bv/fitting/fit_into.h"
#include "pcl_bv/fitting/supports.h"
#include "pcl_bv/gpu/cluster_supports.h"
#include "pcl_bv/numeric/float_environment.h"

namespace pcl_bv {
using namespace detail;
std::vector<Fitted<AnyVolume>> fit(const GpuCloud& cloud, const std::vector<const Method*>& methods,
                                   const MethodOptions& options, const Execution& execution) {
  const FloatEnvironment environment;
  if (std::count(methods.begin(), methods.end(), nullptr) > 0)
    throw std::invalid_argument("fit: methods must not have a null method");
  cloud.on_device().context()->require_alive();
  const PointView points = cloud.points();
  const std::optional<DirectionSet> set = directions_of(methods);
  const bool bounds = std::none_of(methods.begin(), methods.end(), [&](const Method* method) {
    return method->implementation->directions && needs_all_points(*method, options);
  });
  const SupportDetail detail =
      bounds && set == DirectionSet::dop6 ? SupportDetail::bounds : SupportDetail::points;

  FitExecution known(execution);
  std::optional<Supports> supports;
  if (set && !cloud.empty()) supports = supports_on_device(cloud.on_device(), *set, detail, known);
  if (supports) known.supports = &*supports;
  const std::unique_ptr<FarBlocks> far_blocks = far_blocks_on_device(cloud.on_device());
  known.far_blocks = far_blocks.get();
  Supports shared;
  const FitExecution prepared = share_supports(points, methods, known, shared);
  std::vector<Fitted<AnyVolume>> all;
  all.reserve(methods.size());
  for (const Method* method : methods) {
    all.push_back(make_fitted<Fitted<AnyVolume>>(
        [&](auto& made) { return fit_method(*method, points, options, made.volume, prepared); }));
  }
  return all;
}

}  // namespace pcl_bv
