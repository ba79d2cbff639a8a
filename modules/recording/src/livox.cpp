// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The family of Livox sensors with the protocol of the Mid-360 and the HAP.

#include "livox_sensor.h"
#include "sensor_family.h"

namespace pcl_bv::detail {
namespace {

class LivoxFamily final : public SensorFamily {
 public:
  std::optional<std::size_t> model_of(const Payload& packet) const override {
    LivoxPacket header;
    if (!read_livox_packet(packet, header)) return std::nullopt;
    return 0;
  }

  // The packets do not tell which of the models sent them.
  std::string_view model_name(std::size_t) const override { return "Livox"; }

  std::unique_ptr<SweepAssembler> make_assembler(std::size_t) const override {
    return std::make_unique<LivoxSensor>();
  }

  // Packets of the inertial sensor (data type 0) are no packets of points, so none of them is missed.
  std::string undecodable(const Payload& packet) const override {
    LivoxPacket header;
    if (!has_livox_header(packet) || read_livox_packet(packet, header)) return {};
    const bool has_points = header.points > 0 && (packet.size - kLivoxHeader) % header.points == 0;
    if (header.data_type == 0 || !has_points) return {};
    return "Livox' data type " + std::to_string(header.data_type);
  }
};

}  // namespace

std::unique_ptr<SensorFamily> open_livox(const std::filesystem::path&) {
  return std::make_unique<LivoxFamily>();
}

}  // namespace pcl_bv::detail
