// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// One pass over the text with std::from_chars.
#include "text_rows.h"

#include <cstring>

#include "element_type.h"
#include "numbers.h"

namespace pcl_bv {
namespace {

bool is_blank(char c) {
  return c == ' ' || c == '\t' || c == '\r' || c == '\v' || c == '\f';
}

}  // namespace

bool TextRows::find_row() {
  while (at_ != end_ && (is_blank(*at_) || *at_ == '\n'))
    ++at_;
  return at_ != end_;
}

bool TextRows::find_value() {
  while (at_ != end_ && is_blank(*at_))
    ++at_;
  return at_ != end_ && *at_ != '\n';
}

bool TextRows::read(const PointField& field, std::byte* to) {
  const char* after = with_element_type(field, [&](auto value) {
    const char* stop = parse_number(at_, end_, value);
    std::memcpy(to, &value, sizeof value);
    return stop;
  });
  if (!after || (after != end_ && *after != '\n' && !is_blank(*after))) return false;
  at_ = after;
  return true;
}

void TextRows::skip_value() {
  at_ += value().size();
}

void TextRows::skip_row() {
  const void* newline = at_ == end_ ? nullptr : std::memchr(at_, '\n', static_cast<std::size_t>(end_ - at_));
  at_ = newline ? static_cast<const char*>(newline) : end_;
}

std::string_view TextRows::value() const {
  const char* stop = at_;
  while (stop != end_ && *stop != '\n' && !is_blank(*stop))
    ++stop;
  return {at_, static_cast<std::size_t>(stop - at_)};
}

}  // namespace pcl_bv
