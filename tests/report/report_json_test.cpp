// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Reports as JSON: every number reads back exactly, and nothing is written that JSON does not have.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <nlohmann/json.hpp>
#include <random>

#include "pcl_bv/report/csv.h"
#include "pcl_bv/report/report.h"

namespace pcl_bv::detail {
namespace {

using testing::HasSubstr;
using testing::Not;

Report report_of(std::vector<VolumeEntry> volumes) {
  Report report;
  report.file = "a.pcd";
  report.points = 12;
  report.clusters.push_back({0, 12, std::move(volumes)});
  return report;
}

Kdop dop6(double low, double high) {
  SlabVector min(3), max(3);
  min.setConstant(low);
  max.setConstant(high);
  return Kdop(KdopSet::dop6(), min, max);
}

/// Digits from the first to the last that is not 0, leaving the exponent out.
std::size_t significant_digits(std::string_view number) {
  std::string digits;
  for (const char c : number.substr(0, number.find('e'))) {
    if (c >= '0' && c <= '9') digits += c;
  }
  const std::size_t first = digits.find_first_not_of('0');
  return first == std::string::npos ? 0 : digits.find_last_not_of('0') - first + 1;
}

TEST(ReportJson, IsTheDocumentedText) {
  Report report = report_of({{"aabb", Aabb({0, -1, 0.5}, {1, 2, 3}), 0}});
  report.counts = {1, 2, 3, 4, 5, 7, 6, 8};
  report.seconds = Seconds{0.25, 0, 1e-6};
  EXPECT_EQ(
      report_json(report),
      R"({"schema":1,"file":"a.pcd","points":12,)"
      R"("counts":{"nonfinite":1,"range":2,"ground":3,"small":4,"large":5,"noise":7,"inside":6,"class":8},)"
      R"("clusters":[{"id":0,"points":12,"volumes":[)"
      R"({"shape":"aabb","method":"aabb","volume":7.5,"min":[0,-1,0.5],"max":[1,2,3],"outside":0}]}],)"
      R"("seconds":{"read":0.25,"segment":0,"fit":1e-06}})");
}

TEST(ReportJson, ShapesHaveTheirOwnNumbers) {
  EXPECT_THAT(report_json(report_of({{"dop6", dop6(-1, 2), {}}})),
              HasSubstr(R"("directions":[[1,0,0],[0,1,0],[0,0,1]],"min":[-1,-1,-1],"max":[2,2,2]}]}]})"));
  EXPECT_THAT(report_json(report_of({{"sphere-epos26", Sphere({1, 2, 3}, 0.5), {}}})),
              HasSubstr(R"("center":[1,2,3],"radius":0.5}]}]})"));
  Eigen::Matrix3d axes;  // in columns
  axes << 0, -1, 0, 1, 0, 0, 0, 0, 1;
  EXPECT_THAT(
      report_json(report_of({{"obb-min", Obb({1, 2, 3}, axes, {4, 2, 0.5}), 0}})),
      testing::AllOf(
          HasSubstr(
              R"({"shape":"obb","method":"obb-min","volume":32,"center":[1,2,3],)"
              R"("axes":[[0,1,0],[-1,0,0],[0,0,1]],"half_extents":[4,2,0.5],"quaternion":[0,0,0.707106)"),
          Not(HasSubstr("-0"))));
}

TEST(ReportJson, RoundShapesHaveTheirOwnNumbers) {
  EXPECT_THAT(report_json(report_of({{"cylinder", Cylinder({1, 2, 3}, {0, 0, 1}, 0.5, 2), {}}})),
              HasSubstr(R"("center":[1,2,3],"axis":[0,0,1],"radius":0.5,"half_height":2)"));
  EXPECT_THAT(report_json(report_of({{"capsule", Capsule({1, 2, 3}, {4, 5, 6}, 0.5), {}}})),
              HasSubstr(R"("a":[1,2,3],"b":[4,5,6],"radius":0.5)"));
  Eigen::Matrix3d axes;
  axes << 0, 0, 1, 1, 0, 0, 0, 1, 0;
  EXPECT_THAT(report_json(report_of({{"ellipsoid", Ellipsoid({1, 2, 3}, axes, {3, 2, 1}), {}}})),
              HasSubstr(R"("center":[1,2,3],"axes":[[0,1,0],[0,0,1],[1,0,0]],"radii":[3,2,1])"));
}

TEST(ReportJson, APrismHasItsAxesOutlineAndHeights) {
  Eigen::Matrix3d axes;
  axes << 0, 0, 1, 1, 0, 0, 0, 1, 0;
  EXPECT_THAT(
      report_json(report_of({{"prism", Prism(axes, {{0, 0}, {1, 0}, {0, 2.5}}, -1, 3), {}}})),
      HasSubstr(R"("axes":[[0,1,0],[0,0,1],[1,0,0]],"outline":[[0,0],[1,0],[0,2.5]],"low":-1,"high":3)"));
}

TEST(ReportJson, AHullHasItsRankOnlyWhereItIsFlat) {
  const std::vector<HullPlane> planes = {{{-1, 0, 0}, 0}, {{0, -1, 0}, 0}, {{0, 0, -1}, 0}, {{1, 1, 1}, 1}};
  const std::vector<Eigen::Vector3d> corners = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const Hull solid(corners, {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}, planes, 3);
  const std::string text = report_json(report_of({{"hull", solid, {}}}));
  EXPECT_THAT(text, HasSubstr(R"("vertices":[[0,0,0],[1,0,0],[0,1,0],[0,0,1]],)"
                              R"("faces":[[0,2,1],[0,1,3],[0,3,2],[1,2,3]],)"
                              R"("planes":[[-1,0,0,0],[0,-1,0,0],[0,0,-1,0],[1,1,1,1]]})"));
  const Hull flat({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {}, planes, 2);
  EXPECT_THAT(report_json(report_of({{"hull", flat, {}}})), HasSubstr(R"("faces":[],)"));
  EXPECT_THAT(report_json(report_of({{"hull", flat, {}}})), HasSubstr(R"("rank":2)"));
}

TEST(ReportJson, FailedInputHasOnlyItsError) {
  Report report;
  report.file = "b.pcd";
  report.error = "no such \"file\"";
  EXPECT_EQ(report_json(report), R"({"schema":1,"file":"b.pcd","error":"no such \"file\""})");
}

TEST(ReportJson, EmptyVolumeHasNoNumbers) {
  EXPECT_THAT(report_json(report_of({{"aabb", Aabb(), {}},
                                     {"dop26", Kdop(), 0},
                                     {"sphere-epos26", Sphere(), {}},
                                     {"obb-pca", Obb(), {}}})),
              HasSubstr(R"("volumes":[{"shape":"aabb","method":"aabb","empty":true},)"
                        R"({"shape":"kdop","method":"dop26","empty":true,"outside":0},)"
                        R"({"shape":"sphere","method":"sphere-epos26","empty":true},)"
                        R"({"shape":"obb","method":"obb-pca","empty":true}])"));
}

TEST(ReportJson, AFitThatFailedHasItsReasonAndNoNumbers) {
  EXPECT_THAT(report_json(report_of({{"hull", Hull(), {}, "gave \"up\""}})),
              HasSubstr(R"("volumes":[{"shape":"hull","method":"hull","failed":"gave \"up\""}])"));
}

TEST(ReportJson, NoClustersIsAnEmptyArray) {
  Report report;
  EXPECT_THAT(report_json(report), HasSubstr(R"("clusters":[])"));
}

TEST(ReportJson, InvalidUtf8AndControlCharactersAreMadeValid) {
  Report report;
  report.file = "a\xff\n\"\\\x01.pcd";
  const auto parsed = nlohmann::json::parse(report_json(report));
  EXPECT_EQ(parsed["file"], "a\xEF\xBF\xBD\n\"\\\x01.pcd");
}

TEST(ReportJson, AnyBytesAreWrittenAsNlohmannsLibraryDoes) {
  constexpr std::uint64_t seed = 47;
  SCOPED_TRACE(seed);
  std::mt19937_64 random(seed);
  const std::string likely = "a\"\\/\n\x1f\x7f\xc2\xa0\xe0\xed\x9f\xbf\xef\xf0\x90\x8f\xf4\x80\xc1\xff";
  for (int round = 0; round < 20000; ++round) {
    Report report;
    for (auto n = random() % 8; n > 0; --n)
      report.file += random() % 4 == 0 ? static_cast<char>(random()) : likely[random() % likely.size()];
    report.error = "";
    const std::string file =
        nlohmann::json(report.file).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
    ASSERT_EQ(report_json(report), R"({"schema":1,"file":)" + file + R"(,"error":""})");
  }
}

TEST(ReportJson, ComesInPiecesThatTogetherAreTheTextAsTheOtherFormatsDo) {
  Report report;
  report.file = "a.pcd";
  for (std::size_t id = 0; id < 30000; ++id)
    report.clusters.push_back(
        {id, 1, {{"aabb", Aabb({0, 0, 0}, {1.0 / 3, 2, 1.0 + static_cast<double>(id)}), {}}}});
  const auto expect_pieces = [&](const std::string& all, auto* write) {
    std::string joined;
    std::size_t pieces = 0;
    write(report, vector_source(report.clusters), [&](std::string& piece) {
      EXPECT_LT(piece.size(), std::size_t{1} << 21);
      ++pieces;
      joined += std::exchange(piece, {});
    });
    EXPECT_GT(pieces, 1U);
    EXPECT_EQ(joined, all);
  };
  expect_pieces(report_json(report), write_report_json);
  expect_pieces(report_csv(report), write_report_csv);
  expect_pieces(report_text(report), write_report_text);
}

TEST(ReportJson, AnyDoubleReadsBackExactlyInTheFewestDigits) {
  constexpr std::uint64_t seed = 11;
  SCOPED_TRACE(seed);
  std::mt19937_64 random(seed);
  std::vector<double> values = {
      5e-324, 2.2250738585072014e-308, 1e-41,  0.1, 1.0 / 3, 1e22, 9007199254740993.0, 1e38,
      1e100,  9.5367431640625e-07,     5e-322, 1e23};
  while (values.size() < 20000) {
    const std::uint64_t bits = random();
    double value = 0;
    std::memcpy(&value, &bits, sizeof value);
    if (std::abs(value) <= 1e100) values.push_back(value);
  }
  for (const double value : values) {
    const std::string json = report_json(report_of({{"sphere-epos26", Sphere({value, 0, 0}, 0), {}}}));
    const std::size_t begin = json.find("[", json.find("\"center\"")) + 1;
    const std::string digits = json.substr(begin, json.find(',', begin) - begin);
    ASSERT_EQ(std::strtod(digits.c_str(), nullptr), value) << digits;
    ASSERT_EQ(nlohmann::json::parse(digits).get<double>(), value) << digits;
    char scientific[64];
    int digits_needed = 0;
    do {
      std::snprintf(scientific, sizeof scientific, "%.*e", digits_needed, value);
      ++digits_needed;
    } while (std::strtod(scientific, nullptr) != value);
    const auto exponent = static_cast<std::size_t>(std::strchr(scientific, 'e') - scientific);
    if (digits.find_first_of(".e") == std::string::npos)
      continue;  // in full: then zeros or exact digits follow
    ASSERT_EQ(significant_digits(digits), significant_digits({scientific, exponent})) << digits;
  }
}

TEST(ReportJson, NegativeZeroIsWrittenAsZero) {
  Report report =
      report_of({{"dop6", dop6(-0.0, 0.0), {}}, {"sphere-epos26", Sphere({-0.0, -0.0, -0.0}, 0), {}}});
  report.seconds = Seconds{-0.0, -0.0, -0.0};
  EXPECT_THAT(report_json(report), Not(HasSubstr("-0")));
}

TEST(ReportJson, WhatIsNotFiniteIsNeverWritten) {
  Report report = report_of({});
  report.seconds = Seconds{std::numeric_limits<double>::infinity(), 0, 0};
  EXPECT_THROW(report_json(report), std::domain_error);
  report.seconds = Seconds{0, std::numeric_limits<double>::quiet_NaN(), 0};
  EXPECT_THROW(report_json(report), std::domain_error);
}

}  // namespace
}  // namespace pcl_bv::detail
