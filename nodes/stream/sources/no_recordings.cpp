// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Used instead of recorded.cpp, recorded_clouds.cpp, packets.cpp, compressed_cloud.cpp and recording_sink.cpp
// in builds without the component `recording`.

#include "compressed_cloud.h"
#include "pcl_bv/io/raw_cloud.h"
#include "pcl_bv/messages/serialize.h"
#include "recorded_clouds.h"
#include "sources.h"
#include "stream/rig/transform_feed.h"
#include "stream/sinks/sinks.h"

namespace pcl_bv::detail {

std::vector<SourceKind> recording_kinds() {
  return {};
}

std::vector<SinkKind> recording_sinks() {
  return {};
}

std::vector<std::string> recorded_cloud_topics(const std::string&) {
  return {};
}

std::unique_ptr<TransformFeed> recorded_transforms(const std::string&, const std::string&) {
  return nullptr;
}

std::vector<std::string> recorded_odometry_topics(const std::string&) {
  return {};
}

DecompressedCloud decompress(const msg::CompressedPointCloud2& /*message*/) {
  throw MessageError("the cloud is compressed: this build lacks the component recording, which decompresses");
}

bool has_recorded_clouds(const std::filesystem::path& /*file*/) {
  return false;
}

// Without recordings nobody has an object of this class: its constructor throws.
struct RecordedClouds::State {};

RecordedClouds::RecordedClouds(const std::filesystem::path& /*file*/, const std::string& /*topic*/) {
  throw IoError("cannot be read: this build lacks the component recording");
}

RecordedClouds::~RecordedClouds() = default;

std::size_t RecordedClouds::count() {
  return 0;
}

RawCloud RecordedClouds::load(std::size_t /*number*/) {
  return {};
}

std::string RecordedClouds::new_note(std::size_t /*number*/) const {
  return {};
}

std::vector<std::string> RecordedClouds::take_warnings() {
  return {};
}

void check_recording_content(const std::filesystem::path& file) {
  if (has_recording_extension(file))
    throw IoError("is a recording, which this build cannot read: it lacks the component recording");
}

}  // namespace pcl_bv::detail
