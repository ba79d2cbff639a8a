// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Letters are strokes of our own: fonts differ from machine to machine, and finding one takes longer than a
// picture.

#include "picture_parts.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <string>
#include <string_view>

namespace pcl_bv {
namespace {

constexpr double margin_pixels = 30, axis_length = 44, letter_width = 6.4, letter_height = 9.6;

// Lines from point to point, "xy" with x from 0 to 4 and y from 0, above, to 6; a bar begins a new one.
struct Letter {
  char name;
  std::string_view strokes;
};
constexpr Letter letters[] = {{'0', "10 30 41 45 36 16 05 01 10"},
                              {'1', "11 20 26"},
                              {'2', "01 10 30 41 42 06 46"},
                              {'3', "01 10 30 41 42 33 13 33 44 45 36 16 05"},
                              {'4', "36 30 04 44"},
                              {'5', "40 00 02 32 43 45 36 16 05"},
                              {'6', "40 20 02 05 16 36 45 44 33 03"},
                              {'7', "00 40 16"},
                              {'8', "13 02 01 10 30 41 42 33 13 04 05 16 36 45 44 33"},
                              {'9', "06 26 44 41 30 10 01 02 13 43"},
                              {'.', "26 26"},
                              {'-', "13 33"},
                              {'+', "03 43|21 25"},
                              {'e', "04 44 43 32 12 03 05 16 36"},
                              {'x', "02 46|06 42"},
                              {'y', "02 24|42 06"},
                              {'z', "02 42 06 46"}};

void add_letter(cairo_t* cairo, char name, double x, double y) {
  const Letter* letter = std::find_if(std::begin(letters), std::end(letters),
                                      [&](const Letter& known) { return known.name == name; });
  if (letter == std::end(letters)) return;
  bool first = true;
  for (std::size_t i = 0; i + 1 < letter->strokes.size(); i += 3) {
    const double at_x = x + (letter->strokes[i] - '0') * letter_width / 4;
    const double at_y = y + (letter->strokes[i + 1] - '0') * letter_height / 6;
    first ? cairo_move_to(cairo, at_x, at_y) : cairo_line_to(cairo, at_x, at_y);
    first = i + 2 < letter->strokes.size() && letter->strokes[i + 2] == '|';
  }
}

// The upper left corner of the text is at (x, y).
void add_text(cairo_t* cairo, std::string_view text, double x, double y) {
  for (const char letter : text) {
    add_letter(cairo, letter, x, y);
    x += letter_width + 3.2;
  }
}

void stroke(cairo_t* cairo, double red, double green, double blue) {
  cairo_set_line_width(cairo, 4);
  cairo_set_source_rgba(cairo, 0.03, 0.04, 0.07, 0.7);
  cairo_stroke_preserve(cairo);
  cairo_set_line_width(cairo, 1.6);
  cairo_set_source_rgb(cairo, red, green, blue);
  cairo_stroke(cairo);
}

// Red, green and blue, as in RViz and CloudCompare; those that point at the viewer are drawn last.
void draw_axes(cairo_t* cairo, const View& view, double x, double y) {
  constexpr double colours[3][3] = {{0.95, 0.35, 0.35}, {0.45, 0.85, 0.4}, {0.42, 0.6, 1.0}};
  int order[3] = {0, 1, 2};
  std::stable_sort(std::begin(order), std::end(order),
                   [&](int a, int b) { return view.toward[a] < view.toward[b]; });
  for (const int axis : order) {
    const double across = view.right[axis], down = -view.up[axis];
    if (across * across + down * down < 0.01) continue;
    cairo_move_to(cairo, x, y);
    cairo_line_to(cairo, x + axis_length * across, y + axis_length * down);
    add_letter(cairo, "xyz"[axis], x + (axis_length + 13) * across - letter_width / 2,
               y + (axis_length + 13) * down - letter_height * 2 / 3);
    stroke(cairo, colours[axis][0], colours[axis][1], colours[axis][2]);
  }
}

// The greatest of 1, 2 and 5 times a power of ten that is at most this.
double round_length(double most) {
  const double power = std::pow(10.0, std::floor(std::log10(most)));
  for (const double digit : {5.0, 2.0}) {
    if (digit * power <= most) return digit * power;
  }
  return power;
}

void draw_scale(cairo_t* cairo, const View& view, double x, double y) {
  constexpr double longest = 180, tick = 5;
  const double length = round_length(longest / view.scale);
  const double pixels = length * view.scale;
  if (!(pixels > 1) || !(pixels <= longest * 1.01)) return;  // of a scene beyond what can be written
  cairo_move_to(cairo, x, y - tick);
  cairo_line_to(cairo, x, y);
  cairo_line_to(cairo, x + pixels, y);
  cairo_line_to(cairo, x + pixels, y - tick);
  char digits[32];
  const auto written = std::to_chars(digits, digits + sizeof digits, length, std::chars_format::general, 3);
  add_text(cairo, {digits, static_cast<std::size_t>(written.ptr - digits)}, x + 8, y - letter_height - 5);
  stroke(cairo, 0.86, 0.88, 0.92);
}

}  // namespace

void draw_marks(cairo_t* cairo, const View& view) {
  if (view.width < 480 || view.height < 320) return;
  const double bottom = view.height - margin_pixels;
  const double axes_x = margin_pixels + axis_length, axes_y = bottom - axis_length;
  draw_axes(cairo, view, axes_x, axes_y);
  draw_scale(cairo, view, axes_x + axis_length + 46, bottom);
}

}  // namespace pcl_bv
