// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include "pcl_bv/io/raw_cloud.h"
#include "pcl_bv/recording/recording.h"
#include "recording_files.h"

namespace pcl_bv::detail {
namespace {

std::string error_of(const std::filesystem::path& file) {
  try {
    open_recording(file);
  } catch (const IoError& error) {
    return error.what();
  }
  return "no error";
}

TEST(OpenRecording, SaysWhatIsNoRecording) {
  EXPECT_EQ(error_of("/no/such/file"), "no such file or folder");
  EXPECT_THAT(error_of("/dev/null"), testing::StartsWith("unknown recording format; known are: "));
  EXPECT_FALSE(is_recording("/no/such/file"));
  EXPECT_FALSE(is_recording("/"));
}

class OpenRecordingFiles : public RecordingFiles {};

TEST_F(OpenRecordingFiles, DoesNotWaitForAPipe) {
  ASSERT_EQ(::mkfifo(at("pipe").c_str(), 0600), 0);
  EXPECT_FALSE(is_recording(at("pipe")));
  EXPECT_THAT(error_of(at("pipe")), testing::StartsWith("unknown recording format"));
}

}  // namespace
}  // namespace pcl_bv::detail
