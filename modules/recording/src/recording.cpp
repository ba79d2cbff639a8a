// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "pcl_bv/recording/recording.h"

#include <algorithm>
#include <fstream>

#include "formats.h"
#include "pcl_bv/io/io_error.h"

namespace pcl_bv {
namespace {

// Of a regular file only: a pipe would wait, or lose what is read from it.
std::string start_of(const std::filesystem::path& file) {
  std::error_code unknown;
  if (!std::filesystem::is_regular_file(file, unknown)) return {};
  std::ifstream stream(file, std::ios::binary);
  std::string start(64, '\0');
  stream.read(start.data(), static_cast<std::streamsize>(start.size()));
  start.resize(static_cast<std::size_t>(stream.gcount()));
  return start;
}

const RecordingFormat* format_of(const std::filesystem::path& file) {
  const std::string start = start_of(file);
  for (const RecordingFormat& format : recording_formats()) {
    if (format.knows(file, start)) return &format;
  }
  return nullptr;
}

std::string known_formats() {
  std::string names;
  for (const RecordingFormat& format : recording_formats())
    names += (names.empty() ? "" : ", ") + std::string(format.name);
  return names;
}

constexpr std::size_t kListed = 10;  // warnings, so that damaged input cannot fill memory or a log

}  // namespace

void WarningList::add(std::string line) {
  if (lines_.size() < kListed) {
    lines_.push_back(std::move(line));
  } else {
    add_unlisted(1);
  }
}

void WarningList::add_new_of(const WarningList& other, std::uint64_t& added, const std::string& prefix) {
  const std::uint64_t listed = std::min<std::uint64_t>(kListed, other.lines_.size());
  for (; added < listed; ++added)
    add(prefix + other.lines_[added]);
  const std::uint64_t all = listed + other.unlisted_;
  if (all > added) add_unlisted(all - added);
  added = std::max(added, all);
}

void WarningList::add_unlisted(std::uint64_t number) {
  if (unlisted_ == 0) lines_.emplace_back();
  unlisted_ += number;
  lines_.back() = "further warnings are not listed: " + std::to_string(unlisted_) + " so far";
}

bool is_recording(const std::filesystem::path& file) {
  return format_of(file) != nullptr;
}

std::unique_ptr<RecordingReader> open_recording(const std::filesystem::path& file) {
  std::error_code unknown;
  if (!std::filesystem::exists(file, unknown)) throw IoError("no such file or folder");
  const RecordingFormat* const format = format_of(file);
  if (format == nullptr) throw IoError("no recording that is known: " + known_formats());
  return format->open(file);
}

}  // namespace pcl_bv
