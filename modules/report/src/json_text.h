// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Writes JSON directly into a text, because a library's tree of values took 1.5 kB per cluster and most of
// the time of a report.
#pragma once

#include <Eigen/Core>
#include <array>
#include <charconv>
#include <concepts>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "formatting.h"

namespace pcl_bv::detail {

/// Returns the number of bytes of the valid UTF-8 character at the beginning of `text`. If there is no valid
/// character, returns 0 and sets `tried` to the number of bytes of the invalid sequence.
inline std::size_t utf8_length(std::string_view text, std::size_t& tried) {
  const auto byte = [&](std::size_t i) { return i < text.size() ? static_cast<unsigned char>(text[i]) : 0U; };
  const unsigned first = byte(0);
  tried = 1;
  if (first < 0x80) return 1;
  const std::size_t length = first >= 0xF0 ? 4 : first >= 0xE0 ? 3 : 2;
  if (first < 0xC2 || first > 0xF4) return 0;
  const unsigned lowest = first == 0xE0 ? 0xA0 : first == 0xF0 ? 0x90 : 0x80;
  const unsigned highest = first == 0xED ? 0x9F : first == 0xF4 ? 0x8F : 0xBF;
  if (byte(1) < lowest || byte(1) > highest) return 0;
  for (tried = 2; tried < length; ++tried) {
    if ((byte(tried) & 0xC0) != 0x80) return 0;
  }
  return length;
}

/// Appends JSON values to a text, with the commas between them.
class JsonText {
 public:
  explicit JsonText(std::string& text) : text_(text) {}

  JsonText& begin(char bracket) {
    separate();
    text_ += bracket;
    first_ = true;
    return *this;
  }

  JsonText& end(char bracket) {
    text_ += bracket;
    first_ = false;
    return *this;
  }

  JsonText& key(std::string_view name) {
    value(name);
    text_ += ':';
    first_ = true;
    return *this;
  }

  template <typename T>
  JsonText& add(std::string_view name, const T& what) {
    key(name).value(what);
    return *this;
  }

  /// Appends a value that is JSON already.
  JsonText& raw(std::string_view json) {
    literal(json);
    return *this;
  }

  void value(double number) {
    separate();
    append_shortest(number, text_);
  }

  void value(std::integral auto number) {
    separate();
    char digits[24];
    text_.append(digits, std::to_chars(digits, digits + sizeof digits, number).ptr);
  }

  void value(bool yes) { literal(yes ? "true" : "false"); }
  void value(std::nullptr_t) { literal("null"); }

  /// Appends a string. Each invalid UTF-8 sequence is replaced by U+FFFD. An invalid sequence is the longest
  /// beginning of a character or, if there is none, a single byte.
  void value(std::string_view text) {
    separate();
    text_ += '"';
    std::size_t tried = 0;
    for (std::size_t i = 0; i < text.size(); i += tried) {
      const std::size_t length = utf8_length(text.substr(i), tried);
      if (length == 0) {
        text_ += "\xEF\xBF\xBD";
      } else if (length == 1) {
        append_ascii(text[i]);
      } else {
        text_.append(text, i, tried = length);
      }
    }
    text_ += '"';
  }
  void value(const std::string& text) { value(std::string_view(text)); }
  void value(const char* text) { value(std::string_view(text)); }

  template <typename Derived>
  void value(const Eigen::DenseBase<Derived>& vector) {
    begin('[');
    for (Eigen::Index i = 0; i < vector.size(); ++i)
      value(vector.derived()[i]);
    end(']');
  }
  template <typename T, std::size_t N>
  void value(const std::array<T, N>& list) {
    list_of(list);
  }
  template <typename T>
  void value(const std::vector<T>& list) {
    list_of(list);
  }

 private:
  void separate() {
    if (!first_) text_ += ',';
    first_ = false;
  }

  void literal(std::string_view word) {
    separate();
    text_ += word;
  }

  template <typename List>
  void list_of(const List& list) {
    begin('[');
    for (const auto& item : list)
      value(item);
    end(']');
  }

  void append_ascii(char c) {
    constexpr std::string_view named = "\"\\\b\f\n\r\t", names = "\"\\bfnrt", digits = "0123456789abcdef";
    const std::size_t which = named.find(c);
    if (which != std::string_view::npos) {
      text_.append({'\\', names[which]});
    } else if (static_cast<unsigned char>(c) < 0x20) {
      text_.append("\\u00").append({digits[static_cast<unsigned char>(c) >> 4], digits[c & 15]});
    } else {
      text_ += c;
    }
  }

  std::string& text_;
  bool first_ = true;
};

}  // namespace pcl_bv::detail
