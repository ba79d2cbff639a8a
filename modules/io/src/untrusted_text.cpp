// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "pcl_bv/io/untrusted_text.h"

#include <algorithm>
#include <cerrno>
#include <fstream>
#include <new>
#include <stdexcept>
#include <utility>

#include "pcl_bv/io/posix_file.h"

namespace pcl_bv::detail {
namespace {

constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";  // of UTF-8, which some editors write
constexpr std::string_view kSpace = " \t\r\n";
constexpr std::string_view kEndsScalar = "\"[]{} \t\r\n";

// Returns the position behind the closing quote of the string that begins at `at`.
std::size_t end_of_string(std::string_view text, std::size_t at) {
  for (++at; at < text.size() && text[at] != '"'; ++at)
    at += text[at] == '\\';
  return std::min(at + 1, text.size());
}

bool continues_character(char c) {
  return (static_cast<unsigned char>(c) & 0xC0U) == 0x80;
}

// Returns a text without its middle, in at most `max_bytes`. `before` bytes of it are the beginning.
std::string without_middle(std::string_view text, std::size_t max_bytes, std::size_t before) {
  constexpr std::string_view gap = "...";
  std::size_t head = before, tail = text.size() - (max_bytes - before - gap.size());
  while (head > 0 && continues_character(text[head]))
    --head;
  while (tail < text.size() && continues_character(text[tail]))
    ++tail;
  return std::string(text.substr(0, head)).append(gap).append(text.substr(tail));
}

}  // namespace

std::string read_untrusted_text(const std::filesystem::path& path, std::size_t max_bytes) {
  std::error_code unknown;
  errno = 0;
  std::ifstream stream(path, std::ios::binary);
  if (!stream) throw IoError(errno != 0 ? system_reason(errno) : "cannot be read");
  if (std::filesystem::is_directory(path, unknown)) throw IoError(system_reason(EISDIR));
  std::string text;
  for (std::size_t block = 1 << 12; stream && text.size() <= max_bytes;
       block = std::max(block, text.size())) {
    const std::size_t before = text.size();
    text.resize(std::min(before + block, max_bytes + 1));
    stream.read(text.data() + before, static_cast<std::streamsize>(text.size() - before));
    text.resize(before + static_cast<std::size_t>(stream.gcount()));
  }
  if (stream.bad()) throw IoError("cannot be read");
  if (text.size() > max_bytes) throw IoError("has more than " + std::to_string(max_bytes) + " bytes");
  return text;
}

std::string_view next_json_value(std::string_view text, std::size_t& at) {
  if (at == 0 && text.starts_with(kByteOrderMark)) at = kByteOrderMark.size();
  at = std::min(text.find_first_not_of(kSpace, at), text.size());
  const std::size_t begin = at;
  int depth = 0;
  do {
    if (at == text.size()) break;
    switch (text[at]) {
      case '"':
        at = end_of_string(text, at);
        break;
      case '[':
      case '{':
        if (++depth > kMaxJsonDepth)
          throw IoError(position_in(text, at) + ": nested more than " + std::to_string(kMaxJsonDepth) +
                        " deep");
        ++at;
        break;
      case ']':
      case '}':
        --depth;
        ++at;
        break;
      default:
        at = depth > 0 ? at + 1 : std::min(text.find_first_of(kEndsScalar, at + 1), text.size());
    }
  } while (depth > 0);
  return text.substr(begin, at - begin);
}

std::string position_in(std::string_view text, std::size_t at) {
  const std::string_view before = text.substr(0, std::min(at, text.size()));
  const std::size_t line_begin = before.rfind('\n') + 1;  // 0 if there is no line feed (npos + 1)
  return "line " + std::to_string(std::count(before.begin(), before.end(), '\n') + 1) + ", column " +
         std::to_string(before.size() - line_begin + 1);
}

std::string printable(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](char c) { return (c >= 0 && c < ' ') || c == 0x7F; }, '?');
  return text;
}

std::string message_line(std::string_view text) {
  std::string line;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find_first_of(kSpace, at + 1), text.size());
    const std::string_view name = text.substr(at, end - at);
    line += name.size() > kMaxNameBytes ? without_middle(name, kMaxNameBytes, kMaxNameBytes / 2) : name;
    at = end;
  }
  // The reason is at the end of most messages.
  if (line.size() > kMaxMessageBytes) line = without_middle(line, kMaxMessageBytes, kMaxMessageBytes / 2);
  return printable(std::move(line));
}

std::string reason_of(const std::exception& error) {
  const std::string what = error.what();
  const bool too_long =
      dynamic_cast<const std::length_error*>(&error) != nullptr &&
      what.find("::") != std::string::npos;  // "vector::_M_default_append"; ours are sentences
  const bool no_memory = too_long || dynamic_cast<const std::bad_alloc*>(&error) != nullptr;
  return no_memory ? "not enough memory" : what;
}

std::string name_list(const std::vector<std::string>& names) {
  constexpr std::size_t few = 8;
  std::string list;
  for (std::size_t i = 0; i < std::min(few, names.size()); ++i)
    list += (i == 0 ? "" : ", ") + names[i];
  if (names.size() > few) list += " and " + std::to_string(names.size() - few) + " more";
  return list;
}

}  // namespace pcl_bv::detail
