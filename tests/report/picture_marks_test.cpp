// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// What is written on pictures, and how they are framed and cut.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <regex>

#include "clouds.h"
#include "palette.h"
#include "pcl_bv/report/picture.h"
#include "pixels.h"

namespace pcl_bv {
namespace {

using test::decode, test::difference, test::Pixels;

constexpr int width = 800, height = 600;

Picture sized(int w = width, int h = height, ViewFrom from = ViewFrom::top) {
  Picture picture;
  picture.width = w;
  picture.height = h;
  picture.from = from;
  return picture;
}

Aabb box_at(double x, double y, double size = 1) {
  return {{x, y, 0}, {x + size, y + size, size}};
}

/// Two boxes 8 m apart; the first spans pixels 32 to 106 across and 263 to 337 down.
Picture two_boxes(const std::string& first, const std::string& second) {
  Picture picture = sized();
  picture.volumes = {{box_at(-5, 0), 0, first, 0}, {box_at(4, 0), 1, second, 0}};
  return picture;
}

std::size_t count(const std::string& text, std::string_view what) {
  std::size_t n = 0;
  for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + 1))
    ++n;
  return n;
}

std::size_t letters(const Picture& picture) {
  return count(picture_svg(picture), "#glyph");
}

bool is_like(std::uint32_t rgb, const Colour& colour) {
  for (int k = 0; k < 3; ++k) {
    const double channel = (rgb >> (16 - 8 * k) & 0xff) / 255.0;
    if (std::abs(channel - static_cast<double>(colour[k])) > 0.25) return false;
  }
  return true;
}

TEST(PictureLabels, AreWrittenAboveTheirVolumesInTheirColours) {
  const Pixels with = decode(picture_png(two_boxes("0", "17")));
  const Pixels without = decode(picture_png(two_boxes("", "")));
  std::array<int, 2> coloured{}, elsewhere{};
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      if (with.at(x, y) == without.at(x, y)) continue;
      const bool second = x > width / 2;
      const bool above = y > 235 && y < 263 && std::abs(x - (second ? 731 : 69)) < 15;
      coloured[second] += above && is_like(with.at(x, y), palette(second));
      elsewhere[second] += !above;
    }
  }
  EXPECT_GT(coloured[0], 8);
  EXPECT_GT(coloured[1], 12);
  EXPECT_EQ(elsewhere, (std::array<int, 2>{}));
  EXPECT_EQ(letters(two_boxes("0", "17")), letters(two_boxes("", "")) + 3);
}

TEST(PictureLabels, ThatWouldTouchAnEarlierOneAreLeftOut) {
  const auto labelled = [](const std::string& first, const std::string& second) {
    Picture picture = two_boxes("", "");
    picture.volumes.push_back({box_at(0, 0), 2, first, 0});
    picture.volumes.push_back({box_at(0, 0.1, 0.8), 3, second, 0});
    return picture_png(picture);
  };
  EXPECT_TRUE(labelled("1", "2") == labelled("1", ""));
  EXPECT_FALSE(labelled("", "2") == labelled("", ""));
}

TEST(PictureLabels, OfSixHundredNoTwoOverlapAndManyAreThere) {
  Picture picture = sized();
  for (int i = 0; i < 600; ++i)
    picture.volumes.push_back(
        {box_at(i % 30, i / 30, 0.5), static_cast<std::uint32_t>(i), std::to_string(i), 0});
  const std::string svg = picture_svg(picture);
  const std::regex ground("fill-opacity[:=]\"?0\\.6[^>]*d=\"M (\\S+) (\\S+) L \\S+ \\S+ L (\\S+) (\\S+) ");
  std::vector<Aabb> boxes;
  for (std::sregex_iterator at(svg.begin(), svg.end(), ground), end; at != end; ++at) {
    const auto number = [&](int k) { return std::stod((*at)[k]); };
    const Eigen::Vector3d one(number(1), number(2), 0), other(number(3), number(4), 0);
    boxes.emplace_back(one.cwiseMin(other), one.cwiseMax(other));
  }
  EXPECT_GT(boxes.size(), 150u);
  EXPECT_LT(boxes.size(), 600u);
  std::size_t overlapping = 0;
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j)
      overlapping += (boxes[i].min().array() < boxes[j].max().array()).head<2>().all() &&
                     (boxes[j].min().array() < boxes[i].max().array()).head<2>().all();
  }
  EXPECT_EQ(overlapping, 0u);
}

TEST(PictureLabels, OfAnyBytesAreWritten) {
  EXPECT_EQ(letters(two_boxes("\xff\x01", "a\xc3")), letters(two_boxes("??", "a?")));
}

TEST(PictureLabels, AreTheSameBytesEveryTime) {
  EXPECT_TRUE(picture_png(two_boxes("12", "34")) == picture_png(two_boxes("12", "34")));
}

TEST(PictureLegend, NamesEachMethodDrawnOnceIfThereAreSeveral) {
  Picture picture = two_boxes("", "");
  const std::size_t none = letters(picture);
  picture.methods = {"aabb", "kdop", "hull-x"};
  EXPECT_EQ(letters(picture), none);
  picture.volumes.push_back({box_at(0, 0), 0, "", 2});
  picture.volumes.push_back({box_at(1, 0), 1, "", 2});
  EXPECT_EQ(letters(picture), none + 10);
  picture.volumes.push_back({Aabb(), 1, "", 1});
  EXPECT_EQ(letters(picture), none + 10);
}

/// Pixels of a method's line in the legend that are like a colour.
int sample_pixels(const Picture& picture, int row, const Colour& colour) {
  const Pixels pixels = decode(picture_png(picture));
  int n = 0;
  for (int x = 30; x < 82; ++x)
    n += is_like(pixels.at(x, 25 + 22 * row), colour);
  return n;
}

TEST(PictureLegend, TellsMethodsApartByColourWhereEachHasItsOwn) {
  Picture picture = two_boxes("", "");
  picture.methods = {"a", "b"};
  picture.volumes[1].method = 1;
  EXPECT_GT(sample_pixels(picture, 0, palette(0)), 48);
  EXPECT_GT(sample_pixels(picture, 1, palette(1)), 48);
  EXPECT_EQ(count(picture_svg(picture), "stroke-dasharray"), 0u);
}

TEST(PictureLegend, TellsMethodsApartByDashesWhereClustersTakeTheColours) {
  constexpr Colour plain{0.86f, 0.88f, 0.92f};
  Picture picture = two_boxes("", "");
  picture.methods = {"a", "b"};
  picture.volumes.push_back({box_at(-5, 0, 2), 0, "", 1});
  picture.volumes.push_back({box_at(4, 0, 2), 1, "", 1});
  EXPECT_GT(sample_pixels(picture, 0, plain), 48);
  const int dashed = sample_pixels(picture, 1, plain);
  EXPECT_GT(dashed, 20);
  EXPECT_LT(dashed, 44);
  // Two boxes and the sample, each with a dark stroke below and perhaps one for hidden edges.
  EXPECT_GE(count(picture_svg(picture), "stroke-dasharray"), 6u);
}

TEST(PictureScale, SaysTheUnit) {
  const auto with = [](const std::string& unit) {
    Picture picture = two_boxes("", "");
    picture.unit = unit;
    return picture;
  };
  EXPECT_EQ(letters(with("km")), letters(with("")) + 3);
  EXPECT_EQ(Picture().unit, "m");
  const Pixels km = decode(picture_png(with("km"))), m = decode(picture_png(with("m")));
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      if (km.at(x, y) == m.at(x, y)) continue;
      EXPECT_TRUE(y > height - 50 && x > 160 && x < 360) << x << " " << y;
    }
  }
}

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
  Picture picture = sized(width, height, ViewFrom::front);
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
}  // namespace pcl_bv
