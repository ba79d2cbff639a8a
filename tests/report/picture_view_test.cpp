// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// How pictures are turned, framed and cut.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <regex>

#include "clouds.h"
#include "pcl_bv/report/picture.h"
#include "pixels.h"

namespace pcl_bv::detail {
namespace {

using test::box_at, test::decode, test::difference, test::is_like, test::Pixels, test::sized;

TEST(PictureUp, TurnsAllViewsWithIt) {
  const auto cloud = test::gaussian<float>(3000, 7);
  auto turned = cloud;  // a camera's frame: y down, z forward
  for (std::size_t i = 0; i < cloud.xyz.size(); i += 3) {
    turned.xyz[i + 1] = -cloud.xyz[i + 2];
    turned.xyz[i + 2] = cloud.xyz[i + 1];
  }
  for (const ViewFrom from : {ViewFrom::iso, ViewFrom::top, ViewFrom::front, ViewFrom::side}) {
    SCOPED_TRACE(static_cast<int>(from));
    Picture picture = sized(320, 200, from), camera = picture;
    picture.points = cloud.view();
    camera.points = turned.view();
    EXPECT_GT(difference(picture_png(camera), picture_png(picture)), 1000u);
    camera.up = {0, -3, 0};
    // In the oblique view products are added in another order.
    EXPECT_LE(difference(picture_png(camera), picture_png(picture)), from == ViewFrom::iso ? 40u : 0u);
  }
}

TEST(PictureUp, IsUpInThePictureAndWarmWhereHigh) {
  for (const Eigen::Vector3d& up :
       {Eigen::Vector3d(1, 0, 0), Eigen::Vector3d(-1, 0, 0), Eigen::Vector3d(0, 1, 0),
        Eigen::Vector3d(0, -1, 0), Eigen::Vector3d(0, 0, -1), Eigen::Vector3d(0.3, -0.9, 0.2),
        Eigen::Vector3d(0.95, 0.1, 0.2), Eigen::Vector3d(1e-320, 1e-320, 0),
        Eigen::Vector3d(1e308, 1e308, -1e308)}) {
    SCOPED_TRACE(testing::Message() << up.transpose());
    std::vector<float> xyz;
    for (int i = 1; i < 200; ++i) {
      const Eigen::Vector3f p = ((up / up.cwiseAbs().maxCoeff()) * i).cast<float>();
      xyz.insert(xyz.end(), {p.x(), p.y(), p.z()});
    }
    for (const ViewFrom from : {ViewFrom::iso, ViewFrom::front, ViewFrom::side}) {
      Picture picture = sized(320, 200, from);
      picture.up = up;
      const Pixels empty = decode(picture_png(picture));
      picture.points = PointView::of(xyz.data(), 12, xyz.size() / 3);
      const Pixels seen = decode(picture_png(picture));
      int drawn = 0, astray = 0, warm = 0, cold = 0;
      for (int y = 0; y < 200; ++y) {
        for (int x = 0; x < 320; ++x) {
          const std::uint32_t rgb = seen.at(x, y);
          if (rgb == empty.at(x, y)) continue;
          ++drawn;
          astray += std::abs(x - 160) > 8;
          warm += y < 50 && (rgb >> 16) > (rgb & 0xff);
          cold += y > 150 && (rgb >> 16) < (rgb & 0xff);
        }
      }
      EXPECT_GT(drawn, 300);
      EXPECT_EQ(astray, 0);
      EXPECT_GT(warm, 50);
      EXPECT_GT(cold, 50);
    }
  }
}

TEST(PictureUp, AxesKeepTheirColours) {
  Picture picture = sized(800, 600, ViewFrom::front);
  picture.volumes.push_back({Aabb({-3, -3, -3}, {3, 3, 3}), 4});
  picture.up = {0, -1, 0};
  const Pixels pixels = decode(picture_png(picture));
  const int corner_x = 74, corner_y = pixels.height - 74;
  const auto axis = [&](int dx, int dy) { return pixels.at(corner_x + 30 * dx, corner_y + 30 * dy); };
  EXPECT_TRUE(is_like(axis(1, 0), {0.95f, 0.35f, 0.35f}));  // x to the right, red
  EXPECT_TRUE(is_like(axis(0, 1), {0.45f, 0.85f, 0.4f}));   // y down, green
  EXPECT_FALSE(is_like(axis(0, -1), {0.42f, 0.6f, 1.0f}));  // z goes into the picture
}

TEST(PictureUp, ZeroAndWhatIsNotFiniteAreRefused) {
  const double inf = std::numeric_limits<double>::infinity();
  for (const Eigen::Vector3d& up :
       {Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(0, inf, 1), Eigen::Vector3d(1, 0, std::nan(""))}) {
    Picture picture;
    picture.up = up;
    EXPECT_THROW(picture_png(picture), std::invalid_argument);
    EXPECT_THROW(picture_svg(picture), std::invalid_argument);
  }
}

TEST(PictureFrame, FrontAndSideAreCutDownToTheirContent) {
  const auto size_of = [](const Aabb& box, ViewFrom from, int w, int h) {
    Picture picture = sized(w, h, from);
    picture.volumes.push_back({box, 0});
    const Pixels pixels = decode(picture_png(picture));
    return std::array{pixels.width, pixels.height};
  };
  const Aabb flat({0, 0, 0}, {100, 100, 15}), pole({0, 0, 0}, {1, 1, 10});
  for (const ViewFrom from : {ViewFrom::front, ViewFrom::side}) {
    EXPECT_THAT(size_of(flat, from, 1600, 1000),
                testing::ElementsAre(1600, testing::AllOf(testing::Gt(350), testing::Lt(500))));
    EXPECT_THAT(size_of(pole, from, 1600, 1000), testing::ElementsAre(480, 1000));
    EXPECT_THAT(size_of(flat, from, 320, 200), testing::ElementsAre(320, 200));
    EXPECT_THAT(size_of(flat, from, 1600, 200), testing::ElementsAre(1600, 200));
  }
  EXPECT_THAT(size_of(flat, ViewFrom::iso, 1600, 1000), testing::ElementsAre(1600, 1000));
  EXPECT_THAT(size_of(pole, ViewFrom::top, 1600, 1000), testing::ElementsAre(1600, 1000));
}

/// Sixty boxes, of which the frame leaves the three outermost at each side out.
Picture crowd(ViewFrom from) {
  Picture picture = sized(320, 200, from);
  for (int i = 0; i < 60; ++i)
    picture.volumes.push_back({box_at(i % 10, i / 10, 0.8), 1});
  return picture;
}

TEST(PictureFarVolumes, LeaveNoCoordinateFarFromThePicture) {
  for (const double far : {1e7, 1e12, 1e30, 1e150}) {
    for (const ViewFrom from : {ViewFrom::iso, ViewFrom::top, ViewFrom::front, ViewFrom::side}) {
      SCOPED_TRACE(testing::Message() << far << " from " << static_cast<int>(from));
      Picture picture = crowd(from);
      picture.volumes.push_back({Aabb({far, far, far}, {2 * far, 3 * far, 2 * far}), 0, "a", 1});
      picture.volumes.push_back({Aabb({-far, -far, -far}, {far, far, far}), 0, "b", 2});
      picture.volumes.push_back({Sphere({3, -far, -far}, far * std::sqrt(2.0)), 0, "c", 1});
      const std::string svg = picture_svg(picture);
      double least = 0, most = 0;
      for (std::size_t at = svg.find(" d=\""); at != std::string::npos; at = svg.find(" d=\"", at)) {
        for (at += 4; svg[at] != '"';) {
          char* end = nullptr;
          const double number = std::strtod(&svg[at], &end);
          least = std::min(least, number);
          most = std::max(most, number);
          at = end == &svg[at] ? at + 1 : static_cast<std::size_t>(end - svg.data());
        }
      }
      EXPECT_GE(least, -65);
      EXPECT_LE(most, 320 + 65);
      EXPECT_GT(most, 160);
      EXPECT_THAT(svg, testing::Not(testing::HasSubstr("nan")));
      decode(picture_png(picture));
    }
  }
}

TEST(PictureFarVolumes, AreCutWhereTheyLeaveThePicture) {
  const auto beam = [](double reach) {
    Picture picture = crowd(ViewFrom::top);
    picture.volumes.push_back({Aabb({-reach, 2.9, 0}, {reach, 2.9, 0}), 0});
    return picture_png(picture);
  };
  EXPECT_GT(difference(beam(50), picture_png(crowd(ViewFrom::top))), 320u);
  for (const double reach : {1e7, 1e12, 1e30})
    EXPECT_TRUE(beam(reach) == beam(50)) << reach;
}

TEST(PictureFarVolumes, OfHugeSpheresThePartInThePictureIsDrawn) {
  Picture picture = crowd(ViewFrom::top);
  picture.volumes.push_back(
      {Sphere({5.4, 2.9 - 1e6, 0}, 1e6), 0});  // reaches the middle of the scene from below
  const Pixels pixels = decode(picture_png(picture));
  for (const int x : {20, 120, 220, 300}) {
    bool found = false;
    for (int y = 100 - 4; y < 100 + 4; ++y)
      found = found || is_like(pixels.at(x, y), palette(0));
    EXPECT_TRUE(found) << x;
  }
}

TEST(PictureSphere, HasNoCircleThatIsADot) {
  for (const ViewFrom from : {ViewFrom::top, ViewFrom::front, ViewFrom::side}) {
    Picture picture = sized(320, 200, from);
    picture.volumes.push_back({Sphere({1, 2, 3}, 4), 0});
    const std::string svg = picture_svg(picture);
    const std::regex twice("M (\\S+ \\S+) L \\1 ");
    EXPECT_FALSE(std::regex_search(svg, twice)) << static_cast<int>(from);
  }
}

}  // namespace
}  // namespace pcl_bv::detail
