// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "view_html.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <iterator>

#include "page.h"
#include "pcl_bv/points/point_source.h"
#include "pcl_bv/segmentation/up.h"
#include "pcl_bv/volumes/aabb.h"
#include "pipeline/config/settings.h"

namespace pcl_bv::detail {
namespace {

// Encodes bytes as in RFC 4648, with padding.
std::string base64(const std::string& bytes) {
  constexpr const char* digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t three = 0;
    for (std::size_t k = 0; k < 3; ++k)
      three = three << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0U);
    for (std::size_t k = 0; k < 4; ++k)
      text += k <= bytes.size() - i ? digits[three >> (18 - 6 * k) & 63] : '=';
  }
  return text;
}

// Escapes '<', because HTML ends a script element at the first "</script", even inside a JSON string.
std::string escaped_for_script(std::string json) {
  for (std::size_t at = json.find('<'); at != std::string::npos; at = json.find('<', at))
    json.replace(at, 1, "\\u003c");
  return json;
}

class PagePoints {
 public:
  PagePoints(const Frame& frame, const std::vector<std::uint32_t>& labels, const Eigen::Vector3d& origin)
      : frame_(frame), labels_(labels), origin_(origin) {}

  /// Adds at most `max_points` points, chosen evenly by index. Reads the cloud in chunks, because the
  /// cloud may be in a file.
  void add_all(std::size_t max_points) {
    const std::size_t count = frame_.points.count, wanted = std::min(count, max_points);
    std::size_t number = 0;
    for (std::size_t chunk = 0; chunk < chunk_count(count); ++chunk) {
      const LoadedPoints loaded = load_chunk(frame_.points, chunk);
      const PointView& part = loaded.view();
      for (std::size_t i = 0; i < part.count; ++i, ++number) {
        const bool chosen = (number + 1) * wanted / count > number * wanted / count;
        if (chosen) add(load_point(part, i), part.index(i));
      }
    }
  }

  std::size_t shown = 0;
  std::string bytes;

 private:
  void add(const Coordinates& point, std::size_t number) {
    const float xyz[] = {static_cast<float>(point.x - origin_.x()), static_cast<float>(point.y - origin_.y()),
                         static_cast<float>(point.z - origin_.z())};
    if (!std::all_of(std::begin(xyz), std::end(xyz), [](float c) { return std::isfinite(c); })) return;
    append(xyz);
    append(labels_.empty() ? std::uint32_t{0} : labels_[number]);
    if (frame_.intensity) append(frame_.intensity->at(number));
    ++shown;
  }

  template <class Value>
  void append(const Value& value) {
    bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
  }

  const Frame& frame_;
  const std::vector<std::uint32_t>& labels_;
  Eigen::Vector3d origin_;
};

Eigen::Vector3d centre_of_volumes(const FrameResult& result) {
  Aabb all;
  for (const AnyVolume& volume : result.volumes)
    if (!empty(volume)) all.merge(aabb(volume));
  return all.empty() ? Eigen::Vector3d::Zero() : Eigen::Vector3d(all.center().array().round());
}

std::string list(const Eigen::Vector3d& v) {
  return '[' + to_text(v.x()) + ',' + to_text(v.y()) + ',' + to_text(v.z()) + ']';
}

}  // namespace

std::string view_html(const Frame& frame, const FrameResult& result, const Report& report,
                      const std::vector<std::uint32_t>& labels, std::size_t max_points) {
  const Eigen::Vector3d origin = centre_of_volumes(result);
  PagePoints points(frame, labels, origin);
  points.add_all(max_points);
  const std::string data =
      "<script id=\"data\" type=\"application/json\">{\"report\":" + escaped_for_script(report_json(report)) +
      ",\"origin\":" + list(origin) + ",\"shown\":" + std::to_string(points.shown) +
      ",\"of\":" + std::to_string(frame.points.count) + ",\"stride\":" + (frame.intensity ? "20" : "16") +
      ",\"up\":" + list(normalized_up(result.config->ground.up)) + ",\"points\":\"" + base64(points.bytes) +
      "\"}</script>";
  std::string page(live_page());
  page.replace(page.find(kPageData), kPageData.size(), data);
  return page;
}

}  // namespace pcl_bv::detail
