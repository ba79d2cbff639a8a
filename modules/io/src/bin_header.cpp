// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
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

// The check of distributions needs this number of values of each column.
constexpr std::size_t kMinColumnValues = 60;

// Returns every `step`-th value from `first` on, without NaN.
std::vector<float> column_of(const std::vector<float>& values, std::size_t first, std::size_t step) {
  std::vector<float> column;
  for (std::size_t i = first; i < values.size(); i += step)
    if (!std::isnan(values[i])) column.push_back(values[i]);
  std::sort(column.begin(), column.end());
  return column;
}

// Returns the largest difference of the two cumulative distributions (Kolmogorov-Smirnov), 0 to 1.
double distribution_difference(const std::vector<float>& a, const std::vector<float>& b) {
  double largest = 0;
  for (std::size_t i = 0, j = 0; i < a.size() && j < b.size();) {
    const float value = std::min(a[i], b[j]);
    while (i < a.size() && a[i] == value)
      ++i;
    while (j < b.size() && b[j] == value)
      ++j;
    const double difference = static_cast<double>(i) / static_cast<double>(a.size()) -
                              static_cast<double>(j) / static_cast<double>(b.size());
    largest = std::max(largest, std::abs(difference));
  }
  return largest;
}

// Returns the largest difference between parts of a column. If the records have `fields` floats, all parts
// have the same distribution. A part has every record of which the position modulo `period` is the same.
double difference_in_columns(const std::vector<float>& values, std::size_t fields, std::size_t period) {
  double largest = 0;
  for (std::size_t column = 0; column < fields; ++column) {
    const std::vector<float> first = column_of(values, column, period);
    for (std::size_t part = column + fields; part < period; part += fields)
      largest = std::max(largest, distribution_difference(first, column_of(values, part, period)));
  }
  return largest;
}

// Kinds of values in a column, from general to special. Coordinates of one axis are of the same kind in all
// points.
enum class ColumnKind : std::uint8_t { any, small, whole };

ColumnKind kind_of(const std::vector<float>& values) {
  const auto is_whole = [](float value) { return value == std::trunc(value); };
  if (std::all_of(values.begin(), values.end(), is_whole)) return ColumnKind::whole;
  const auto is_small = [](float value) { return std::abs(value) <= 1; };
  return std::all_of(values.begin(), values.end(), is_small) ? ColumnKind::small : ColumnKind::any;
}

// Returns whether `other` floats per point explain the distributions of the columns, and `fields` do not. If
// `other` is a multiple of `fields`, the sweeps of some sensors have such a pattern: successive points come
// from different beams. Then the floats at the positions of the next point's x, y and z must be of another
// kind than coordinates: colours, normals, intensities, classes or numbers of rings. But if they are all
// equal or not finite, every second record is empty.
bool columns_fit_better(const std::vector<float>& values, std::size_t fields, std::size_t other) {
  const std::size_t period = std::lcm(fields, other);
  const auto count = static_cast<double>(values.size() / period);
  if (count < kMinColumnValues) return false;
  if (period == other) {
    const auto is_constant = [](const std::vector<float>& column) {
      return column.empty() || column.front() == column.back();  // columns are sorted
    };
    std::size_t constant = 0;
    for (std::size_t axis = 0; axis < 3; ++axis)
      constant += is_constant(column_of(values, axis + fields, other)) ? 1 : 0;
    if (constant == 3) return false;
    for (std::size_t axis = 0; axis < 3; ++axis)
      if (kind_of(column_of(values, axis, other)) >= kind_of(column_of(values, axis + fields, other)))
        return false;
    return true;
  }
  const double noise = 2.2 * std::sqrt(2 / count);  // exceeded by chance once in 10 000 pairs
  return difference_in_columns(values, other, period) < noise &&
         difference_in_columns(values, fields, period) > std::max(0.3, 2 * noise);
}

// Returns the other number of fields for which columns_fit_better(), or 0. Unlike better_field_count(), it
// also detects the number if the points have a random order. The columns of a divisor of the true number fit,
// too, because they mix the same values in all points.
std::size_t better_column_count(const std::vector<float>& values, std::size_t fields, std::size_t file_size) {
  std::size_t best = 0;
  for (const std::size_t other : {3, 4, 5, 6, 7, 8, 9}) {
    const bool fits = other != fields && file_size % (other * sizeof(float)) == 0;
    const bool candidate = best == 0 || other % best == 0;
    if (fits && candidate && columns_fit_better(values, best == 0 ? fields : best, other)) best = other;
  }
  return best;
}

void require_plausible(const InputFile& file, std::size_t fields) {
  const std::vector<float> values = sample_of(file);
  const auto bad =
      static_cast<std::size_t>(std::count_if(values.begin(), values.end(), is_implausible_coordinate));
  const std::string prefix = "with " + std::to_string(fields) + " floats per point, ";
  if (2 * bad > values.size())
    throw IoError(prefix + "most values are not plausible coordinates: probably not a .bin point cloud");
  const std::size_t jump = better_field_count(values, fields, file.size()),
                    mixed = better_column_count(values, fields, file.size());
  if (jump == 0 && mixed == 0) return;
  const std::string other = std::to_string(mixed != 0 ? mixed : jump);
  throw IoError(prefix +
                (jump != 0 ? "successive points jump; " : "columns mix coordinates with other values; ") +
                other + " floats per point fit better: try --bin-fields " + other);
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
