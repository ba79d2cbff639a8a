// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// A cloud tiled over several inputs. The points of all inputs are numbered consecutively and loaded when they
// are needed.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <list>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "inputs.h"
#include "pcl_bv/io/raw_cloud.h"
#include "pcl_bv/points/point_source.h"

namespace pcl_bv::detail {

/// One input (tile) without its points.
struct TileHeader {
  std::size_t points = 0;
  ScalarType scalar = ScalarType::float32;
  bool random_access = false;          ///< Whether parts are read by position (CloudHeader).
  std::optional<std::string> error{};  ///< Why the input is excluded; excluded inputs have no points.
  std::string note{};                  ///< As RawCloud::note, but from the header only.
};

/// Describes an input without reading the points of a file. Clouds that are generated or recorded are loaded,
/// counted and freed.
TileHeader describe_tile(const Job& job);

/// An error while reading one of the inputs.
class TileError : public IoError {
 public:
  TileError(std::size_t tile, const std::string& reason) : IoError(reason), tile_(tile) {}
  std::size_t tile() const { return tile_; }

 private:
  std::size_t tile_;
};

/// A range of point numbers. It includes .first and does not include .second.
using PointRange = std::pair<std::size_t, std::size_t>;

/// The points of all inputs. Files that can be read by position are read in parts. All other inputs (ascii,
/// compressed, .ply, .las, .laz, and small ones) are read completely in each pass, and only a small number of
/// them is in memory at the same time. If one input has float64 coordinates, all inputs are read as float64.
class Tiles final : public PointSource {
 public:
  /// `threads` is the number of threads that call load() at the same time. It determines how many tiles stay
  /// open.
  Tiles(std::vector<Job> jobs, std::vector<TileHeader> headers, std::size_t threads);

  /// Returns a view of all points, which is valid until exclude() is called or this object is destroyed.
  PointView xyz() const { return view_of(*this, offsets_.back(), scalar_); }

  const std::vector<Job>& jobs() const { return jobs_; }
  const TileHeader& header(std::size_t tile) const { return headers_[tile]; }

  /// Returns the numbers of the points of an input.
  PointRange points_of(std::size_t tile) const { return {offsets_[tile], offsets_[tile + 1]}; }

  /// Returns the number of inputs that are not excluded.
  std::size_t included_count() const;

  /// Returns the warnings about an input that are known so far, as in RawCloud::note.
  std::string note(std::size_t tile) const;

  /// Excludes an input from the cloud. The points of later inputs are renumbered.
  void exclude(std::size_t tile, const std::string& reason);

  /// Returns share `number` of `shares` shares. The shares cover the cloud and have about the same number of
  /// points. In a file that can be read by position, a share begins at the beginning of a chunk. In any other
  /// input, a share can begin only at the beginning of the input.
  PointRange share(std::size_t number, std::size_t shares) const;

  /// Loads points. Throws TileError if an input cannot be read or has changed since it was first opened.
  PointView load(std::size_t first, std::size_t count, std::vector<std::byte>& buffer) const override;

  /// Replaces `values` by the values of an integer field of points [first, first + count). Throws TileError
  /// as load() does, and for an input with points whose field cannot be used (integer_field()).
  void load_integers(const std::string& field, std::size_t first, std::size_t count,
                     std::vector<std::int64_t>& values) const;

  /// Throws TileError if a file has changed since it was first opened.
  void require_unchanged() const;

  /// If set, called after every few million points, by any thread, with the number of points loaded so far.
  std::function<void(std::size_t points)> on_loaded;

 private:
  struct OpenTile;
  struct Slot;
  struct Identity {
    long long size = -1, modified = 0, changed = 0, number = 0;
    bool operator==(const Identity& other) const = default;
  };

  void number_points();
  std::size_t tile_of(std::size_t point) const;
  std::size_t share_begin(std::size_t number, std::size_t shares) const;
  std::shared_ptr<const OpenTile> open(std::size_t tile) const;
  OpenTile open_now(std::size_t tile) const;
  Identity identity_of(std::size_t tile) const;
  template <typename Copy>
  void for_each_tile(std::size_t first, std::size_t count, const Copy& copy) const;
  void copy(std::size_t tile, std::size_t first, std::size_t count, std::byte* to) const;
  void count_loaded(std::size_t points) const;

  std::vector<Job> jobs_;
  std::vector<TileHeader> headers_;
  std::vector<std::size_t> offsets_;  // first point of each input, then the number of all points
  ScalarType scalar_ = ScalarType::float32;
  std::size_t max_open_;

  mutable std::mutex mutex_;
  mutable std::list<std::shared_ptr<Slot>> open_;  // most recently used first
  mutable std::vector<Identity> identities_;       // one per input; Identity() until the input is opened
  mutable std::vector<std::string> notes_;         // one per input; empty until the input is read completely
  mutable std::atomic<std::size_t> loaded_ = 0;
};

}  // namespace pcl_bv::detail
