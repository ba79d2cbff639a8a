// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Many inputs as one cloud: numbered through in their order, none of it held.
#pragma once

#include <atomic>
#include <cstddef>
#include <functional>
#include <list>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "inputs.h"
#include "pcl_bv/io/io_error.h"
#include "pcl_bv/points/point_source.h"

namespace pcl_bv {

/// One of the inputs, without its points.
struct TileHeader {
  std::size_t points = 0;
  ScalarType scalar = ScalarType::float32;
  bool by_position = false;            ///< As CloudHeader has it.
  std::optional<std::string> error{};  ///< Why it is left out; then there are no points.
  std::string note{};                  ///< As RawCloud has it, as far as the header says.
};

/// Reads no points of files; generated clouds and those of recordings are made, counted and dropped.
TileHeader describe_tile(const Job& job);

/// What reading one of the inputs threw.
class TileError : public IoError {
 public:
  TileError(std::size_t tile, const std::string& reason) : IoError(reason), tile_(tile) {}
  std::size_t tile() const { return tile_; }

 private:
  std::size_t tile_;
};

/// Numbers of points, from .first to before .second.
using PointRange = std::pair<std::size_t, std::size_t>;

/// Files that can be read by position are; of the others (ascii, compressed, .ply, .las, and small ones) each
/// pass reads all and holds few at a time. If one has doubles, all are read as doubles.
class Tiles final : public PointSource {
 public:
  /// `threads`: how many may load at a time, so how many tiles are kept open.
  Tiles(std::vector<Job> jobs, std::vector<TileHeader> headers, std::size_t threads);

  /// All points. Dies with this object, and changes where a tile is left out.
  PointView xyz() const { return view_of(*this, offsets_.back(), scalar_); }

  const std::vector<Job>& jobs() const { return jobs_; }
  const TileHeader& header(std::size_t tile) const { return headers_[tile]; }

  /// Inputs that are not left out.
  std::size_t used() const;

  /// What was noticed about an input so far, as RawCloud::note.
  std::string note(std::size_t tile) const;

  /// From here on its points are not of the cloud; those behind it have lesser numbers.
  void leave_out(std::size_t tile, const std::string& reason);

  /// Of `shares` of about as many points each, which cover the cloud, the one with this number. They begin
  /// where chunks of a file do, or where an input does that can only be read from its beginning.
  PointRange share(std::size_t number, std::size_t shares) const;

  /// Throws TileError, also for a file that is not what it was when it was first opened.
  PointView load(std::size_t first, std::size_t count, std::vector<std::byte>& buffer) const override;

  /// Throws TileError if a file that was read has been changed since.
  void require_unchanged() const;

  /// Called with the number of points loaded so far, now and then, by any thread.
  std::function<void(std::size_t points)> on_loaded;

 private:
  struct Opened;
  struct Slot;
  struct Identity {
    long long size = -1, modified = 0, changed = 0, number = 0;
    bool operator==(const Identity& other) const = default;
  };

  void number_points();
  std::size_t tile_of(std::size_t point) const;
  std::size_t share_begin(std::size_t number, std::size_t shares) const;
  std::shared_ptr<const Opened> open(std::size_t tile) const;
  Opened open_now(std::size_t tile) const;
  Identity identity_of(std::size_t tile) const;
  void copy(std::size_t tile, std::size_t first, std::size_t count, std::byte* to) const;
  void count_loaded(std::size_t points) const;

  std::vector<Job> jobs_;
  std::vector<TileHeader> headers_;
  std::vector<std::size_t> offsets_;  // of each input, and the number of all points
  ScalarType scalar_ = ScalarType::float32;
  std::size_t most_open_;

  mutable std::mutex mutex_;
  mutable std::list<std::shared_ptr<Slot>> open_;  // the one asked for last comes first
  mutable std::vector<Identity> identities_;       // of each input that has been opened
  mutable std::vector<std::string> notes_;         // of each input that is read whole
  mutable std::atomic<std::size_t> loaded_ = 0;
};

}  // namespace pcl_bv
