// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "rig_recording.h"

#include <Eigen/Geometry>
#include <cmath>
#include <cstring>
#include <vector>

#include "pcl_bv/io/atomic_file.h"
#include "pcl_bv/io/raw_cloud.h"
#include "pcl_bv/messages/schema.h"
#include "pcl_bv/messages/serialize.h"
#include "pcl_bv/recording/mcap_writer.h"

namespace pcl_bv::detail {
namespace {

constexpr std::int64_t kStart = 1'700'000'000'000'000'000;
constexpr double kPosePeriod = 0.01;
constexpr std::array<const char*, kRigSensors> kTopics{"/front/points", "/rear/points"};

std::int64_t stamp_at(double seconds) {
  return kStart + std::llround(1e9 * seconds);
}

msg::TransformStamped transform_of(const char* parent, const char* child, double seconds,
                                   const RigPose& pose) {
  const Eigen::Matrix<double, 3, 4, Eigen::RowMajor> rows =
      Eigen::Map<const Eigen::Matrix<double, 3, 4, Eigen::RowMajor>>(pose.data());
  const Eigen::Quaterniond q(Eigen::Matrix3d(rows.leftCols<3>()));
  msg::TransformStamped step;
  step.header = {msg::time_of(stamp_at(seconds)), parent};
  step.child_frame_id = child;
  step.transform = {{rows(0, 3), rows(1, 3), rows(2, 3)}, {q.x(), q.y(), q.z(), q.w()}};
  return step;
}

// A record as drivers write it: x, y, z, intensity, ring, t.
#pragma pack(push, 1)
struct Record {
  float x, y, z, intensity;
  std::uint16_t ring;
  std::uint32_t t;
};
#pragma pack(pop)

std::vector<Record> records_of(const RigSweep& sweep) {
  std::vector<Record> records(sweep.ring.size());
  for (std::size_t i = 0; i < records.size(); ++i) {
    const float intensity =
        sweep.object[i] == 0 ? 10.F : 20.F + static_cast<float>(sweep.object[i] % 8) * 10.F;
    records[i] = {sweep.xyz[3 * i], sweep.xyz[3 * i + 1], sweep.xyz[3 * i + 2],
                  intensity,        sweep.ring[i],        sweep.time_ns[i]};
  }
  return records;
}

msg::PointCloud2 cloud_of(const std::vector<Record>& records, const RigSweep& sweep, std::size_t sensor) {
  using Field = msg::PointField;
  msg::PointCloud2 cloud;
  cloud.header = {msg::time_of(stamp_at(sweep.seconds)), kRigFrames.at(sensor)};
  cloud.width = static_cast<std::uint32_t>(records.size());
  cloud.point_step = sizeof(Record);
  cloud.row_step = cloud.point_step * cloud.width;
  cloud.fields = {{"x", 0, Field::FLOAT32, 1},    {"y", 4, Field::FLOAT32, 1},
                  {"z", 8, Field::FLOAT32, 1},    {"intensity", 12, Field::FLOAT32, 1},
                  {"ring", 16, Field::UINT16, 1}, {"t", 18, Field::UINT32, 1}};
  cloud.data = {reinterpret_cast<const std::byte*>(records.data()), records.size() * sizeof(Record)};
  return cloud;
}

class Recorder {
 public:
  explicit Recorder(const std::filesystem::path& file) : writer_(file) {
    const auto add = [&](const char* name, const char* type) {
      return writer_.add_topic({name, type, schema_of(type), {}});
    };
    fixed_ = add("/tf_static", msg::TFMessage::ros_type);
    moving_ = add("/tf", msg::TFMessage::ros_type);
    for (std::size_t sensor = 0; sensor < kRigSensors; ++sensor)
      clouds_.at(sensor) = add(kTopics.at(sensor), msg::PointCloud2::ros_type);
  }

  void write_mountings() {
    msg::TFMessage message;
    for (std::size_t sensor = 0; sensor < kRigSensors; ++sensor)
      message.transforms.push_back(
          transform_of("base_link", kRigFrames.at(sensor), 0, RigDrive::mounting(sensor)));
    write(fixed_, 0, message);
  }

  // Writes the poses of the robot up to this time.
  void write_poses(const RigDrive& drive, double until) {
    for (; next_pose_ <= until; next_pose_ += kPosePeriod)
      write(moving_, next_pose_,
            msg::TFMessage{{transform_of("odom", "base_link", next_pose_, drive.pose(next_pose_))}});
  }

  void write_sweep(const RigDrive& drive, std::size_t sensor, std::size_t number) {
    const RigSweep sweep = drive.sweep(sensor, number);
    const std::vector<Record> records = records_of(sweep);
    const double end = sweep.seconds + kRigSweepSeconds;
    write_poses(drive, end);
    write(clouds_.at(sensor), end, cloud_of(records, sweep, sensor));
  }

  void close() { writer_.close(); }

 private:
  template <class Message>
  void write(std::size_t topic, double seconds, const Message& message) {
    bytes_.clear();
    write_cdr(message, bytes_);
    const std::int64_t time = stamp_at(seconds);
    writer_.write(topic, time, time, bytes_.data(), bytes_.size());
  }

  McapWriter writer_;
  std::size_t fixed_ = 0, moving_ = 0;
  std::array<std::size_t, kRigSensors> clouds_{};
  double next_pose_ = 0;
  std::vector<std::byte> bytes_;
};

}  // namespace

void write_rig_recording(const RigSequence& spec, const std::filesystem::path& file) {
  RigDriveOptions options;
  options.seed = spec.seed;
  const RigDrive drive(options);
  replace_file_atomically(file, [&](const std::filesystem::path& unfinished) {
    Recorder recorder(unfinished);
    recorder.write_mountings();
    for (std::size_t number = 0; number < spec.frames; ++number)
      for (std::size_t sensor = 0; sensor < kRigSensors; ++sensor)
        recorder.write_sweep(drive, sensor, number);
    recorder.write_poses(drive, kRigSweepSeconds * static_cast<double>(spec.frames) + 0.5);
    recorder.close();
  });
}

}  // namespace pcl_bv::detail
