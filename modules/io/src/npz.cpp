// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The .zip files that numpy.savez() and savez_compressed() write (PKWARE's APPNOTE, 4.3): the central
// directory at the end has the sizes and offsets of all arrays.

#include <libdeflate.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <memory>
#include <vector>

#include "fields.h"
#include "npy_format.h"
#include "pcl_bv/io/crc32.h"
#include "pcl_bv/io/numpy.h"
#include "pcl_bv/io/raw_cloud_edit.h"

namespace pcl_bv::detail {
namespace {

constexpr std::size_t kDirectoryEnd = 22, kDirectoryEntry = 46, kLocalEntry = 30;
constexpr std::size_t kMaxComment = 65535, kMaxDirectory = std::size_t{64} << 20;
constexpr std::size_t kMaxArray = std::size_t{64} << 30, kMaxRatio = 1032;  // of deflate
constexpr std::uint32_t kIn64 = 0xFFFFFFFF;

struct ZipEntry {
  std::string name;  // without .npy
  unsigned flags = 0, method = 0;
  std::uint32_t crc = 0;
  std::size_t compressed = 0, size = 0, begin = 0;
};

template <typename T>
std::size_t zip_number(std::string_view bytes, std::size_t at) {
  if (bytes.size() < sizeof(T) || at > bytes.size() - sizeof(T)) throw IoError("its directory is damaged");
  T value;
  std::memcpy(&value, bytes.data() + at, sizeof value);
  return value;
}

std::string bytes_at(const InputFile& file, std::size_t at, std::size_t size) {
  if (at > file.size() || size > file.size() - at) throw IoError("truncated: an array is not in the file");
  std::string bytes(size, '\0');
  if (size > 0) file.read(at, bytes.data(), size);
  return bytes;
}

// Sizes of 4 GiB and above are in a record with the number 1, in the order of the numbers that need it.
void read_zip64(std::string_view extra, ZipEntry& entry) {
  for (std::size_t at = 0; at + 4 <= extra.size();) {
    const std::size_t id = zip_number<std::uint16_t>(extra, at),
                      size = zip_number<std::uint16_t>(extra, at + 2);
    at += 4;
    if (id == 1) {
      std::size_t next = at;
      for (std::size_t* value : {&entry.size, &entry.compressed, &entry.begin}) {
        if (*value != kIn64) continue;
        *value = zip_number<std::uint64_t>(extra, next);
        next += 8;
      }
    }
    at += size;
  }
}

std::string zip_directory(const InputFile& file) {
  const std::size_t tail_size = std::min(file.size(), kDirectoryEnd + kMaxComment);
  const std::string tail = bytes_at(file, file.size() - tail_size, tail_size);
  const std::size_t end = tail.rfind("PK\5\6");
  if (end == std::string::npos || tail.size() - end < kDirectoryEnd)
    throw IoError("is no .npz file: it has no directory");
  std::size_t size = zip_number<std::uint32_t>(tail, end + 12),
              begin = zip_number<std::uint32_t>(tail, end + 16);
  if (begin == kIn64 || size == kIn64) {  // a record before it has the offset of the directory
    const std::size_t locator = tail.rfind("PK\6\7", end);
    if (locator == std::string::npos) throw IoError("its directory is damaged");
    const std::string record = bytes_at(file, zip_number<std::uint64_t>(tail, locator + 8), 56);
    size = zip_number<std::uint64_t>(record, 40);
    begin = zip_number<std::uint64_t>(record, 48);
  }
  if (size > kMaxDirectory) throw IoError("its directory has more than 64 MiB");
  return bytes_at(file, begin, size);
}

std::vector<ZipEntry> read_zip_directory(const InputFile& file) {
  const std::string directory = zip_directory(file);
  std::vector<ZipEntry> entries;
  for (std::size_t at = 0; at + kDirectoryEntry <= directory.size();) {
    if (directory.compare(at, 4, "PK\1\2") != 0) throw IoError("its directory is damaged");
    ZipEntry entry;
    entry.flags = static_cast<unsigned>(zip_number<std::uint16_t>(directory, at + 8));
    entry.method = static_cast<unsigned>(zip_number<std::uint16_t>(directory, at + 10));
    entry.crc = static_cast<std::uint32_t>(zip_number<std::uint32_t>(directory, at + 16));
    entry.compressed = zip_number<std::uint32_t>(directory, at + 20);
    entry.size = zip_number<std::uint32_t>(directory, at + 24);
    entry.begin = zip_number<std::uint32_t>(directory, at + 42);
    const std::size_t name = zip_number<std::uint16_t>(directory, at + 28),
                      extra = zip_number<std::uint16_t>(directory, at + 30),
                      comment = zip_number<std::uint16_t>(directory, at + 32);
    at += kDirectoryEntry;
    if (name + extra > directory.size() - at) throw IoError("its directory is damaged");
    entry.name = directory.substr(at, name);
    read_zip64(std::string_view(directory).substr(at + name, extra), entry);
    at += name + extra + comment;
    if (!entry.name.ends_with(".npy")) continue;
    entry.name.resize(entry.name.size() - 4);
    entries.push_back(std::move(entry));
  }
  return entries;
}

const ZipEntry& cloud_entry(const std::vector<ZipEntry>& entries) {
  std::string known;
  for (const char* name : {"points", "xyz", "cloud", "pointcloud", "point_cloud", "pc", "data", "arr_0"}) {
    known += (known.empty() ? "" : ", ") + std::string(name);
    for (const ZipEntry& entry : entries)
      if (entry.name == name) return entry;
  }
  if (entries.size() == 1) return entries.front();
  std::string names;
  for (const ZipEntry& entry : entries)
    names += (names.empty() ? "" : ", ") + entry.name;
  if (entries.empty()) throw IoError("has no array");
  throw IoError("its arrays are " + in_quotes(names) + "; one must have a name of " + known);
}

void require_crc(const ZipEntry& entry, const std::string& array) {
  if (crc32_of(array.data(), array.size()) != entry.crc)
    throw IoError("array " + in_quotes(entry.name) + " is damaged: its check sum (CRC-32) differs");
}

std::string array_of(const InputFile& file, const ZipEntry& entry) {
  if ((entry.flags & 1) != 0) throw IoError("is encrypted");
  if (entry.method != 0 && entry.method != 8)
    throw IoError("compression " + std::to_string(entry.method) + " is not stored or deflated");
  const std::string local = bytes_at(file, entry.begin, kLocalEntry);
  if (!local.starts_with("PK\3\4")) throw IoError("its directory is damaged");
  const std::size_t begin =
      entry.begin + kLocalEntry + zip_number<std::uint16_t>(local, 26) + zip_number<std::uint16_t>(local, 28);
  if (entry.size > kMaxArray || entry.size / kMaxRatio > entry.compressed || entry.compressed > file.size())
    throw IoError("array " + in_quotes(entry.name) + ": its size cannot be right");
  if (entry.method == 0 && entry.size != entry.compressed) throw IoError("its directory is damaged");
  std::string bytes = bytes_at(file, begin, entry.compressed);
  if (entry.method == 0) {
    require_crc(entry, bytes);
    return bytes;
  }
  std::string array(entry.size, '\0');
  const std::unique_ptr<libdeflate_decompressor, decltype(&libdeflate_free_decompressor)> decompressor(
      libdeflate_alloc_decompressor(), &libdeflate_free_decompressor);
  if (!decompressor) throw std::bad_alloc();
  const libdeflate_result result = libdeflate_deflate_decompress(
      decompressor.get(), bytes.data(), bytes.size(), array.data(), array.size(), nullptr);
  if (result != LIBDEFLATE_SUCCESS) throw IoError("array " + in_quotes(entry.name) + " is damaged");
  require_crc(entry, array);
  return array;
}

}  // namespace

RawCloud read_npz(const std::filesystem::path& path) {
  const InputFile file(path);
  try {
    const std::vector<ZipEntry> entries = read_zip_directory(file);
    const ZipEntry& entry = cloud_entry(entries);
    const std::string array = array_of(file, entry);
    NpyHeader header = parse_npy_header(array);
    read_npy_points(array, header);
    RawCloud& cloud = header.records.cloud;
    if (entries.size() > 1)
      add_note(cloud, "of " + std::to_string(entries.size()) + " arrays, only " + in_quotes(entry.name) +
                          " is read");
    update_packed_xyz(cloud);
    return std::move(cloud);
  } catch (const std::bad_alloc&) {
    throw IoError("not enough memory for its points, file of " + std::to_string(file.size()) + " bytes");
  }
}

}  // namespace pcl_bv::detail
