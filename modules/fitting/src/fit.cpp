// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "pcl_bv/fitting/fit.h"

#include <algorithm>
#include <chrono>
#include <numeric>
#include <utility>

#include "pcl_bv/fitting/fit_into.h"
#include "pcl_bv/numeric/float_environment.h"
#include "pcl_bv/parallel/for_each_chunk.h"
#include "schedule.h"

namespace pcl_bv {
using namespace detail;
namespace {

constexpr std::size_t kManyPoints = 200'000;

// Returns the time of the call in seconds. The time of a fit must be measured, because methods differ much.
// For 300 points, a box takes 0.2 us and a capsule about a thousand times as long.
template <typename Call>
double seconds(const Call& call) {
  const auto begin = std::chrono::steady_clock::now();
  call();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

// Fits one volume to each cluster.
template <typename Fit>
auto fit_each(const PointView& points, const IndexLists& clusters, const Execution& execution,
              const Fit& fit) {
  const std::vector<PointView> views = subsets(points, clusters);
  std::vector<decltype(fit(points, execution))> all(views.size());
  for_each_view(
      views, [&](std::size_t i, const Execution& own) { all[i] = fit(views[i], own); }, execution);
  return all;
}

}  // namespace

Fitted<Aabb> fit_aabb(const PointView& points, const Execution& execution) {
  return make_fitted<Fitted<Aabb>>(
      [&](auto& made) { return detail::fit_aabb(points, made.volume, execution); });
}

Fitted<Kdop> fit_kdop(const PointView& points, const std::shared_ptr<const KdopSet>& set,
                      const Execution& execution) {
  return make_fitted<Fitted<Kdop>>(
      [&](auto& made) { return detail::fit_kdop(points, set, made.volume, nullptr, execution); });
}

KdopWithContacts fit_kdop_with_contacts(const PointView& points, const std::shared_ptr<const KdopSet>& set,
                                        const Execution& execution) {
  return make_fitted<KdopWithContacts>(
      [&](auto& made) { return detail::fit_kdop(points, set, made.volume, &made.contacts, execution); });
}

Fitted<Sphere> fit_sphere(const PointView& points, const SphereOptions& options, const Execution& execution) {
  return make_fitted<Fitted<Sphere>>(
      [&](auto& made) { return detail::fit_sphere(points, options, made.volume, execution); });
}

Certified<Sphere, SphereCertificate> fit_smallest_sphere(const PointView& points,
                                                         const Execution& execution) {
  return make_fitted<Certified<Sphere, SphereCertificate>>([&](auto& made) {
    return detail::fit_smallest_sphere(points, made.volume, made.certificate, execution);
  });
}

Fitted<Obb> fit_obb(const PointView& points, const ObbOptions& options, const Execution& execution) {
  return make_fitted<Fitted<Obb>>(
      [&](auto& made) { return detail::fit_obb(points, options, made.volume, execution); });
}

Fitted<Hull> fit_hull(const PointView& points, const Execution& execution) {
  return make_fitted<Fitted<Hull>>(
      [&](auto& made) { return detail::fit_hull(points, made.volume, execution); });
}

Fitted<Prism> fit_prism(const PointView& points, const PrismOptions& options, const Execution& execution) {
  return make_fitted<Fitted<Prism>>(
      [&](auto& made) { return detail::fit_prism(points, options, made.volume, execution); });
}

Fitted<Cylinder> fit_cylinder(const PointView& points, const Execution& execution) {
  return make_fitted<Fitted<Cylinder>>(
      [&](auto& made) { return detail::fit_cylinder(points, made.volume, execution); });
}

Fitted<Capsule> fit_capsule(const PointView& points, const Execution& execution) {
  return make_fitted<Fitted<Capsule>>(
      [&](auto& made) { return detail::fit_capsule(points, made.volume, execution); });
}

Fitted<Ellipsoid> fit_ellipsoid(const PointView& points, const Execution& execution) {
  return fit_smallest_ellipsoid(points, execution);
}

Certified<Ellipsoid, EllipsoidCertificate> fit_smallest_ellipsoid(const PointView& points,
                                                                  const Execution& execution) {
  return make_fitted<Certified<Ellipsoid, EllipsoidCertificate>>(
      [&](auto& made) { return detail::fit_ellipsoid(points, made.volume, made.certificate, execution); });
}

std::vector<Fitted<Aabb>> fit_aabb(const PointView& points, const IndexLists& clusters,
                                   const Execution& execution) {
  return fit_each(points, clusters, execution,
                  [](const PointView& view, const Execution& own) { return fit_aabb(view, own); });
}

std::vector<Fitted<Kdop>> fit_kdop(const PointView& points, const IndexLists& clusters,
                                   const std::shared_ptr<const KdopSet>& set, const Execution& execution) {
  return fit_each(points, clusters, execution,
                  [&](const PointView& view, const Execution& own) { return fit_kdop(view, set, own); });
}

std::vector<Fitted<Sphere>> fit_sphere(const PointView& points, const IndexLists& clusters,
                                       const SphereOptions& options, const Execution& execution) {
  return fit_each(points, clusters, execution, [&](const PointView& view, const Execution& own) {
    return fit_sphere(view, options, own);
  });
}

std::vector<Fitted<Obb>> fit_obb(const PointView& points, const IndexLists& clusters,
                                 const ObbOptions& options, const Execution& execution) {
  return fit_each(points, clusters, execution,
                  [&](const PointView& view, const Execution& own) { return fit_obb(view, options, own); });
}

std::vector<Fitted<Hull>> fit_hull(const PointView& points, const IndexLists& clusters,
                                   const Execution& execution) {
  return fit_each(points, clusters, execution,
                  [](const PointView& view, const Execution& own) { return fit_hull(view, own); });
}

std::vector<Fitted<Prism>> fit_prism(const PointView& points, const IndexLists& clusters,
                                     const PrismOptions& options, const Execution& execution) {
  return fit_each(points, clusters, execution,
                  [&](const PointView& view, const Execution& own) { return fit_prism(view, options, own); });
}

std::vector<Fitted<Cylinder>> fit_cylinder(const PointView& points, const IndexLists& clusters,
                                           const Execution& execution) {
  return fit_each(points, clusters, execution,
                  [](const PointView& view, const Execution& own) { return fit_cylinder(view, own); });
}

std::vector<Fitted<Capsule>> fit_capsule(const PointView& points, const IndexLists& clusters,
                                         const Execution& execution) {
  return fit_each(points, clusters, execution,
                  [](const PointView& view, const Execution& own) { return fit_capsule(view, own); });
}

std::vector<Fitted<Ellipsoid>> fit_ellipsoid(const PointView& points, const IndexLists& clusters,
                                             const Execution& execution) {
  return fit_each(points, clusters, execution,
                  [](const PointView& view, const Execution& own) { return fit_ellipsoid(view, own); });
}

void for_each_view(const std::vector<PointView>& views,
                   const std::function<void(std::size_t, const Execution&)>& fit,
                   const Execution& execution) {
  const FloatEnvironment environment;  // for the fits that run outside of the parallel region below
  const auto larger = [&](std::size_t a, std::size_t b) {
    return std::make_pair(views[b].count, a) < std::make_pair(views[a].count, b);
  };
  // Clusters are usually in descending order of size. In this case nothing is sorted or allocated.
  std::vector<std::size_t> order;
  const auto by_count = [](const PointView& a, const PointView& b) { return a.count > b.count; };
  if (!std::is_sorted(views.begin(), views.end(), by_count)) {
    order.resize(views.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::sort(order.begin(), order.end(), larger);
  }
  const auto nth = [&](std::size_t n) { return order.empty() ? n : order[n]; };

  std::size_t small = 0;
  for (; small < views.size() && views[nth(small)].count >= kManyPoints; ++small)
    fit(nth(small), execution);
  if (small == views.size()) return;
  // The time of one view of middle size predicts the time of the others. Only the number of threads depends
  // on this prediction. The largest view would predict better, but its fit takes longer, and the other
  // threads wait meanwhile.
  const Execution serial{Serial{}, execution.isa};
  const std::size_t probe =
      thread_count(execution.parallel) == 1 ? small : small + (views.size() - small) / 2;
  const double took = seconds([&] { fit(nth(probe), serial); });
  const auto weight = [&](std::size_t n) { return static_cast<double>(views[nth(n)].count + 1); };
  double points = -weight(probe);
  for (std::size_t n = small; n < views.size(); ++n)
    points += weight(n);
  const ParallelPolicy policy = worthwhile(execution.parallel, took / weight(probe) * points);
  for_each_chunk(policy, views.size() - small - 1, [&](std::size_t i) {
    const std::size_t n = small + i;
    fit(nth(n < probe ? n : n + 1), serial);
  });
}

}  // namespace pcl_bv
