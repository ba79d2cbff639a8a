// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Scores next to KITTI's labels: files of a few lines, whose scores are computed by hand.

#include "kitti_score.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <stdexcept>

#include "temporary_folder.h"

namespace pcl_bv::bench {
namespace {

using testing::HasSubstr;

// The camera is at the LiDAR and looks along x: camera x is -y, camera y is -z, camera z is x. The focal
// length is 700 pixels, the centre of the image (620, 190).
constexpr const char* kCalibration =
    "P2: 700 0 620 0 0 700 190 0 0 0 1 0\n"
    "R_rect 1 0 0 0 1 0 0 0 1\n"
    "Tr_velo_cam 0 -1 0 0 0 0 -1 0 1 0 0 0\n";

class KittiScore : public testing::Test {
 protected:
  std::string write(const std::string& name, const std::string& text) const {
    const std::string path = (folder_ / name).string();
    std::ofstream(path) << text;
    return path;
  }

  KittiCalibration calibration() const { return KittiCalibration(write("calib.txt", kCalibration)); }

  std::vector<KittiObject> labels(const std::string& text) const {
    return read_kitti_labels(write("labels.txt", text), calibration());
  }

  TrackScores score(const std::string& label_lines, const std::vector<ResultFrame>& results,
                    const KittiProtocol& protocol = {}) const {
    TrackScore found;
    add_kitti_sequence(labels(label_lines), calibration(), results, protocol, found);
    return found.result();
  }

  const test::TemporaryFolder folder_;
};

// A label of a car of 4 x 2 x 1.5 m whose centre in the LiDAR's frame is (x, y, -1).
std::string car(int frame, int id, double x, double y, const std::string& type = "Car", int truncated = 0,
                int occluded = 0) {
  // camera: (-y, 1.75, x) is the centre of the lower face; ry = -pi/2 has the length along the camera's z
  return std::to_string(frame) + ' ' + std::to_string(id) + ' ' + type + ' ' + std::to_string(truncated) +
         ' ' + std::to_string(occluded) + " 0 0 0 100 100 1.5 2 4 " + std::to_string(-y) + " 1.75 " +
         std::to_string(x) + " -1.5707963267948966\n";
}

FoundBox box(std::uint32_t track, double x, double y) {
  return {track, {{x, y}, 0, 4, 2}, -1.75, -0.25};
}

TEST_F(KittiScore, LabelsAreInTheFrameOfTheLidar) {
  const std::vector<KittiObject> objects =
      labels(car(3, 5, 20, 4) + "4 6 Car 0 0 0 0 0 1 1 1.5 2 4 -4 1.75 20 0.0\n");
  ASSERT_EQ(objects.size(), 2U);
  EXPECT_EQ(objects[0].frame, 3U);
  EXPECT_EQ(objects[0].id, 5U);
  EXPECT_NEAR(objects[0].base.center.x(), 20, 1e-9);
  EXPECT_NEAR(objects[0].base.center.y(), 4, 1e-9);
  EXPECT_NEAR(std::cos(objects[0].base.yaw), 1, 1e-9);
  EXPECT_NEAR(objects[0].low, -1.75, 1e-9);
  EXPECT_NEAR(objects[0].high, -0.25, 1e-9);
  EXPECT_NEAR(std::abs(std::sin(objects[1].base.yaw)), 1, 1e-9);  // ry = 0: along the camera's x
}

TEST_F(KittiScore, OfPerfectTracksIsOne) {
  std::string lines;
  std::vector<ResultFrame> results;
  for (int frame = 0; frame < 5; ++frame) {
    lines += car(frame, 1, 20 + frame, 3) + car(frame, 2, 15, -3);
    results.push_back({static_cast<std::size_t>(frame), {box(7, 20 + frame, 3), box(9, 15, -3)}});
  }
  const TrackScores scores = score(lines, results);
  EXPECT_EQ(scores.truths, 10U);
  EXPECT_DOUBLE_EQ(scores.mota, 1);
  EXPECT_NEAR(scores.motp, 1, 1e-9);
  EXPECT_NEAR(scores.hota, 1, 1e-9);
}

TEST_F(KittiScore, ASwitchAMissAndAWrongBoxCostOneEach) {
  std::string lines;
  for (int frame = 0; frame < 4; ++frame)
    lines += car(frame, 1, 20, 3);
  // frame 1 misses the car, frame 2 has another track, frame 3 has a second box that overlaps the car a
  // little
  const TrackScores scores = score(
      lines, {{0, {box(7, 20, 3)}}, {1, {}}, {2, {box(8, 20, 3)}}, {3, {box(8, 20, 3), box(9, 23, 3)}}});
  EXPECT_EQ(scores.truths, 4U);
  EXPECT_EQ(scores.misses, 1U);
  EXPECT_EQ(scores.switches, 1U);
  EXPECT_EQ(scores.wrong, 1U);
  EXPECT_EQ(scores.fragments, 1U);
  EXPECT_DOUBLE_EQ(scores.mota, 1 - 3.0 / 4);
  // Detection: 3 matches of 4 + 4 - 3. Association of the car with track 7: 1 / 4 once, with 8: 2 / 4 twice.
  const double detection = 3.0 / 5, association = (0.25 + 0.5 + 0.5) / 3;
  EXPECT_NEAR(scores.hota, std::sqrt(detection * association), 1e-9);
}

TEST_F(KittiScore, MotpIsTheMeanIou) {
  // shifted by 1 m along the length of 4 m: 3 / 5
  EXPECT_NEAR(score(car(0, 1, 20, 3), {{0, {box(7, 21, 3)}}}).motp, 0.6, 1e-9);
}

TEST_F(KittiScore, FramesWithoutALineAreMissed) {
  EXPECT_EQ(score(car(0, 1, 20, 3) + car(1, 1, 20, 3), {{0, {box(7, 20, 3)}}}).misses, 1U);
}

TEST_F(KittiScore, HiddenTruncatedAndOtherObjectsNeedNotBeFoundButMayBe) {
  const std::string lines = car(0, 1, 20, 3, "Car", 0, 3) + car(0, 2, 20, -3, "Car", 1, 0) +
                            car(0, 3, 30, 3, "Van") + car(0, 4, 30, -3);
  const KittiProtocol strict{{"Car"}, 0.3, true};
  const TrackScores missed = score(lines, {{0, {box(4, 30, -3)}}}, strict);
  EXPECT_EQ(missed.truths, 1U);
  EXPECT_EQ(missed.misses + missed.wrong, 0U);
  const TrackScores found =
      score(lines, {{0, {box(1, 20, 3), box(2, 20, -3), box(3, 30, 3), box(4, 30, -3)}}}, strict);
  EXPECT_EQ(found.truths, 1U);
  EXPECT_EQ(found.misses + found.wrong, 0U);
}

TEST_F(KittiScore, BoxesInDontCareOutsideTheImageAndFarAwayAreIgnored) {
  const KittiProtocol strict{{"Car"}, 0.3, true};
  const auto wrong = [&](const FoundBox& found, const std::string& more = "") {
    return score(car(0, 1, 20, 3) + more, {{0, {box(7, 20, 3), found}}}, strict).wrong;
  };
  EXPECT_EQ(wrong(box(8, 20, -3)), 1U);
  // At 20 m and 3 m to the right: pixel 620 + 700 * 3 / 20 = 725.
  EXPECT_EQ(wrong(box(8, 20, -3), "0 -1 DontCare -1 -1 -10 650 150 800 300 -1 -1 -1 -1000 -1000 -1000 -10\n"),
            0U);
  // The rectangle of the box ends at pixel 776, so a sixth of it is in this region.
  EXPECT_EQ(wrong(box(8, 20, -3), "0 -1 DontCare -1 -1 -10 760 150 900 300 -1 -1 -1 -1000 -1000 -1000 -10\n"),
            1U);
  EXPECT_EQ(wrong(box(8, 20, -3), "0 -1 DontCare -1 -1 -10 10 150 200 300 -1 -1 -1 -1000 -1000 -1000 -10\n"),
            1U);
  EXPECT_EQ(wrong(box(8, -20, 3)), 0U);                         // behind the camera
  EXPECT_EQ(wrong(box(8, 10, 12)), 0U);                         // to the left of the image
  EXPECT_EQ(wrong({8, {{60, 3}, 0, 4, 2}, -1.75, -0.25}), 0U);  // 18 pixels high
}

TEST_F(KittiScore, BoxesAwayFromLabelsAreIgnoredUnlessTheyAreToCount) {
  KittiProtocol protocol;
  const std::vector<ResultFrame> results{{0, {box(7, 20, 3), box(8, 20, -3)}}};
  EXPECT_EQ(score(car(0, 1, 20, 3), results, protocol).wrong, 0U);
  protocol.count_unlabelled = true;
  EXPECT_EQ(score(car(0, 1, 20, 3), results, protocol).wrong, 1U);
}

TEST_F(KittiScore, ErrorsNameTheFileTheLineAndTheReason) {
  const auto error_of = [&](const auto& run) {
    try {
      run();
    } catch (const std::exception& error) {
      return std::string(error.what());
    }
    return std::string("no error");
  };
  EXPECT_THAT(error_of([&] { labels(car(0, 1, 20, 3) + "1 2 Car 0 0\n"); }),
              HasSubstr("labels.txt: line 2: has 5 columns, not 17"));
  EXPECT_THAT(error_of([&] { labels("x" + car(0, 1, 20, 3)); }), HasSubstr("line 1: 'x0' is not a number"));
  EXPECT_THAT(error_of([&] { labels("-1" + car(0, 1, 20, 3)); }), HasSubstr("is not a frame number"));
  EXPECT_THAT(error_of([&] { KittiCalibration((folder_ / "none.txt").string()); }),
              HasSubstr("none.txt: cannot be read"));
  EXPECT_THAT(error_of([&] { KittiCalibration(write("short.txt", "P2: 1 2 3\n")); }),
              HasSubstr("short.txt: P2 does not have 12 numbers"));
  EXPECT_THAT(error_of([&] {
                score("", {{0, {box(7, 1, 1), box(7, 9, 9)}}});
              }),
              HasSubstr("frame 0 has track 7 twice"));
  EXPECT_THAT(error_of([&] { score("", {{0, {}}, {0, {}}}); }), HasSubstr("frame 0 has two lines"));
  EXPECT_THAT(error_of([&] {
                read_kitti_detections(write("d.txt", "0,7,1,2,3,4,0.5,1,1,1,0,0,9,0,0\n"), calibration());
              }),
              HasSubstr("d.txt: line 1: '7' is not one of the types 1, 2 and 3"));
}

TEST_F(KittiScore, LinesOfBvStreamAreRead) {
  const std::string path = write(
      "r.jsonl",
      R"({"seq":0,"file":"velodyne/000012.bin","clusters":[{"id":0,"track":5,"volumes":[)"
      R"({"shape":"aabb","method":"aabb","min":[1,2,3],"max":[5,4,6]},)"
      R"({"shape":"obb","method":"obb-yaw","center":[3,3,4.5],"axes":[[0,1,0],[-1,0,0],[0,0,1]],"half_extents":[2,1,1.5]}]},)"
      R"({"id":1,"track":null,"volumes":[]}]})"
      "\n"
      R"({"seq":1,"file":"velodyne/000013.bin","error":"dropped: queue"})"
      "\n");
  const std::vector<ResultFrame> aabb = read_result_lines(path, ""), yaw = read_result_lines(path, "obb-yaw");
  ASSERT_EQ(aabb.size(), 2U);
  EXPECT_EQ(aabb[0].number, 12U);
  EXPECT_TRUE(aabb[1].boxes.empty());
  ASSERT_EQ(aabb[0].boxes.size(), 1U);
  EXPECT_EQ(aabb[0].boxes[0].base.length, 4);
  EXPECT_EQ(yaw[0].boxes[0].base.width, 2);
  EXPECT_NEAR(yaw[0].boxes[0].base.yaw, std::acos(0), 1e-12);
  EXPECT_EQ(yaw[0].boxes[0].low, 3);
  EXPECT_THROW(read_result_lines(path, "sphere"), std::runtime_error);
  EXPECT_THROW(read_result_lines(write("bad.jsonl", "{\n"), ""), std::runtime_error);
}

}  // namespace
}  // namespace pcl_bv::bench
