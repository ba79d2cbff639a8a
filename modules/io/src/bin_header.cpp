// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "pcd_format.h"
#include "pcl_bv/io/read_cloud.h"

namespace pcl_bv::detail {
namespace {

constexpr std::size_t kMinFields = 3, kMaxFields = 32;

// Number of floats that are checked, which are those of about 2000 points. The check takes 0.1 ms.
constexpr std::size_t kSampledFloats = 8192;

// Numbers of fields that are tried in addition to the assumed number.
constexpr std::size_t kAlternativeFields[] = {3, 4, 5, 6, 7, 8};

std::size_t default_field_count(const std::filesystem::path& path) {
  const bool nuscenes = lower_case_extension(path.stem()) == ".pcd";
  return nuscenes ? 5 : 4;
}

std::vector<float> sample_of(const InputFile& file) {
  const std::size_t floats = std::min(kSampledFloats, file.size() / sizeof(float));
  std::vector<float> values(floats);
  file.read(0, values.data(), floats * sizeof(float));
  return values;
}

bool is_implausible_coordinate(float value) {
  const float magnitude = std::abs(value);
  return !(magnitude <= 1e7F) || (magnitude < 1e-20F && magnitude != 0);
}

// Returns the median difference between values that are `distance` floats apart. The median is robust against
// a small number of jumps. Differences with NaN (lost beams) are ignored.
float median_difference(const std::vector<float>& values, std::size_t distance) {
  std::vector<float> differences;
  for (std::size_t i = 0; i + distance < values.size(); ++i) {
    const float difference = std::abs(values[i + distance] - values[i]);
    if (std::isfinite(difference)) differences.push_back(difference);
  }
  if (differences.empty()) return std::numeric_limits<float>::infinity();
  const auto middle = differences.begin() + static_cast<std::ptrdiff_t>(differences.size() / 2);
  std::nth_element(differences.begin(), middle, differences.end());
  return *middle;
}

// Returns the smallest other number of fields with which the median difference of successive records is less
// than a third of that with `fields`. Returns 0 if there is no such number. Multiples of the true number also
// give small differences. Therefore the smallest number is returned, and a difference that is only a little
// smaller is not enough.
std::size_t better_field_count(const std::vector<float>& values, std::size_t fields, std::size_t file_size) {
  if (values.size() < 16 * fields) return 0;
  const float own = median_difference(values, fields);
  for (const std::size_t other : kAlternativeFields) {
    const bool fits = other != fields && file_size % (other * sizeof(float)) == 0;
    if (fits && median_difference(values, other) < own / 3) return other;
  }
  return 0;
}

void require_plausible(const InputFile& file, std::size_t fields) {
  const std::vector<float> values = sample_of(file);
  const auto bad =
      static_cast<std::size_t>(std::count_if(values.begin(), values.end(), is_implausible_coordinate));
  const std::string prefix = "with " + std::to_string(fields) + " floats per point, ";
  if (2 * bad > values.size())
    throw IoError(prefix + "most values are not plausible coordinates: probably not a .bin point cloud");
  const std::size_t other = better_field_count(values, fields, file.size());
  if (other == 0) return;
  throw IoError(prefix + "successive points jump; " + std::to_string(other) +
                " floats per point fit better: try --bin-fields " + std::to_string(other));
}

}  // namespace

PcdHeader read_bin_header(const InputFile& file, const std::filesystem::path& path, std::size_t fields) {
  if (fields != 0 && (fields < kMinFields || fields > kMaxFields))
    throw std::invalid_argument("read_bin: " + std::to_string(fields) + " fields; must be 0 or 3 to 32");
  constexpr std::array names{"x", "y", "z", "intensity", "ring"};
  PcdHeader header;
  header.encoding = PcdEncoding::binary;
  RawCloud& cloud = header.cloud;
  const std::size_t count = fields == 0 ? default_field_count(path) : fields;
  for (std::size_t i = 0; i < count; ++i, cloud.point_step += 4) {
    std::string name = i < names.size() ? names[i] : "field" + std::to_string(i + 1);
    cloud.fields.push_back({std::move(name), 'F', 4, 1, cloud.point_step});
  }
  if (file.size() % cloud.point_step != 0) {
    throw IoError("truncated: " + std::to_string(file.size()) + " bytes are not a multiple of the " +
                  std::to_string(cloud.point_step) + " bytes of a point");
  }
  cloud.width = file.size() / cloud.point_step;
  if (fields == 0) require_plausible(file, count);
  return header;
}

}  // namespace pcl_bv::detail
