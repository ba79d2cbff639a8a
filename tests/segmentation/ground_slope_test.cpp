// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// split_ground_by_slope(): compared with its definition, and on scenes of maps.

#include <gmock/gmock.h>

#include <algorithm>
#include <limits>
#include <map>
#include <numbers>

#include "ground_scenes.h"
#include "pcl_bv/segmentation/slope_surface.h"

namespace pcl_bv {
namespace {

using detail::CellRange;
using detail::cells_that_matter;
using detail::kBoundMargin;
using detail::LowestPoint;
using detail::LowestPoints;
using detail::SlopeSurface;
using testing::HasSubstr;

template <typename T>
GroundSplit split(const Cloud<T>& cloud, const GroundSlopeOptions& options, const Execution& execution = {}) {
  return split_ground_by_slope(scene_view(cloud), options, execution);
}

double number_in(std::mt19937& random, double low, double high) {
  return low + (high - low) * static_cast<double>(random() % 65536) / 65536;
}

double tangent(const GroundSlopeOptions& options) {
  return static_cast<float>(std::tan(options.max_slope_degrees * std::numbers::pi / 180));
}

// The surface as the header defines it, from all pairs of cells.
class Definition {
 public:
  Definition(const Cloud<double>& cloud, const GroundSlopeOptions& options) : options_(options) {
    for (const auto& p : cloud) {
      if (!std::isfinite(p[0] + p[1] + p[2])) continue;
      const auto [at, inserted] = low_.emplace(cell(p), p[2]);
      if (!inserted) at->second = std::min(at->second, p[2]);
    }
    find_outliers();
    for (const auto& [c, low] : low_) {
      double height = INFINITY;
      for (const auto& [other, other_low] : sources_)
        height = std::min(height, other_low + rise() * distance(c, other));
      height_[c] = height;
    }
  }

  double surface(const std::array<double, 3>& p) const {
    const Cell c = cell(p);
    const double x = slope(c, {1, 0}), y = slope(c, {0, 1});
    return height_.at(c) + 0.5 * (std::abs(x) + std::abs(y)) +
           x * (p[0] / options_.cell_size - static_cast<double>(c[0]) - 0.5) +
           y * (p[1] / options_.cell_size - static_cast<double>(c[1]) - 0.5);
  }

  std::size_t outliers() const { return low_.size() - sources_.size(); }

 private:
  using Cell = std::array<long, 2>;

  Cell cell(const std::array<double, 3>& p) const {
    return {std::lround(std::floor(p[0] / options_.cell_size)),
            std::lround(std::floor(p[1] / options_.cell_size))};
  }
  double rise() const { return tangent(options_) * options_.cell_size; }
  static double distance(const Cell& a, const Cell& b) {
    const long dx = a[0] - b[0], dy = a[1] - b[1];
    return std::sqrt(static_cast<double>(dx * dx + dy * dy));
  }
  bool is_above(const Cell& a, const Cell& b) const {
    return low_.at(a) > low_.at(b) + rise() * distance(a, b) + options_.distance;
  }
  // Gives the cells of each patch the same number, and counts them.
  void number_patches() {
    for (const auto& [start, low] : low_) {
      if (patch_.contains(start)) continue;
      const std::size_t number = patch_size_.size();
      std::vector<Cell> cells{start};
      patch_[start] = number;
      for (std::size_t i = 0; i < cells.size(); ++i) {
        const Cell from = cells[i];
        for (const auto& [to, to_low] : low_) {
          if (distance(from, to) > 3 || std::abs(to_low - low_.at(from)) > rise() + options_.distance)
            continue;
          if (patch_.emplace(to, number).second) cells.push_back(to);
        }
      }
      patch_size_.push_back(cells.size());
    }
  }
  bool is_below_large_patch(const Cell& c) const {
    return std::any_of(low_.begin(), low_.end(), [&](const auto& other) {
      return distance(c, other.first) <= 10 && is_above(other.first, c) &&
             patch_size_[patch_.at(other.first)] >= 20;
    });
  }
  void find_outliers() {
    number_patches();
    for (const auto& [c, low] : low_)
      if (patch_size_[patch_[c]] >= 20 || !is_below_large_patch(c)) sources_.emplace(c, low);
  }
  double slope(const Cell& c, const Cell& step) const {
    const auto before = height_.find({c[0] - step[0], c[1] - step[1]}),
               after = height_.find({c[0] + step[0], c[1] + step[1]});
    if (before == height_.end() || after == height_.end()) return 0;
    const double a = height_.at(c) - before->second, b = after->second - height_.at(c);
    if (a * b <= 0) return 0;
    return std::abs(a) < std::abs(b) ? a : b;
  }

  GroundSlopeOptions options_;
  std::map<Cell, double> low_, sources_, height_;
  std::map<Cell, std::size_t> patch_;
  std::vector<std::size_t> patch_size_;
};

// Hills with boxes, pits and gaps.
Cloud<double> landscape(unsigned seed, std::size_t count, double side, unsigned points_per_pit = 100) {
  std::mt19937 random(seed);
  Cloud<double> cloud;
  const double phase = number_in(random, 0, 6), steep = number_in(random, 0.2, 3);
  while (cloud.size() < count) {
    const double x = number_in(random, -side, side), y = number_in(random, -side, side);
    double z = steep * std::sin(x / 5 + phase) + 0.1 * y;
    if (std::hypot(x, y) < side / 4) continue;
    if (std::abs(x - 3) < 4 && y > 2) z += number_in(random, 0, 6);
    if (random() % points_per_pit == 0) z -= number_in(random, 0, 20);
    cloud.push_back({x, y, z});
  }
  return cloud;
}

TEST(GroundBySlope, IsThatOfItsDefinition) {
  std::size_t outliers = 0, ground = 0, rest = 0;
  for (unsigned seed = 1; seed <= 40; ++seed) {
    const Cloud<double> cloud = landscape(seed, 20 + 100 * (seed % 20), 5 + seed % 17);
    GroundSlopeOptions options;
    options.cell_size = seed % 3 == 0 ? 0.7 : 1;
    options.max_slope_degrees = std::array{0.0, 5.0, 20.0, 60.0}[seed % 4];
    options.distance = seed % 2 == 0 ? 0.1 : 0.4;
    const Definition definition(cloud, options);
    std::vector<std::int32_t> wanted, doubtful;
    for (std::size_t i = 0; i < cloud.size(); ++i) {
      const double above = cloud[i][2] - definition.surface(cloud[i]);
      if (std::abs(above - options.distance) < 1e-6) doubtful.push_back(static_cast<std::int32_t>(i));
      if (above <= options.distance) wanted.push_back(static_cast<std::int32_t>(i));
    }
    EXPECT_LT(doubtful.size(), 2U);
    const GroundSplit found = split(cloud, options);
    EXPECT_TRUE(found.found);
    EXPECT_EQ(found.ground, wanted) << seed;
    EXPECT_EQ(found.ground.size() + found.rest.size(), cloud.size());
    outliers += definition.outliers();
    ground += found.ground.size();
    rest += found.rest.size();
  }
  EXPECT_GT(outliers, 50U);  // the scenes have all cases
  EXPECT_GT(ground, 5000U);
  EXPECT_GT(rest, 5000U);
}

TEST(GroundBySlope, DoesNotDependOnOrderThreadsAxesOrScalarType) {
  Cloud<double> cloud = landscape(7, 150'000, 60, 2000);
  for (auto& p : cloud)
    for (double& c : p)
      c = static_cast<float>(c);
  cloud[5][0] = cloud[70'000][2] = NAN;
  const GroundSplit once = split(cloud, {});
  ASSERT_GT(once.ground.size(), 50'000U);
  ASSERT_GT(once.rest.size(), 1000U);
  EXPECT_EQ(once.ground.size() + once.rest.size(), cloud.size() - 2);
  EXPECT_EQ(split(cloud, {}, Threads{3}).ground, once.ground);
  Cloud<float> floats(cloud.size());
  std::vector<std::int32_t> order = numbers(0, cloud.size()), shuffled_ground;
  std::shuffle(order.begin(), order.end(), std::mt19937(1));
  Cloud<double> shuffled(cloud.size());
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    shuffled[i] = cloud[static_cast<std::size_t>(order[i])];
    for (std::size_t axis = 0; axis < 3; ++axis)
      floats[i][axis] = static_cast<float>(cloud[i][axis]);
  }
  for (const std::int32_t i : split(shuffled, {}, Threads{2}).ground)
    shuffled_ground.push_back(order[static_cast<std::size_t>(i)]);
  std::sort(shuffled_ground.begin(), shuffled_ground.end());
  EXPECT_EQ(shuffled_ground, once.ground);
  EXPECT_EQ(split(floats, {}).ground, once.ground);
  for (unsigned axis = 0; axis < 6; ++axis) {
    GroundSlopeOptions options;
    options.up = 3 * axis_up(axis);
    EXPECT_EQ(split(turned(floats, axis), options).ground, once.ground) << axis;
  }
}

TEST(GroundBySlope, OfSharesIsThatOfTheWholeCloudForAnyTilingAndOrder) {
  std::size_t moved = 0;  // points that are ground of a share alone, or not, but otherwise in the cloud
  for (unsigned seed = 1; seed <= 40; ++seed) {
    std::mt19937 random(seed);
    Cloud<double> cloud = landscape(seed, 500 + 400 * (seed % 5), 20 + seed);
    if (seed % 2 == 0) std::sort(cloud.begin(), cloud.end());
    cloud[seed][1] = NAN;
    const PointView points = scene_view(cloud);
    GroundSlopeOptions options;
    options.cell_size = number_in(random, 0.4, 3);
    std::vector<LowestPoints> shares;
    std::vector<std::uint8_t> expected(points.count), found(points.count), alone(points.count);
    for (std::size_t begin = 0, end = 0; begin < points.count; begin = end) {
      end = std::min(points.count, begin + 1 + random() % points.count);
      const PointView part = points.slice(begin, end - begin);
      shares.emplace_back(options).add(part, Threads{2});
      SlopeSurface(part, options, {}).classify(part, &alone[begin]);
    }
    std::shuffle(shares.begin(), shares.end(), random);
    LowestPoints all(options);
    for (const LowestPoints& share : shares)
      for (std::size_t i = 0; i < share.size(); ++i)
        all.add(share[i]);
    SlopeSurface(points, options, {}).classify(points, expected.data());
    SlopeSurface(std::move(all), Threads{3}).classify(points, found.data());
    EXPECT_EQ(found, expected) << seed;
    moved += alone != expected;
  }
  EXPECT_GT(moved, 10U);
}

TEST(GroundBySlope, InARangeDependsOnlyOnTheCellsThatMatter) {
  std::size_t all_cells = 0, used_cells = 0, ground = 0, rest = 0;
  for (unsigned seed = 1; seed <= 30; ++seed) {
    std::mt19937 random(seed);
    const Cloud<double> cloud = landscape(seed, 60'000, 120);
    GroundSlopeOptions options;
    options.cell_size = number_in(random, 0.3, 1);
    options.max_slope_degrees = std::array{0.0, 20.0, 45.0, 70.0}[seed % 4];
    const double x = number_in(random, -120, 100), y = number_in(random, -120, 100),
                 side = number_in(random, 1, 60);
    Cloud<double> part;
    for (const auto& p : cloud)
      if (p[0] >= x && p[0] < x + side && p[1] >= y && p[1] < y + side) part.push_back(p);
    LowestPoints whole(options), own(options), used(options);
    whole.add(scene_view(cloud), Serial{});
    own.add(scene_view(part), Serial{});
    CellRange cells;
    for (std::size_t i = 0; i < own.size(); ++i)
      cells.merge({own[i].x, own[i].y, own[i].x, own[i].y});
    double lowest = INFINITY, highest = -INFINITY;
    for (std::size_t i = 0; i < whole.size(); ++i) {
      lowest = std::min(lowest, whole[i].height);
      if (cells.inflated(kBoundMargin).contains(whole[i])) highest = std::max(highest, whole[i].height);
    }
    const CellRange that_matter = cells_that_matter(cells, lowest, highest, options);
    for (std::size_t i = 0; i < whole.size(); ++i)
      if (that_matter.contains(whole[i])) used.add(whole[i]);
    all_cells += whole.size();
    used_cells += used.size();
    std::vector<std::uint8_t> expected(part.size()), found(part.size());
    SlopeSurface(std::move(whole), {}).classify(scene_view(part), expected.data());
    SlopeSurface(std::move(used), {}).classify(scene_view(part), found.data());
    EXPECT_EQ(found, expected) << seed;
    const auto count = static_cast<std::size_t>(std::count(found.begin(), found.end(), 1));
    ground += count;
    rest += found.size() - count;
  }
  EXPECT_LT(used_cells, all_cells / 10 * 9);
  EXPECT_GT(ground, 1000U);
  EXPECT_GT(rest, 1000U);
}

TEST(GroundBySlope, OfAFarLowPlaceMattersNearASlopeOnlyUpToItsReach) {
  GroundSlopeOptions options;
  options.max_slope_degrees = 45;
  EXPECT_EQ(cells_that_matter({0, 0, 4, 0}, 0, 100, options).max_x, 4 + 10 + 100 + 72);
  EXPECT_EQ(cells_that_matter({0, 0, 4, 0}, 100, 100, options).min_y, -82);
  options.max_slope_degrees = 0;
  EXPECT_EQ(cells_that_matter({0, 0, 4, 0}, 0, 1, options).max_x, std::numeric_limits<std::int32_t>::max());
  EXPECT_TRUE(cells_that_matter({}, 0, 1, options).empty());
}

// The lowest cells are one patch, which is too large for an outlier, so they lower the ground next to them.
TEST(GroundBySlope, InARangeDependsOnWholePatchesBesideIt) {
  GroundSlopeOptions options;
  options.max_slope_degrees = 45;
  const CellRange range{0, 0, 4, 4};
  LowestPoints used(options);
  const CellRange that_matter = cells_that_matter(range, -20, 0, options);
  for (std::int32_t x = 0; x < 200; ++x) {
    for (std::int32_t y = 0; y < 5; ++y) {
      const bool low = y == 2 && x >= 14 && x < 14 + 20 * 3 && (x - 14) % 3 == 0;
      const LowestPoint point{x, y, low ? -20.0 : 0.0};
      if (that_matter.contains(point)) used.add(point);
    }
  }
  EXPECT_LT(used.size(), 200U * 5);
  const Cloud<double> point{{4.5, 2.5, 0}};
  std::uint8_t ground = 1;
  SlopeSurface(std::move(used), {}).classify(scene_view(point), &ground);
  EXPECT_EQ(ground, 0);
}

TEST(GroundBySlope, MovesWithTheCloud) {
  Cloud<double> cloud = landscape(3, 20'000, 30);
  for (auto& p : cloud)
    for (double& c : p)
      c = std::round(c * 1024) / 1024;
  GroundSlopeOptions options;
  options.max_slope_degrees = 0;  // so that no height is rounded
  const GroundSplit here = split(cloud, options);
  ASSERT_GT(here.rest.size(), 100U);
  for (const std::array<double, 3>& by : {std::array{0x1p19, -0x1p22, 0x1p10}, std::array{-64.0, 1.0, 0.5}}) {
    Cloud<double> moved = cloud;
    for (auto& p : moved)
      for (std::size_t axis = 0; axis < 3; ++axis)
        p[axis] += by[axis];
    EXPECT_EQ(split(moved, options).ground, here.ground);
  }
}

// A grid of points every 0.25 m, up to `side` from the origin. height(x, y) is NaN where there is no point.
template <typename Height>
Cloud<double> surface_of(double side, const Height& height, std::array<double, 3> at = {}) {
  Cloud<double> cloud;
  for (double x = -side; x < side; x += 0.25)
    for (double y = -side; y < side; y += 0.25)
      if (const double z = height(x, y); !std::isnan(z)) cloud.push_back({at[0] + x, at[1] + y, at[2] + z});
  return cloud;
}

TEST(GroundBySlope, IsAllOfAnEvenSlopeUpToTheLimit) {
  for (const double degrees : {0.0, 5.0, 19.0}) {
    const double k = std::tan(degrees * std::numbers::pi / 180);
    for (const double turn : {0.0, 0.4, 0.785, 2.5}) {
      const Cloud<double> cloud =
          surface_of(30, [&](double x, double y) { return k * (x * std::cos(turn) + y * std::sin(turn)); },
                     {691'000, 5'334'000, 520});
      const GroundSplit found = split(cloud, {});
      // The rise of the outermost cells is unknown.
      EXPECT_GE(found.ground.size(), cloud.size() * 96 / 100) << degrees << ' ' << turn;
      for (const std::int32_t i : found.rest) {
        const auto& p = cloud[static_cast<std::size_t>(i)];
        EXPECT_GE(std::max(std::abs(p[0] - 691'000), std::abs(p[1] - 5'334'000)), 29);
      }
    }
  }
}

TEST(GroundBySlope, EndsWhereASlopeIsSteeper) {
  const auto slope = [](double degrees) {
    const double k = std::tan(degrees * std::numbers::pi / 180);
    return surface_of(30, [&](double x, double) { return k * std::max(x, 0.0); });
  };
  const auto share = [&](double degrees, double limit) {
    GroundSlopeOptions options;
    options.max_slope_degrees = limit;
    const Cloud<double> cloud = slope(degrees);
    return static_cast<double>(split(cloud, options).ground.size()) / static_cast<double>(cloud.size());
  };
  EXPECT_LT(share(25, 20), 0.6);
  EXPECT_GT(share(25, 27), 0.97);
  EXPECT_LT(share(10, 5), 0.6);
  const double default_limit = GroundSlopeOptions().max_slope_degrees;
  EXPECT_LT(share(20.9, default_limit), 0.8);
  EXPECT_GT(share(19.5, default_limit), 0.96);
}

TEST(GroundBySlope, IsNotARoofButTheStreetUnderABridge) {
  const auto is_roof = [](double x, double y) { return std::abs(x) < 10 && std::abs(y) < 6; };
  const Cloud<double> house = surface_of(30, [&](double x, double y) { return is_roof(x, y) ? 8.0 : 0.0; });
  const GroundSplit found = split(house, {});
  for (std::size_t i = 0; i < house.size(); ++i) {
    const bool ground = std::binary_search(found.ground.begin(), found.ground.end(), static_cast<int>(i));
    EXPECT_EQ(ground, !is_roof(house[i][0], house[i][1]));
  }
  Cloud<double> bridge = surface_of(30, [](double, double) { return 0.0; });
  const std::size_t street = bridge.size();
  const Cloud<double> deck =
      surface_of(30, [](double, double y) { return std::abs(y) < 4 ? 6.0 : std::nan(""); });
  bridge.insert(bridge.end(), deck.begin(), deck.end());
  EXPECT_EQ(split(bridge, {}).ground, numbers(0, street));
}

TEST(GroundBySlope, IsNotLoweredBySomePointsBelowIt) {
  Cloud<double> cloud = surface_of(20, [](double x, double) { return 0.05 * x; });
  const std::size_t even = cloud.size();
  cloud.push_back({0.5, 0.5, -8});  // two in one cell, two in cells side by side, one far down
  cloud.push_back({0.6, 0.5, -8.1});
  cloud.push_back({10.5, 3.5, -3});
  cloud.push_back({10.5, 4.5, -3});
  cloud.push_back({-10.5, 3.5, -300});
  cloud.push_back({-15.5, 3.5, 2});  // an object
  const GroundSplit found = split(cloud, {});
  EXPECT_EQ(found.ground, numbers(0, even + 5));
  EXPECT_EQ(found.rest, numbers(even + 5, even + 6));
}

TEST(GroundBySlope, IsFoundUnderTreesBySinglePoints) {
  std::mt19937 random(5);
  Cloud<double> forest = surface_of(40, [&](double, double) { return number_in(random, 8, 15); });
  const std::size_t trees = forest.size();
  for (double x = -38.5; x < 40; x += 3)
    for (double y = -38.5; y < 40; y += 3)
      forest.push_back({x, y, number_in(random, 0, 0.1)});
  const GroundSplit found = split(forest, {});
  EXPECT_EQ(found.ground, numbers(trees, forest.size()));
}

TEST(GroundBySlope, IsFoundAmongFewPointsAndBesideGaps) {
  EXPECT_FALSE(split(Cloud<double>(), {}).found);
  EXPECT_FALSE(split(Cloud<double>{{NAN, 0, 0}, {0, INFINITY, 0}}, {}).found);
  const GroundSplit one = split(Cloud<double>{{1e6, -3e6, 100}}, {});
  EXPECT_TRUE(one.found);
  EXPECT_EQ(one.ground, numbers(0, 1));
  EXPECT_EQ(one.normal, Eigen::Vector3d::Zero());
  // A step of 3 m: across a gap of 2 m it is too steep, across one of 20 m it is not.
  const Cloud<double> cloud{
      {0.5, 0.5, 0}, {2.5, 0.5, 3}, {-20.5, 0.5, 3}, {0.6, 0.5, 0.19}, {0.6, 0.5, 0.21}};
  EXPECT_EQ(split(cloud, {}).rest, (std::vector<std::int32_t>{1, 4}));
  const Cloud<double> huge{{9e99, -9e99, 1}, {1e30, 0, 5}, {0, 0, 0}, {1e101, 0, 0}};
  EXPECT_EQ(split(huge, {}).ground.size() + split(huge, {}).rest.size(), 3U);
}

TEST(GroundBySlope, NamesTheCloudsPointsThroughListsAndSlices) {
  const Cloud<double> cloud = landscape(9, 3000, 15);
  const GroundSplit part = split(Cloud<double>(cloud.begin() + 100, cloud.begin() + 2100), {});
  std::vector<std::int32_t> wanted;
  for (const std::int32_t i : part.ground)
    wanted.push_back(i + 100);
  PointView view = scene_view(cloud).slice(100, 2000);
  EXPECT_EQ(split_ground_by_slope(view).ground, wanted);
  const std::vector<std::int32_t> list = numbers(100, 2100);
  view = scene_view(cloud);
  view.indices = list.data();
  view.count = list.size();
  EXPECT_EQ(split_ground_by_slope(view).ground, wanted);
}

TEST(GroundBySlope, RefusesOptionsOutOfRange) {
  const Cloud<double> cloud{{0, 0, 0}};
  const auto refuses = [&](const auto& change, const char* what) {
    GroundSlopeOptions options;
    change(options);
    try {
      split(cloud, options);
      ADD_FAILURE() << what;
    } catch (const std::invalid_argument& error) {
      EXPECT_THAT(error.what(), HasSubstr(what));
    }
  };
  for (const double bad : {0.0, -1.0, 1001.0, double{NAN}})
    refuses([bad](auto& o) { o.cell_size = bad; }, "cell_size");
  for (const double bad : {0.0, -1.0, double{INFINITY}, double{NAN}})
    refuses([bad](auto& o) { o.distance = bad; }, "distance");
  for (const double bad : {-1.0, 90.0, double{NAN}})
    refuses([bad](auto& o) { o.max_slope_degrees = bad; }, "max_slope_degrees");
  refuses([](auto& o) { o.up.setZero(); }, "up");
}

}  // namespace
}  // namespace pcl_bv
