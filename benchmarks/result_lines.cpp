// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "result_lines.h"

#include <charconv>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>

namespace pcl_bv::bench {
namespace {

using Json = nlohmann::json;

Eigen::Vector3d vector_of(const Json& list) {
  return {list.at(0).get<double>(), list.at(1).get<double>(), list.at(2).get<double>()};
}

const Json& volume_of(const Json& cluster, const std::string& method) {
  for (const Json& volume : cluster.at("volumes")) {
    if (method.empty() || volume.at("method") == method) return volume;
  }
  throw std::runtime_error(method.empty() ? "a cluster has no volume" : "a cluster has no volume " + method);
}

FoundBox box_of(const Json& cluster, const std::string& method) {
  const Json& volume = volume_of(cluster, method);
  const std::string shape = volume.at("shape");
  FoundBox box;
  box.track = cluster.at("track").get<std::uint32_t>();
  if (shape == "aabb") {
    const Eigen::Vector3d min = vector_of(volume.at("min")), max = vector_of(volume.at("max"));
    box.base = {(min + max).head<2>() / 2, 0, max.x() - min.x(), max.y() - min.y()};
    box.low = min.z();
    box.high = max.z();
    return box;
  }
  const std::string name = volume.at("method");
  if (shape != "obb") throw std::runtime_error(name + " is no box; choose one by --method");
  const Eigen::Vector3d center = vector_of(volume.at("center")), half = vector_of(volume.at("half_extents")),
                        first = vector_of(volume.at("axes").at(0)),
                        third = vector_of(volume.at("axes").at(2));
  // 0.99: 8 degrees, so that the boxes of a tilted sensor can be scored too.
  if (std::abs(third.z()) < 0.99)
    throw std::runtime_error(name + " is not upright; use obb-yaw or obb-lshape");
  box.base = {center.head<2>(), std::atan2(first.y(), first.x()), 2 * half.x(), 2 * half.y()};
  box.low = center.z() - half.z();
  box.high = center.z() + half.z();
  return box;
}

std::size_t number_of(const Json& line) {
  const auto seq = line.at("seq").get<std::size_t>();
  if (!line.contains("file")) return seq;
  const std::string stem = std::filesystem::path(line["file"].get<std::string>()).stem().string();
  std::size_t number = 0;
  const auto [end, error] = std::from_chars(stem.data(), stem.data() + stem.size(), number);
  return error == std::errc() && end == stem.data() + stem.size() ? number : seq;
}

ResultFrame frame_of(const Json& line, const std::string& method) {
  ResultFrame frame;
  frame.number = number_of(line);
  if (line.contains("error")) return frame;
  for (const Json& cluster : line.at("clusters")) {
    if (cluster.contains("track") && !cluster["track"].is_null())
      frame.boxes.push_back(box_of(cluster, method));
  }
  return frame;
}

}  // namespace

std::vector<ResultFrame> read_result_lines(const std::filesystem::path& file, const std::string& method) {
  std::ifstream lines(file);
  if (!lines) throw std::runtime_error(file.string() + ": cannot be read");
  std::vector<ResultFrame> frames;
  std::size_t number = 0;
  for (std::string line; std::getline(lines, line);) {
    ++number;
    if (line.empty()) continue;
    try {
      frames.push_back(frame_of(Json::parse(line), method));
    } catch (const std::exception& error) {
      throw std::runtime_error(file.string() + ": line " + std::to_string(number) + ": " + error.what());
    }
  }
  if (frames.empty()) throw std::runtime_error(file.string() + ": no frames");
  return frames;
}

}  // namespace pcl_bv::bench
