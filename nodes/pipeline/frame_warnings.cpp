// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "pcl_bv/nodes/frame_result.h"

#include <cmath>
#include <limits>
#include <utility>

#include "ground.h"
#include "pcl_bv/io/number_text.h"
#include "pcl_bv/io/untrusted_text.h"
#include "pcl_bv/segmentation/ground.h"
#include "pcl_bv/segmentation/up.h"
#include "pipeline/config/settings.h"
#include "pipeline/deskew/point_times.h"

namespace pcl_bv {
using namespace detail;
namespace {

// Smallest share of points beyond 100 m that gives a warning. On a motorway, a tenth of the points may be so
// far away without a problem.
constexpr double kMinFarShare = 0.2;

// If the share of ground is smaller, other_up() searches for another up direction. In streets, 30 % to 60 %
// of the points are ground; in cluttered streets, 13 %.
constexpr double kLittleGround = 0.15;

struct Found {
  const Frame& frame;
  const FrameResult& result;
  const SettingName& name;
  bool& searched;  // whether little ground has led to a search for another up direction

  const PipelineConfig& config() const { return *result.config; }
  bool zones() const { return config().ground.method == GroundMethod::zones; }
  double ground_share() const {
    const Counts& c = result.counts;
    const std::size_t kept = result.points - c.nonfinite - c.range - c.inside;
    return kept < kFewPoints ? 1 : static_cast<double>(c.ground) / static_cast<double>(kept);
  }
  std::optional<OtherUp> other_up() const {
    if (config().ground.method == GroundMethod::slope) return {};  // maps have no sensor above the ground
    const double share = result.counts.ground > 0 ? ground_share() : 0;
    return find_other_up(result.cloud_of(frame), plane_settings(config().ground), result.sensor.position,
                         share);
  }
};

std::string percent(double share) {
  return std::to_string(std::lround(100 * share)) + " %";
}

std::string text_of(const Eigen::Vector3d& position) {
  std::string text = "(";
  for (const double coordinate : position) {
    const std::string number =
        std::abs(coordinate) < 1e9 ? fixed_text(coordinate, 1) : general_text(coordinate, 6);
    text.append(text.size() > 1 ? ", " : "").append(number);
  }
  return text + ')';
}

std::string no_ground(const Found& f) {
  std::string text = ground_warning(f.result, f.name);
  if (text.empty() || f.result.counts.ground > 0) return text;
  const auto other = f.other_up();
  if (!other) return text;
  return ground_warning(
      f.result, f.name,
      ' ' + format_up(other->up) + " (" + percent(other->share) + " of the points would be ground)");
}

std::string little_ground(const Found& f) {
  const double share = f.ground_share();
  if (f.config().ground.method == GroundMethod::none || share == 0 || share >= kLittleGround) return {};
  // Searches only once per configuration. A cluttered stream has little ground in every frame, and each
  // search takes milliseconds.
  if (std::exchange(f.searched, true)) return {};
  const auto other = f.other_up();
  if (!other) return {};
  return "only " + percent(share) + " of the points are ground (up is " + format_up(f.config().ground.up) +
         "), " + percent(other->share) + " would be with the opposite up: if the cloud is upside down, use " +
         f.name("ground.up") + ' ' + format_up(other->up);
}

std::string sensor_elsewhere(const Found& f) {
  if (!f.zones() || f.result.sensor.confirmed) return {};
  if (const auto& given = f.config().ground.sensor)
    return "few points lie around " + f.name("ground.sensor") + ' ' + text_of(*given) +
           ", the centre of ground zones: ground may be missed";
  return "the points do not lie around the origin: ground zones are centred at " +
         text_of(f.result.sensor.position) +
         ", where the points are densest; if the sensor was elsewhere, use " + f.name("ground.sensor");
}

std::string origin_elsewhere(const Found& f) {
  if (f.result.around_origin) return {};
  const bool range = f.config().filter.range_max < std::numeric_limits<double>::infinity();
  const bool growth = f.config().cluster.tolerance_per_metre > 0;
  if (!range && !growth) return {};
  return (range ? f.name("filter.range_max") : "") + (range && growth ? " and " : "") +
         (growth ? f.name("cluster.tolerance_per_metre") : "") + (range && growth ? " are" : " is") +
         " measured from the origin, but the points do not lie around it";
}

std::string far_points(const Found& f) {
  if (!f.zones() || f.result.sensor.far_share < kMinFarShare) return {};
  return percent(f.result.sensor.far_share) + " of the points are 100 m or more from " +
         text_of(f.result.sensor.position) +
         ", the centre of ground zones: the ground there is a rough estimate";
}

std::string level_ground(const Found& f) {
  if (!f.zones() || !f.result.ground.assumed_level || f.result.counts.ground == 0) return {};
  return "no plane lies " + f.name("ground.sensor_height") + ' ' + to_text(*f.config().ground.sensor_height) +
         " m below the sensor, within 0.5 m: level ground is assumed there";
}

template <TrackTime... times>
std::string track_times(const Found& f) {
  return ((f.result.track_time == times) || ...) ? track_warning(f.result) : std::string();
}

// Returns whether the sensor of a rig has returns, but no times of a sweep.
bool lacks_times(const Frame& frame, const SensorPart& part) {
  if (frame.seconds == nullptr || times_differ(frame.seconds + part.first, part.count)) return false;
  for (std::size_t i = part.first; i < part.first + part.count; ++i)
    if (has_return(load_point(frame.points, i))) return true;
  return false;
}

std::string points_not_moved(const Found& f) {
  const std::vector<SensorPart>& sensors = f.frame.sensors;
  if (sensors.empty() || f.config().deskew != Deskew::on || f.result.deskew.outcome == DeskewOutcome::off)
    return deskew_warning(f.result);
  constexpr std::size_t max_names = 5;
  std::string names;
  std::size_t count = 0;
  for (const SensorPart& part : sensors) {
    if (!lacks_times(f.frame, part)) continue;
    if (++count <= max_names) names += (names.empty() ? "" : ", ") + part.name;
  }
  if (count > max_names) names += " and " + std::to_string(count - max_names) + " others";
  if (count > 0)
    return printable(names) +
           ": points cannot be moved to the stamp: they have no times, or times that are not those of a "
           "sweep";
  return f.result.deskew.outcome == DeskewOutcome::no_times ? "" : deskew_warning(f.result);
}

constexpr std::string (*kKinds[])(const Found&) = {no_ground,
                                                   little_ground,
                                                   sensor_elsewhere,
                                                   origin_elsewhere,
                                                   far_points,
                                                   level_ground,
                                                   track_times<TrackTime::recorded, TrackTime::none>,
                                                   track_times<TrackTime::gap>,
                                                   track_times<TrackTime::restarted>,
                                                   points_not_moved};

}  // namespace

std::vector<std::string> FrameWarnings::take(const Frame& frame, const FrameResult& result) {
  if (config_ != result.config) {
    returned_ = 0;
    searched_ = false;
  }
  config_ = result.config;
  std::vector<std::string> texts;
  std::uint32_t bit = 1;
  for (const auto& kind : kKinds) {
    std::string text = (returned_ & bit) != 0 ? "" : kind({frame, result, name_, searched_});
    if (!text.empty()) {
      returned_ |= bit;
      texts.push_back(std::move(text));
    }
    bit <<= 1;
  }
  return texts;
}

}  // namespace pcl_bv
