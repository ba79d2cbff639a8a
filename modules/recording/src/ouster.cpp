// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The family of Ouster sensors.

#include <cstring>
#include <map>

#include "ouster_metadata_files.h"
#include "ouster_sensor.h"
#include "sensor_family.h"

namespace pcl_bv::detail {
namespace {

constexpr std::size_t kOusterBeams[] = {16, 32, 64, 128};

std::size_t measurement_id(const std::byte* column) {
  std::uint16_t id;
  std::memcpy(&id, column + 8, sizeof id);
  return id;
}

// Returns whether the packet has columns of this profile: its size fits, and most measurement ids are one
// more than the id before.
bool has_columns(const Payload& packet, const OusterProfile& profile, std::size_t beams) {
  constexpr std::size_t min_columns = 4;
  const std::size_t column = profile.column_size(beams), around = profile.packet_size(beams, 0);
  if (packet.size < around + min_columns * column || (packet.size - around) % column != 0) return false;
  const std::size_t columns = (packet.size - around) / column;
  std::size_t successors = 0;
  const std::byte* at = packet.data + profile.packet_header;
  for (std::size_t i = 1; i < columns; ++i, at += column)
    successors += measurement_id(at + column) == measurement_id(at) + 1 ? 1U : 0U;
  return 2 * successors >= columns;
}

bool is_like_ouster(const Payload& packet) {
  for (const OusterProfile* const profile : kOusterProfiles) {
    for (const std::size_t beams : kOusterBeams) {
      if (has_columns(packet, *profile, beams)) return true;
    }
  }
  return false;
}

class OusterFamily final : public SensorFamily {
 public:
  explicit OusterFamily(const std::filesystem::path& capture) : files_(capture) {}

  // The other files of the folder are not read before the first packet that needs them.
  std::optional<std::size_t> model_of(const Payload& packet) const override {
    const std::optional<std::size_t> model = files_.find(packet);
    if (model || files_.has_read_folder() || !is_like_ouster(packet)) return model;
    files_.read_folder();
    return files_.find(packet);
  }

  std::string_view model_name(std::size_t model) const override { return files_.metadata(model).model; }

  std::unique_ptr<SweepAssembler> make_assembler(std::size_t model) const override {
    Sensor& sensor = sensors_[model];
    if (!sensor.geometry) {
      sensor.metadata = std::make_shared<OusterMetadata>(files_.metadata(model));
      sensor.geometry = std::make_shared<OusterGeometry>(*sensor.metadata);
    }
    return std::make_unique<OusterSensor>(sensor.metadata, sensor.geometry);
  }

  std::string undecodable(const Payload& packet) const override {
    if (!is_like_ouster(packet)) return {};
    requirement_ = files_.missing_for(packet);
    const std::uint64_t serial = files_.serial_of(packet);
    return "an Ouster packet of " + std::to_string(packet.size) + " bytes" +
           (serial == 0 ? "" : " of sensor " + std::to_string(serial));
  }

  std::string requirement() const override { return requirement_; }

 private:
  struct Sensor {
    std::shared_ptr<const OusterMetadata> metadata{};
    std::shared_ptr<const OusterGeometry> geometry{};
  };

  mutable OusterMetadataFiles files_;
  mutable std::map<std::size_t, Sensor> sensors_;
  mutable std::string requirement_;  // of the last packet that could not be decoded
};

}  // namespace

std::unique_ptr<SensorFamily> open_ouster(const std::filesystem::path& capture) {
  return std::make_unique<OusterFamily>(capture);
}

}  // namespace pcl_bv::detail
