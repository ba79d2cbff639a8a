// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// A file per frame: pictures, labelled clouds, and meshes with an index.

#include <algorithm>
#include <cstring>

#include "frame_report.h"
#include "line_file.h"
#include "pcl_bv/io/atomic_file.h"
#include "pcl_bv/io/pcd.h"
#include "pcl_bv/nodes/labels.h"
#include "pcl_bv/report/meshes.h"
#include "pcl_bv/report/picture.h"
#include "sinks.h"

namespace pcl_bv {

FrameFiles::FrameFiles(const SinkDescription& description)
    : folder_(description.place), extension_(description.kind->files) {
  std::error_code failure;
  std::filesystem::create_directories(folder_, failure);
  if (!std::filesystem::is_directory(folder_)) throw IoError("cannot be made a folder");
}

std::string FrameFiles::name(const FrameHeader& header, std::string_view stem) const {
  std::string number = std::to_string(header.number);
  number.insert(0, 6 - std::min<std::size_t>(number.size(), 6), '0');
  return std::string(stem) + number + std::string(extension_);
}

namespace {

class VtpSink : public FrameSink {
 public:
  explicit VtpSink(const SinkDescription& description)
      : files_(description), points_(description.points), index_(files_.path("frames.pvd")) {
    index_.write(std::string(pvd_begin), pvd_end);
  }
  void write(const Frame& frame, const FrameResult& result) override {
    const std::string name = files_.name(frame.header);
    std::vector<ClusterEntry> clusters;
    for (TrackedEntry& entry : to_report(frame, result).clusters)
      clusters.push_back(std::move(entry.cluster));
    write_file_atomically(files_.path(name), volumes_vtp(clusters, result.tracks));
    if (first_) first_stamp_ns_ = frame.header.stamp_ns;
    first_ = false;
    const double seconds = 1e-9 * static_cast<double>(frame.header.stamp_ns - first_stamp_ns_);
    std::string entries = pvd_entry({seconds, name});
    if (points_) {
      const std::string points = files_.name(frame.header, "points");
      write_file_atomically(files_.path(points), points_vtp(frame.points, labels_of(frame, result)));
      entries += pvd_entry({seconds, points, 1});
    }
    index_.write(std::move(entries), pvd_end);
  }
  void close() override { index_.close(); }

 private:
  FrameFiles files_;
  bool points_, first_ = true;
  std::int64_t first_stamp_ns_ = 0;
  LineFile index_;
};

class ImageSink : public FrameSink {
 public:
  explicit ImageSink(const SinkDescription& description) : files_(description) {}
  void write(const Frame& frame, const FrameResult& result) override {
    const std::vector<std::uint32_t> labels = labels_of(frame, result);
    Picture picture;
    picture.points = frame.points;
    picture.labels = labels.data();
    for (std::size_t i = 0; i < result.volumes.size(); ++i)
      picture.volumes.push_back({result.volumes[i], static_cast<std::uint32_t>(i / result.methods.size())});
    write_picture(files_.path(frame.header), picture);
  }

 private:
  FrameFiles files_;
};

class LabelsSink : public FrameSink {
 public:
  explicit LabelsSink(const SinkDescription& description) : files_(description) {}
  void write(const Frame& frame, const FrameResult& result) override {
    write_pcd(files_.path(frame.header), labelled(frame.points, labels_of(frame, result)));
  }

 private:
  // x, y and z in their own type, and the label.
  static RawCloud labelled(const PointView& points, const std::vector<std::uint32_t>& labels) {
    RawCloud cloud;
    const std::size_t size = size_of(points.scalar);
    for (const char* axis : {"x", "y", "z"}) {
      cloud.fields.push_back({axis, 'F', static_cast<std::uint32_t>(size), 1, cloud.point_step});
      cloud.point_step += size;
    }
    cloud.fields.push_back({"label", 'U', 4, 1, cloud.point_step});
    cloud.point_step += 4;
    cloud.width = points.count;
    cloud.data.resize(cloud.point_step * points.count);
    for (std::size_t i = 0; i < points.count; ++i) {
      std::byte* to = cloud.data.data() + i * cloud.point_step;
      const std::byte* from = points.address(i);
      for (std::size_t axis = 0; axis < 3; ++axis)
        std::memcpy(to + axis * size, from + axis * points.step(), size);
      std::memcpy(to + 3 * size, &labels[points.index(i)], 4);
    }
    return cloud;
  }

  FrameFiles files_;
};

}  // namespace

std::unique_ptr<FrameSink> open_vtp(const SinkDescription& description) {
  return std::make_unique<VtpSink>(description);
}

std::unique_ptr<FrameSink> open_image(const SinkDescription& description) {
  return std::make_unique<ImageSink>(description);
}

std::unique_ptr<FrameSink> open_labels(const SinkDescription& description) {
  return std::make_unique<LabelsSink>(description);
}

}  // namespace pcl_bv
