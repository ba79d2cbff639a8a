// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Small scenes, and pictures decoded again.
#pragma once

#include <cairo.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "palette.h"
#include "pcl_bv/report/picture.h"

namespace pcl_bv::test {
using namespace detail;

struct Pixels {
  int width = 0, height = 0;
  std::vector<std::uint32_t> rgb;

  std::uint32_t at(int x, int y) const { return rgb[static_cast<std::size_t>(y) * width + x]; }
};

inline Pixels decode(const std::string& png) {
  std::string_view rest = png;
  const auto read = [](void* from, unsigned char* to, unsigned n) {
    auto& bytes = *static_cast<std::string_view*>(from);
    if (bytes.size() < n) return CAIRO_STATUS_READ_ERROR;
    std::memcpy(to, bytes.data(), n);
    bytes.remove_prefix(n);
    return CAIRO_STATUS_SUCCESS;
  };
  const std::unique_ptr<cairo_surface_t, void (*)(cairo_surface_t*)> surface(
      cairo_image_surface_create_from_png_stream(read, &rest), cairo_surface_destroy);
  EXPECT_EQ(cairo_surface_status(surface.get()), CAIRO_STATUS_SUCCESS);
  Pixels pixels{
      cairo_image_surface_get_width(surface.get()), cairo_image_surface_get_height(surface.get()), {}};
  for (int y = 0; y < pixels.height; ++y) {
    const unsigned char* row = cairo_image_surface_get_data(surface.get()) +
                               static_cast<std::ptrdiff_t>(y) * cairo_image_surface_get_stride(surface.get());
    for (int x = 0; x < pixels.width; ++x) {
      std::uint32_t pixel = 0;
      std::memcpy(&pixel, row + 4 * x, 4);
      pixels.rgb.push_back(pixel & 0xffffff);
    }
  }
  return pixels;
}

/// Pixels that differ between two pictures of one size.
inline std::size_t difference(const std::string& a, const std::string& b) {
  const Pixels p = decode(a), q = decode(b);
  std::size_t n = 0;
  for (std::size_t i = 0; i < p.rgb.size(); ++i)
    n += p.rgb[i] != q.rgb[i];
  return n;
}

inline Picture sized(int width = 800, int height = 600, ViewFrom from = ViewFrom::top) {
  Picture picture;
  picture.width = width;
  picture.height = height;
  picture.from = from;
  return picture;
}

inline Aabb box_at(double x, double y, double size = 1) {
  return {{x, y, 0}, {x + size, y + size, size}};
}

inline bool is_like(std::uint32_t rgb, const Colour& colour) {
  for (int k = 0; k < 3; ++k) {
    const double channel = (rgb >> (16 - 8 * k) & 0xff) / 255.0;
    if (std::abs(channel - static_cast<double>(colour[k])) > 0.25) return false;
  }
  return true;
}

}  // namespace pcl_bv::test
