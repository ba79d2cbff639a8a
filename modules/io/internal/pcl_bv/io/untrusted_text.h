// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Reads untrusted text. Checks the text's size and nesting depth before any library parses it, and keeps
// messages that quote the text on one line.
#pragma once

#include <cstddef>
#include <exception>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "pcl_bv/io/raw_cloud.h"

namespace pcl_bv {
namespace [[gnu::visibility("default")]] detail {

inline constexpr std::size_t kMaxConfigBytes = std::size_t{1} << 20;  ///< Settings as YAML.
/// Maximum for metadata.yaml of rosbag2. It is large, because the file may contain the definitions of message
/// types.
inline constexpr std::size_t kMaxMetadataBytes = std::size_t{16} << 20;
inline constexpr std::size_t kMaxVolumesBytes = std::size_t{1} << 30;         ///< JSON with volumes.
inline constexpr std::size_t kMaxPartialHeaderBytes = std::size_t{64} << 20;  ///< Header of partial results.
inline constexpr std::size_t kMaxPosesBytes = std::size_t{1} << 30;           ///< Poses and calibrations.
/// Maximum nesting depth of JSON, small enough for recursive functions over a value. pcl_bv's reports nest 8
/// deep.
inline constexpr int kMaxJsonDepth = 64;

/// Returns the content of a file or a pipe. Never reads more than `max_bytes` + 1 bytes. Throws IoError, such
/// as "no such file or directory" or "has more than 1048576 bytes".
std::string read_untrusted_text(const std::filesystem::path& path, std::size_t max_bytes);

/// Returns the text of the JSON value that begins at `text[at]` or after white space there, and moves `at` to
/// the end of the value. Skips a byte order mark at the beginning of `text`. Only quotes and brackets are
/// inspected, so the value may be invalid JSON. Returns an empty text at the end of `text`. Throws IoError if
/// the value is nested more than kMaxJsonDepth deep. Takes linear time and allocates nothing.
std::string_view next_json_value(std::string_view text, std::size_t& at);

/// Returns the position of byte `at` as text, such as "line 2, column 7". Lines and columns are counted from
/// 1.
std::string position_in(std::string_view text, std::size_t at);

/// Returns the text with `?` in place of each control character. A control character would break the line of
/// a message, or control a terminal. UTF-8 is unchanged.
std::string printable(std::string text);

inline constexpr std::size_t kMaxMessageBytes = 500;  ///< Of a message in one line.
inline constexpr std::size_t kMaxNameBytes = 120;     ///< Of a name in it: bytes without a blank.

/// Returns a message as one line of at most kMaxMessageBytes, with `?` in place of control characters. Names
/// of files, topics and keys may have any length: names of more than kMaxNameBytes and longer lines lose
/// their middle, which becomes "...". Characters of UTF-8 stay whole.
std::string message_line(std::string_view text);

/// Returns what() of an error, or "not enough memory" for a failed allocation, also one of more than a standard
/// container can hold: their what() is only a name in C++.
std::string reason_of(const std::exception& error);

/// Returns the names as "a, b, c". Of more than 8 names, returns the first 8 and the number of the others.
std::string name_list(const std::vector<std::string>& names);

}  // namespace detail
}  // namespace pcl_bv
