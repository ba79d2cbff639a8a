// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Pictures, decoded again and looked at.

#include "pcl_bv/report/picture.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "clouds.h"
#include "files.h"
#include "pcl_bv/io/raw_cloud.h"
#include "pixels.h"

namespace pcl_bv::detail {
namespace {

constexpr int width = 320, height = 200;

using test::decode, test::difference, test::Pixels;

Picture picture_of(const PointView& points) {
  Picture picture;
  picture.points = points;
  picture.width = width;
  picture.height = height;
  return picture;
}

std::string background() {
  return picture_png(picture_of({}));
}

TEST(Picture, HasTheSizeAsked) {
  const Pixels pixels = decode(background());
  EXPECT_EQ(pixels.width, width);
  EXPECT_EQ(pixels.height, height);
}

TEST(Picture, SameInputGivesTheSameBytes) {
  const auto cloud = test::gaussian<float>(3000, 5);
  Picture picture = picture_of(cloud.view());
  picture.volumes.push_back({Aabb({-2, -2, -2}, {2, 2, 2}), 0});
  picture.volumes.push_back({Sphere({0, 0, 0}, 2), 1});
  EXPECT_EQ(picture_png(picture), picture_png(picture));
}

TEST(Picture, PointsAreDrawn) {
  const auto cloud = test::gaussian<float>(3000, 6);
  EXPECT_GT(difference(picture_png(picture_of(cloud.view())), background()), 2000u);
}

TEST(Picture, BadPointsAndDeadBeamsAreLeftOut) {
  const float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();
  const std::vector<float> xyz = {0, 0, 0, nan, 1, 1, 1, inf, 1, -0.0f, 0, -0.0f};
  EXPECT_EQ(picture_png(picture_of(PointView::of(xyz.data(), 12, 4))), background());
}

TEST(Picture, EmptyVolumesAreLeftOut) {
  Picture picture = picture_of({});
  for (const AnyVolume& volume : {AnyVolume(Aabb()), AnyVolume(Kdop()), AnyVolume(Sphere())}) {
    picture.volumes.push_back({volume, 0});
  }
  EXPECT_EQ(picture_png(picture), background());
}

TEST(Picture, EveryShapeIsDrawnAndFillsTheFrame) {
  SlabVector min(3), max(3);
  min.setConstant(-3);
  max.setConstant(3);
  for (const AnyVolume& volume :
       {AnyVolume(Aabb({-3, -3, -3}, {3, 3, 3})), AnyVolume(Kdop(KdopSet::dop6(), min, max)),
        AnyVolume(Sphere({7, 8, 9}, 4))}) {
    SCOPED_TRACE(shape_name(volume));
    Picture picture = picture_of({});
    picture.volumes.push_back({volume, 0});
    const std::string png = picture_png(picture);
    EXPECT_GT(difference(png, background()), 5000u);
    const Pixels seen = decode(png), empty = decode(background());
    for (int x = 0; x < width; ++x) {  // nothing touches the upper and lower edge
      EXPECT_EQ(seen.rgb[x], empty.rgb[x]);
      EXPECT_EQ(seen.rgb[width * (height - 1) + x], empty.rgb[width * (height - 1) + x]);
    }
  }
}

TEST(Picture, FarStrayPointsDoNotShrinkTheScene) {
  auto cloud = test::gaussian<float>(4000, 8);
  const std::size_t alone = difference(picture_png(picture_of(cloud.view())), background());
  for (int i = 0; i < 20; ++i)
    cloud.xyz.insert(cloud.xyz.end(), {1e6f, -1e6f, static_cast<float>(i)});
  EXPECT_GT(difference(picture_png(picture_of(cloud.view())), background()), alone / 2);
}

// Of pixels in the lower left corner, how many are as red, green or blue as an axis.
std::array<std::size_t, 3> axis_pixels(const std::string& png) {
  const Pixels pixels = decode(png);
  std::array<std::size_t, 3> n{};
  for (int y = pixels.height - 160; y < pixels.height; ++y) {
    for (int x = 0; x < 160; ++x) {
      const std::uint32_t rgb = pixels.rgb[static_cast<std::size_t>(y) * pixels.width + x];
      const std::uint32_t r = rgb >> 16, g = rgb >> 8 & 0xff, b = rgb & 0xff;
      n[0] += r > 150 && g < 120 && b < 120;
      n[1] += g > 150 && r < 140 && b < 140;
      n[2] += b > 180 && r < 140;
    }
  }
  return n;
}

TEST(Picture, ShowsTheAxesThatAreNotSeenEndOn) {
  Picture picture = picture_of({});
  picture.width = 960;
  picture.height = 600;
  picture.volumes.push_back({AnyVolume(Aabb({-3, -3, -3}, {3, 3, 3})), 4});
  using testing::ElementsAre;
  using testing::Gt;
  picture.from = ViewFrom::iso;
  EXPECT_THAT(axis_pixels(picture_png(picture)), ElementsAre(Gt(20u), Gt(20u), Gt(20u)));
  picture.from = ViewFrom::top;
  EXPECT_THAT(axis_pixels(picture_png(picture)), ElementsAre(Gt(20u), Gt(20u), 0u));
  picture.from = ViewFrom::front;
  EXPECT_THAT(axis_pixels(picture_png(picture)), ElementsAre(Gt(20u), 0u, Gt(20u)));
  picture.volumes.clear();
  EXPECT_THAT(axis_pixels(picture_png(picture)), ElementsAre(0u, 0u, 0u));
}

TEST(Picture, HasAScaleBarOfARoundLength) {
  for (const double size : {1e-30, 0.013, 1.0, 40.0, 5e6, 1e30}) {
    Picture picture = picture_of({});
    picture.width = 1000;
    picture.height = 1000;
    picture.from = ViewFrom::top;
    picture.volumes.push_back({AnyVolume(Aabb({0, 0, 0}, {size, size, size})), 4});
    const Pixels pixels = decode(picture_png(picture));
    std::size_t longest = 0;  // run of light grey
    for (int y = 966; y < 976; ++y) {
      std::size_t run = 0;
      for (int x = 100; x < 500; ++x) {
        const std::uint32_t rgb = pixels.rgb[static_cast<std::size_t>(y) * 1000 + x];
        run = (rgb & 0xff) > 150 && (rgb >> 16) > 150 ? run + 1 : 0;
        longest = std::max(longest, run);
      }
    }
    const double length = static_cast<double>(longest) / 920 * size;  // the frame has margins of 4 %
    const double digit = length / std::pow(10.0, std::floor(std::log10(length * 1.02)));
    EXPECT_TRUE(std::abs(digit - 1) < 0.05 || std::abs(digit - 2) < 0.1 || std::abs(digit - 5) < 0.2)
        << size << ": " << length;
  }
}

TEST(Picture, NearPointsHideFarOnes) {
  std::vector<float> xyz;
  std::vector<std::uint32_t> labels;
  for (const float z : {1.0f, 0.0f}) {  // a shelf above another; the viewer looks from above
    for (int i = 0; i < 300 * 300; ++i) {
      xyz.insert(xyz.end(),
                 {0.01f * static_cast<float>(i % 300) + 1, 0.01f * static_cast<float>(i / 300) + 1, z});
      labels.push_back(z > 0 ? 0 : 1);
    }
  }
  Picture picture = picture_of(PointView::of(xyz.data(), 12, xyz.size() / 3));
  picture.labels = labels.data();
  const std::string both = picture_png(picture);
  for (std::uint32_t& label : labels)
    label = 1 - label;
  const std::string swapped = picture_png(picture);
  const auto blue = [](const std::string& png) {
    std::size_t n = 0;
    for (const std::uint32_t p : decode(png).rgb)
      n += (p & 0xff) > 100 && (p & 0xff) > (p >> 16);
    return n;
  };
  EXPECT_GT(blue(both), blue(swapped) + 2000) << "label 0 is blue and lies on top";
}

TEST(Picture, AnyMagnitudeAndFlatVolumesAreDrawn) {
  for (const auto& cloud : test::nasty_clouds<float>()) {
    SCOPED_TRACE(cloud.name);
    Picture picture = picture_of(cloud.view());
    Aabb box;
    for (std::size_t i = 0; i < cloud.size(); ++i) {
      const Coordinates p = load_point(cloud.view(), i);
      if (is_valid(p)) box.extend({p.x, p.y, p.z});
    }
    picture.volumes.push_back({box, 0});
    const std::string png = picture_png(picture);
    EXPECT_EQ(decode(png).rgb.size(), static_cast<std::size_t>(width * height));
    if (box.empty() || box.min() == box.max()) continue;
    EXPECT_GT(difference(png, background()), 20u);
  }
}

/// Where two pictures differ.
struct Extent {
  int left = width, right = -1, top = height, bottom = -1;

  double aspect() const { return static_cast<double>(right - left) / (bottom - top); }
};

Extent extent_of_difference(const std::string& a, const std::string& b) {
  const Pixels p = decode(a), q = decode(b);
  Extent extent;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      if (p.rgb[y * width + x] == q.rgb[y * width + x]) continue;
      extent.left = std::min(extent.left, x);
      extent.right = std::max(extent.right, x);
      extent.top = std::min(extent.top, y);
      extent.bottom = std::max(extent.bottom, y);
    }
  }
  return extent;
}

TEST(Picture, ViewsLookAlongTheAxes) {
  Picture box = picture_of({});
  box.volumes.push_back({Aabb({0, 0, 0}, {6, 3, 2}), 0});
  for (const auto& [from, aspect] :
       {std::pair{ViewFrom::top, 2.0}, {ViewFrom::front, 3.0}, {ViewFrom::side, 1.5}}) {
    SCOPED_TRACE(static_cast<int>(from));
    box.from = from;
    EXPECT_NEAR(extent_of_difference(picture_png(box), background()).aspect(), aspect, 0.05 * aspect);
    Picture marked = box;  // x, y and z grow to the right or up in each of these views
    marked.volumes.push_back({Aabb({5, 2.6, 1.7}, {6, 3, 2}), 1});
    const Extent mark = extent_of_difference(picture_png(marked), picture_png(box));
    EXPECT_GT(mark.left, width / 2);
    EXPECT_LT(mark.bottom, height / 2);
  }
}

TEST(Picture, TopViewShowsTheUpperOfTwo) {
  const std::vector<float> xyz = {1, 1, 0, 1, 1, 5, 2, 2, 0, 2, 2, 5};
  const std::uint32_t upper[] = {1, 0, 1, 0}, lower[] = {0, 1, 0, 1}, only[] = {0, 0, 0, 0};
  Picture picture = picture_of(PointView::of(xyz.data(), 12, 4));
  picture.from = ViewFrom::top;
  const auto labelled = [&](const std::uint32_t* labels) {
    picture.labels = labels;
    return picture_png(picture);
  };
  EXPECT_EQ(labelled(upper), labelled(only));
  EXPECT_NE(labelled(lower), labelled(only));
}

TEST(Picture, SvgHasThePointsAsAnImageAndTheVolumesAsPaths) {
  const auto cloud = test::gaussian<float>(3000, 6);
  Picture picture = picture_of(cloud.view());
  const std::string points = picture_svg(picture);
  EXPECT_THAT(points, testing::StartsWith("<?xml"));
  EXPECT_THAT(points, testing::EndsWith("</svg>\n"));
  EXPECT_THAT(points, testing::HasSubstr("data:image/png;base64,"));
  EXPECT_THAT(points, testing::HasSubstr("width=\"320px\" height=\"200px\""));
  const auto paths = [](const std::string& svg) {
    std::size_t n = 0;
    for (std::size_t at = svg.find("<path"); at != std::string::npos; at = svg.find("<path", at + 1))
      ++n;
    return n;
  };
  picture.volumes.push_back({Aabb({-2, -2, -2}, {2, 2, 2}), 0});
  picture.volumes.push_back({Sphere({0, 0, 0}, 2), 1});
  EXPECT_GT(paths(picture_svg(picture)), paths(points) + 10);
  picture.height = 15;
  EXPECT_THROW(picture_svg(picture), std::invalid_argument);
}

using PictureFile = FileTest;

TEST_F(PictureFile, IsOfTheFormatThatItsNameSays) {
  for (const auto& [name, start] : {std::pair{"a.SVG", "<?xml"}, {"a.png", "\x89PNG"}, {"a", "\x89PNG"}}) {
    write_picture(file(name), picture_of({}));
    EXPECT_THAT(file_content(file(name)), testing::StartsWith(start));
  }
}

TEST(Picture, SidesOutsideTheRangeAreRefused) {
  for (const int side : {15, 16385, 0, -1}) {
    Picture picture = picture_of({});
    picture.height = side;
    EXPECT_THROW(picture_png(picture), std::invalid_argument);
  }
}

TEST(Picture, UnwritablePathIsAnIoErrorAndNothingElse) {
  EXPECT_THROW(write_picture("/no/such/folder/a.png", picture_of({})), IoError);
}

}  // namespace
}  // namespace pcl_bv::detail
