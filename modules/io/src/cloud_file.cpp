// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "pcl_bv/io/cloud_file.h"

#include <algorithm>
#include <optional>
#include <stdexcept>
#include <utility>

#include "block_sums.h"
#include "fields.h"
#include "npy_format.h"
#include "pcd_format.h"
#include "pcl_bv/io/read_cloud.h"
#include "pcl_bv/io/text_cloud.h"

namespace pcl_bv {
using namespace detail;

struct CloudFile::Opened {
  InputFile file;
  PcdHeader header;
  CoordinateFields fields;
  mutable BlockSums sums;
};

namespace {

// Bytes of a part of the file. When load() reads the first bytes of a part, the following part is prefetched.
constexpr std::size_t kAhead = std::size_t{8} << 20;

// Maximum size in bytes of records that load() uses without packing their coordinates.
constexpr std::size_t kShortRecord = 64;

// Bytes of records that pack() reads at a time.
constexpr std::size_t kPiece = std::size_t{256} << 10;

// Returns the header of a .bin or .npy file or of a binary .pcd file. Returns nullopt for other encodings of
// .pcd files and for other files.
std::optional<PcdHeader> binary_header(const InputFile& file, const std::filesystem::path& path,
                                       std::size_t bin_fields) {
  const std::string extension = lower_case_extension(path);
  if (extension == ".ply" || extension == ".las" || extension == ".laz" || extension == ".npz")
    return std::nullopt;
  if (is_text_name(path)) return std::nullopt;
  if (extension == ".npy") {
    NpyHeader array = read_npy_header(file);
    if (array.by_column) return std::nullopt;
    return std::move(array.records);
  }
  refuse_other_formats(path);
  PcdHeader header = extension == ".bin" ? read_bin_header(file, path, bin_fields) : read_pcd_header(file);
  if (header.encoding != PcdEncoding::binary) return std::nullopt;
  require_records(file, header);
  return header;
}

void prefetch(const InputFile& file, std::size_t from, std::size_t to) {
  if (from / kAhead != to / kAhead) file.prefetch((to / kAhead + 1) * kAhead, kAhead);
}

// Never shrinks the buffer, because growing it again would fill the new part with zeros.
void grow(std::vector<std::byte>& buffer, std::size_t bytes) {
  if (buffer.size() < bytes) buffer.resize(bytes);
}

// Packs the coordinates of the records from `offset` on into the beginning of the buffer. The records are
// read piece by piece into the end of the buffer.
void pack(const InputFile& file, std::size_t offset, std::size_t step, const CoordinateFields& fields,
          std::size_t count, std::vector<std::byte>& buffer) {
  const std::size_t packed = 3 * size_of(fields.scalar);
  const std::size_t at_a_time = std::clamp<std::size_t>(kPiece / step, 1, count);
  grow(buffer, count * packed + at_a_time * step);
  std::byte* const piece = buffer.data() + count * packed;
  for (std::size_t done = 0; done < count; done += at_a_time) {
    const std::size_t n = std::min(at_a_time, count - done);
    file.read(offset + done * step, piece, n * step);
    pack_coordinates(fields, piece, n, step, buffer.data() + done * packed);
  }
}

}  // namespace

std::unique_ptr<CloudFile> CloudFile::open(const std::filesystem::path& path, std::size_t bin_fields) {
  InputFile file(path);
  std::optional<PcdHeader> header = binary_header(file, path, bin_fields);
  if (!header || header->cloud.size() <= kChunkPoints) return nullptr;
  const CoordinateFields fields = coordinate_fields(header->cloud.fields);
  file.prefetch(header->data_offset, 2 * kAhead);
  BlockSums sums(header->cloud.size());
  return std::unique_ptr<CloudFile>(new CloudFile(
      std::unique_ptr<Opened>(new Opened{std::move(file), std::move(*header), fields, std::move(sums)})));
}

CloudFile::CloudFile(std::unique_ptr<Opened> file) : file_(std::move(file)) {}
CloudFile::~CloudFile() = default;

const RawCloud& CloudFile::header() const {
  return file_->header.cloud;
}

void CloudFile::require_unchanged() const {
  file_->file.require_unchanged();
}

PointView CloudFile::xyz() const {
  return view_of(*this, header().size(), file_->fields.scalar);
}

void CloudFile::load_records(std::size_t first, std::size_t count, std::vector<std::byte>& buffer) const {
  const std::size_t step = header().point_step;
  if (first > header().size() || count > header().size() - first)
    throw std::out_of_range("CloudFile: the requested records are outside the cloud");
  grow(buffer, count * step);
  file_->file.read(file_->header.data_offset + first * step, buffer.data(), count * step);
}

PointView CloudFile::load(std::size_t first, std::size_t count, std::vector<std::byte>& buffer) const {
  const CoordinateFields& fields = file_->fields;
  const std::size_t step = header().point_step, from = file_->header.data_offset + first * step;
  prefetch(file_->file, from, from + count * step);
  PointView view;
  if (fields.adjacent && step <= kShortRecord) {
    grow(buffer, count * step);
    file_->file.read(from, buffer.data(), count * step);
    view = view_at(fields, buffer.data(), count, step);
  } else {
    pack(file_->file, from, step, fields, count, buffer);
    view = packed_points(buffer.data(), fields.scalar, count);
  }
  view.first = first;
  file_->sums.check(first, count, buffer.data(), view.stride);
  return view;
}

}  // namespace pcl_bv
