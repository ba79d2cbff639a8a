// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Clusters of a share of a cloud, which can be joined with those of other shares.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "pcl_bv/parallel/execution.h"
#include "pcl_bv/points/point_view.h"
#include "pcl_bv/segmentation/clusters.h"
#include "pcl_bv/segmentation/stored_clusters.h"

namespace pcl_bv {
namespace [[gnu::visibility("default")]] detail {

/// Consecutive records of a share. Their points are in one component and in one cell of a grid. A run that is
/// not written (ShareRecords::gather) has the cell of its first point.
struct ShareRun {
  static constexpr std::uint32_t kNoise = ~std::uint32_t{0};
  static constexpr std::uint32_t kNotWritten = 0;  ///< As a check sum.

  std::uint64_t cell = 0;  ///< Key of the cell. It is the same in all shares with the same options.
  std::uint64_t points = 0;
  std::uint32_t component = 0;  ///< A component of the share, or kNoise.
  std::uint32_t check_sum = 0;  ///< stored_sum() of the bytes of the records.
};

/// A connected component of the points of a share.
struct ShareComponent {
  std::uint64_t points = 0;
  std::uint64_t first_number = 0;  ///< Smallest number of its points.
};

/// Returns the check sum of more bytes, a multiple of 4, after those that have the sum `before`.
std::uint32_t run_check_sum(const std::byte* bytes, std::size_t count, std::uint32_t before = 0x811c9dc5);

/// Returns the ShareRun::check_sum for a check sum.
constexpr std::uint32_t stored_sum(std::uint32_t sum) {
  return sum == ShareRun::kNotWritten ? 1 : sum;
}

/// Returns the check sum of the coordinates of a point, which are numbers of this type without gaps. Never 0.
inline std::uint32_t point_check_sum(const std::byte* coordinates, ScalarType scalar) {
  return stored_sum(run_check_sum(coordinates, 3 * size_of(scalar)));
}

/// Thrown if the records of a share are damaged or cannot be read.
class ShareError : public std::runtime_error {
 public:
  ShareError(std::size_t share, const std::string& reason, bool wrong_sum = false)
      : std::runtime_error(reason), share_(share), wrong_sum_(wrong_sum) {}
  std::size_t share() const { return share_; }   ///< Number of the share among those that are merged.
  bool wrong_sum() const { return wrong_sum_; }  ///< Whether the check sum of a run is wrong.

 private:
  std::size_t share_;
  bool wrong_sum_;
};

/// The clustered points of a share. A record has the coordinates of a valid point, and a number of 8 bytes
/// with a mark for core points. Runs are in the order of their records.
class ClusterShare {
 public:
  ClusterShare() = default;
  virtual ~ClusterShare() = default;
  ClusterShare(const ClusterShare&) = delete;
  ClusterShare& operator=(const ClusterShare&) = delete;

  virtual ScalarType scalar() const = 0;
  virtual const std::vector<ShareRun>& runs() const = 0;
  virtual const std::vector<ShareComponent>& components() const = 0;

  /// Reads the bytes of records. Throws std::runtime_error. Several threads may call it at the same time.
  virtual void read(std::uint64_t first_byte, std::byte* to, std::size_t count) const = 0;

  /// Added to the numbers of all points, so that shares with numbers of their own can be merged.
  std::uint64_t first_number = 0;
};

/// Returns the number of bytes of a record of a share.
std::size_t share_record_bytes(ScalarType scalar);

/// A collective call of all shares. Takes keys of the cells of a share and returns those of all other shares.
using GatherCells = std::function<std::vector<std::uint64_t>(const std::vector<std::uint64_t>& own)>;

/// Number of calls that a share makes.
inline constexpr int kGatherCalls = 2;

/// Which records a share writes, and where.
struct ShareRecords {
  /// An existing file and the byte from which records are written; empty for a temporary file.
  std::filesystem::path file;
  std::uint64_t first_byte = 0;
  /// If set, records that are not needed to merge the share with the others are not written: those of visited
  /// components and noise that no other share can affect. They must not be read.
  GatherCells gather{};
};

/// Clusters the points of a share.
class MadeClusterShare final : public ClusterShare {
 public:
  /// As StoredClusters; options about sizes are ignored, and StoredClusterOptions::visit is called with the
  /// components of one brick that have an allowed size. Points have the numbers PointView::index(i).
  MadeClusterShare(const PointView& points, const ClusterOptions& options,
                   const StoredClusterOptions& store = {}, const Execution& execution = {},
                   const ShareRecords& written = {});
  ~MadeClusterShare() override;

  ScalarType scalar() const override;
  const std::vector<ShareRun>& runs() const override;
  const std::vector<ShareComponent>& components() const override;
  void read(std::uint64_t first_byte, std::byte* to, std::size_t count) const override;

  /// The visit of a component, or nothing if it was not visited.
  std::optional<StoredVisit> visit(std::uint32_t component) const;
  std::size_t invalid_points() const;  ///< Number of points that are not valid.

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace detail
}  // namespace pcl_bv
