// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Occlusion and visible faces for several sensors.

#include "pipeline/track/viewpoints.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <random>

#include "pcl_bv/points/select_points.h"
#include "pipeline/track/box_filter.h"
#include "pipeline/track/occlusion.h"
#include "pipeline/track/track.h"
#include "pipeline/track/tracker.h"

namespace pcl_bv::detail {
namespace {

constexpr double kDegree = 3.14159265358979323846 / 180;

// A merged cloud: each sensor has a point 30 m away in each degree of its field of view.
struct Rig {
  std::vector<SensorPart> sensors;
  std::vector<float> xyz;

  void add(const Eigen::Vector3d& position, double first_degree = 0, double last_degree = 360) {
    const std::size_t first = xyz.size() / 3;
    for (double degrees = first_degree; degrees < last_degree; ++degrees) {
      xyz.push_back(static_cast<float>(position.x() + 30 * std::cos(degrees * kDegree)));
      xyz.push_back(static_cast<float>(position.y() + 30 * std::sin(degrees * kDegree)));
      xyz.push_back(0);
    }
    sensors.push_back({"", first, xyz.size() / 3 - first, 0, position});
  }
  PointView points() const { return PointView::of(xyz.data(), 12, xyz.size() / 3); }
  Viewpoints viewpoints() const {
    Viewpoints result;
    result.find(sensors, points());
    return result;
  }
};

Rig rig_at(double x) {
  Rig rig;
  rig.add({x, 0, 0});
  rig.add({-x, 0, 0});
  return rig;
}

TEST(Viewpoints, WithoutAMergedCloudTheViewIsFromThePositionOfTheSensor) {
  Viewpoints viewpoints;
  viewpoints.find({}, {}, {0, 10, 0});
  const Aabb box({4, -1, 0}, {6, 1, 2});
  EXPECT_FALSE(viewpoints.occluded({10, 0, 1}, {box}));
  EXPECT_TRUE(viewpoints.occluded({7.5, -5, 1}, {box}));
  EXPECT_FALSE(viewpoints.occluded({7.5, -5, 1}, {box}, 0));  // the box is the object itself
  EXPECT_EQ(viewpoints.visible_face(Eigen::Vector3d::UnitY(), Eigen::Vector3d::Zero(), -1, 1),
            VisibleFace::high);
}

TEST(Viewpoints, WithoutAMergedCloudTheRulesAreThoseOfTheOrigin) {
  std::mt19937 random(5);
  const auto uniform = [&] { return static_cast<double>(random()) / 4294967296.0 * 20 - 10; };
  Viewpoints viewpoints;
  viewpoints.find({{"silent", 0, 0, 0, {3, 4, 5}}}, {});
  for (int i = 0; i < 2000; ++i) {
    Eigen::Vector3d corner, other, position;
    for (int k = 0; k < 3; ++k) {
      corner[k] = uniform();
      other[k] = uniform();
      position[k] = uniform();
    }
    const Aabb box(corner.cwiseMin(other), corner.cwiseMax(other));
    ASSERT_EQ(viewpoints.occluded(position, {box}), occludes(box, position)) << i;
    for (int k = 0; k < 3; ++k) {
      const VisibleFace visible = viewpoints.visible_face(Eigen::Vector3d::Unit(k), Eigen::Vector3d::Zero(),
                                                          box.min()[k], box.max()[k]);
      ASSERT_EQ(visible == VisibleFace::low, box.min()[k] > 0) << i;
      ASSERT_EQ(visible == VisibleFace::high, box.max()[k] < 0) << i;
    }
  }
}

TEST(Viewpoints, APositionIsOccludedIfItIsOccludedForEverySensor) {
  const Viewpoints viewpoints = rig_at(3).viewpoints();
  const Eigen::Vector3d behind(0, 20, 0);
  const Aabb narrow({-1, 5, -1}, {1, 6, 1}), wide({-3, 5, -1}, {3, 6, 1}), left({-3, 5, -1}, {-1, 6, 1}),
      right({1, 5, -1}, {3, 6, 1});
  EXPECT_TRUE(occludes(narrow, behind));
  EXPECT_FALSE(viewpoints.occluded(behind, {narrow}));
  EXPECT_TRUE(viewpoints.occluded(behind, {wide}));
  EXPECT_FALSE(occludes(left, behind) || occludes(right, behind));
  EXPECT_FALSE(viewpoints.occluded(behind, {left}));
  EXPECT_TRUE(viewpoints.occluded(behind, {left, right}));
}

TEST(Viewpoints, ASensorThatMeasuresNothingInADirectionCannotSeeAnObjectThere) {
  Rig rig;
  rig.add({3, 0, 0}, -60, 60);
  rig.add({-3, 0, 0}, 90, 270);
  const Viewpoints viewpoints = rig.viewpoints();
  const Aabb ahead({9, -1, -1}, {10, 1, 1}), aback({-10, -1, -1}, {-9, 1, 1});
  EXPECT_TRUE(viewpoints.occluded({20, 0, 0}, {ahead}));  // the rear sensor has a free line above the robot
  EXPECT_TRUE(viewpoints.occluded({-20, 0, 0}, {aback}));
  EXPECT_FALSE(viewpoints.occluded({20, 0, 0}, {aback}));
  EXPECT_TRUE(viewpoints.occluded({0, -20, 0}, {}));  // neither measures there
  EXPECT_FALSE(viewpoints.occluded({20, 10, 0}, {ahead}));
}

TEST(Viewpoints, PointsThatAreFilteredOutOrInvalidAreNoDirections) {
  Rig rig;
  rig.add({3, 0, 0});
  rig.add({-3, 0, 0});
  std::vector<std::int32_t> ahead;  // x >= 0
  for (std::int32_t i = 0; i < static_cast<std::int32_t>(rig.xyz.size() / 3); ++i)
    if (rig.xyz[3 * static_cast<std::size_t>(i)] >= 0) ahead.push_back(i);
  Viewpoints viewpoints;
  viewpoints.find(rig.sensors, select_points(rig.points(), ahead));
  EXPECT_FALSE(viewpoints.occluded({20, 0, 0}, {}));
  EXPECT_TRUE(viewpoints.occluded({-20, 0, 0}, {}));
  std::fill(rig.xyz.begin(), rig.xyz.end(), NAN);
  viewpoints.find(rig.sensors, rig.points());
  EXPECT_TRUE(viewpoints.occluded({20, 0, 0}, {}));
}

TEST(Viewpoints, EverySectorOfALargeCloudIsFound) {
  Rig rig;
  for (int i = 0; i < 500; ++i)
    rig.add({0, 0, 0});
  const Viewpoints viewpoints = [&] {
    Viewpoints all;
    all.find({{"", 0, rig.xyz.size() / 3, 0, {0, 0, 0}}}, rig.points());
    return all;
  }();
  for (double degrees = 0.5; degrees < 360; ++degrees)
    EXPECT_FALSE(
        viewpoints.occluded({9 * std::cos(degrees * kDegree), 9 * std::sin(degrees * kDegree), 0}, {}))
        << degrees;
}

TEST(Viewpoints, SensorsOnBothSidesOfAnObjectSeeBothFaces) {
  const Viewpoints viewpoints = rig_at(10).viewpoints();
  const auto visible = [&](double low, double high) {
    return viewpoints.visible_face(Eigen::Vector3d::UnitX(), Eigen::Vector3d::Zero(), low, high);
  };
  EXPECT_EQ(visible(12, 14), VisibleFace::low);
  EXPECT_EQ(visible(-14, -12), VisibleFace::high);
  EXPECT_EQ(visible(4, 6), VisibleFace::both);
  EXPECT_EQ(visible(8, 12), VisibleFace::both);
  EXPECT_EQ(viewpoints.visible_face(-Eigen::Vector3d::UnitX(), {4, 0, 0}, -5, -3), VisibleFace::both);
  EXPECT_EQ(viewpoints.visible_face(-Eigen::Vector3d::UnitX(), {4, 0, 0}, -10, -8), VisibleFace::high);
  EXPECT_EQ(viewpoints.visible_face(-Eigen::Vector3d::UnitX(), {4, 0, 0}, 15, 16), VisibleFace::low);
}

TEST(Viewpoints, TheNearestSensorIsOneThatSentACloud) {
  const std::vector<SensorPart> sensors{{"", 0, 5, 0, {3, 0, 0}}, {"", 5, 0, 0, {-3, 0, 0}}};
  EXPECT_EQ(nearest_sensor(sensors, {-9, 0, 0}, {1, 1, 1}), Eigen::Vector3d(3, 0, 0));
  EXPECT_EQ(nearest_sensor({}, {-9, 0, 0}, {1, 1, 1}), Eigen::Vector3d(1, 1, 1));
}

// Returns the id of a person who was not seen for two seconds because of these boxes.
std::optional<std::uint32_t> id_after_absence(const std::vector<Aabb>& boxes, const Viewpoints& viewpoints) {
  Tracker tracker;
  const Aabb person({-0.3, 19.7, -0.8}, {0.3, 20.3, 0.8});
  std::vector<Tracker::Assignment> found;
  for (int i = 0; i < 26; ++i)
    tracker.update(i * 100'000'000LL, i < 5 || i == 25 ? std::vector<Aabb>{person} : boxes, {}, found, {},
                   viewpoints);
  return found[0].track ? std::optional(found[0].track->id) : std::nullopt;
}

TEST(Tracker, ATrackLivesLongerIfEverySensorIsOccluded) {
  const Viewpoints viewpoints = rig_at(3).viewpoints();
  const Aabb narrow({-1, 5, -1}, {1, 6, 1}), left({-3, 5, -1}, {-1, 6, 1}), right({1, 5, -1}, {3, 6, 1});
  EXPECT_EQ(id_after_absence({left, right}, viewpoints), 0U);
  EXPECT_EQ(id_after_absence({left, right}, Viewpoints()), std::nullopt);  // visible from the origin
  EXPECT_EQ(id_after_absence({narrow}, viewpoints), std::nullopt);
  EXPECT_EQ(id_after_absence({narrow}, Viewpoints()), 0U);  // occluded from the origin
}

// A car stands between two sensors. The one at x = 12 sees its end at x = 7. The end that faces the origin
// comes into view, 0.3 m a frame.
TEST(Track, AnEndThatComesIntoViewIsNoMotionIfAnotherSensorSeesTheOtherEnd) {
  const Viewpoints viewpoints = rig_at(12).viewpoints();
  for (const bool merged : {true, false}) {
    Track track;
    track.start({{5, 4, 0}, {7, 6, 1.5}}, Pose::Identity());
    double fastest = 0;
    for (int i = 1; i < 10; ++i) {
      track.predict(0.1);
      track.expect(Pose::Identity());
      track.correct({{5 - 0.3 * i, 4, 0}, {7, 6, 1.5}}, Pose::Identity(), 0.1,
                    merged ? viewpoints : Viewpoints::single());
      fastest = std::max(fastest, track.motion.velocity().norm());
    }
    EXPECT_EQ(fastest < 0.1, merged) << fastest;
  }
}

TEST(BoxFilter, ABoxBetweenTwoSensorsGrowsOnBothSides) {
  std::vector<float> xyz;
  for (const float x : {4.F, 6.F})
    for (const float y : {-1.F, 1.F})
      for (const float z : {0.F, 1.F})
        xyz.insert(xyz.end(), {x, y, z});
  const Viewpoints viewpoints = rig_at(10).viewpoints();
  const PointView points = PointView::of(xyz.data(), 12, xyz.size() / 3);
  const auto upright = [](double low, double high) {
    return Obb({(low + high) / 2, 0, 0.5}, Eigen::Matrix3d::Identity(), {(high - low) / 2, 1, 0.5});
  };
  for (const bool merged : {true, false}) {
    std::vector<float> whole = xyz;
    for (std::size_t i = 0; i < whole.size(); i += 3)
      whole[i] = whole[i] < 5 ? 3.F : 7.F;
    BoxFilter filter;
    BoxState state;
    if (merged) state.around.viewpoints = &viewpoints;
    filter.smoothed(upright(3, 7), PointView::of(whole.data(), 12, whole.size() / 3), state, false, true);
    const Obb box = filter.smoothed(upright(4, 6), points, state, false, true);
    EXPECT_NEAR(box.half_extents().x(), 2, 1e-6);
    EXPECT_NEAR(box.center().x(), merged ? 5 : 6, 1e-6);
  }
}

}  // namespace
}  // namespace pcl_bv::detail
