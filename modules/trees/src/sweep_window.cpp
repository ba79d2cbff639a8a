// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "pcl_bv/trees/sweep_window.h"

#include <stdexcept>
#include <utility>

namespace pcl_bv {

SweepWindow::SweepWindow(std::size_t sweeps) : capacity_(sweeps) {
  if (sweeps == 0) throw std::invalid_argument("SweepWindow: must hold 1 sweep or more, not 0");
}

void SweepWindow::add(const PointView& points, const Execution& execution) {
  if (points.count > 0 && points_ > 0 && points.scalar != scalar_)
    throw std::invalid_argument(points.scalar == ScalarType::float64
                                    ? "SweepWindow: the points are double, the window holds float points"
                                    : "SweepWindow: the points are float, the window holds double points");
  // Partial adds PointView::first to the number that it is given, so first is subtracted here. Unsigned
  // numbers wrap.
  const std::size_t number = static_cast<std::size_t>(first_) + points_;
  const Partial sweep(points, number - points.first, execution);
  Partial with_sweep = newest_merged_;
  with_sweep.merge(sweep);
  newest_.push_back({sweep, points.count});
  newest_merged_ = std::move(with_sweep);
  points_ += points.count;
  if (points.count > 0) scalar_ = points.scalar;
  merged_.reset();
  if (size() > capacity_) drop_oldest();
}

void SweepWindow::drop_oldest() {
  if (size() == 0) return;
  if (oldest_.empty()) refill_oldest();
  first_ += oldest_.back().points;
  points_ -= oldest_.back().points;
  oldest_.pop_back();
  merged_.reset();
}

void SweepWindow::refill_oldest() {
  for (auto sweep = newest_.rbegin(); sweep != newest_.rend(); ++sweep) {
    Partial with_newer = sweep->merged;
    if (!oldest_.empty()) with_newer.merge(oldest_.back().merged);
    oldest_.push_back({std::move(with_newer), sweep->points});
  }
  newest_.clear();
  newest_merged_ = Partial();
}

const Partial& SweepWindow::merged() const {
  if (!merged_) {
    Partial all = newest_merged_;
    if (!oldest_.empty()) all.merge(oldest_.back().merged);
    merged_ = std::move(all);
  }
  return *merged_;
}

}  // namespace pcl_bv
