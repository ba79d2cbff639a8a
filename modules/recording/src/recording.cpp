// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "pcl_bv/recording/recording.h"

#include <fstream>

#include "formats.h"
#include "pcl_bv/io/raw_cloud.h"

namespace pcl_bv {
using namespace detail;
namespace {

// Returns the first 64 bytes of a regular file. Returns an empty text for any other file, because reading a
// pipe would block or take data from the pipe.
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
    if (format.matches(file, start)) return &format;
  }
  return nullptr;
}

std::string known_formats() {
  std::string names;
  for (const RecordingFormat& format : recording_formats())
    names += (names.empty() ? "" : ", ") + std::string(format.name);
  return names;
}

}  // namespace

bool is_recording(const std::filesystem::path& file) {
  return format_of(file) != nullptr;
}

std::unique_ptr<RecordingReader> open_recording(const std::filesystem::path& file) {
  std::error_code unknown;
  if (!std::filesystem::exists(file, unknown)) throw IoError("no such file or folder");
  const RecordingFormat* const format = format_of(file);
  if (format == nullptr) throw IoError("unknown recording format; known are: " + known_formats());
  return format->open(file);
}

}  // namespace pcl_bv
