// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The method table, driven; AnyVolume compares by value.

#include "fits.h"

#include <benchmark/benchmark.h>

#include <stdexcept>

#include "pcl_bv/fitting/fit.h"

namespace pcl_bv::bench {
using namespace detail;
namespace {

const std::string kWithPoints = "-points";

detail::Supports extremes_with_points(const Cloud& cloud, const Execution& execution) {
  return detail::find_supports(cloud.view, DirectionSet::dop26, detail::SupportDetail::points, execution);
}

bool same_points(const detail::Supports& a, const detail::Supports& b) {
  for (std::size_t k = 0; k < kMaxDirections; ++k) {
    if (a.along[k].low_point.index != b.along[k].low_point.index ||
        a.along[k].high_point.index != b.along[k].high_point.index) {
      return false;
    }
  }
  return a.used == b.used;
}

}  // namespace

void require(bool holds, const std::string& what) {
  if (!holds) throw std::logic_error(what);
}

Fit::Fit(const std::string& work) : name_(work), with_points_(work.ends_with(kWithPoints)) {
  const std::size_t plus = work.find('+');
  if (plus != std::string::npos) options_.growth = parse_growth(work.substr(plus + 1));
  method_ =
      find_method(with_points_ ? work.substr(0, work.size() - kWithPoints.size()) : work.substr(0, plus));
  require(method_ != nullptr, "no method " + work);
}

AnyVolume Fit::volume(const Cloud& cloud, const Execution& execution) const {
  return method_->fit(cloud.view, options_, execution).volume;
}

void Fit::check(Cloud& cloud, const Execution& execution) const {
  const Execution reference{Serial{}, Isa::scalar};
  const std::string row = name_ + " of " + cloud.name.text();
  if (!cloud.proven.contains(name_)) {
    const AnyVolume expected = volume(cloud, reference);
    require(verify(expected, cloud.view, {OpenMP{}, Isa::automatic}).outside == 0,
            row + ": a point is outside");
    cloud.proven.emplace(name_, expected);
  }
  require(volume(cloud, execution) == cloud.proven.at(name_), row + ": not the reference's answer");
  if (!with_points_) return;
  if (!cloud.supports) cloud.supports = extremes_with_points(cloud, reference);
  require(same_points(extremes_with_points(cloud, execution), *cloud.supports), row + ": other points");
}

void Fit::operator()(const Cloud& cloud, const Execution& execution) const {
  if (with_points_) {
    benchmark::DoNotOptimize(extremes_with_points(cloud, execution));
  } else {
    benchmark::DoNotOptimize(volume(cloud, execution));
  }
}

}  // namespace pcl_bv::bench
