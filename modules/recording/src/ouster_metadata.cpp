// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "ouster_metadata.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <iterator>
#include <limits>

#include "pcl_bv/io/read_json.h"

namespace pcl_bv::detail {
namespace {

constexpr std::size_t kMaxBeams = 256, kMaxColumnsPerPacket = 64, kMaxColumnsPerFrame = 8192;
constexpr std::size_t kMaxUdpPayload = 65'507;
constexpr double kMaxMillimetres = 1e5;

const UntrustedJson* member_of(const UntrustedJson& object, const char* key) {
  if (!object.is_object()) return nullptr;
  const auto found = object.find(key);
  return found == object.end() ? nullptr : &*found;
}

// Returns the value with this key in one of the sections, or at the top level as in the flat layout.
const UntrustedJson* find_value(const UntrustedJson& json, std::initializer_list<const char*> sections,
                                const char* key) {
  for (const char* section : sections) {
    const UntrustedJson* const inner = member_of(json, section);
    if (inner == nullptr) continue;
    if (const UntrustedJson* const value = member_of(*inner, key)) return value;
  }
  return member_of(json, key);
}

[[noreturn]] void refuse_value(const char* key, const UntrustedJson& value, const std::string& allowed) {
  throw IoError(std::string(key) + " is " + abbreviated(value) + ", but must be " + allowed);
}

double number_in(const UntrustedJson& value, const char* key, double limit) {
  const double number = value.is_number() ? value.get<double>() : std::numeric_limits<double>::quiet_NaN();
  if (!(std::abs(number) <= limit))
    refuse_value(key, value, "a number of magnitude <= " + std::to_string(static_cast<long>(limit)));
  return number;
}

std::size_t count_in(const UntrustedJson* value, const char* key, std::size_t limit) {
  if (value == nullptr) throw IoError(std::string("has no ") + key);
  const bool valid = value->is_number_integer() && *value >= 1 && *value <= limit;
  if (!valid) refuse_value(key, *value, "a whole number from 1 to " + std::to_string(limit));
  return value->get<std::size_t>();
}

std::vector<double> numbers_in(const UntrustedJson* value, const char* key, std::size_t size, double limit) {
  if (value == nullptr) throw IoError(std::string("has no ") + key);
  if (!value->is_array() || value->size() != size)
    refuse_value(key, *value, "a list of " + std::to_string(size) + " numbers");
  std::vector<double> numbers;
  for (const UntrustedJson& element : *value)
    numbers.push_back(number_in(element, key, limit));
  return numbers;
}

std::string text_in(const UntrustedJson* value) {
  constexpr std::size_t long_enough = 40;
  if (value == nullptr || !value->is_string()) return {};
  return printable(value->get_ref<const std::string&>().substr(0, long_enough));
}

// Returns the columns of a lidar mode such as "1024x10".
std::size_t columns_of_mode(const std::string& mode) {
  std::size_t columns = 0;
  const auto [end, error] = std::from_chars(mode.data(), mode.data() + mode.size(), columns);
  if (error != std::errc() || columns < 1 || columns > kMaxColumnsPerFrame ||
      end == mode.data() + mode.size() || *end != 'x')
    throw IoError("has neither a packet format nor a lidar_mode such as \"1024x10\"");
  return columns;
}

void read_format(const UntrustedJson& json, OusterMetadata& made) {
  const auto in_format = [&](const char* key) {
    return find_value(json, {"lidar_data_format", "data_format"}, key);
  };
  std::string profile = text_in(in_format("udp_profile_lidar"));
  if (profile.empty()) profile = text_in(find_value(json, {"config_params"}, "udp_profile_lidar"));
  if (profile.empty()) profile = kOusterLegacy.name;
  const auto* const found = std::find_if(std::begin(kOusterProfiles), std::end(kOusterProfiles),
                                         [&](const OusterProfile* known) { return known->name == profile; });
  if (found == std::end(kOusterProfiles)) {
    std::string known;
    for (const OusterProfile* const supported : kOusterProfiles)
      known += (known.empty() ? "" : ", ") + std::string(supported->name);
    throw IoError("udp_profile_lidar is " + profile + "; supported are " + known);
  }
  made.profile = *found;
  if (in_format("pixels_per_column") == nullptr) {  // firmware 1.13 and earlier
    made.beams = 64;
    made.columns_per_packet = 16;
    made.columns_per_frame = columns_of_mode(text_in(find_value(json, {"config_params"}, "lidar_mode")));
  } else {
    made.beams = count_in(in_format("pixels_per_column"), "pixels_per_column", kMaxBeams);
    made.columns_per_packet =
        count_in(in_format("columns_per_packet"), "columns_per_packet", kMaxColumnsPerPacket);
    made.columns_per_frame =
        count_in(in_format("columns_per_frame"), "columns_per_frame", kMaxColumnsPerFrame);
  }
  if (made.packet_size() > kMaxUdpPayload) throw IoError("packets would have more than 65507 bytes");
}

// Returns the distance of the beams' origin for metadata without it, as Ouster's SDK does.
double default_beam_origin(const std::string& model) {
  if (model.starts_with("OS-0-")) return 27.67;
  if (model.starts_with("OS-1-")) return 15.806;
  if (model.starts_with("OS-2-")) return 13.762;
  return 12.163;
}

void read_beams(const UntrustedJson& json, OusterMetadata& made) {
  const auto in_beams = [&](const char* key) { return find_value(json, {"beam_intrinsics"}, key); };
  const auto angles = [&](const char* key, double limit) {
    return numbers_in(in_beams(key), key, made.beams, limit);
  };
  made.altitudes = angles("beam_altitude_angles", 90);
  made.azimuths = angles("beam_azimuth_angles", 360);
  if (const UntrustedJson* const transform = in_beams("beam_to_lidar_transform")) {
    const std::vector<double> all = numbers_in(transform, "beam_to_lidar_transform", 16, kMaxMillimetres);
    made.beam_x_mm = all[3];
    made.beam_z_mm = all[11];
  } else if (const UntrustedJson* const origin = in_beams("lidar_origin_to_beam_origin_mm")) {
    made.beam_x_mm = number_in(*origin, "lidar_origin_to_beam_origin_mm", kMaxMillimetres);
  } else {
    made.beam_x_mm = default_beam_origin(made.model);
  }
  const std::vector<double> transform =
      numbers_in(find_value(json, {"lidar_intrinsics"}, "lidar_to_sensor_transform"),
                 "lidar_to_sensor_transform", 16, kMaxMillimetres);
  std::copy(transform.begin(), transform.end(), made.lidar_to_sensor.begin());
}

// Returns a whole number that tells sensors apart, or 0 if there is none.
std::uint64_t identifier_in(const UntrustedJson* value) {
  const bool valid = value != nullptr && value->is_number_unsigned();
  return valid ? value->get<std::uint64_t>() : 0;
}

}  // namespace

OusterMetadata parse_ouster_metadata(std::string_view json) {
  const UntrustedJson parsed = read_json(json);
  if (find_value(parsed, {"beam_intrinsics"}, "beam_altitude_angles") == nullptr)
    throw IoError("has no beam_altitude_angles");
  OusterMetadata made;
  made.model = text_in(find_value(parsed, {"sensor_info"}, "prod_line"));
  if (made.model.empty()) made.model = "Ouster";
  const std::string serial = text_in(find_value(parsed, {"sensor_info"}, "prod_sn"));
  std::from_chars(serial.data(), serial.data() + serial.size(), made.serial);  // stays 0 if not a number
  made.init_id = identifier_in(find_value(parsed, {"sensor_info"}, "initialization_id"));
  made.port = identifier_in(find_value(parsed, {"config_params"}, "udp_port_lidar"));
  read_format(parsed, made);
  read_beams(parsed, made);
  return made;
}

}  // namespace pcl_bv::detail
