// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Files that are odd but can be read: both commands, whole, in parts and together, give the same points and
// say the same.

#include <gmock/gmock.h>

#include <cstring>

#include "command.h"
#include "pcl_bv/io/read_cloud.h"

namespace pcl_bv::test {
using namespace detail;
namespace {

using testing::HasSubstr;

class OddInputs : public PcdBv {
 protected:
  /// A .pcd of four points in a box of 1 x 2 x 3, and of the field label, in the binary or the text given.
  std::string pcd(const std::string& name, const std::string& fields, const std::string& sizes,
                  const std::string& types, const std::string& body,
                  const std::string& viewpoint = "0 0 0 1 0 0 0") const {
    return file(name, "FIELDS " + fields + " label\nSIZE " + sizes + " 4\nTYPE " + types +
                          " U\nWIDTH 4\nHEIGHT 1\nVIEWPOINT " + viewpoint + "\nDATA ascii\n" + body);
  }

  static std::string rows(const std::string& label) {
    return "0 0 0 " + label + "\n1 0 0 2\n0 2 0 3\n1 2 3 4\n";
  }

  Result stream(const std::string& source,
                const std::vector<std::string>& settings = {"--cluster", "0", "--range", "0:inf"}) const {
    std::vector<std::string> all{"--source", source, "--rate", "max", "--ground", "none", "--volume", "aabb"};
    all.insert(all.end(), settings.begin(), settings.end());
    return run(all, {.program = "bv_stream"});
  }

  /// By both commands and in every way of reading: the box 1 x 2 x 3, and on standard error only this note.
  void expect_box(const std::string& path, const std::string& note = "") const {
    SCOPED_TRACE(path);
    const Json box = Json::parse("[1.0,2.0,3.0]");
    const auto expect = [&](const Result& result) {
      EXPECT_EQ(result.status, 0);
      const Json report = result.json();
      const Json& whole = report.is_array() ? report[0] : report;
      ASSERT_TRUE(whole.contains("clusters")) << result.out;
      EXPECT_EQ(whole["clusters"][0]["points"], 4);
      EXPECT_EQ(whole["clusters"][0]["volumes"][0]["max"], box);
      EXPECT_EQ(result.error_lines(), note.empty() ? 0U : 1U) << result.err;
      EXPECT_THAT(result.err, HasSubstr(note));
    };
    expect(run({"--volume", "aabb", "--format", "jsonl", path}));
    expect(run({"--volume", "aabb", "--format", "jsonl", "--info", "--labels", at("l.pcd"), path}));
    expect(run({"--volume", "aabb", "--format", "jsonl", "--together", path}));
    expect(stream(path));
    const Result partial = run({"--partial", at("part"), path});
    EXPECT_EQ(partial.status, 0);
    EXPECT_THAT(partial.err, HasSubstr(note));
    EXPECT_EQ(
        run({"--volume", "aabb", "--format", "jsonl", "--merge", at("part")}).json()["clusters"][0]["points"],
        4);
  }
};

TEST_F(OddInputs, GiveTheSameByBothCommandsAndInEveryWayOfReading) {
  expect_box(pcd("int.pcd", "x y z", "2 2 2", "I I I", rows("1")));
  expect_box(pcd("mixed.pcd", "x y z", "8 8 4", "F F F", rows("1")));
  expect_box(pcd("upper.pcd", "X Y Z", "4 4 4", "F F F", rows("1")));
  expect_box(pcd("float.pcd", "x y z", "4 4 4", "F F F", rows("1.0")));
  expect_box(pcd("none.pcd", "x y z", "4 4 4", "F F F", rows("-1")));
  expect_box(
      pcd("word.pcd", "x y z", "4 4 4", "F F F", rows("car")),
      "row 1, field 'label': 'car' is not an unsigned integer of 4 bytes; 1 such value is replaced by 0");
  expect_box(pcd("view.pcd", "x y z", "4 4 4", "F F F", rows("1"), "1 0 0 1 0 0 0"),
             "VIEWPOINT is not the identity and is not applied");
  expect_box(
      file("upper.ply", "ply\nformat ascii 1.0\ncomment " + std::string(70'000, 'c') +
                            "\nelement vertex 4\nproperty short X\nproperty double Y\nproperty float Z\n"
                            "property uint label\nend_header\n" +
                            rows("1")));
}

TEST_F(OddInputs, KeepTheirFieldsWithTheLabels) {
  const std::string path = pcd("int.pcd", "X Y Z", "2 2 8", "I I F", rows("1"));
  ASSERT_EQ(run({"--labels", at("l.pcd"), path}).status, 0);
  const RawCloud cloud = read_pcd(at("l.pcd"));
  ASSERT_EQ(cloud.fields.size(), 4U);
  EXPECT_EQ(cloud.fields[0].name + cloud.fields[0].type, "XI");
  EXPECT_EQ(cloud.fields[1].size, 2U);
  std::int16_t y = 0;
  std::memcpy(&y, &cloud.data[3 * cloud.point_step + 2], 2);
  EXPECT_EQ(y, 2);
}

TEST_F(OddInputs, WithUnreadClassesAreRefusedOnlyWhereClassesAreAskedFor) {
  const std::string path = pcd("word.pcd", "x y z", "4 4 4", "F F F", rows("car"));
  const std::vector<std::string> clusters{"--cluster", "9", "--min-size", "1", "--format", "jsonl", path};
  EXPECT_EQ(run(clusters).status, 0);
  std::vector<std::string> classes = clusters;
  classes.insert(classes.begin(), {"--class", "label"});
  const Result refused = run(classes);
  EXPECT_EQ(refused.status, 1);
  EXPECT_THAT(refused.err, HasSubstr("field 'label' has values that are no integers: row 1"));
  const Result lost = stream(path, {"--cluster", "9", "--class", "label"});
  EXPECT_EQ(lost.status, 1);
  EXPECT_THAT(lost.err, HasSubstr("field 'label' has values that are no integers: row 1"));
}

TEST_F(OddInputs, AreSaidOfEachInputOfOneCloud) {
  const std::string view = "0 0 1 1 0 0 0";
  const std::vector<std::string> both{"--together", "--volume", "aabb",
                                      pcd("a.pcd", "x y z", "4 4 4", "F F F", rows("1"), view),
                                      pcd("b.pcd", "x y z", "4 4 4", "F F F", rows("word"))};
  const Result result = run(both);
  EXPECT_EQ(result.status, 0);
  EXPECT_THAT(result.err, HasSubstr("a.pcd: VIEWPOINT is not the identity"));
  EXPECT_THAT(result.err, HasSubstr("b.pcd: row 1, field 'label': 'word'"));
}

TEST_F(OddInputs, OfWhichTheRangeDropsMostNameItAndWhereItComesFrom) {
  std::string far;
  for (int i = 0; i < 120; ++i)
    far += std::to_string(i < 50 ? 1 : 5) + " 0 " + std::to_string(0.001 * i) + "\n";
  const std::string path = file("far.pcd", header(120) + far);
  const std::string config = file("c.yaml", "filter: {range_max: 3}\n");
  const std::string said = "70 of 120 points are outside the range of ";
  const auto error_of = [&](std::vector<std::string> options) {
    options.push_back(path);
    return run(options).err;
  };
  EXPECT_THAT(error_of({"--preset", "table"}),
              HasSubstr(said + "0.2 to 2 m from the origin (--preset table)"));
  EXPECT_THAT(error_of({"--config", config}),
              HasSubstr(said + "0 to 3 m from the origin (--config " + config + ")"));
  EXPECT_THAT(error_of({"--preset", "table", "--range", "0.5:4"}),
              HasSubstr(said + "0.5 to 4 m from the origin (--range)"));
  EXPECT_EQ(error_of({"--range", "0:6"}), "");
  EXPECT_EQ(error_of({"--range", "2:6"}), "");  // 50 of 120
  EXPECT_THAT(stream(path, {"--cluster", "0", "--range", "0:3"}).err,
              HasSubstr("frame 0: " + said + "0 to 3 m from the origin (--range)"));
}

}  // namespace
}  // namespace pcl_bv::test
