// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The programs label_scores and association_scores: what they print, and that wrong use and bad files give
// one line.

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <vector>

#include "temporary_folder.h"

namespace pcl_bv::bench {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

struct Ran {
  int status = -1;
  std::string text;  // of both streams
};

Ran run(const std::string& command) {
  FILE* const pipe = popen((PCL_BV_BIN_DIR "/" + command + " 2>&1").c_str(), "r");
  Ran ran;
  std::array<char, 4096> buffer;
  for (std::size_t n; (n = std::fread(buffer.data(), 1, buffer.size(), pipe)) > 0;)
    ran.text.append(buffer.data(), n);
  ran.status = WEXITSTATUS(pclose(pipe));
  return ran;
}

class LabelScores : public testing::Test {
 protected:
  std::string write(const std::string& name, const std::string& bytes) const {
    const std::filesystem::path path = folder_ / name;
    std::filesystem::create_directories(path.parent_path());
    std::ofstream(path, std::ios::binary) << bytes;
    return path.string();
  }

  static std::string words(const std::vector<std::uint32_t>& labels) {
    std::string bytes(4 * labels.size(), 0);
    std::memcpy(bytes.data(), labels.data(), bytes.size());
    return bytes;
  }

  const test::TemporaryFolder folder_;
};

TEST_F(LabelScores, OfPerfectKittiTracksAreOneHundred) {
  const std::string calibration = write("calib.txt",
                                        "P2: 700 0 620 0 0 700 190 0 0 0 1 0\nR_rect 1 0 0 0 1 0 0 0 1\n"
                                        "Tr_velo_cam 0 -1 0 0 0 0 -1 0 1 0 0 0\n");
  const std::string labels =
      write("labels.txt", "0 4 Car 0 0 0 0 0 100 100 1.5 2 4 -3 1.75 20 -1.5707963267948966\n");
  const std::string results = write(
      "r.jsonl",
      R"({"seq":0,"clusters":[{"track":1,"volumes":[{"shape":"aabb","method":"aabb","min":[18,2,-1.75],"max":[22,4,-0.25]}]}]})"
      "\n");
  const Ran ran = run("label_scores kitti " + results + ' ' + labels + ' ' + calibration);
  EXPECT_EQ(ran.status, 0) << ran.text;
  EXPECT_THAT(ran.text, HasSubstr("bird's-eye IoU >= 0.3"));
  EXPECT_THAT(ran.text, HasSubstr("| 100.00 | 100.00 | 100.00 | 100.00 | 100.00 | 0 | 0 | 1 | 0 | 0 |"));
  const Ran short_file =
      run("label_scores kitti " + results + ' ' + write("l.txt", "0 1\n") + ' ' + calibration);
  EXPECT_EQ(short_file.status, 1);
  EXPECT_THAT(short_file.text, HasSubstr("l.txt: line 1: has 2 columns, not 17\n"));
}

TEST_F(LabelScores, OfSemanticKittiCompareFilesOfOneNumber) {
  // road, road, car x 2: all found right, but the car has too few points to be a segment
  write("found/frame000003.pcd",
        "VERSION .7\nFIELDS x y z label\nSIZE 4 4 4 4\nTYPE F F F U\nCOUNT 1 1 1 1\nWIDTH 4\nHEIGHT "
        "1\nPOINTS 4\n"
        "DATA ascii\n1 0 -1.7 4294967294\n2 0 -1.7 4294967294\n3 0 -1 0\n3 0 -0.5 0\n");
  write("labels/000003.label", words({40, 40, 10, 10}));
  write("labels/000004.label", words({40}));
  const std::string folders = (folder_ / "found").string() + ' ' + (folder_ / "labels").string();
  const Ran ran = run("label_scores semantic-kitti " + folders);
  EXPECT_EQ(ran.status, 0) << ran.text;
  EXPECT_THAT(ran.text, HasSubstr("over 1 sweeps"));
  EXPECT_THAT(ran.text,
              HasSubstr("| vegetation is not counted | 100.00 / 0.00 | 100.00 / 0.00 | 100.00 / 0.00 |"));
  EXPECT_THAT(ran.text, HasSubstr("| 0.00 / 0.00 | 0.00 / 0.00 |"));
  write("labels/000003.label", words({40, 40, 10}));
  const Ran shorter = run("label_scores semantic-kitti " + folders);
  EXPECT_EQ(shorter.status, 1);
  EXPECT_THAT(shorter.text, HasSubstr("000003.label: has 3 labels, but "));
  std::filesystem::remove(folder_ / "labels/000003.label");
  EXPECT_THAT(run("label_scores semantic-kitti " + folders).text, HasSubstr("has no .label of this number"));
}

TEST_F(LabelScores, WrongUseIsOneLineAndStatusTwo) {
  for (const char* arguments :
       {"label_scores", "label_scores coco", "label_scores kitti a b", "label_scores kitti a b c --min-iou 2",
        "label_scores kitti a b c --min-iou", "label_scores kitti --fast", "label_scores semantic-kitti a",
        "association_scores coco", "association_scores synth many", "association_scores kitti a"}) {
    const Ran ran = run(arguments);
    EXPECT_EQ(ran.status, 2) << arguments;
    EXPECT_EQ(std::count(ran.text.begin(), ran.text.end(), '\n'), 1) << ran.text;
  }
  EXPECT_EQ(run("label_scores --help").status, 0);
}

TEST_F(LabelScores, FilesThatCannotBeReadAreOneLineAndStatusOne) {
  for (const char* arguments : {"label_scores kitti none none none", "label_scores semantic-kitti none none",
                                "association_scores kitti none none none"}) {
    const Ran ran = run(arguments);
    EXPECT_EQ(ran.status, 1) << arguments;
    EXPECT_EQ(std::count(ran.text.begin(), ran.text.end(), '\n'), 1) << ran.text;
    EXPECT_THAT(ran.text, HasSubstr("none: ")) << arguments;
  }
}

TEST_F(LabelScores, AssociationAloneIsScoredForBothTrackers) {
  const Ran ran = run("association_scores synth 1 20");
  EXPECT_EQ(ran.status, 0) << ran.text;
  EXPECT_THAT(ran.text, StartsWith("Detections of cars, synth:rural-road-sequence, 1 seeds of 20 frames\n"));
  for (const char* row : {"| pcl_bv, death 5, poses |", "| as AB3DMOT, death 2, no poses |"})
    EXPECT_THAT(ran.text, HasSubstr(row));
}

}  // namespace
}  // namespace pcl_bv::bench
