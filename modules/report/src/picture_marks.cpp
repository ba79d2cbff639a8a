// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include <Eigen/Geometry>
#include <algorithm>
#include <charconv>
#include <cmath>
#include <string>

#include "picture_parts.h"

namespace pcl_bv::detail {
namespace {

constexpr double margin = 30, axis_length = 44, text_size = 13, cap_height = 10, row_height = 22;
constexpr Colour plain{0.86f, 0.88f, 0.92f};

using Box = Eigen::AlignedBox2d;

class Marks {
 public:
  Marks(cairo_t* cairo, const View& view) : cairo_(cairo), view_(view), bottom_(view.height - margin) {
    // Cairo's built-in font is the same on all machines. Finding any other font takes longer than drawing a
    // picture.
    cairo_select_font_face(cairo, "@cairo:", CAIRO_FONT_SLANT_NORMAL, CAIRO_FONT_WEIGHT_BOLD);
    cairo_set_font_size(cairo, text_size);
  }

  void draw_axes();
  void draw_scale(const std::string& unit);
  void draw_legend(const std::vector<std::string>& methods, const Styles& styles);
  void draw_labels(const std::vector<PictureVolume>& volumes);

 private:
  double width_of(const std::string& text) const {
    cairo_text_extents_t extents;
    cairo_text_extents(cairo_, text.c_str(), &extents);
    return extents.x_advance;
  }

  Box box_of(const std::string& text, double x, double y) const {
    return {Eigen::Vector2d(x - 3, y - cap_height - 3), Eigen::Vector2d(x + width_of(text) + 3, y + 4)};
  }

  void darken(const Box& box) {
    cairo_rectangle(cairo_, box.min().x(), box.min().y(), box.sizes().x(), box.sizes().y());
    cairo_set_source_rgba(cairo_, 0.03, 0.04, 0.07, 0.75);
    cairo_fill(cairo_);
    occupied_.push_back(box);
  }

  /// Writes a text whose baseline starts at x, y.
  void write(const std::string& text, double x, double y, const Colour& colour) {
    cairo_set_source_rgb(cairo_, colour[0], colour[1], colour[2]);
    cairo_move_to(cairo_, x, y);
    cairo_show_text(cairo_, text.c_str());
  }

  void line(double x0, double y0, double x1, double y1) {
    cairo_move_to(cairo_, x0, y0);
    cairo_line_to(cairo_, x1, y1);
  }

  cairo_t* cairo_;
  const View& view_;
  double bottom_;
  std::vector<Box> occupied_;  ///< Areas with text or marks, which labels must not overlap.
};

/// Replaces characters that Cairo's built-in font does not have by '?'.
std::string readable(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c < ' ' || c > '~'; }, '?');
  return text;
}

// Draws the axes in the colours of RViz and CloudCompare. The axis that points most towards the viewer is
// drawn last, so that it is on top.
void Marks::draw_axes() {
  constexpr Colour colours[3] = {{0.95f, 0.35f, 0.35f}, {0.45f, 0.85f, 0.4f}, {0.42f, 0.6f, 1.0f}};
  const double axis_extent = axis_length + 13, x = margin + axis_length, y = bottom_ - axis_length;
  int order[3] = {0, 1, 2};
  std::stable_sort(std::begin(order), std::end(order),
                   [&](int a, int b) { return view_.toward[a] < view_.toward[b]; });
  for (const int axis : order) {
    const double dx = view_.right[axis], dy = -view_.up[axis];
    if (dx * dx + dy * dy < 0.01) continue;
    line(x, y, x + axis_length * dx, y + axis_length * dy);
    stroke(cairo_, colours[axis], true);
    const std::string name(1, "xyz"[axis]);
    const double left = x + axis_extent * dx - width_of(name) / 2,
                 foot = y + axis_extent * dy + cap_height / 3;
    darken(box_of(name, left, foot));
    write(name, left, foot, colours[axis]);
  }
  occupied_.emplace_back(Eigen::Vector2d(x - axis_extent, y - axis_extent),
                         Eigen::Vector2d(x + axis_extent, y + axis_extent));
}

// Returns the largest number of the form 1, 2 or 5 times a power of ten that is not larger than `most`.
double round_length(double most) {
  const double power = std::pow(10.0, std::floor(std::log10(most)));
  for (const double digit : {5.0, 2.0}) {
    if (digit * power <= most) return digit * power;
  }
  return power;
}

void Marks::draw_scale(const std::string& unit) {
  constexpr double longest = 180, tick = 5, x = margin + 2 * axis_length + 46;
  const double length = round_length(longest / view_.scale);
  const double pixels = length * view_.scale;
  if (!(pixels > 1) || !(pixels <= longest * 1.01)) return;  // the scene size exceeds the range of doubles
  line(x, bottom_ - tick, x, bottom_);
  cairo_line_to(cairo_, x + pixels, bottom_);
  cairo_line_to(cairo_, x + pixels, bottom_ - tick);
  stroke(cairo_, plain, true);
  char digits[32];
  const auto written = std::to_chars(digits, digits + sizeof digits, length, std::chars_format::general, 3);
  const std::string text = std::string(digits, written.ptr) + (unit.empty() ? "" : " " + readable(unit));
  occupied_.push_back(box_of(text, x + 8, bottom_ - 6).extend(Eigen::Vector2d(x + pixels, bottom_)));
  write(text, x + 8, bottom_ - 6, plain);
}

void Marks::draw_legend(const std::vector<std::string>& methods, const Styles& styles) {
  if (styles.colour_of.size() < 2) return;
  constexpr double sample = 52;
  double x = margin, y = margin, widest = 0;
  for (const auto& [method, number] : styles.colour_of) {
    if (method >= methods.size()) continue;
    if (y > bottom_ - kMarkMargin) {  // begin a new column
      x += sample + 24 + widest;
      y = margin, widest = 0;
    }
    const Colour colour = styles.by_colour ? palette(number) : plain;
    const std::string name = readable(methods[method]);
    darken(box_of(name, x + sample + 12, y).extend(Eigen::Vector2d(x - 6, y)));
    line(x, y - cap_height / 2, x + sample, y - cap_height / 2);
    stroke(cairo_, colour, true, styles.dash(method));
    write(name, x + sample + 12, y, plain);
    widest = std::max(widest, width_of(name));
    y += row_height;
  }
}

void Marks::draw_labels(const std::vector<PictureVolume>& volumes) {
  const Box frame(Eigen::Vector2d(0, 0), Eigen::Vector2d(view_.width, view_.height));
  // A label is above the volume's highest point. In a view from above, it is above the volume's upper edge in
  // the picture.
  const Eigen::Vector3d& rise = view_.world_up.dot(view_.toward) > 0.9 ? view_.up : view_.world_up;
  for (const PictureVolume& entry : volumes) {
    if (entry.label.empty() || empty(entry.volume)) continue;
    const Eigen::Vector3d middle = center(entry.volume);
    const Eigen::Vector2d at = view_.project(middle).head<2>();
    if (!frame.contains(at)) continue;
    const std::string text = readable(entry.label);
    const double width = width_of(text);
    const double height = (support(entry.volume, rise) - middle).dot(rise);
    const double top = view_.project(middle + height * rise).y();
    const double x = std::max(4.0, std::min(at.x() - width / 2, view_.width - width - 4));
    const double y = std::max(cap_height + 4, top - 7);
    const Box box = box_of(text, x, y);
    if (std::any_of(occupied_.begin(), occupied_.end(),
                    [&](const Box& other) { return other.intersects(box); }))
      continue;
    darken(box);
    write(text, x, y, palette(entry.colour));
  }
}

}  // namespace

void draw_marks(cairo_t* cairo, const Picture& picture, const View& view, const Styles& styles) {
  Marks marks(cairo, view);
  marks.draw_axes();
  marks.draw_scale(picture.unit);
  marks.draw_legend(picture.methods, styles);
  marks.draw_labels(picture.volumes);
}

}  // namespace pcl_bv::detail
