// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The family of Ouster sensors.

#include <cstring>

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

// Returns the serial number in a packet, or 0 if it has none.
std::uint64_t serial_of(const Payload& packet, const OusterProfile& profile) {
  std::uint64_t serial = 0;
  if (!profile.is_legacy()) std::memcpy(&serial, packet.data + 7, 5);
  return serial;
}

class OusterFamily final : public SensorFamily {
 public:
  explicit OusterFamily(const std::filesystem::path& capture) : capture_(capture) {
    std::error_code unknown;
    if (std::filesystem::exists(own_ouster_metadata(capture), unknown)) metadata();
  }

  std::optional<std::size_t> model_of(const Payload& packet) const override {
    if (!found_ && !is_like_ouster(packet)) return std::nullopt;
    const FoundOusterMetadata& found = metadata();
    if (!found.metadata || packet.size != found.metadata->packet_size()) return std::nullopt;
    const std::uint64_t serial = serial_of(packet, *found.metadata->profile);
    if (serial != 0 && found.metadata->serial != 0 && serial != found.metadata->serial) return std::nullopt;
    return 0;
  }

  std::string_view model_name(std::size_t) const override { return metadata().metadata->model; }

  std::unique_ptr<SweepAssembler> make_assembler(std::size_t) const override {
    if (!geometry_) {
      shared_ = std::make_shared<OusterMetadata>(*metadata().metadata);
      geometry_ = std::make_shared<OusterGeometry>(*shared_);
    }
    return std::make_unique<OusterSensor>(shared_, geometry_);
  }

  std::string undecodable(const Payload& packet) const override {
    if (!is_like_ouster(packet)) return {};
    const auto& known = metadata().metadata;
    std::string what = "an Ouster packet of " + std::to_string(packet.size) + " bytes";
    if (known && packet.size == known->packet_size())
      what += " of sensor " + std::to_string(serial_of(packet, *known->profile));
    return what;
  }

  std::string requirement() const override {
    const FoundOusterMetadata& found = metadata();
    if (!found.metadata) return found.reason;
    const OusterMetadata& known = *found.metadata;
    return found.file + " is of sensor " + std::to_string(known.serial) + " with packets of " +
           std::to_string(known.packet_size()) + " bytes (" + std::string(known.profile->name) + ", " +
           std::to_string(known.beams) + " beams)";
  }

 private:
  // Metadata without the capture's name are not searched before the first packet that needs them, because the
  // folder of a capture may have many .json files.
  const FoundOusterMetadata& metadata() const {
    if (!found_) found_ = find_ouster_metadata(capture_);
    return *found_;
  }

  std::filesystem::path capture_;
  mutable std::optional<FoundOusterMetadata> found_;
  mutable std::shared_ptr<const OusterMetadata> shared_;
  mutable std::shared_ptr<const OusterGeometry> geometry_;
};

}  // namespace

std::unique_ptr<SensorFamily> open_ouster(const std::filesystem::path& capture) {
  return std::make_unique<OusterFamily>(capture);
}

}  // namespace pcl_bv::detail
