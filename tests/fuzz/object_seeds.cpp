// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "object_seeds.h"

#include <fstream>
#include <iterator>
#include <random>

#include "object_parts.h"
#include "pcl_bv/points/point_source.h"
#include "pcl_bv/report/ground_file.h"
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

// Writes the points as shares, one behind the other. A cloud says that it has more points than it has.
std::string shares_of(const PointView& all, std::size_t count, const ObjectChoices& choices,
                      const fs::path& file, std::size_t more = 0) {
  const std::size_t points = all.count;
  std::string shares;
  for (std::size_t s = 0; s < count; ++s) {
    const std::size_t first = points * s / count, end = points * (s + 1) / count;
    ObjectFileHeader header{{}, "c", "v"};
    header.cloud.cloud_points = points + more;
    header.cloud.shares = {{first, end}};
    write_object_file(file, FileLife::temporary, [&](const fs::path& empty) {
      const MadeClusterShare share(all.slice(first, end - first), fuzzed_options(choices), {},
                                   {Serial{}, UsableIsa(Isa::automatic)},
                                   {empty, first_record_of_object_file()});
      complete_object_file(empty, 0, header, share, [&](std::uint32_t component) -> std::string {
        if (component % 3 == 2) return {};
        return R"({"id":0,"points":3,"volumes":[{"method":"a","shape":"sphere","center":[0,0,0],"radius":1}]})";
      });
    });
    shares += content_of(file);
  }
  fs::remove(file);
  return shares;
}

void write_grounds(const fs::path& folder) {
  const std::vector<LowestPoint> cells = {{-3, 7, 2.5}, {4, 7, -1}, {0, -2, 0.25}, {1, 1, 0}};
  LowestPoints lowest{GroundSlopeOptions()};
  GroundBounds bounds;
  for (const LowestPoint& cell : cells) {
    lowest.add(cell);
    bounds.add(cell);
  }
  GroundFileHeader header{{}, "o"};
  header.cloud.cloud_points = 9;
  header.cloud.shares = {{2, 8}};
  write_ground_file(folder / "file", FileLife::temporary, header, lowest);
  std::ofstream(folder / "cells", std::ios::binary)
      << std::string(reinterpret_cast<const char*>(&bounds), sizeof bounds)
      << std::string(reinterpret_cast<const char*>(cells.data()), cells.size() * sizeof(LowestPoint));
}

}  // namespace

void write_objects(const fs::path& folder) {
  write_grounds(folder / "ground");
  const fs::path objects = folder / "objects", file = folder / "share";
  const auto write = [&](const std::string& name, unsigned byte, const std::string& shares) {
    std::ofstream(objects / name, std::ios::binary) << static_cast<char>(byte) << shares;
  };
  const std::vector<float> floats = points_in_a_row<float>(30);
  const std::vector<double> doubles = points_in_a_row<double>(30);
  const auto points = [&](ScalarType scalar, std::size_t count) {
    const auto* const bytes = scalar == ScalarType::float32
                                  ? reinterpret_cast<const std::byte*>(floats.data())
                                  : reinterpret_cast<const std::byte*>(doubles.data());
    return packed_points(bytes, scalar, count);
  };
  std::string both_types;
  for (unsigned byte = 0; byte < 256; byte += 4) {
    const ObjectChoices choices(static_cast<unsigned char>(byte));
    const std::string one = shares_of(points(choices.scalar, 9), 1, choices, file);
    const std::string three = shares_of(points(choices.scalar, 30), 3, choices, file);
    write("repaired" + std::to_string(byte), byte | 2U, without_headers(three));
    if (byte < 8) write("own" + std::to_string(byte), byte, one);
    if (byte % 64 != 0) continue;
    write("sums" + std::to_string(byte), byte | ObjectChoices::kCheckSums, three);
    write("great" + std::to_string(byte), byte | ObjectChoices::kCheckSums,
          shares_of(points(choices.scalar, 30), 3, choices, file, std::size_t{1} << 62U));
    both_types += one;
  }
  write("types", ObjectChoices::kCheckSums, both_types);
}
