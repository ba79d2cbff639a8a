// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Messages as bytes, written field by field from the rules of their encodings (OMG DDSI-RTPS 2.3, section 10:
// plain CDR; wiki.ros.org: ROS 1), without the writer that is tested.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

namespace pcl_bv::test {

enum class Encoding : std::uint8_t { cdr, big_endian_cdr, ros1 };

class MessageBytes {
 public:
  explicit MessageBytes(Encoding encoding) : encoding_(encoding) {
    if (encoding == Encoding::ros1) return;
    bytes_ = {std::byte{0}, encoding == Encoding::cdr ? std::byte{1} : std::byte{0}, std::byte{0},
              std::byte{0}};
  }

  /// Numbers are aligned to their size in CDR, counted from the end of its header of 4 bytes.
  template <class T>
  MessageBytes& number(T value) {
    if (encoding_ != Encoding::ros1)
      while ((bytes_.size() - 4) % sizeof(T) != 0)
        bytes_.push_back(std::byte{0xee});
    std::byte raw[sizeof(T)];
    std::memcpy(raw, &value, sizeof(T));
    if (encoding_ == Encoding::big_endian_cdr) std::reverse(raw, raw + sizeof(T));
    bytes_.insert(bytes_.end(), raw, raw + sizeof(T));
    return *this;
  }
  MessageBytes& text(const std::string& characters) {
    const bool null = encoding_ != Encoding::ros1;
    number(static_cast<std::uint32_t>(characters.size() + null));
    for (const char c : characters)
      number(static_cast<std::uint8_t>(c));
    return null ? number(std::uint8_t{0}) : *this;
  }
  MessageBytes& blob(const std::vector<std::byte>& bytes) {
    number(static_cast<std::uint32_t>(bytes.size()));
    bytes_.insert(bytes_.end(), bytes.begin(), bytes.end());
    return *this;
  }
  MessageBytes& header(std::int32_t seconds, std::uint32_t nanoseconds, const std::string& frame) {
    if (encoding_ == Encoding::ros1) number(std::uint32_t{9});  // seq
    return number(seconds).number(nanoseconds).text(frame);
  }

  const std::vector<std::byte>& bytes() const { return bytes_; }

 private:
  Encoding encoding_;
  std::vector<std::byte> bytes_;
};

/// The i-th point of a Livox message of this file.
struct LivoxPoint {
  explicit LivoxPoint(std::uint32_t i)
      : offset_time(1000 * i + 7),
        x(static_cast<float>(i) + 0.1F),
        y(-static_cast<float>(i)),
        z(0.5F),
        reflectivity(static_cast<std::uint8_t>(255 - i % 256)),
        tag(static_cast<std::uint8_t>(16 + i % 3)),
        line(static_cast<std::uint8_t>(i % 4)) {}
  std::uint32_t offset_time;
  float x, y, z;
  std::uint8_t reflectivity, tag, line;
};

/// livox_ros_driver2/msg/CustomMsg of LivoxPoint 0, 1, ..., stamp 5.000000006 s.
inline std::vector<std::byte> livox_message(Encoding encoding, std::uint32_t points,
                                            const std::string& frame = "livox_frame") {
  MessageBytes message(encoding);
  message.header(5, 6, frame).number(std::uint64_t{5'000'000'006}).number(points);
  for (const int byte : {192, 1, 2, 3})  // lidar_id, rsvd
    message.number(static_cast<std::uint8_t>(byte));
  message.number(points);
  for (std::uint32_t i = 0; i < points; ++i) {
    const LivoxPoint p(i);
    message.number(p.offset_time).number(p.x).number(p.y).number(p.z);
    message.number(p.reflectivity).number(p.tag).number(p.line);
  }
  return message.bytes();
}

/// sensor_msgs/PointField with a count of 1.
struct CloudField {
  std::string name;
  std::uint32_t offset;
  std::uint8_t datatype;
};

/// The description of a compressed cloud. `format` is left out in ROS 1.
struct CompressedCloud {
  std::uint32_t height = 1, width = 0, point_step = 16, row_step = 0;
  std::string format;
  std::vector<CloudField> fields{{"x", 0, 7}, {"y", 4, 7}, {"z", 8, 7}, {"intensity", 12, 7}};
};

/// CompressedPointCloud2 with the stamp 5.000000006 s in the frame lidar.
inline std::vector<std::byte> compressed_message(Encoding encoding, const CompressedCloud& cloud,
                                                 const std::vector<std::byte>& compressed) {
  MessageBytes message(encoding);
  message.header(5, 6, "lidar").number(cloud.height).number(cloud.width);
  message.number(static_cast<std::uint32_t>(cloud.fields.size()));
  for (const CloudField& field : cloud.fields)
    message.text(field.name).number(field.offset).number(field.datatype).number(std::uint32_t{1});
  message.number(std::uint8_t{0}).number(cloud.point_step).number(cloud.row_step).blob(compressed);
  message.number(std::uint8_t{1});
  if (encoding != Encoding::ros1) message.text(cloud.format);
  return message.bytes();
}

}  // namespace pcl_bv::test
