// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Files with the clusters of a share of a cloud, and their volumes. One machine merges all files.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "pcl_bv/io/posix_file.h"
#include "pcl_bv/report/partial_file.h"
#include "pcl_bv/segmentation/cluster_share.h"

namespace pcl_bv {
namespace [[gnu::visibility("default")]] detail {

/// An input of a cloud.
struct ObjectInput {
  std::size_t number = 0;  ///< Among the inputs of the cloud.
  std::size_t points = 0;
  std::string path;                       ///< Absolute, or the name of a generated cloud.
  std::optional<std::size_t> recorded{};  ///< Number of the cloud, if the file is a recording.
};

/// The inputs that have points of a share, and how they are read.
struct ObjectInputs {
  std::vector<ObjectInput> list;
  std::size_t bin_fields = 0;
  std::string columns, topic;
};

/// The ground that was removed from a share.
struct ShareGround {
  std::size_t points = 0;       ///< Number of points of the share that are ground.
  std::uint64_t check_sum = 0;  ///< Of the files from which the surface was computed.
};

/// What a file says about its share.
struct ObjectFileHeader {
  PartialFile cloud;          ///< The cloud, the points of the share, and counts; without a Partial.
  std::string clusters;       ///< The options of the clustering. Shares with other options do not merge.
  std::string volumes;        ///< The options of the volumes. Volumes with other options are fitted again.
  std::size_t nonfinite = 0;  ///< Number of points of the share that are not valid.
  /// With classes, a share is a share of the cloud for each class. The first one has the counts of all.
  std::optional<std::int64_t> class_value{};
  std::size_t dropped_class = 0;  ///< Number of points of the share whose class is dropped.
  /// Nothing in files of older versions.
  std::optional<ObjectInputs> inputs{};
  /// If the ground was removed. Then the file has a bit for each point of the share.
  std::optional<ShareGround> ground{};

  /// Removes points, counts and inputs, for the next class of the same points.
  void without_points() {
    if (inputs) inputs->list.clear();
    if (ground) ground->points = 0;
    cloud.shares.clear();
    cloud.counts = Counts();
    nonfinite = dropped_class = 0;
  }
};

/// Where the text of a component begins among all texts, and its CRC-32.
struct ObjectText {
  std::uint64_t begin = 0, check_sum = 0;
};

/// The first bytes of a share in a file.
struct ObjectFilePreamble {
  char format[24];
  std::uint64_t record_bytes, text_bytes, header_bytes, cloud_bytes, runs, components;
};

/// The clusters of a share in a file. The index (24 bytes for each run and 32 for each component) is in
/// memory.
class ObjectFile final : public ClusterShare {
 public:
  /// Opens a share that begins at a byte of a file. Throws IoError with the reason if the index is damaged or
  /// of another version.
  ObjectFile(std::shared_ptr<const InputFile> file, std::uint64_t begin);

  const ObjectFileHeader& header() const { return header_; }
  std::uint64_t begin() const { return begin_; }
  std::uint64_t end() const { return end_; }  ///< First byte behind the share.

  ScalarType scalar() const override { return scalar_; }
  const std::vector<ShareRun>& runs() const override { return runs_; }
  const std::vector<ShareComponent>& components() const override { return components_; }
  void read(std::uint64_t first_byte, std::byte* to, std::size_t count) const override;

  /// Reads bytes of the whole share, from its begin on. Throws IoError.
  void read_bytes(std::uint64_t first_byte, std::byte* to, std::size_t count) const;

  /// Returns the text that was written for a component, or nothing if there is none. Throws IoError if it is
  /// damaged.
  std::optional<std::string> text(std::uint32_t component) const;
  bool has_text(std::uint32_t component) const {
    return texts_[component + 1].begin > texts_[component].begin;
  }

  /// Sets ground[i] to 1 for each point number first + i of the cloud that the share has and that is ground.
  /// Throws IoError if the file is damaged.
  void mark_ground(std::size_t first, std::vector<std::uint8_t>& ground) const;

 private:
  void read_index();
  void require_right_index() const;

  std::shared_ptr<const InputFile> file_;
  std::uint64_t begin_, end_ = 0;
  ObjectFilePreamble preamble_;
  ObjectFileHeader header_;
  ScalarType scalar_ = ScalarType::float32;
  std::vector<ShareRun> runs_;
  std::vector<ShareComponent> components_;
  std::vector<ObjectText> texts_;  // of each component; then where the last one ends
};

enum class FileLife : std::uint8_t {
  lasting,   ///< Written atomically, and on the disk at the end (fsync).
  temporary  ///< For another process that reads it now. Waiting for the disk would take seconds.
};

/// Calls `make` with an empty file, to which it writes a share: its records from the byte
/// first_record_of_object_file() on (ShareRecords), and then the rest by complete_object_file(). Creates
/// missing folders of a lasting file. Throws IoError, and what `make` throws.
void write_object_file(const std::filesystem::path& path, FileLife life,
                       const std::function<void(const std::filesystem::path& file)>& make);

/// Returns where the records of a share begin, from its own begin on.
std::uint64_t first_record_of_object_file();

/// Writes all but the records of a share that begins at a byte of a file. `text` is called for each component
/// in their order, and returns its text; an empty text is none. `ground` has a bit for each point of the
/// share, the first one in the lowest bit of the first word, if the header has the ground. Returns where the
/// next share begins. Throws IoError.
std::uint64_t complete_object_file(const std::filesystem::path& file, std::uint64_t begin,
                                   const ObjectFileHeader& header, const ClusterShare& share,
                                   const std::function<std::string(std::uint32_t component)>& text,
                                   const std::vector<std::uint64_t>& ground = {});

/// Writes several shares to one file, atomically.
void join_object_files(const std::filesystem::path& path,
                       const std::vector<std::unique_ptr<ObjectFile>>& shares);

/// Opens all shares of a file. Throws IoError with the reason.
std::vector<std::unique_ptr<ObjectFile>> open_object_file(const std::filesystem::path& path);

}  // namespace detail
}  // namespace pcl_bv
