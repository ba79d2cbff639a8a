// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Decompresses a chunk with LASzip. A layered chunk begins with a point that is not compressed, the number of
// its points (u32) and the sizes of its layers (u32 each). LASzip 3.5 adds the sizes in 32 bits and trusts
// the sum, so they are checked before. Not checked: a coded sequence of GPS times can make LASzip
// call itself until the stack is exhausted.

#ifdef PCL_BV_LASZIP
#include <laszip/laszip_api.h>
#endif

#include <algorithm>
#include <cstring>
#include <istream>
#include <limits>
#include <streambuf>

#include "las_format.h"
#include "laz_format.h"

namespace pcl_bv::detail {

#ifdef PCL_BV_LASZIP

namespace {

constexpr std::size_t kLazHeaderOf12 = 227, kLazHeaderOf14 = 375, kVlrHead = 54;

// Bytes in memory as a stream that can seek.
class LazBytes : public std::streambuf {
 public:
  LazBytes(std::byte* bytes, std::size_t size) {
    auto* const begin = reinterpret_cast<char*>(bytes);
    setg(begin, begin, begin + size);
  }

  std::size_t left() const { return static_cast<std::size_t>(egptr() - gptr()); }

 protected:
  pos_type seekoff(off_type offset, std::ios_base::seekdir from, std::ios_base::openmode) override {
    const char* const base = from == std::ios_base::beg   ? eback()
                             : from == std::ios_base::cur ? gptr()
                                                          : egptr();
    const off_type to = base - eback() + offset;
    if (to < 0 || to > egptr() - eback()) return pos_type(off_type(-1));
    setg(eback(), eback() + to, egptr());
    return to;
  }

  pos_type seekpos(pos_type to, std::ios_base::openmode mode) override {
    return seekoff(to, std::ios_base::beg, mode);
  }
};

template <typename T>
void put(ByteBuffer& bytes, std::size_t at, T value) {
  std::memcpy(bytes.data() + at, &value, sizeof value);
}

// Returns the number of bytes before the chunk in the file that LASzip sees: the header, the record of LASzip
// and, unless pointwise, the offset of the table of chunks.
std::size_t prefix_bytes(const LazLayout& laz) {
  return (laz.point_format >= 6 ? kLazHeaderOf14 : kLazHeaderOf12) + kVlrHead + laz.record.size() +
         (laz.compressor == LazLayout::pointwise ? 0 : sizeof(std::int64_t));
}

// Writes the header of a file with this chunk alone.
void write_prefix(const LasHeader& header, std::size_t points, ByteBuffer& bytes, std::size_t prefix) {
  const LazLayout& laz = *header.laz;
  const bool wide = laz.point_format >= 6;
  const std::size_t size = wide ? kLazHeaderOf14 : kLazHeaderOf12;
  const std::size_t data = size + kVlrHead + laz.record.size();
  const auto count = static_cast<std::uint32_t>(points);
  std::fill_n(bytes.begin(), prefix, std::byte{0});
  std::memcpy(bytes.data(), "LASF", 4);
  put<std::uint8_t>(bytes, 24, 1);
  put<std::uint8_t>(bytes, 25, wide ? 4 : 2);
  put(bytes, 94, static_cast<std::uint16_t>(size));
  put(bytes, 96, static_cast<std::uint32_t>(data));
  put<std::uint32_t>(bytes, 100, 1);
  put(bytes, 104, static_cast<std::uint8_t>(laz.point_format | 128U));
  put(bytes, 105, static_cast<std::uint16_t>(header.record));
  put(bytes, 107, wide ? 0U : count);
  if (wide) put<std::uint64_t>(bytes, 247, points);
  std::memcpy(bytes.data() + size + 2, "laszip encoded", 14);
  put<std::uint16_t>(bytes, size + 18, 22204);
  put(bytes, size + 20, static_cast<std::uint16_t>(laz.record.size()));
  std::memcpy(bytes.data() + size + kVlrHead, laz.record.data(), laz.record.size());
  put(bytes, size + kVlrHead + 12, std::numeric_limits<std::uint32_t>::max() - 1);  // points of a chunk
  // An offset equal to the position of this field tells LASzip that there is no table.
  if (laz.compressor != LazLayout::pointwise) put(bytes, data, static_cast<std::int64_t>(data));
}

[[noreturn]] void refuse_chunk(const LazChunk& chunk, const std::string& what) {
  throw IoError("corrupt: the chunk at byte " + std::to_string(chunk.offset) + " " + what);
}

// Throws IoError if the first four bytes are 0xFFFFFFFF. The coder's value must be below its interval length
// 0xFFFFFFFF; LASzip does not check this and would read beyond its tables.
void check_coded(const std::byte* at, std::size_t bytes, const LazChunk& chunk) {
  constexpr std::size_t word = 4;
  if (bytes >= word && std::all_of(at, at + word, [](std::byte byte) { return byte == std::byte{0xFF}; }))
    refuse_chunk(chunk, "begins with no coded number");
}

// Throws IoError unless the number of points and the sizes of the layers are those of the chunk.
void check_layers(const std::byte* bytes, const LazChunk& chunk, const LasHeader& header) {
  const std::size_t layers = header.laz->layers, head = header.record + 4 * (1 + layers);
  if (chunk.bytes < head) refuse_chunk(chunk, "is too short for its layers");
  std::vector<std::uint32_t> sizes(1 + layers);  // the number of points comes first
  std::memcpy(sizes.data(), bytes + header.record, 4 * sizes.size());
  if (chunk.whole ? sizes[0] != chunk.points : sizes[0] < chunk.points)
    refuse_chunk(chunk, "has " + std::to_string(sizes[0]) + " points, " +
                            (chunk.whole ? "the table of chunks says " : "the header needs ") +
                            std::to_string(chunk.points));
  std::size_t at = head;
  for (std::size_t i = 1; i < sizes.size() && sizes[i] <= chunk.bytes - at; ++i) {
    check_coded(bytes + at, sizes[i], chunk);
    at += sizes[i];
    if (i == layers && at == chunk.bytes) return;
  }
  refuse_chunk(chunk, "does not have the bytes of its layers");
}

void check_chunk(const std::byte* bytes, const LazChunk& chunk, const LasHeader& header) {
  if (chunk.bytes < header.record) refuse_chunk(chunk, "is too short for a point");
  if (header.laz->compressor == LazLayout::layered) return check_layers(bytes, chunk, header);
  check_coded(bytes + header.record, chunk.bytes - header.record, chunk);
}

// Owns a reader of LASzip.
class Laszip {
 public:
  Laszip() {
    if (laszip_create(&reader_) != 0) throw IoError("LASzip cannot be started");
  }
  ~Laszip() {
    laszip_close_reader(reader_);
    laszip_destroy(reader_);
  }
  Laszip(const Laszip&) = delete;
  Laszip& operator=(const Laszip&) = delete;

  laszip_POINTER get() const { return reader_; }

 private:
  laszip_POINTER reader_ = nullptr;
};

// Writes a point as the record that a file without compression has, as far as fields of the cloud need it.
class LazRecord {
 public:
  explicit LazRecord(const LasHeader& header) : laz_(*header.laz), bytes_(header.record) {}

  const std::byte* of(const laszip_point& point) {
    laz_.point_format >= 6 ? put_wide(point) : put_bytes(0, &point.X, 20);
    if (laz_.time_at != 0) put_bytes(laz_.time_at, &point.gps_time, 8);
    if (laz_.color_at != 0) put_bytes(laz_.color_at, point.rgb, 6);
    return bytes_.data();
  }

 private:
  void put_bytes(std::size_t at, const void* from, std::size_t bytes) {
    std::memcpy(bytes_.data() + at, from, bytes);
  }

  void put_byte(std::size_t at, unsigned value) { bytes_[at] = static_cast<std::byte>(value); }

  void put_wide(const laszip_point& point) {
    put_bytes(0, &point.X, 14);  // and the intensity
    put_byte(14, point.extended_return_number | point.extended_number_of_returns << 4U);
    put_byte(15, point.extended_classification_flags | point.extended_scanner_channel << 4U |
                     point.scan_direction_flag << 6U | point.edge_of_flight_line << 7U);
    put_byte(16, point.extended_classification);
    put_bytes(20, &point.point_source_ID, 2);
  }

  const LazLayout& laz_;
  std::vector<std::byte> bytes_;
};

}  // namespace

bool reads_laz() {
  return true;
}

class LazChunkReader::Decoder {
 public:
  Decoder(const LasHeader& header, std::size_t offset, ByteBuffer& bytes)
      : offset_(offset), bytes_(bytes.data(), bytes.size()), stream_(&bytes_), record_(header) {
    laszip_BOOL compressed = 0;
    check(laszip_open_reader_stream(laszip_.get(), stream_, &compressed));
    check(laszip_get_point_pointer(laszip_.get(), &point_));
  }

  const std::byte* next_record() {
    check(laszip_read_point(laszip_.get()));
    return record_.of(*point_);
  }

  bool at_end() const { return bytes_.left() == 0; }

  [[noreturn]] void fail(const std::string& reason) const {
    throw IoError("corrupt: the chunk at byte " + std::to_string(offset_) +
                  " cannot be decompressed: " + reason);
  }

 private:
  void check(laszip_I32 status) {
    if (status == 0) return;
    laszip_CHAR* text = nullptr;
    laszip_get_error(laszip_.get(), &text);
    fail(text == nullptr ? "no reason given" : text);
  }

  std::size_t offset_;
  LazBytes bytes_;
  std::istream stream_;
  LazRecord record_;
  Laszip laszip_;
  laszip_point* point_ = nullptr;
};

LazChunkReader::LazChunkReader(const InputFile& file, const LasHeader& header, const LazChunk& chunk)
    : header_(header), whole_(chunk.whole) {
  const std::size_t prefix = prefix_bytes(*header.laz);
  bytes_.resize(prefix + chunk.bytes);
  file.read(chunk.offset, bytes_.data() + prefix, chunk.bytes);
  check_chunk(bytes_.data() + prefix, chunk, header);
  write_prefix(header, chunk.points, bytes_, prefix);
  decoder_ = std::make_unique<Decoder>(header, chunk.offset, bytes_);
}

LazChunkReader::~LazChunkReader() = default;

void LazChunkReader::read(std::size_t points, std::byte* to) {
  for (std::size_t i = 0; i < points; ++i, to += header_.cloud.point_step)
    convert_las_record(decoder_->next_record(), header_, to);
}

void LazChunkReader::require_end() const {
  if (whole_ && !decoder_->at_end()) decoder_->fail("bytes are left");
}

#else

bool reads_laz() {
  return false;
}

// No file gets here: read_las_header() has refused it.
class LazChunkReader::Decoder {};

LazChunkReader::LazChunkReader(const InputFile&, const LasHeader& header, const LazChunk& chunk)
    : header_(header), whole_(chunk.whole) {
  throw IoError("this build has no LASzip");
}

LazChunkReader::~LazChunkReader() = default;

void LazChunkReader::read(std::size_t points, std::byte* to) {
  std::fill_n(to, points * header_.cloud.point_step, std::byte{0});
}

void LazChunkReader::require_end() const {
  if (whole_) throw IoError("this build has no LASzip");
}

#endif

}  // namespace pcl_bv::detail
