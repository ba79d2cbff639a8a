// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "pcl_bv/report/partial_file.h"

#include <algorithm>
#include <cstring>
#include <iterator>
#include <stdexcept>

#include "pcl_bv/io/crc32.h"
#include "pcl_bv/io/raw_cloud.h"
#include "pcl_bv/io/read_json.h"

namespace pcl_bv::detail {
namespace {

using Json = UntrustedJson;
using Shares = std::vector<std::pair<std::size_t, std::size_t>>;

constexpr std::string_view kFormat = "pcl_bv partial results ";
constexpr std::string_view kVersion = "1\n";

std::string check_sum(std::string_view content) {
  const std::uint32_t value = crc32_of(content.data(), content.size());
  std::string bytes(sizeof value, '\0');
  std::memcpy(bytes.data(), &value, sizeof value);
  return bytes;
}

void require(bool good, const char* what) {
  if (!good) throw IoError(what);
}

void require_same(bool same, const char* what) {
  if (!same) throw std::invalid_argument(what);
}

// Returns the union of `a` and `b`. Adjacent ranges become one. Throws std::invalid_argument if `a` and `b`
// overlap.
Shares united_shares(const Shares& a, const Shares& b) {
  Shares sorted, shares;
  std::merge(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(sorted));
  for (const auto& share : sorted) {
    require_same(shares.empty() || share.first >= shares.back().second,
                 "overlaps another share: is the same file given twice?");
    if (!shares.empty() && share.first == shares.back().second) {
      shares.back().second = share.second;
    } else {
      shares.push_back(share);
    }
  }
  return shares;
}

std::size_t points_in(const Shares& shares) {
  std::size_t points = 0;
  for (const auto& [first, end] : shares)
    points += end - first;
  return points;
}

// Returns a non-negative integer of at most 64 bits. Throws IoError for any other value.
std::size_t unsigned_integer(const Json& number) {
  require(number.is_number_unsigned(), "invalid header: a non-negative integer is expected");
  return number.get<std::size_t>();
}

// Parses the line of JSON. Throws Json::exception and IoError.
PartialFile read_partial_header(std::string_view line) {
  require(line.size() <= kMaxPartialHeaderBytes, "its header is too long");
  const Json json = read_json(line);
  PartialFile file;
  file.inputs_hash = unsigned_integer(json.at("inputs_hash"));
  file.inputs = unsigned_integer(json.at("inputs"));
  if (json.contains("first_input")) file.first_input = json.at("first_input").get<std::string>();
  file.cloud_points = unsigned_integer(json.at("cloud_points"));
  if (json.contains("origin")) {
    file.origin.emplace();
    for (std::size_t k = 0; k < 3; ++k)
      (*file.origin)[static_cast<Eigen::Index>(k)] = json.at("origin").at(k).get<double>();
    require(file.origin->allFinite(), "its origin is not finite");
  }
  file.filter = json.at("filter").get<std::string>();
  file.counts.range = unsigned_integer(json.at("range"));
  file.counts.inside = unsigned_integer(json.at("inside"));
  std::size_t end = 0;
  for (const Json& share : json.at("shares")) {
    file.shares.emplace_back(unsigned_integer(share.at(0)), unsigned_integer(share.at(1)));
    const auto& [from, to] = file.shares.back();
    const bool apart = from > end || (from == 0 && file.shares.size() == 1);
    require(apart && from < to && to <= file.cloud_points, "its ranges of points are inconsistent");
    end = to;
  }
  return file;
}

}  // namespace

void PartialFile::add_input(std::string_view name, std::size_t points) {
  const auto add = [&](unsigned char byte) { inputs_hash = (inputs_hash ^ byte) * 0x100000001b3; };
  for (const char c : name)
    add(static_cast<unsigned char>(c));
  for (std::size_t i = 0; i <= 8; ++i)  // a zero byte ends the name; 8 bytes of the number follow
    add(i == 0 ? 0 : static_cast<unsigned char>(points >> (8 * (i - 1))));
  if (inputs++ == 0) first_input = name;
  cloud_points += points;
}

bool PartialFile::has_inputs_of(const PartialFile& other) const {
  return inputs_hash == other.inputs_hash && inputs == other.inputs && cloud_points == other.cloud_points;
}

void PartialFile::merge(const PartialFile& other) {
  require_same(has_inputs_of(other), "is a share of another cloud: the inputs were not the same");
  require_same(origin == other.origin, "is a share with another --origin");
  require_same(filter == other.filter, "is a share with another --range or other regions");
  Shares all = united_shares(shares, other.shares);
  partial.merge(other.partial);
  shares = std::move(all);
  counts.range += other.counts.range;
  counts.inside += other.counts.inside;
  if (first_input.empty()) first_input = other.first_input;
}

bool PartialFile::is_whole() const {
  return points_in(shares) == cloud_points;
}

std::string PartialFile::missing() const {
  std::string text;
  std::size_t from = 0;
  const auto gap = [&](std::size_t to) {
    if (from == to) return;
    text += (text.empty() ? "points " : ", ") + std::to_string(from) + " to " + std::to_string(to);
  };
  for (const auto& [first, end] : shares) {
    gap(first);
    from = end;
  }
  gap(cloud_points);
  return text + " of " + std::to_string(cloud_points);
}

std::string partial_file_content(const PartialFile& file) {
  nlohmann::ordered_json json{
      {"inputs", file.inputs}, {"inputs_hash", file.inputs_hash}, {"cloud_points", file.cloud_points}};
  if (!file.first_input.empty()) json["first_input"] = file.first_input;
  if (file.origin) json["origin"] = {(*file.origin)[0], (*file.origin)[1], (*file.origin)[2]};
  json["filter"] = file.filter;
  json["range"] = file.counts.range;
  json["inside"] = file.counts.inside;
  json["shares"] = file.shares;
  std::string content(kFormat);
  content += kVersion;
  content += json.dump(-1, ' ', true, Json::error_handler_t::replace) + '\n';
  const std::vector<std::byte> bytes = file.partial.to_bytes();
  content.append(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  return content + check_sum(content);
}

PartialFile parse_partial_file(std::string_view content, bool has_partial) {
  require(!content.starts_with("pcl_bv objects "), "has objects: give --cluster as for --partial");
  require(!content.starts_with("pcl_bv ground "), "has the ground of a share: name it by --ground-parts");
  require(content.starts_with(kFormat), "is no file of partial results, as --partial writes them");
  std::string_view rest = content.substr(kFormat.size());
  require(rest.size() > 6, "is truncated");
  require(rest.starts_with(kVersion),
          "was written by another version of pcl_bv: this one reads versions 1 and 2");
  const std::size_t sum = 4;
  require(content.substr(content.size() - sum) == check_sum(content.substr(0, content.size() - sum)),
          "is damaged: the checksum does not match");
  rest = rest.substr(kVersion.size(), rest.size() - kVersion.size() - sum);
  const std::size_t end = rest.find('\n');
  require(end != std::string_view::npos, "is truncated");
  try {
    PartialFile file = read_partial_header(rest.substr(0, end));
    const std::string_view bytes = rest.substr(end + 1);
    file.partial = Partial::from_bytes(reinterpret_cast<const std::byte*>(bytes.data()), bytes.size());
    require(file.partial.size() == (has_partial ? points_in(file.shares) : 0), "its numbers of points are inconsistent");
    return file;
  } catch (const Json::exception&) {
    throw IoError("its header cannot be read");
  } catch (const std::invalid_argument& error) {
    throw IoError(error.what());
  }
}

}  // namespace pcl_bv::detail
