// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Sinks that write files for each frame, namely pictures, labelled clouds, or meshes with an index.

#include <algorithm>
#include <cstring>
#include <utility>

#include "line_file.h"
#include "pcl_bv/io/atomic_file.h"
#include "pcl_bv/io/growing_file.h"
#include "pcl_bv/io/read_cloud.h"
#include "pcl_bv/report/meshes.h"
#include "pcl_bv/report/picture.h"
#include "sinks.h"

namespace pcl_bv::detail {
namespace {

namespace fs = std::filesystem;

const SinkOptions& with_created_folder(const SinkOptions& description) {
  create_folder(description.target);
  return description;
}

// Returns a file name such as frame000012.vtp.
std::string numbered(const char* stem, const Frame& frame, std::string_view extension) {
  std::string number = std::to_string(frame.header.number);
  number.insert(0, 6 - std::min<std::size_t>(number.size(), 6), '0');
  return stem + number + std::string(extension);
}

class FilesSink : public FrameSink {
 public:
  using Write = void (*)(const fs::path&, const Frame&, const FrameResult&);
  FilesSink(const SinkOptions& description, Write write_file)
      : description_(with_created_folder(description)),
        lock_(lock_folder(description.target)),
        write_(write_file) {}
  void write(const Frame& frame, const FrameResult& result) override {
    write_(description_.target / numbered("frame", frame, description_.kind->files), frame, result);
  }

 private:
  SinkOptions description_;
  std::shared_ptr<const FileDescriptor> lock_;
  Write write_;
};

void write_image(const fs::path& file, const Frame& frame, const FrameResult& result) {
  const std::vector<std::uint32_t> labels = labels_of(frame, result);
  write_picture(file, picture_of(frame, result, labels));
}

// Writes x, y and z in the scalar type of the points, and the label as a fourth field.
void write_labels(const fs::path& file, const Frame& frame, const FrameResult& result) {
  const PointView& points = result.cloud_of(frame);
  const std::vector<std::uint32_t> labels = labels_of(frame, result);
  const auto size = static_cast<std::uint32_t>(size_of(points.scalar));
  RawCloud cloud;
  cloud.fields = {{"x", 'F', size, 1, 0},
                  {"y", 'F', size, 1, size},
                  {"z", 'F', size, 1, std::size_t{2} * size},
                  {"label", 'U', 4, 1, std::size_t{3} * size}};
  cloud.point_step = std::size_t{3} * size + 4;
  cloud.width = points.count;
  cloud.data.resize(cloud.point_step * points.count);
  std::byte* to = cloud.data.data();
  for (std::size_t chunk = 0; chunk < chunk_count(points.count); ++chunk) {
    const LoadedPoints loaded = load_chunk(points, chunk);
    const PointView& part = loaded.view();
    for (std::size_t i = 0; i < part.count; ++i, to += cloud.point_step) {
      for (std::size_t axis = 0; axis < 3; ++axis)
        std::memcpy(to + axis * size, part.address(i) + axis * part.step(), size);
      std::memcpy(to + std::size_t{3} * size, &labels[part.index(i)], 4);
    }
  }
  write_pcd(file, cloud);
}

class VtpSink : public FrameSink {
 public:
  explicit VtpSink(const SinkOptions& description)
      : description_(with_created_folder(description)), index_(description.target / "frames.pvd") {}
  void write(const Frame& frame, const FrameResult& result) override {
    const bool tracked = result.config->track.enabled;
    std::string entries = add("frame", frame, volumes_vtp(cluster_entries(result), tracked), 0);
    if (description_.points)
      entries += add("points", frame, points_vtp(result.cloud_of(frame), labels_of(frame, result)), 1);
    append(entries);
  }
  void close() override {
    append("");
    index_.close();
  }

 private:
  void append(const std::string& entries) { index_.write(std::exchange(heading_, "") + entries, kPvdEnd); }

  std::string add(const char* stem, const Frame& frame, const std::string& content, int part) {
    const std::string name = numbered(stem, frame, description_.kind->files);
    write_file_atomically(description_.target / name, content);
    if (!first_stamp_ns_) first_stamp_ns_ = frame.header.stamp_ns;
    return pvd_entry({static_cast<double>(frame.header.stamp_ns - *first_stamp_ns_) / 1e9, name, part});
  }

  SinkOptions description_;
  LineFile index_;
  std::string heading_{kPvdBegin};
  std::optional<std::int64_t> first_stamp_ns_;
};

}  // namespace

std::unique_ptr<FrameSink> open_vtp(const SinkOptions& description) {
  return std::make_unique<VtpSink>(description);
}

std::unique_ptr<FrameSink> open_image(const SinkOptions& description) {
  return std::make_unique<FilesSink>(description, write_image);
}

std::unique_ptr<FrameSink> open_labels(const SinkOptions& description) {
  return std::make_unique<FilesSink>(description, write_labels);
}

}  // namespace pcl_bv::detail
