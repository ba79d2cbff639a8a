// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "cloud_decoder.h"

#include <draco/compression/point_cloud/point_cloud_kd_tree_decoder.h>
#include <draco/compression/point_cloud/point_cloud_sequential_decoder.h>

#include <string>
#include <type_traits>

#include "pcl_bv/messages/serialize.h"

namespace pcl_bv::draco_module {
namespace {

constexpr int kMinVersion = 0x203;  // 2.3, of Draco 1.1 and later; the decoders of older ones check less

[[noreturn]] void refuse(const std::string& what) {
  throw MessageError("the cloud of Draco " + what);
}

// Returns whether the number of points that the k-d tree announces for itself is that of the cloud.
// Draco 1.5.5 would decode as many points as the tree announces before it compares the two. The numbers come
// after the compression level: the bits of a coordinate and the points.
bool tree_has(std::uint32_t points, const draco::DecoderBuffer& at) {
  draco::DecoderBuffer ahead(at);
  std::uint8_t level = 0;
  std::uint32_t bits = 0, tree_points = 0;
  return ahead.Decode(&level) && ahead.Decode(&bits) && ahead.Decode(&tree_points) && tree_points == points;
}

// One of Draco's decoders that checks what it has read before it decodes the values. Base's functions read in
// this order: the number of points, the descriptions of the attributes, the values.
template <class Base>
class CheckedDecoder final : public Base {
 public:
  explicit CheckedDecoder(const CloudLimits& limits) : limits_(limits) {}

 private:
  static constexpr bool kTree = std::is_same_v<Base, draco::PointCloudKdTreeDecoder>;

  bool DecodeGeometryData() override {
    if (!Base::DecodeGeometryData()) return false;
    if (this->bitstream_version() < kMinVersion) refuse("has a bitstream before 2.3");
    const std::uint32_t points = this->point_cloud()->num_points();
    if (points > limits_.max_points)
      refuse("has " + std::to_string(points) + " points; " + std::to_string(limits_.max_points) +
             " are allowed");
    return true;
  }

  bool DecodeAllAttributes() override {
    const draco::PointCloud& cloud = *this->point_cloud();
    const auto attributes = static_cast<std::size_t>(cloud.num_attributes());
    if (attributes != limits_.attribute_bytes.size())
      refuse("has " + std::to_string(attributes) + " attributes for " +
             std::to_string(limits_.attribute_bytes.size()) + " fields");
    for (std::size_t i = 0; i < attributes; ++i) {
      const draco::PointAttribute& attribute = *cloud.attribute(static_cast<int>(i));
      const std::size_t bytes = static_cast<std::size_t>(draco::DataTypeLength(attribute.data_type())) *
                                static_cast<std::size_t>(attribute.num_components());
      if (bytes != limits_.attribute_bytes[i])
        refuse("has an attribute of " + std::to_string(bytes) + " bytes for a field of " +
               std::to_string(limits_.attribute_bytes[i]));
    }
    if (kTree && (this->num_attributes_decoders() != 1 || !tree_has(cloud.num_points(), *this->buffer())))
      refuse("has a tree of other points");
    return Base::DecodeAllAttributes();
  }

  const CloudLimits& limits_;
};

template <class Base>
draco::Status decode(const CloudLimits& limits, draco::DecoderBuffer& buffer, draco::PointCloud& cloud) {
  const draco::DecoderOptions options;
  return CheckedDecoder<Base>(limits).Decode(options, &buffer, &cloud);
}

}  // namespace

void decode_cloud(const std::byte* data, std::size_t size, const CloudLimits& limits,
                  draco::PointCloud& cloud) {
  draco::DecoderBuffer buffer;
  buffer.Init(reinterpret_cast<const char*>(data), size);
  draco::DecoderBuffer ahead(buffer);
  draco::DracoHeader header;
  draco::Status status = draco::PointCloudDecoder::DecodeHeader(&ahead, &header);
  if (status.ok()) {
    if (header.encoder_type != draco::POINT_CLOUD) refuse("is no point cloud");
    if (header.encoder_method == draco::POINT_CLOUD_SEQUENTIAL_ENCODING) {
      status = decode<draco::PointCloudSequentialDecoder>(limits, buffer, cloud);
    } else if (header.encoder_method == draco::POINT_CLOUD_KD_TREE_ENCODING) {
      status = decode<draco::PointCloudKdTreeDecoder>(limits, buffer, cloud);
    } else {
      refuse("has the unknown encoding " + std::to_string(header.encoder_method));
    }
  }
  if (!status.ok()) refuse("cannot be decoded: " + status.error_msg_string());
}

}  // namespace pcl_bv::draco_module
