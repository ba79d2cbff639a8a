// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <regex>

#include "palette.h"
#include "pcl_bv/report/picture.h"
#include "pixels.h"

namespace pcl_bv::detail {
namespace {

using test::box_at, test::decode, test::is_like, test::Pixels, test::sized;
constexpr int width = 800, height = 600;

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
  const std::regex ground("fill-opacity[:=]\"?0\\.75[^>]*d=\"M (\\S+) (\\S+) L \\S+ \\S+ L (\\S+) (\\S+) ");
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

}  // namespace
}  // namespace pcl_bv::detail
