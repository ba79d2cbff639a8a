// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The units of the coordinate system in the variable length records of a .las file: keys of GeoTIFF (OGC
// 19-008r4) or well-known text (OGC 01-009, 18-010r7).

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>

#include "las_format.h"

namespace pcl_bv::detail {
namespace {

constexpr std::size_t kRecordHeader = 54, kMaxRecords = std::size_t{1} << 20;  // bytes
constexpr std::uint16_t kGeoKeys = 34735, kWellKnownText = 2112;

struct LasUnits {
  bool feet = false, degrees = false;
};

std::uint16_t number_at(std::string_view bytes, std::size_t at) {
  std::uint16_t value = 0;
  if (at + sizeof value <= bytes.size()) std::memcpy(&value, bytes.data() + at, sizeof value);
  return value;
}

void read_keys(std::string_view keys, LasUnits& units) {
  constexpr std::uint16_t model_type = 1024, linear_unit = 3076, vertical_unit = 4099;
  constexpr std::uint16_t geographic = 2, first_foot = 9002, last_foot = 9006;
  const std::size_t count = number_at(keys, 6);
  for (std::size_t i = 1; i <= count && 8 * i + 8 <= keys.size(); ++i) {
    const std::uint16_t key = number_at(keys, 8 * i), value = number_at(keys, 8 * i + 6);
    if (key == model_type && value == geographic) units.degrees = true;
    const bool foot = value >= first_foot && value <= last_foot;
    if ((key == linear_unit || key == vertical_unit) && foot) units.feet = true;
  }
}

void read_well_known_text(std::string_view wkt, LasUnits& units) {
  std::string text(wkt);
  std::transform(text.begin(), text.end(), text.begin(),
                 [](char c) { return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c; });
  const auto has = [&](const char* word) { return text.find(word) != std::string::npos; };
  if (!has("PROJCS[") && !has("PROJCRS[") && (has("GEOGCS[") || has("GEOGCRS["))) units.degrees = true;
  for (std::size_t at = text.find("UNIT[\""); at != std::string::npos; at = text.find("UNIT[\"", at)) {
    at += 6;
    const std::string_view name = std::string_view(text).substr(at, text.find('"', at) - at);
    if (name.find("FOOT") != std::string_view::npos || name.find("FEET") != std::string_view::npos)
      units.feet = true;
  }
}

}  // namespace

std::string las_units_note(const InputFile& file, std::size_t begin, std::size_t end) {
  end = std::min({end, file.size(), begin + kMaxRecords});
  if (begin >= end) return {};
  std::string records(end - begin, '\0');
  file.read(begin, records.data(), records.size());
  LasUnits units;
  for (std::size_t at = 0; at + kRecordHeader <= records.size();) {
    const std::string_view record = std::string_view(records).substr(at);
    const std::uint16_t id = number_at(record, 18), length = number_at(record, 20);
    const std::string_view content = record.substr(kRecordHeader, length);
    const bool projection = record.substr(2).starts_with("LASF_Projection");
    if (projection && id == kGeoKeys) read_keys(content, units);
    if (projection && id == kWellKnownText) read_well_known_text(content, units);
    at += kRecordHeader + length;
  }
  if (units.degrees) return "x and y are longitude and latitude: all distances in their plane are in degrees";
  if (units.feet)
    return "coordinates are in feet (the coordinate system of the file): distances and tolerances are feet, "
           "too";
  return {};
}

}  // namespace pcl_bv::detail
