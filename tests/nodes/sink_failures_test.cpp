// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Sinks whose disk is full, and sinks of one file.

#include <gmock/gmock.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "file_size_limit.h"
#include "folder.h"
#include "pcl_bv/nodes/frame_pipeline.h"
#include "pcl_bv/nodes/frame_result.h"
#include "pcl_bv/nodes/frame_sink.h"
#include "pcl_bv/recording/recording.h"
#include "pcl_bv/report/meshes.h"

namespace pcl_bv::detail {
namespace {

using testing::EndsWith;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

// A frame with so many clusters of three points each.
struct ManyClusters {
  explicit ManyClusters(std::size_t clusters) {
    for (std::size_t i = 0; i < 3 * clusters; ++i) {
      const auto corner = static_cast<float>(10 * (i / 3));
      xyz.insert(xyz.end(), {corner + (i % 3 == 1 ? 0.25F : 0), i % 3 == 2 ? 0.125F : 0, 1});
    }
    frame.points = PointView::of(xyz.data(), 12, 3 * clusters);
    PipelineConfig config = whole_cloud_config();
    config.cluster.tolerance = 0.5;
    config.cluster.min_size = 1;
    FramePipeline(config).process(frame, result);
    EXPECT_EQ(result.clusters.size(), clusters);
  }
  std::vector<float> xyz;
  Frame frame;
  FrameResult result;
};

class SinkFailures : public Folder {
 protected:
  std::string at(const std::string& name) const { return (path_ / name).string(); }

  // Writes up to 100 frames, until a file becomes larger than the limit. Returns the number of frames that
  // were written.
  static int fill(const std::string& sink, rlim_t bytes, std::size_t clusters = 40) {
    ManyClusters many(clusters);
    const auto opened = make_sink(parse_sink(sink));
    const test::FileSizeLimit limit(bytes);
    int written = 0;
    try {
      for (; written < 100; ++written) {
        many.frame.header.number = static_cast<std::uint64_t>(written);
        opened->write(many.frame, many.result);
      }
    } catch (const IoError&) {
    }
    try {
      opened->close();  // as SinkGroup does
    } catch (const IoError&) {
    }
    return written;
  }
};

TEST_F(SinkFailures, LinesAreWholeWhenTheDiskIsFull) {
  for (const std::string kind : {"jsonl", "csv", "kitti"}) {
    const int frames = fill(kind + ":" + at("whole"), RLIM_INFINITY);
    const std::string whole = read("whole");
    const std::string one = whole.substr(0, whole.size() / static_cast<std::size_t>(frames));
    fill(kind + ":" + at("cut"), 5 * one.size() / 2);
    const std::string cut = read("cut");
    EXPECT_THAT(cut, EndsWith("\n")) << kind;
    EXPECT_GT(cut.size(), one.size()) << kind;
    EXPECT_LT(cut.size(), 5 * one.size() / 2 + 1) << kind;
    EXPECT_TRUE(whole.starts_with(cut) || kind == "jsonl") << kind;  // with times in each line
    const std::ptrdiff_t lines = std::count(cut.begin(), cut.end(), '\n');
    EXPECT_EQ((lines - (kind == "csv")) % (kind == "jsonl" ? 1 : 40), 0) << kind << ": a frame is whole, too";
    fill(kind + ":" + at("none"), 10);
    EXPECT_EQ(read("none"), "") << kind;
  }
}

TEST_F(SinkFailures, AnIndexIsWholeWhenTheDiskIsFull) {
  // The mesh of a frame is larger than its entry in the index, so only many frames fill the index.
  const int frames = fill("vtp:" + at("v"), 6'000, 2);
  const std::string index = read("v/frames.pvd");
  EXPECT_THAT(index, StartsWith(std::string(kPvdBegin)));
  EXPECT_THAT(index, EndsWith(std::string(kPvdEnd)));
  EXPECT_GT(frames, 10);
  EXPECT_LT(frames, 100);
  EXPECT_THAT(index, HasSubstr("frame0000" + std::to_string(frames - 1) + ".vtp"));
  EXPECT_THAT(index, Not(HasSubstr("frame0000" + std::to_string(frames) + ".vtp")));
}

TEST_F(SinkFailures, ARecordingIsReadableWhenTheDiskIsFull) {
  for (const auto& [kind, file] :
       {std::pair<std::string, std::string>{"mcap", "whole"}, {"rosbag2", "whole/whole_0.db3"}}) {
    fill(kind + ":" + at("whole"), RLIM_INFINITY, 200);
    const rlim_t half = std::filesystem::file_size(at(file)) / 2;
    EXPECT_LT(fill(kind + ":" + at(kind), half, 200), 100) << kind;
    const auto reader = open_recording(at(kind));
    std::size_t messages = 0;
    RecordedMessage message;
    while (reader->next(message))
      ++messages;
    EXPECT_TRUE(messages > 0 || kind == "rosbag2");  // whose first transaction may not have fitted
    std::filesystem::remove_all(at("whole"));
  }
}

std::string refusal(const std::string& sink) {
  try {
    make_sink(parse_sink(sink));
  } catch (const IoError& error) {
    return error.what();
  }
  return "";
}

TEST_F(SinkFailures, AFileHasOneSinkAtATime) {
  const ManyClusters found(2);
  const std::vector<std::string> kinds = {"jsonl:", "csv:", "kitti:", "mcap:"};
  for (const std::string& kind : kinds) {
    const auto first = make_sink(parse_sink(kind + at("a")));
    first->write(found.frame, found.result);
    const std::string before = read("a");
    std::filesystem::remove(at("hard"));
    std::filesystem::create_hard_link(at("a"), at("hard"));
    for (const std::string& other : kinds) {
      EXPECT_THAT(refusal(other + at("a")), HasSubstr("locked")) << kind << other;
      EXPECT_THAT(refusal(other + at("hard")), HasSubstr("locked")) << kind << other;
    }
    EXPECT_EQ(read("a"), before) << kind;
    first->close();
    EXPECT_EQ(refusal("jsonl:" + at("a")), "") << kind;
  }
  const auto index = make_sink(parse_sink("vtp:" + at("v")));
  EXPECT_THAT(refusal("vtp:" + at("v")), HasSubstr("locked"));
}

}  // namespace
}  // namespace pcl_bv::detail
