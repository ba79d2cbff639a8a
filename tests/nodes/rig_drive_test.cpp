// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// A robot with two LiDARs that turns at 30 degrees a second (synth rig), from its sweeps to tracked objects.

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <map>

#include "pcl_bv/nodes/frame_pipeline.h"
#include "pcl_bv/synth/rig_drive.h"
#include "pipeline/track/occlusion.h"
#include "pipeline/track/viewpoints.h"
#include "stream/rig/rig_source.h"

namespace pcl_bv::detail {
namespace {

using namespace std::chrono_literals;
using Kind = RigObject::Kind;

constexpr double kStart = 1000;  // stamp of the first sweep, seconds

Pose pose_of(const RigPose& rows) {
  Pose pose = Pose::Identity();
  for (std::size_t i = 0; i < rows.size(); ++i)
    pose(static_cast<Eigen::Index>(i / 4), static_cast<Eigen::Index>(i % 4)) = rows[i];
  return pose;
}

std::int64_t stamp_at(double seconds) {
  return std::llround(1e9 * (kStart + seconds));
}

// One of the robot's sensors. Classes are the numbers of objects.
class DriveSource final : public FrameSource {
 public:
  DriveSource(const RigDrive& drive, std::size_t sensor, std::size_t frames)
      : drive_(drive), sensor_(sensor), frames_(frames) {}

  Next next(Frame& frame, std::chrono::milliseconds) override {
    if (number_ == frames_) return Next::end;
    const auto sweep = std::make_shared<RigSweep>(drive_.sweep(sensor_, number_++));
    frame = Frame();
    frame.header.frame_id = kRigFrames.at(sensor_);
    frame.header.stamp_ns = frame.recorded_ns = stamp_at(sweep->seconds);
    frame.points = PointView::of(sweep->xyz.data(), 12, sweep->ring.size());
    frame.times = FieldView{reinterpret_cast<const std::byte*>(sweep->time_ns.data()), 4, 'U', 4};
    frame.classes = std::make_shared<std::vector<std::int64_t>>(sweep->object.begin(), sweep->object.end());
    frame.owner = sweep;
    return Next::frame;
  }

 private:
  const RigDrive& drive_;
  std::size_t sensor_, frames_, number_ = 0;
};

// The poses of the robot, 100 a second, as /tf has them.
class DrivePoses final : public TransformFeed {
 public:
  explicit DrivePoses(const RigDrive& drive) : drive_(drive) {}

  void read(std::int64_t recorded_ns, Transforms& to) override {
    for (; stamp_at(seconds_) < recorded_ns + 500'000'000; seconds_ += 0.01)
      to.add("odom", "base_link", stamp_at(seconds_), pose_of(drive_.pose(seconds_)));
  }
  std::vector<std::string> take_warnings() override { return {}; }

 private:
  const RigDrive& drive_;
  double seconds_ = 0;
};

RigSource source_of(const RigDrive& drive, std::size_t frames) {
  RigInputs inputs;
  for (std::size_t sensor = 0; sensor < kRigSensors; ++sensor) {
    inputs.sensors.push_back(
        {std::make_unique<DriveSource>(drive, sensor, frames), kRigFrames.at(sensor), "", {}});
    inputs.transforms.add_fixed("base_link", kRigFrames.at(sensor), pose_of(RigDrive::mounting(sensor)));
  }
  inputs.feeds.push_back(std::make_unique<DrivePoses>(drive));
  RigConfig rig;
  rig.frame = "base_link";
  rig.fixed_frame = "odom";
  ReplayOptions options;
  options.point_times = true;
  return {std::move(inputs), rig, options};
}

PipelineConfig street_config(Deskew deskew) {
  PipelineConfig config;
  config.deskew = deskew;
  config.ground.method = GroundMethod::zones;
  config.cluster.tolerance = 0.6;
  config.cluster.tolerance_per_metre = 0.02;
  config.volumes = {"aabb"};
  config.track.enabled = true;
  return config;
}

// Returns the distance of a point from the surface of an upright box or cylinder, seen from above.
double distance_from_surface(const RigObject& object, const Eigen::Vector3d& p) {
  const double x = p.x() - object.x, y = p.y() - object.y;
  if (object.radius > 0) return std::hypot(x, y) - object.radius;
  const double c = std::cos(object.yaw), s = std::sin(object.yaw);
  const double dx = std::abs(c * x + s * y) - object.length / 2,
               dy = std::abs(c * y - s * x) - object.width / 2;
  return dx > 0 && dy > 0 ? std::hypot(dx, dy) : std::max(dx, dy);
}

// The root of the mean squared distance of points from the walls and poles that they were measured on.
double thickness(bool rolling, Deskew deskew) {
  RigDriveOptions options;
  options.noise = 0.01;
  options.rolling = rolling;
  const RigDrive drive(options);
  RigSource source = source_of(drive, 6);
  FramePipeline pipeline(street_config(deskew));
  Frame frame;
  FrameResult result;
  double squares = 0, count = 0;
  while (source.next(frame, 0ms) == Next::frame) {
    pipeline.process(frame, result);
    if (frame.header.stamp_ns == stamp_at(0)) continue;  // the first frame has no motion yet
    const double now = 1e-9 * static_cast<double>(frame.header.stamp_ns) - kStart;
    const std::vector<RigObject> objects = drive.objects(now);
    for (const SensorPart& part : frame.sensors) {
      // Without rolling, a sensor stands at the time of its own stamp.
      const double measured = rolling ? now : 1e-9 * static_cast<double>(part.stamp_ns) - kStart;
      const Pose pose = pose_of(drive.pose(measured));
      for (std::size_t i = part.first; i < part.first + part.count; ++i) {
        const auto object = static_cast<std::size_t>((*frame.classes)[i]);
        if (object == 0) continue;
        const RigObject& truth = objects[object - 1];
        if (truth.kind != Kind::wall && truth.kind != Kind::pole) continue;
        const Coordinates p = load_point(result.cloud_of(frame), i);
        const double distance = distance_from_surface(truth, pose * Eigen::Vector3d(p.x, p.y, p.z));
        squares += distance * distance;
        count += 1;
      }
    }
  }
  EXPECT_GT(count, 10'000);
  return std::sqrt(squares / count);
}

TEST(RigDrive, WallsAndPolesAreAsThinAfterDeskewingAsOfAStandingSensor) {
  const double standing = thickness(false, Deskew::off), rolling = thickness(true, Deskew::off),
               deskewed = thickness(true, Deskew::on);
  std::printf("thickness: standing %.4f m, rolling %.4f m, deskewed %.4f m\n", standing, rolling, deskewed);
  EXPECT_LE(deskewed, 1.1 * standing);
  EXPECT_GE(rolling, 20 * deskewed);
}

struct HandOver {
  std::size_t objects = 0, sightings = 0, switches = 0;
};

struct Known {
  std::uint64_t track = 0, seq = 0;  // at the last sighting
};

// Follows the tracks of cars and people. The object of a cluster is that of most of its points. As in CLEAR
// MOT, an object keeps its track as long as one of its clusters has it. An object that was out of view for
// longer than tracks live (track.death) may get a new one.
HandOver track_objects(std::size_t frames) {
  const RigDrive drive({});
  RigSource source = source_of(drive, frames);
  FramePipeline pipeline(street_config(Deskew::on));
  Frame frame;
  FrameResult result;
  std::map<std::int64_t, Known> known;
  std::map<std::int64_t, unsigned> sensors;  // bits of the sensors that saw an object
  HandOver found;
  while (source.next(frame, 0ms) == Next::frame) {
    pipeline.process(frame, result);
    const std::vector<RigObject> objects = drive.objects(0);
    std::map<std::int64_t, std::map<std::size_t, std::uint64_t>>
        tracks;  // of each object, by number of points
    for (std::size_t k = 0; k < result.clusters.size(); ++k) {
      if (!result.tracks[k]) continue;
      std::map<std::int64_t, std::size_t> points;
      for (std::size_t i = 0; i < result.clusters.list_size(k); ++i) {
        const auto point = static_cast<std::size_t>(result.clusters.list(k)[i]);
        const std::int64_t object = (*frame.classes)[point];
        ++points[object];
        sensors[object] |= point < frame.sensors[1].first ? 1U : 2U;
      }
      const auto most = std::max_element(points.begin(), points.end(),
                                         [](const auto& a, const auto& b) { return a.second < b.second; });
      tracks[most->first].emplace(most->second, result.tracks[k]->id);
    }
    for (const auto& [object, parts] : tracks) {
      if (object == 0) continue;
      const Kind kind = objects[static_cast<std::size_t>(object - 1)].kind;
      if (kind == Kind::wall || kind == Kind::pole) continue;
      ++found.sightings;
      const std::uint64_t seq = frame.header.seq, largest = parts.rbegin()->second;
      Known& last = known.try_emplace(object, Known{largest, seq}).first->second;
      const bool same = std::any_of(parts.begin(), parts.end(),
                                    [&](const auto& part) { return part.second == last.track; });
      found.switches += !same && seq - last.seq <= TrackConfig().death;
      last = {same ? last.track : largest, seq};
    }
  }
  for (const auto& [object, bits] : sensors)
    found.objects += bits == 3U && object > 0;
  return found;
}

TEST(RigDrive, TracksKeepTheirIdsFromOneSensorToTheOther) {
  const HandOver found = track_objects(300);
  std::printf("%zu objects seen by both sensors, %zu sightings, %zu changes of the id\n", found.objects,
              found.sightings, found.switches);
  EXPECT_GE(found.objects, 10U);
  EXPECT_EQ(found.switches, 0U);
}

// How often a rule is wrong about objects that no sensor sees, and about objects that one sees.
struct OcclusionErrors {
  std::size_t hidden = 0, hidden_wrong = 0, seen = 0, seen_wrong = 0;

  void add(bool is_seen, bool occluded) {
    ++(is_seen ? seen : hidden);
    if (is_seen && occluded) ++seen_wrong;
    if (!is_seen && !occluded) ++hidden_wrong;
  }
};

// Judges each object by the boxes of all clusters without points of it.
void add_objects(const std::vector<RigObject>& objects, const Pose& robot, const Frame& frame,
                 const FrameResult& result, OcclusionErrors& from_origin, OcclusionErrors& from_sensors) {
  Viewpoints viewpoints;
  viewpoints.find(frame.sensors, result.points_after_filter(frame.points));
  std::vector<std::size_t> points(objects.size() + 1);
  for (const std::int64_t object : *frame.classes)
    ++points[static_cast<std::size_t>(object)];
  for (std::size_t k = 0; k < objects.size(); ++k) {
    if (objects[k].kind == Kind::wall || objects[k].kind == Kind::pole) continue;
    const auto own = static_cast<std::int64_t>(k + 1);
    std::vector<Aabb> boxes;
    for (std::size_t c = 0; c < result.clusters.size(); ++c) {
      const std::int32_t *const list = result.clusters.list(c), *const end =
                                                                    list + result.clusters.list_size(c);
      const auto is_own = [&](std::int32_t i) {
        return (*frame.classes)[static_cast<std::size_t>(i)] == own;
      };
      if (std::none_of(list, end, is_own)) boxes.push_back(std::get<Aabb>(result.volume(c, 0)));
    }
    const Eigen::Vector3d position =
        robot.inverse() * Eigen::Vector3d(objects[k].x, objects[k].y, objects[k].height / 2);
    const bool seen = points[k + 1] > 0;
    from_origin.add(seen, std::any_of(boxes.begin(), boxes.end(),
                                      [&](const Aabb& box) { return occludes(box, position); }));
    from_sensors.add(seen, viewpoints.occluded(position, boxes));
  }
}

TEST(RigDrive, OcclusionIsJudgedFromThePlaceOfEachSensor) {
  const RigDrive drive({});
  RigSource source = source_of(drive, 120);
  FramePipeline pipeline(street_config(Deskew::on));
  Frame frame;
  FrameResult result;
  OcclusionErrors from_origin, from_sensors;
  while (source.next(frame, 0ms) == Next::frame) {
    pipeline.process(frame, result);
    const double now = 1e-9 * static_cast<double>(frame.header.stamp_ns) - kStart;
    add_objects(drive.objects(now), pose_of(drive.pose(now)), frame, result, from_origin, from_sensors);
  }
  for (const OcclusionErrors& errors : {from_origin, from_sensors})
    std::printf("%zu of %zu hidden objects are not occluded, %zu of %zu seen ones are\n", errors.hidden_wrong,
                errors.hidden, errors.seen_wrong, errors.seen);
  EXPECT_LT(from_sensors.seen_wrong, from_origin.seen_wrong);
  EXPECT_LE(from_sensors.hidden_wrong + from_sensors.seen_wrong,
            from_origin.hidden_wrong + from_origin.seen_wrong);
}

}  // namespace
}  // namespace pcl_bv::detail
