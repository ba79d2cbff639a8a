// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Draws points as small discs in a depth buffer of twice the picture's resolution. Shades the points by their
// neighbours' depth (eye-dome lighting, Boucheny 2009) and averages the samples of each pixel. Cairo is not
// used for the points, because it would need minutes instead of 0.1 s.

#include "picture_parts.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "pcl_bv/points/point_source.h"

namespace pcl_bv::detail {
namespace {

constexpr int samples = 2;  // per pixel in each direction
constexpr float no_depth = std::numeric_limits<float>::infinity();

constexpr Colour background_top{0.035f, 0.047f, 0.078f};
constexpr Colour background_bottom{0.078f, 0.098f, 0.149f};
constexpr Colour grey_far{0.20f, 0.235f, 0.31f};
constexpr Colour grey_near{0.50f, 0.55f, 0.66f};

Colour mix(const Colour& a, const Colour& b, float t) {
  return {a[0] + (b[0] - a[0]) * t, a[1] + (b[1] - a[1]) * t, a[2] + (b[2] - a[2]) * t};
}

/// Returns the colour for a relative height from 0 (blue) to 1 (orange).
Colour height_colour(float t) {
  constexpr Colour stops[] = {{0.24f, 0.36f, 0.68f},
                              {0.17f, 0.62f, 0.74f},
                              {0.44f, 0.82f, 0.56f},
                              {0.95f, 0.87f, 0.45f},
                              {0.98f, 0.62f, 0.34f}};
  const float at = t * 4;
  const int stop = std::min(static_cast<int>(at), 3);
  return mix(stops[stop], stops[stop + 1], at - static_cast<float>(stop));
}

/// Returns the relative height of a point in the range View::heights, from 0 to 1.
float relative_height(const View& view, const Eigen::Vector3d& point) {
  const auto& [low, high] = view.heights;
  const double above = point.dot(view.world_up) - low;
  return static_cast<float>(std::clamp(low < high ? above / (high - low) : above, 0.0, 1.0));
}

struct Raster {
  Raster(int w, int h)
      : width(w), height(h), depth(static_cast<std::size_t>(w) * h, no_depth), colour(depth.size()) {}

  int width, height;
  std::vector<float> depth;
  std::vector<Colour> colour;
};

using Offsets = std::vector<std::array<int, 2>>;

Offsets disc(double radius) {
  Offsets offsets;
  const int disc_radius = static_cast<int>(radius);
  for (int y = -disc_radius; y <= disc_radius; ++y) {
    for (int x = -disc_radius; x <= disc_radius; ++x) {
      if (x * x + y * y <= radius * radius) offsets.push_back({x, y});
    }
  }
  return offsets;
}

void splat(Raster& raster, const Eigen::Vector3d& at, const Offsets& offsets, const Colour& colour) {
  const double outside_margin = 64;
  if (!(at.x() > -outside_margin && at.x() < raster.width + outside_margin)) return;
  if (!(at.y() > -outside_margin && at.y() < raster.height + outside_margin)) return;
  const int px = static_cast<int>(std::floor(at.x())), py = static_cast<int>(std::floor(at.y()));
  const float depth = static_cast<float>(std::clamp(at.z(), -1e30, 1e30));
  for (const auto& [dx, dy] : offsets) {
    const int x = px + dx, y = py + dy;
    if (x < 0 || x >= raster.width || y < 0 || y >= raster.height) continue;
    const std::size_t i = static_cast<std::size_t>(y) * raster.width + x;
    if (depth < raster.depth[i]) {
      raster.depth[i] = depth;
      raster.colour[i] = colour;
    }
  }
}

/// Returns the brightness of a sample, from 0 to 1. The brightness is lower if neighbours are closer to the
/// viewer.
float eye_dome_brightness(const Raster& raster, int x, int y) {
  constexpr int step = 3;
  constexpr float max_depth_step = 40;  // in samples; larger depth differences have the same effect
  constexpr int around[8][2] = {{1, 0}, {-1, 0}, {0, 1}, {0, -1}, {1, 1}, {1, -1}, {-1, 1}, {-1, -1}};
  const float here = raster.depth[static_cast<std::size_t>(y) * raster.width + x];
  float covered = 0;
  for (const auto& [dx, dy] : around) {
    const int nx = x + step * dx, ny = y + step * dy;
    if (nx < 0 || nx >= raster.width || ny < 0 || ny >= raster.height) continue;
    const float there = raster.depth[static_cast<std::size_t>(ny) * raster.width + nx];
    if (there < here) covered += std::min(here - there, max_depth_step);
  }
  return std::exp(-2.2f * covered / (8 * max_depth_step));
}

std::uint32_t pack(const Colour& colour) {
  std::uint32_t pixel = 0xff;
  for (const float channel : colour) {
    pixel = pixel << 8 | static_cast<std::uint32_t>(std::lround(std::clamp(channel, 0.0f, 1.0f) * 255));
  }
  return pixel;
}

std::vector<std::uint32_t> shade(const Raster& raster) {
  const int width = raster.width / samples, height = raster.height / samples;
  std::vector<std::uint32_t> pixels(static_cast<std::size_t>(width) * height);
  for (int y = 0; y < height; ++y) {
    const float relative_y = static_cast<float>(y) / static_cast<float>(height);
    const Colour background = mix(background_top, background_bottom, relative_y);
    for (int x = 0; x < width; ++x) {
      Colour sum{};
      for (int s = 0; s < samples * samples; ++s) {
        const int sx = x * samples + s % samples, sy = y * samples + s / samples;
        const std::size_t i = static_cast<std::size_t>(sy) * raster.width + sx;
        const bool hit = raster.depth[i] != no_depth;
        const Colour& colour = hit ? raster.colour[i] : background;
        const float light = hit ? eye_dome_brightness(raster, sx, sy) : 1;
        for (int c = 0; c < 3; ++c)
          sum[c] += colour[c] * light;
      }
      for (float& channel : sum)
        channel /= samples * samples;
      pixels[static_cast<std::size_t>(y) * width + x] = pack(sum);
    }
  }
  return pixels;
}

}  // namespace

std::vector<std::uint32_t> draw_points(const Picture& picture, const View& view) {
  Raster raster(view.width * samples, view.height * samples);
  const double area = static_cast<double>(raster.width) * raster.height;
  const double spacing =
      std::sqrt(area / static_cast<double>(std::max<std::size_t>(picture.points.count, 1)));
  const Offsets small = disc(std::clamp(0.17 * spacing, 0.5, 6.0));
  const Offsets large = disc(std::clamp(0.26 * spacing, 1.0, 6.0));
  const auto draw = [&](const Coordinates& p, std::size_t index) {
    const Eigen::Vector3d point(p.x, p.y, p.z), at = view.project(point);
    const Eigen::Vector3d sample(at.x() * samples, at.y() * samples, at.z() * samples);
    if (!picture.labels) return splat(raster, sample, large, height_colour(relative_height(view, point)));
    const std::uint32_t label = picture.labels[index];
    if (label < kLabelGround) return splat(raster, sample, large, palette(label));
    const double near = 0.5 - at.z() / picture.height;
    splat(raster, sample, small, mix(grey_far, grey_near, static_cast<float>(std::clamp(near, 0.0, 1.0))));
  };
  for (std::size_t chunk = 0; chunk < chunk_count(picture.points.count); ++chunk) {
    const LoadedPoints part = load_chunk(picture.points, chunk);
    for (std::size_t i = 0; i < part.view().count; ++i) {
      const Coordinates p = load_point(part.view(), i);
      if (is_drawn(p)) draw(p, part.view().index(i));
    }
  }
  return shade(raster);
}

}  // namespace pcl_bv::detail
