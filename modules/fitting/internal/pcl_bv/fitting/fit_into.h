// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The implementations of fit.h. These functions write into an existing volume and reuse its memory. They can
// begin with supports that are known already (FitExecution::supports).
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "pcl_bv/fitting/fit.h"
#include "pcl_bv/fitting/methods.h"
#include "pcl_bv/fitting/supports.h"
#include "pcl_bv/numeric/float_environment.h"

namespace pcl_bv {
namespace [[gnu::visibility("default")]] detail {

/// Calls `fit` with a default FittedT, which is a Fitted or a class derived from a Fitted, and returns this
/// FittedT. `fit` must write the member `volume` and return the EstimationResult, which is stored, too. A
/// FloatEnvironment lives while `fit` runs. The other functions of this header make no FloatEnvironment, so
/// their callers must hold one or run in a parallel region.
template <typename FittedT, typename Fit>
FittedT make_fitted(const Fit& fit) {
  const FloatEnvironment environment;
  FittedT made;
  static_cast<EstimationResult&>(made) = fit(made);
  return made;
}

EstimationResult fit_aabb(const PointView& points, Aabb& box, const FitExecution& execution);
/// If `touching` is not null, also stores the points that touch the slabs in `*touching`.
EstimationResult fit_kdop(const PointView& points, const std::shared_ptr<const KdopSet>& set, Kdop& kdop,
                          SlabPoints* touching, const FitExecution& execution);
EstimationResult fit_sphere(const PointView& points, const SphereOptions& options, Sphere& sphere,
                            const FitExecution& execution);
EstimationResult fit_smallest_sphere(const PointView& points, Sphere& sphere, SphereCertificate& certificate,
                                     const FitExecution& execution);
EstimationResult fit_obb(const PointView& points, const ObbOptions& options, Obb& box,
                         const FitExecution& execution);
EstimationResult fit_hull(const PointView& points, Hull& hull, const FitExecution& execution);
EstimationResult fit_prism(const PointView& points, const PrismOptions& options, Prism& prism,
                           const FitExecution& execution);
EstimationResult fit_cylinder(const PointView& points, Cylinder& cylinder, const FitExecution& execution);
EstimationResult fit_capsule(const PointView& points, Capsule& capsule, const FitExecution& execution);
EstimationResult fit_ellipsoid(const PointView& points, Ellipsoid& ellipsoid,
                               EllipsoidCertificate& certificate, const FitExecution& execution);
EstimationResult fit_smallest(const PointView& points, const std::vector<const Method*>& among,
                              const MethodOptions& options, AnyVolume& volume, const Method*& winner,
                              const FitExecution& execution);

/// The implementation of a method.
struct MethodFit {
  EstimationResult (*fit)(const PointView&, const MethodOptions&, AnyVolume&, const FitExecution&);
  std::optional<DirectionSet> directions;  ///< Directions whose supports the method finds first, if any.
  bool needs_hull = false;                 ///< Whether the method needs the convex hull.
  bool needs_box = false;  ///< Whether it first needs the bounds along the coordinate axes, without points.
};

/// Fits the method to the points.
EstimationResult fit_method(const Method& method, const PointView& points, const MethodOptions& options,
                            AnyVolume& volume, const FitExecution& execution);

/// Returns the smallest set with all directions whose supports the methods find first; nothing if no method
/// finds any.
std::optional<DirectionSet> directions_of(const std::vector<const Method*>& among);

/// Prepares the fits of several methods to the same points, and returns the execution for these fits. If two
/// or more methods need the convex hull, computes the supports along dop26 and the hull. Otherwise, if two or
/// more methods find supports first, computes the supports along all their directions, unless these are only
/// the coordinate axes. Otherwise, if two or more methods need the box of the points and `execution` has no
/// supports, computes this box. Stores the results in `supports`, which must outlive the returned execution.
/// In all other cases, `supports` is not used.
FitExecution share_supports(const PointView& points, const std::vector<const Method*>& among,
                            const FitExecution& execution, Supports& supports);

/// Finds supports of several views of a cloud before they are fitted, on a device other than the processor.
class SupportFinder {
 public:
  virtual ~SupportFinder() = default;

  /// Finds supports along `set` for as many of the views as it pays for, and forgets those of earlier calls.
  /// May throw.
  virtual void find(const std::vector<PointView>& views, DirectionSet set, const Execution& execution) = 0;

  /// Returns the execution for view i, with what is known about its points. Several threads may call this
  /// function at a time. What the execution refers to lives until the next call of find().
  virtual FitExecution known(std::size_t i, const Execution& execution) const = 0;
};

}  // namespace detail
}  // namespace pcl_bv
