// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Clustering from the command line, and the labels that show it.

#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <fstream>
#include <map>

#include "command.h"
#include "pcl_bv/io/read_cloud.h"

namespace pcl_bv::test {
using namespace detail;
namespace {

constexpr std::uint32_t none = 4294967295;

const PointField& field(const RawCloud& cloud, std::string_view name) {
  for (const PointField& candidate : cloud.fields) {
    if (candidate.name == name) return candidate;
  }
  throw std::runtime_error("no field " + std::string(name));
}

std::vector<std::uint32_t> labels_of(const RawCloud& cloud) {
  const PointField& label = field(cloud, "label");
  EXPECT_EQ(label.type, 'U');
  EXPECT_EQ(label.size, 4u);
  std::vector<std::uint32_t> labels(cloud.size());
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    std::memcpy(&labels[i], cloud.data.data() + i * cloud.point_step + label.offset, 4);
  }
  return labels;
}

/// Rows of points 0.1 apart, `gap` from row to row: sizes 12, 3, 30.
std::vector<std::string> three_rows() {
  std::vector<std::string> points;
  int row = 0;
  for (const int size : {12, 3, 30}) {
    for (int i = 0; i < size; ++i)
      points.push_back(std::to_string(0.1 * i) + " " + std::to_string(10 * row) + " 1");
    ++row;
  }
  return points;
}

TEST_F(PcdBv, ClustersComeLargestFirstAndSmallOnesAreCounted) {
  auto points = three_rows();
  points.push_back("nan nan nan");
  const std::string cloud = ascii("rows.pcd", points);
  const Json report = run({"--format", "jsonl", "--cluster", "0.2", cloud}).json();
  ASSERT_EQ(report["clusters"].size(), 2u);
  EXPECT_EQ(report["clusters"][0]["id"], 0);
  EXPECT_EQ(report["clusters"][0]["points"], 30);
  EXPECT_EQ(report["clusters"][1]["id"], 1);
  EXPECT_EQ(report["clusters"][1]["points"], 12);
  EXPECT_EQ(report["counts"]["small"], 3);
  EXPECT_EQ(report["counts"]["large"], 0);
  EXPECT_EQ(report["counts"]["nonfinite"], 1);
}

TEST_F(PcdBv, SizesLimitTheClusters) {
  const std::string cloud = ascii("rows.pcd", three_rows());
  const Json report =
      run({"--format", "jsonl", "--cluster", "0.2", "--min-size", "3", "--max-size", "12", cloud}).json();
  ASSERT_EQ(report["clusters"].size(), 2u);
  EXPECT_EQ(report["clusters"][0]["points"], 12);
  EXPECT_EQ(report["clusters"][1]["points"], 3);
  EXPECT_EQ(report["counts"]["small"], 0);
  EXPECT_EQ(report["counts"]["large"], 30);
}

// Two dense rows and a thin one between, of which each point has two neighbours at most.
TEST_F(PcdBv, MinPointsDropsWhatIsThinAsNoise) {
  std::vector<std::string> points;
  for (int row = 0; row < 2; ++row) {
    for (int i = 0; i < 40; ++i)
      points.push_back(std::to_string(0.05 * i + 4 * row) + " 0 0");
  }
  for (int i = 0; i < 13; ++i)
    points.push_back(std::to_string(2.105 + 0.145 * i) + " 0 0");
  const std::string cloud = ascii("thin.pcd", points);
  const std::vector<std::string> options = {"--format", "jsonl", "--cluster", "0.16", "--volume", "aabb"};
  const auto report = [&](const std::string& least) {
    std::vector<std::string> all = options;
    all.insert(all.end(), {"--min-points", least, cloud});
    return run(all).json();
  };
  EXPECT_EQ(report("1")["clusters"].size(), 1u);
  EXPECT_EQ(report("1")["counts"]["noise"], 0);
  const Json dense = report("5");
  ASSERT_EQ(dense["clusters"].size(), 2u);
  EXPECT_EQ(dense["clusters"][0]["points"].get<int>() + dense["clusters"][1]["points"].get<int>() +
                dense["counts"]["noise"].get<int>(),
            93);
  EXPECT_GE(dense["counts"]["noise"], 11);
  EXPECT_THAT(run({"--cluster", "0.16", "--min-points", "5", cloud}).out,
              testing::HasSubstr(" in no cluster"));
}

// Rows of points 0.5 m apart at 2 m and at 50 m.
TEST_F(PcdBv, TheToleranceGrowsWithTheRange) {
  std::vector<std::string> points;
  for (int i = 0; i < 10; ++i) {
    for (const int x : {2, 50})
      points.push_back(std::to_string(x) + " " + std::to_string(0.5 * i) + " 0");
  }
  const std::string cloud = ascii("rows.pcd", points);
  const auto clusters = [&](const std::string& tolerance) {
    return run({"--format", "jsonl", "--cluster", tolerance, "--min-size", "2", "--volume", "aabb", cloud})
        .json()["clusters"];
  };
  EXPECT_EQ(clusters("0.3").size(), 0u);
  const Json far = clusters("0.3:0.01");
  ASSERT_EQ(far.size(), 1u);
  EXPECT_EQ(far[0]["points"], 10);
  EXPECT_EQ(far[0]["volumes"][0]["min"][0], 50);
  EXPECT_EQ(clusters("0.3:0.2").size(), 2u);
}

TEST_F(PcdBv, OversizedClustersAreDroppedKeptOrSplit) {
  std::vector<std::string> points;
  for (int i = 0; i < 60; ++i)
    points.push_back(std::to_string((i < 30 ? 0.05 : 0.06) * i + (i < 30 ? 0 : 0.1)) + " 0 0");
  const std::string cloud = ascii("rows.pcd", points);
  const auto report = [&](const std::string& rule) {
    return run({"--format", "jsonl", "--cluster", "0.5", "--max-size", "40", "--volume", "aabb",
                "--oversized", rule, cloud})
        .json();
  };
  EXPECT_EQ(report("drop")["clusters"].size(), 0u);
  EXPECT_EQ(report("drop")["counts"]["large"], 60);
  EXPECT_EQ(report("keep")["clusters"][0]["points"], 60);
  const Json split = report("split");
  ASSERT_EQ(split["clusters"].size(), 2u) << split;
  EXPECT_EQ(split["clusters"][0]["points"], 30);
  EXPECT_EQ(split["counts"]["large"], 0);
}

TEST_F(PcdBv, GroupsOfPeopleAreCutIfAsked) {
  std::vector<std::string> points;  // two columns of 1.7 m, 0.4 m wide, 0.3 m apart
  for (int i = 0; i < 2 * 200; ++i) {
    const double angle = 2.4 * i, height = 1.7 * (i / 2) / 200;
    points.push_back(std::to_string(10 + 0.2 * std::cos(angle)) + " " +
                     std::to_string((i % 2 == 0 ? 0 : 0.7) + 0.2 * std::sin(angle)) + " " +
                     std::to_string(height));
  }
  const std::string cloud = ascii("people.pcd", points);
  const auto report = [&](const std::string& how) {
    return run({"--format", "jsonl", "--cluster", "0.5", "--volume", "aabb", "--refine", how, "--check",
                cloud})
        .json();
  };
  const Json off = report("off"), neck = report("neck");
  ASSERT_EQ(off["clusters"].size(), 1u);
  EXPECT_FALSE(off["counts"].contains("cut"));
  EXPECT_FALSE(off["clusters"][0].contains("cut"));
  ASSERT_EQ(neck["clusters"].size(), 2u) << neck;
  EXPECT_EQ(neck["counts"]["cut"], 1);
  for (const Json& person : neck["clusters"]) {
    EXPECT_EQ(person["points"], 200);
    EXPECT_EQ(person["cut"], true);
    EXPECT_EQ(person["volumes"][0]["outside"], 0);
  }
}

// One row of points, of two classes in turn, and a lone point of a third.
TEST_F(PcdBv, PointsOfDifferentClassesShareNoCluster) {
  std::string text =
      "VERSION .7\nFIELDS x y z kind\nSIZE 4 4 4 2\nTYPE F F F I\nCOUNT 1 1 1 1\nWIDTH 31\nHEIGHT 1\n"
      "VIEWPOINT 0 0 0 1 0 0 0\nPOINTS 31\nDATA ascii\n";
  for (int i = 0; i < 30; ++i)
    text += std::to_string(0.1 * i) + " 0 0 " + (i % 3 == 0 ? "-2" : "7") + "\n";
  text += "9 9 9 30000\n";
  std::ofstream(at("kinds.pcd")) << text;
  const std::vector<std::string> options = {"--format",   "jsonl", "--cluster", "0.5",
                                            "--min-size", "2",     "--volume",  "aabb"};
  const auto with = [&](std::vector<std::string> more) {
    std::vector<std::string> all = options;
    all.insert(all.end(), more.begin(), more.end());
    all.push_back(at("kinds.pcd"));
    return run(all);
  };
  EXPECT_EQ(with({}).json()["clusters"].size(), 1u);
  EXPECT_FALSE(with({}).json()["clusters"][0].contains("class"));
  const Json report = with({"--class", "kind"}).json();
  ASSERT_EQ(report["clusters"].size(), 2u) << report;
  EXPECT_EQ(report["clusters"][0]["class"], 7);
  EXPECT_EQ(report["clusters"][0]["points"], 20);
  EXPECT_EQ(report["clusters"][1]["class"], -2);
  EXPECT_EQ(report["clusters"][1]["points"], 10);
  EXPECT_EQ(report["counts"]["small"], 1);
  const Result absent = with({"--class", "label"});
  EXPECT_EQ(absent.status, 1);
  EXPECT_EQ(absent.err,
            "pcd_bv: " + at("kinds.pcd") + ": there is no field 'label'; the fields are x, y, z, kind\n");
  const Result wrong = with({"--class", "x"});
  EXPECT_EQ(wrong.status, 1);
  EXPECT_EQ(wrong.err, "pcd_bv: " + at("kinds.pcd") + ": field 'x' is floating point, not an integer\n");
}

TEST_F(PcdBv, AFileOfSettingsSaysWhatIsSpecialAboutAClass) {
  std::string text =
      "VERSION 0.7\nFIELDS x y z kind\nSIZE 4 4 4 4\nTYPE F F F U\nCOUNT 1 1 1 1\nWIDTH 30\nHEIGHT 1\n"
      "POINTS 30\nDATA ascii\n";
  for (int i = 0; i < 30; ++i)
    text += std::to_string(0.1 * i) + " 0 0 " + std::to_string(i / 10) + "\n";
  std::ofstream(at("kinds.pcd")) << text;
  std::ofstream(at("kinds.yaml")) << "cluster:\n  tolerance: 0.15\n  class_field: kind\n  classes:\n"
                                     "  - {value: 1, drop: true}\n  - {value: 2, volumes: [sphere]}\n"
                                     "filter: {range_min: 0}\nground: {method: none}\nvolumes: [aabb]\n";
  const Json report = run({"--format", "jsonl", "--config", at("kinds.yaml"), at("kinds.pcd")}).json();
  ASSERT_EQ(report["clusters"].size(), 2u) << report;
  EXPECT_EQ(report["clusters"][0]["volumes"][0]["shape"], "aabb");
  EXPECT_EQ(report["clusters"][1]["class"], 2);
  ASSERT_EQ(report["clusters"][1]["volumes"].size(), 1u);
  EXPECT_EQ(report["clusters"][1]["volumes"][0]["shape"], "sphere");
  EXPECT_EQ(report["counts"]["class"], 10);
  const Result printed = run({"--config", at("kinds.yaml"), "--print-config"});
  std::ofstream(at("printed.yaml")) << printed.out;
  EXPECT_EQ(run({"--config", at("printed.yaml"), "--print-config"}).out, printed.out);
  EXPECT_THAT(printed.out, testing::HasSubstr("{value: 2, drop: false, volumes: [sphere]}"));
}

TEST_F(PcdBv, ClusterOptionsThatMeanNothingAreWrongUse) {
  const auto refused = [&](std::vector<std::string> options, const std::string& line) {
    options.push_back("synth:sphere");
    const Result result = run(options);
    EXPECT_EQ(result.status, 2);
    EXPECT_EQ(result.err, "pcd_bv: " + line + "\n");
  };
  refused({"--cluster", "0.5:far"}, "--cluster PER_METRE: 'far' is not a number");
  refused({"--cluster", "0.5:"}, "--cluster PER_METRE: '' is not a number");
  refused({"--cluster", "0.5:-1"}, "--cluster PER_METRE: -1 is not at least 0 and at most 1e+06");
  refused({"--cluster", "0.5:0.01", "--min-points", "5"},
          "--min-points: 5 is not allowed: must be 1 if --cluster PER_METRE is above 0");
  refused({"--cluster", "0.5", "--oversized", "shrink"},
          "--oversized: 'shrink' is not one of drop, keep, split");
  refused({"--range", "5"}, "--range: '5' lacks :MAX");
  refused({"--range", "5:1"}, "--range MAX: 1 is below --range MIN, 5");
  refused({"--cluster", "1", "--min-size", "9", "--max-size", "8"}, "--max-size: 8 is below --min-size, 9");
  refused({"--cluster", "1", "--max-extent", "5,5,1", "--min-extent", "0,0,2"},
          "--max-extent: up: 1 is below --min-extent, 2");
  refused({"--cluster", "1", "--max-extent", "5,5"}, "--max-extent: '5,5' is not three numbers");
  refused({"--min-extent", "1,1,1"}, "--min-extent: only useful with --cluster");
  refused({"--oversized", "keep"}, "--oversized: only useful with --cluster");
  refused({"--refine", "neck"}, "--refine: only useful with --cluster");
  refused({"--cluster", "0.5", "--refine", "head"}, "--refine: 'head' is not one of auto, off, neck, tracks");
  refused({"--class", "label"}, "--class: only useful with --cluster");
}

TEST_F(PcdBv, LabelsAreTheClustersOfTheReport) {
  const Result result = run({"--format", "jsonl", "--volume", "aabb", "--range", "1:50", "--cluster", "0.3",
                             "--labels", at("l.pcd"), "synth:street:32000"});
  ASSERT_EQ(result.status, 0) << result.err;
  const Json report = result.json();
  ASSERT_GT(report["clusters"].size(), 3u);
  const RawCloud cloud = read_pcd(at("l.pcd"));
  ASSERT_EQ(report["points"], cloud.size());
  const std::vector<std::uint32_t> labels = labels_of(cloud);
  std::map<std::uint32_t, std::array<std::array<double, 3>, 2>> extent;
  std::map<std::uint32_t, std::size_t> size;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const Coordinates p = load_point(cloud.xyz(), i);
    const std::array<double, 3> at{p.x, p.y, p.z};
    auto& [low, high] = extent.try_emplace(labels[i], std::array{at, at}).first->second;
    low = {std::min(low[0], p.x), std::min(low[1], p.y), std::min(low[2], p.z)};
    high = {std::max(high[0], p.x), std::max(high[1], p.y), std::max(high[2], p.z)};
    ++size[labels[i]];
  }
  for (const Json& cluster : report["clusters"]) {
    const std::uint32_t id = cluster["id"];
    SCOPED_TRACE(id);
    EXPECT_EQ(cluster["points"], size[id]);
    EXPECT_EQ(cluster["volumes"][0]["min"], Json(extent[id][0]));
    EXPECT_EQ(cluster["volumes"][0]["max"], Json(extent[id][1]));
  }
  const Json& counts = report["counts"];
  const std::size_t dropped = counts["nonfinite"].get<std::size_t>() + counts["range"].get<std::size_t>() +
                              counts["small"].get<std::size_t>() + counts["large"].get<std::size_t>();
  EXPECT_EQ(size[none], dropped);
}

TEST_F(PcdBv, WithoutClusteringEveryUsedPointIsLabelledZero) {
  const std::string cloud = ascii("c.pcd", {"0 0 0", "nan 0 0", "3 0 0", "9 0 0"});
  EXPECT_EQ(run({"--range", "1:5", "--labels", at("l.pcd"), cloud}).status, 0);
  EXPECT_THAT(labels_of(read_pcd(at("l.pcd"))), testing::ElementsAre(none, none, 0, none));
}

TEST_F(PcdBv, LabelsKeepFieldsOrderShapeAndViewpoint) {
  std::string text = header(6);
  const auto put = [&](std::string_view from, std::string_view to) {
    text.replace(text.find(from), from.size(), to);
  };
  put("FIELDS x y z", "FIELDS ring x y z label t");
  put("SIZE 4 4 4", "SIZE 2 4 4 4 1 8");
  put("TYPE F F F", "TYPE U F F F I F");
  put("COUNT 1 1 1", "COUNT 1 1 1 1 1 1");
  put("WIDTH 6\nHEIGHT 1", "WIDTH 3\nHEIGHT 2");
  put("0 0 0 1 0 0 0", "1 2 3 0.5 0.5 0.5 0.5");
  for (int i = 0; i < 6; ++i)
    text += std::to_string(i + 7) + " " + std::to_string(i) + " 0.5 nan -3 0.125\n";
  const std::string input = file("rich.pcd", text);
  ASSERT_EQ(run({"--labels", at("l.pcd"), input}).status, 0);
  const RawCloud before = read_pcd(input), after = read_pcd(at("l.pcd"));
  EXPECT_EQ(after.width, 3u);
  EXPECT_EQ(after.height, 2u);
  EXPECT_EQ(after.viewpoint, before.viewpoint);
  EXPECT_THAT(read_file(at("l.pcd")), testing::HasSubstr("DATA binary\n"));
  ASSERT_EQ(after.fields.size(), before.fields.size());
  for (const PointField& old : before.fields) {
    SCOPED_TRACE(old.name);
    if (old.name == "label") continue;
    const PointField& now = field(after, old.name);
    EXPECT_EQ(now.type, old.type);
    ASSERT_EQ(now.size, old.size);
    for (std::size_t i = 0; i < 6; ++i) {
      EXPECT_EQ(std::memcmp(after.data.data() + i * after.point_step + now.offset,
                            before.data.data() + i * before.point_step + old.offset, old.size),
                0);
    }
  }
  EXPECT_THAT(labels_of(after), testing::Each(none));
}

}  // namespace
}  // namespace pcl_bv::test
