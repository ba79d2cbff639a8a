// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The table: aligned, within the terminal, and free of noise.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>

#include "german_locale.h"
#include "pcl_bv/report/csv.h"
#include "pcl_bv/report/report.h"

namespace pcl_bv::detail {
namespace {

using testing::HasSubstr;
using testing::Not;

Report two_clusters() {
  Report report;
  report.file = "street.pcd";
  report.points = 1000;
  report.counts.nonfinite = 7;
  report.counts.small = 3;
  report.clusters.push_back({0,
                             900,
                             {{"aabb", Aabb({-30, -4, -1.5}, {10, 4, 2.5}), {}},
                              {"sphere-epos26", Sphere({-10, 0, 0.5}, 21), {}}}});
  report.clusters.push_back(
      {1, 90, {{"aabb", Aabb({4.0001, -1, 0}, {4.5, -0.5, 0}), {}}, {"sphere-epos26", Sphere(), {}}}});
  return report;
}

std::vector<std::string> lines(const std::string& text) {
  std::vector<std::string> result;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);)
    result.push_back(line);
  return result;
}

TEST(ReportText, HeaderNamesFilePointsAndOnlyTheReasonsThatOccur) {
  const std::string header = lines(report_text(two_clusters()))[0];
  EXPECT_EQ(header, "street.pcd: 1000 points, 7 not finite, 3 in small clusters");
}

TEST(ReportText, EachVolumeIsOneRowAndItsClusterIsNamedOnce) {
  const auto rows = lines(report_text(two_clusters()));
  ASSERT_EQ(rows.size(), 6u);
  EXPECT_THAT(rows[2],
              testing::MatchesRegex(" +0 +900 +aabb +-10.000 +0.000 +0.500 +40.000 +8.000 +4.000 +1280"));
  EXPECT_THAT(rows[3], testing::MatchesRegex(" +sphere-epos26 +-10.000 +0.000 +0.500 +r 21.000 +38792"));
  EXPECT_THAT(rows[4], testing::MatchesRegex(" +1 +90 +aabb .*"));
  EXPECT_THAT(rows[5], testing::MatchesRegex(" +sphere-epos26 +empty"));
}

TEST(ReportText, AndJsonAndCsvDoNotDependOnTheLocale) {
  Report report = two_clusters();
  report.seconds = {0.00125, 0.0025, 0.0005};
  const auto all = [&] { return report_text(report) + report_json(report) + report_csv(report); };
  const std::string before = all();
  const test::GermanLocale german;
  EXPECT_EQ(all(), before);
  if (!german.is_set()) GTEST_SKIP() << "localedef cannot create a German locale";
}

TEST(ReportText, ColumnsAreAligned) {
  const auto rows = lines(report_text(two_clusters()));
  const std::size_t method = rows[1].find("method");
  EXPECT_EQ(rows[2].find("aabb"), method);
  EXPECT_EQ(rows[3].find("sphere"), method);
  EXPECT_EQ(rows[2].size(), rows[1].size());
}

// A pole of 6 m, longer along y.
const Obb pole =
    Obb({1, 2, 3}, Eigen::Matrix3d::Identity(), {0.25, 0.5, 3}).upright(Eigen::Vector3d::UnitZ());

TEST(ReportText, UprightBoxesHaveLengthWidthHeightAndYaw) {
  Report report;
  report.file = "street.pcd";
  report.clusters.push_back({0, 900, {{"obb-lshape", pole, {}}}});
  const auto rows = lines(report_text(report));
  EXPECT_THAT(rows[1], testing::MatchesRegex(" +id .* +length +width +height +yaw +volume"));
  EXPECT_THAT(rows[2], testing::MatchesRegex(" +0 +900 +obb-lshape .* 1.0000 +0.5000 +6.0000 +1.57 +3.000"));
}

TEST(ReportText, BesideOtherShapesBothMeaningsOfTheSizesAreNamed) {
  Report report = two_clusters();
  report.clusters.push_back({2, 900, {{"obb-yaw", pole, {}}, {"obb-min", pole, {}}}});
  const auto rows = lines(report_text(report));
  EXPECT_THAT(rows[1], HasSubstr("length/x width/y height/z"));
  EXPECT_THAT(rows[1], HasSubstr("yaw"));
  EXPECT_THAT(rows[6], HasSubstr("1.57"));
  EXPECT_THAT(rows[7], Not(HasSubstr("1.57"))) << "obb-min is not upright";
  for (std::size_t i : {2, 6, 7})
    EXPECT_EQ(rows[i].size(), rows[1].size()) << "not aligned";
}

TEST(ReportText, WithoutUprightBoxesThereIsNoYaw) {
  EXPECT_THAT(report_text(two_clusters()), Not(HasSubstr("yaw")));
  EXPECT_THAT(report_text(two_clusters()), HasSubstr("size x"));
}

TEST(ReportText, OutsideIsAColumnOnlyWhenChecked) {
  Report report = two_clusters();
  EXPECT_THAT(report_text(report), Not(HasSubstr("outside")));
  report.clusters[0].volumes[0].outside = 2;
  EXPECT_THAT(report_text(report), HasSubstr("outside"));
}

TEST(ReportText, SmallNegativeNumbersDoNotBecomeMinusZero) {
  Report report = two_clusters();
  report.clusters[0].volumes[1].volume = Sphere({-1e-7, -1e-9, 0}, 21);
  EXPECT_THAT(report_text(report), Not(testing::ContainsRegex("-0\\.0+ ")));
}

TEST(ReportText, AnyMagnitudeFitsTheTerminal) {
  for (const double scale : {1e-41, 1e-12, 1e-3, 1.0, 1e3, 5e6, 1e7, 1e20, 1e38, 1e100}) {
    for (const double size : {1e-3, 1.0}) {
      SCOPED_TRACE(testing::Message() << scale << ", relative size " << size);
      Report report;
      const Eigen::Vector3d low = Eigen::Vector3d(-1.23456789, -1, -1.1) * scale,
                            step = Eigen::Vector3d(1, 0.9, 0.1) * scale * size;
      const Eigen::Matrix3d turned = Eigen::AngleAxisd(-1.5, Eigen::Vector3d::UnitZ()).toRotationMatrix();
      report.clusters.push_back({12345,
                                 123456789,
                                 {{"sphere-epos26", Sphere(low, scale * size), 123},
                                  {"obb-lshape", Obb(low, turned, step), 0},
                                  {"aabb", Aabb(low, low + step), 0}}});
      const auto rows = lines(report_text(report));
      for (std::size_t i = 1; i < rows.size(); ++i)
        EXPECT_LE(rows[i].size(), 120u) << rows[i];
    }
  }
}

TEST(ReportText, AFitThatFailedSaysSo) {
  Report report = two_clusters();
  report.clusters[1].volumes[1] = {"hull", Hull(), {}, "gave up"};  // where an empty one was
  EXPECT_THAT(report_text(report), HasSubstr("failed"));
  EXPECT_THAT(report_text(report), Not(HasSubstr("empty")));
}

TEST(ReportText, NoClustersSaysSo) {
  Report report;
  report.file = "a.pcd";
  EXPECT_EQ(report_text(report), "a.pcd: 0 points, no clusters\n");
}

TEST(ReportText, FailedInputGivesNoText) {
  Report report;
  report.file = "a.pcd";
  report.error = "broken";
  EXPECT_EQ(report_text(report), "");
}

TEST(ReportText, InfoStandsBelowTheFirstLine) {
  Report report;
  report.file = "a.pcd";
  report.points = 6;
  report.info =
      CloudInfo{{Aabb({-1.5, 0, 1e-9}, {2, 3, 5e6}), 0.01234, 1, 2}, 3, 2, {{"x"}, {"n\x1b[1m", 'U', 2, 7}}};
  EXPECT_EQ(report_text(report),
            "a.pcd: 6 points, no clusters\n"
            "  x -1.5 to 2, y 0 to 3, z 1e-09 to 5e+06, spacing 0.0123, 3 x 2, 1 not finite, 2 at 0,0,0\n"
            "  fields x:F32 n?[1m:U16x7\n");
  report.info = CloudInfo();
  EXPECT_EQ(report_text(report), "a.pcd: 6 points, no clusters\n  0 not finite, 0 at 0,0,0\n  fields\n");
}

}  // namespace
}  // namespace pcl_bv::detail
