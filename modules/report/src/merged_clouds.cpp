// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Partial results of several clouds that were processed independently, and their files.

#include <algorithm>
#include <stdexcept>
#include <tuple>

#include "pcl_bv/fitting/partial_clouds.h"
#include "pcl_bv/io/atomic_file.h"
#include "pcl_bv/io/list_clouds.h"
#include "pcl_bv/io/posix_file.h"
#include "pcl_bv/io/raw_cloud.h"
#include "pcl_bv/io/read_json.h"
#include "pcl_bv/report/partial_file.h"

namespace pcl_bv::detail {
namespace {

constexpr std::string_view kSeveralClouds = "pcl_bv partial results 2\n";
constexpr std::size_t kMaxFileBytes = std::size_t{1} << 30;

bool comes_before(const PartialFile& a, const PartialFile& b) {
  if (natural_less(a.first_input, b.first_input)) return true;
  if (natural_less(b.first_input, a.first_input)) return false;
  return std::tie(a.first_input, a.cloud_points, a.inputs_hash, a.inputs) <
         std::tie(b.first_input, b.cloud_points, b.inputs_hash, b.inputs);
}

void require_good_file(bool good, const char* what) {
  if (!good) throw IoError(what);
}

// Parses the line with the lengths of the contents. Throws IoError unless they are `bytes` in all.
std::vector<std::size_t> read_lengths(std::string_view line, std::size_t bytes) {
  require_good_file(line.size() <= kMaxPartialHeaderBytes, "its header is too long");
  std::vector<std::size_t> lengths;
  try {
    const UntrustedJson header = read_json(line);
    for (const UntrustedJson& length : header.at("lengths")) {
      require_good_file(length.is_number_unsigned(), "its header cannot be read");
      lengths.push_back(length.get<std::size_t>());
      require_good_file(lengths.back() <= bytes, "is truncated");
      bytes -= lengths.back();
    }
  } catch (const UntrustedJson::exception&) {
    throw IoError("its header cannot be read");
  }
  require_good_file(bytes == 0, "is damaged: it is too long");
  return lengths;
}

}  // namespace

void MergedClouds::add(const PartialFile& share) {
  if (!clouds_.empty() && share.origin != clouds_.front().origin)
    throw std::invalid_argument("is a share with another --origin");
  if (!clouds_.empty() && share.filter != clouds_.front().filter)
    throw std::invalid_argument("is a share with another --range or other regions");
  PartialFile cloud = share;
  const auto known = std::find_if(clouds_.begin(), clouds_.end(),
                                  [&](const PartialFile& other) { return other.has_inputs_of(share); });
  if (known != clouds_.end()) {
    cloud.merge(*known);
    clouds_.erase(known);
  }
  clouds_.insert(std::upper_bound(clouds_.begin(), clouds_.end(), cloud, comes_before), cloud);
}

std::size_t MergedClouds::points_before(const PartialFile& share) const {
  std::size_t points = 0;
  for (const PartialFile& cloud : clouds_) {
    if (cloud.has_inputs_of(share)) break;
    points += cloud.cloud_points;
  }
  return points;
}

void MergedClouds::require_whole() const {
  for (const PartialFile& cloud : clouds_) {
    if (cloud.is_whole()) continue;
    std::string problem = "shares are missing: " + cloud.missing();
    if (clouds_.size() > 1) {
      problem += " of the inputs that begin with '" + cloud.first_input + "'. The files are shares of " +
                 std::to_string(clouds_.size()) + " clouds: --part K/N needs the same inputs for all K";
    }
    throw IoError(problem);
  }
}

PartialFile MergedClouds::joined() const {
  if (clouds_.size() == 1) return clouds_.front();
  PartialFile all;
  std::vector<Partial> partials;
  for (const PartialFile& cloud : clouds_) {
    all.inputs += cloud.inputs;
    all.cloud_points += cloud.cloud_points;
    all.counts.range += cloud.counts.range;
    all.counts.inside += cloud.counts.inside;
    all.origin = cloud.origin;
    all.filter = cloud.filter;
    partials.push_back(cloud.partial);
  }
  all.partial = join_clouds(partials);
  return all;
}

std::string merged_clouds_content(const MergedClouds& clouds) {
  if (clouds.clouds().size() == 1) return partial_file_content(clouds.clouds().front());
  std::string contents;
  nlohmann::ordered_json lengths = nlohmann::ordered_json::array();
  for (const PartialFile& cloud : clouds.clouds()) {
    const std::string content = partial_file_content(cloud);
    lengths.push_back(content.size());
    contents += content;
  }
  return std::string(kSeveralClouds) + nlohmann::ordered_json{{"lengths", lengths}}.dump() + '\n' + contents;
}

MergedClouds parse_merged_clouds(std::string_view content) {
  MergedClouds all;
  if (!content.starts_with(kSeveralClouds)) {
    all.add(parse_partial_file(content));
    return all;
  }
  std::string_view rest = content.substr(kSeveralClouds.size());
  const std::size_t end = rest.find('\n');
  require_good_file(end != std::string_view::npos, "is truncated");
  const std::string_view line = rest.substr(0, end);
  rest.remove_prefix(end + 1);
  for (const std::size_t length : read_lengths(line, rest.size())) {
    try {
      all.add(parse_partial_file(rest.substr(0, length)));
    } catch (const std::invalid_argument& error) {
      throw IoError(std::string("is damaged: one of its clouds ") + error.what());
    }
    rest.remove_prefix(length);
  }
  require_good_file(!all.clouds().empty(), "is damaged: it has no cloud");
  return all;
}

void write_partial_file(const std::filesystem::path& path, const MergedClouds& clouds) {
  create_folder_of(path);
  write_file_atomically(path, merged_clouds_content(clouds));
}

MergedClouds read_partial_file(const std::filesystem::path& path) {
  const InputFile file(path);
  require_good_file(file.size() <= kMaxFileBytes,
                    "is too large for partial results (files of objects need --cluster)");
  std::string content(file.size(), '\0');
  file.read(0, content.data(), content.size());
  return parse_merged_clouds(content);
}

}  // namespace pcl_bv::detail
