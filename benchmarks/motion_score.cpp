// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "motion_score.h"

#include <algorithm>
#include <cmath>

namespace pcl_bv::bench {
namespace {

constexpr double kPi = 3.14159265358979323846;

double quantile(std::vector<double> values, double share) {
  if (values.empty()) return 0;
  const auto place = static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + place, values.end());
  return values[static_cast<std::size_t>(place)];
}

}  // namespace

void MotionScore::add(const MotionSighting& sighting) {
  const double error = (sighting.velocity - sighting.true_velocity).head<2>().norm();
  errors_.push_back(error);
  const bool moves_truly = sighting.true_velocity.norm() >= moves;
  asked_[moves_truly] += 1;
  right_[moves_truly] += sighting.moving == moves_truly;
  if (!sighting.turn) return;
  const Key key{sequence_, {sighting.object, sighting.track}};
  ++boxes_;
  const auto [last, first] = last_turn_.try_emplace(key, *sighting.turn);
  flips_ += !first && std::abs(std::remainder(*sighting.turn - last->second, 2 * kPi)) > 0.75 * kPi;
  last->second = *sighting.turn;
  if (moves_truly || sighting.range >= near) return;
  turns_[key].push_back(*sighting.turn);
  lengths_[key].push_back(sighting.length);
}

double MotionScore::velocity_error(double share) const {
  return quantile(errors_, share);
}

double MotionScore::turn_jitter(double share) const {
  std::vector<double> all;
  for (const auto& [key, turns] : turns_) {
    // The median of angles: the one of least mean distance to the others.
    double best = 0, least = -1;
    for (const double middle : turns) {
      double sum = 0;
      for (const double turn : turns)
        sum += std::abs(std::remainder(turn - middle, kPi));
      if (least >= 0 && sum >= least) continue;
      least = sum;
      best = middle;
    }
    for (const double turn : turns)
      all.push_back(std::abs(std::remainder(turn - best, kPi)) * 180 / kPi);
  }
  return quantile(all, share);
}

double MotionScore::length_jitter(double share) const {
  std::vector<double> all;
  for (const auto& [key, lengths] : lengths_) {
    const double middle = quantile(lengths, 0.5);
    for (const double length : lengths)
      all.push_back(std::abs(length - middle));
  }
  return quantile(all, share);
}

}  // namespace pcl_bv::bench
