// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Where the compressed points of a .laz file are, and functions that read them. LASzip decompresses each
// chunk as if it were a file of its own, whose header is written here. So LASzip interprets no count, offset
// or table of the file.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "pcl_bv/io/las.h"
#include "pcl_bv/io/posix_file.h"
#include "pcl_bv/io/raw_cloud.h"
#include "pcl_bv/parallel/execution.h"

namespace pcl_bv::detail {

struct LasHeader;

/// Points that are compressed together. They can be decompressed without any others.
struct LazChunk {
  std::size_t offset = 0, bytes = 0;  ///< Place in the file.
  std::size_t points = 0;             ///< Points to read, > 0.
  bool whole = false;                 ///< The chunk certainly has no other points.
  /// If set, the chunk need not be decompressed: each of its points is here, and all other fields are 0.
  std::optional<std::array<double, 3>> placeholder{};
};

/// How the points are compressed, as the record "laszip encoded" of the file says.
struct LazLayout {
  /// Ways to compress points, with the numbers that LASzip gives them. Formats 6 to 10 are always layered.
  enum Compressor : std::uint16_t { pointwise = 1, chunked = 2, layered = 3 };

  unsigned point_format = 0;
  std::uint16_t compressor = chunked;
  std::size_t layers = 0;    ///< If layered: sizes of layers at the beginning of a chunk.
  std::size_t time_at = 0;   ///< Offset in a record; 0 if the format has no such field.
  std::size_t color_at = 0;  ///< Offset in a record; 0 if the format has no such field.
  std::string record;        ///< Data of the record "laszip encoded", checked.
  std::vector<LazChunk> chunks;
};

/// Reads the layout of a file with compressed points. header.data_offset, header.record, the number of points
/// and the format of `layout` must have been read. Adds a note to the cloud if the chunks have more points
/// than the header. Throws IoError if the layout is invalid, if the header says 0 points but chunks follow,
/// or in builds without LASzip.
void read_laz_layout(const InputFile& file, LasHeader& header, LazLayout layout);

/// Marks the chunks that read_las() with `can_skip` need not decompress. If the tree of a COPC file is
/// invalid or does not contain the bounding box of the header, marks none and adds a note to the cloud.
void mark_skipped_chunks(const InputFile& file, LasHeader& header, const BoxPredicate& can_skip);

/// Reads the points into header.cloud.data. For more than 32 points per compressed byte, memory grows with
/// the points that were decompressed. Throws IoError.
void read_laz_points(const InputFile& file, LasHeader& header, const ParallelPolicy& policy);

/// Decompresses one chunk.
class LazChunkReader {
 public:
  /// Reads the chunk's bytes. Throws IoError if they are invalid.
  LazChunkReader(const InputFile& file, const LasHeader& header, const LazChunk& chunk);
  ~LazChunkReader();
  LazChunkReader(const LazChunkReader&) = delete;
  LazChunkReader& operator=(const LazChunkReader&) = delete;

  /// Converts the next `points` points to records of the cloud. Throws IoError if the chunk is damaged.
  void read(std::size_t points, std::byte* to);

  /// Throws IoError if bytes of a whole chunk are left, which only a damaged chunk has. Call it after the
  /// last point.
  void require_end() const;

 private:
  class Decoder;

  const LasHeader& header_;
  ByteBuffer bytes_;  // a header, and the chunk
  bool whole_ = false;
  std::unique_ptr<Decoder> decoder_;
};

}  // namespace pcl_bv::detail
