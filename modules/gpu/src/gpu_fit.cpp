// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "pcl_bv/gpu/gpu_fit.h"

#include <algorithm>
#include <optional>
#include <stdexcept>

#include "pcl_bv/fitting/fit_into.h"
#include "pcl_bv/fitting/supports.h"
#include "pcl_bv/numeric/float_environment.h"
#include "support_pass.h"

namespace pcl_bv {
using namespace detail;
namespace {

// The device has the coordinates of float points themselves, so its box must be that of the support points.
void require_same_box(const DeviceExtremes& found, const Supports& supports) {
  bool same = true;
  for (std::size_t axis = 0; axis < 3 && supports.used > 0; ++axis)
    same =
        same && supports.along[axis].low == found.low[axis] && supports.along[axis].high == found.high[axis];
  if (!same) throw std::invalid_argument("fit: the points have changed since they were copied to the device");
}

// Returns the supports along `set`, or nothing if the processor has to search them.
std::optional<Supports> supports_by_device(const GpuCloud& cloud, DirectionSet set, SupportDetail detail,
                                           const FitExecution& execution) {
  const DevicePoints& on_device = cloud.on_device();
  const PointView points = cloud.points();
  const bool bounds = detail == SupportDetail::bounds && !on_device.rounded();
  const DeviceExtremes found = find_extremes(on_device, set, !bounds);
  if (bounds) return supports_of_bounds(points, found.low, found.high, found.dropped, execution);
  if (!found.complete) return std::nullopt;
  std::vector<std::byte> storage;
  Supports supports =
      find_supports_among(points, on_device.blocks(found.candidates, storage), set, found.dropped, execution);
  if (!on_device.rounded()) require_same_box(found, supports);
  return supports;
}

}  // namespace

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
  if (set && !cloud.empty()) supports = supports_by_device(cloud, *set, detail, known);
  if (supports) known.supports = &*supports;
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
