// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "object_seeds.h"

#include <fstream>
#include <random>

#include "object_parts.h"
#include "pcl_bv/points/point_source.h"
#include "pcl_bv/report/object_file.h"

namespace {

using namespace pcl_bv;
using namespace pcl_bv::detail;
namespace fs = std::filesystem;

std::string content_of(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

// Points in pairs along x, so that clusters are in several cells and shares.
template <typename T>
std::vector<T> points_in_a_row(std::size_t count) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> noise(-0.1, 0.1);
  std::vector<T> xyz;
  for (std::size_t i = 0; i < count; ++i)
    for (const double middle : {static_cast<double>(i / 3) * 0.8, static_cast<double>(i % 2) * 0.4, 1.0})
      xyz.push_back(static_cast<T>(middle + noise(random)));
  return xyz;
}

// Writes the points as shares, one behind the other.
template <typename T>
std::string shares_of(const std::vector<T>& xyz, std::size_t count, const ObjectChoices& choices,
                      const fs::path& file) {
  const std::size_t points = xyz.size() / 3;
  const auto* const bytes = reinterpret_cast<const std::byte*>(xyz.data());
  const PointView all = packed_points(bytes, choices.scalar, points);
  std::string shares;
  for (std::size_t s = 0; s < count; ++s) {
    const std::size_t first = points * s / count, end = points * (s + 1) / count;
    ObjectFileHeader header{{}, "c", "v"};
    header.cloud.cloud_points = points;
    header.cloud.shares = {{first, end}};
    write_object_file(file, FileLife::temporary, [&](const fs::path& empty) {
      const MadeClusterShare share(all.slice(first, end - first), fuzzed_options(choices), {},
                                   {Serial{}, UsableIsa(Isa::automatic)},
                                   {empty, first_record_of_object_file()});
      complete_object_file(empty, header, share, [&](std::uint32_t component) -> std::string {
        if (component % 3 == 2) return {};
        return R"({"id":0,"points":3,"volumes":[{"method":"a","shape":"sphere","center":[0,0,0],"radius":1}]})";
      });
    });
    shares += content_of(file);
  }
  fs::remove(file);
  return shares;
}

}  // namespace

void write_objects(const fs::path& folder) {
  const fs::path objects = folder / "objects";
  const auto write = [&](unsigned char byte, const std::string& shares) {
    std::ofstream(objects / std::to_string(byte), std::ios::binary) << static_cast<char>(byte) << shares;
  };
  for (unsigned byte = 0; byte < 256; byte += 4) {
    const ObjectChoices choices(static_cast<unsigned char>(byte));
    const bool floats = choices.scalar == ScalarType::float32;
    const fs::path file = folder / "share";
    const std::string one = floats ? shares_of(points_in_a_row<float>(9), 1, choices, file)
                                   : shares_of(points_in_a_row<double>(9), 1, choices, file);
    const std::string three = floats ? shares_of(points_in_a_row<float>(30), 3, choices, file)
                                     : shares_of(points_in_a_row<double>(30), 3, choices, file);
    if (byte < 8) write(static_cast<unsigned char>(byte), one);
    if (byte % 64 == 4) write(static_cast<unsigned char>(byte | ObjectChoices::kCheckSums), one);
    if (byte % 64 == 0) write(static_cast<unsigned char>(byte | ObjectChoices::kCheckSums), three);
    write(static_cast<unsigned char>(byte | 2U), without_headers(three));
  }
}
