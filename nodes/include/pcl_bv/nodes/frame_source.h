// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Where frames come from.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>

#include "pcl_bv/nodes/frame.h"

namespace [[gnu::visibility("default")]] pcl_bv {

/// A frame that its source has not been able to read; the next one may be fine. what() names it and says why.
class FrameError : public std::runtime_error {
 public:
  FrameError(FrameHeader frame_header, const std::string& what)
      : std::runtime_error(what), header(std::move(frame_header)) {}
  FrameHeader header;
};

class FrameSource {
 public:
  virtual ~FrameSource() = default;

  /// Replaces `frame` by the next one; false at the end. Throws FrameError for a frame that cannot be read;
  /// the next call gives the one after it.
  virtual bool next(Frame& frame) = 0;
};

inline constexpr double kLeastRate = 1e-3, kGreatestRate = 1e6;

/// How files become frames.
struct ReplayOptions {
  double rate_hz = 10;  ///< Frames a second, 0.001 to 1000000: frame n is n / rate_hz after the first.
  /// From the last number in the file's name instead: whole ones are nanoseconds, with a point seconds. A
  /// name without a number is a FrameError.
  bool from_name = false;
  std::size_t bin_fields = 0;  ///< As read_cloud() takes it.
};

/// The clouds of a folder in natural order, or one file, `loops` times over (at least once). Throws IoError
/// if there is no cloud, std::invalid_argument for a rate out of range.
std::unique_ptr<FrameSource> open_folder(const std::filesystem::path& path, const ReplayOptions& stamps = {},
                                         std::size_t loops = 1);

/// `street-sequence[:FRAMES[:SEED]]`, each frame made when it is asked for. Throws std::invalid_argument for
/// another name and as open_folder().
std::unique_ptr<FrameSource> open_synth(std::string_view name, const ReplayOptions& stamps = {},
                                        std::size_t loops = 1);

/// open_synth() for what begins with "synth:", else open_folder().
std::unique_ptr<FrameSource> open_source(const std::string& name, const ReplayOptions& stamps = {},
                                         std::size_t loops = 1);

/// What the function gives, until it returns false. It may throw FrameError.
std::unique_ptr<FrameSource> make_source(std::function<bool(Frame&)> next);

/// The stamp in a file's name without its extension, as ReplayOptions says; nanoseconds, -1 without one.
std::int64_t stamp_in_name(std::string_view stem);

}  // namespace pcl_bv
