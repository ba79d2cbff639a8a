// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "pcl_bv/report/object_file.h"

#include <algorithm>
#include <cstring>
#include <fstream>
#include <new>

#include "object_header.h"
#include "pcl_bv/io/atomic_file.h"
#include "pcl_bv/io/crc32.h"
#include "pcl_bv/io/raw_cloud.h"

namespace pcl_bv::detail {
namespace {

// A share is a preamble, the records of the points, the texts of components, blocks of bits of the ground,
// each with its CRC-32, and the index: the header as JSON, what it says about the cloud, runs, components,
// begins of texts, and a CRC-32 of preamble and index. The records come first, because their number is known
// before the index is.
constexpr char kObjectFormat[sizeof ObjectFilePreamble::format] = "pcl_bv objects 1\n";
static_assert(sizeof(ObjectFilePreamble) == 72);
static_assert(sizeof(ShareRun) == 24 && sizeof(ShareComponent) == 16);

constexpr std::uint64_t kMaxItems = (std::uint64_t{1} << 32U) - 1;
constexpr std::size_t kBlock = 1U << 22U;
constexpr std::size_t kGroundPoints = 1U << 20U;  // in a block

template <typename T>
std::string_view bytes_of(const std::vector<T>& items) {
  return {reinterpret_cast<const char*>(items.data()), items.size() * sizeof(T)};
}

std::uint32_t check_sum(std::initializer_list<std::string_view> parts) {
  std::uint32_t sum = 0;
  for (const std::string_view part : parts)
    sum = crc32_of(part.data(), part.size(), sum);
  return sum;
}

std::string_view bytes_of(const ObjectFilePreamble& preamble) {
  return {reinterpret_cast<const char*>(&preamble), sizeof preamble};
}

std::uint64_t points_in(const std::vector<ShareRun>& runs) {
  std::uint64_t points = 0;
  for (const ShareRun& run : runs)
    points += run.points;
  return points;
}

void require_good(bool good, const char* what) {
  if (!good) throw IoError(what);
}

std::size_t ground_bit_count(const ObjectFileHeader& header) {
  if (!header.ground || header.cloud.shares.empty()) return 0;
  require_good(header.cloud.shares.size() == 1, "its index is wrong");
  return header.cloud.shares.front().second - header.cloud.shares.front().first;
}

std::uint64_t rounded_up(std::uint64_t count, std::uint64_t divisor) {
  return count / divisor + (count % divisor == 0 ? 0 : 1);
}

// Returns the size of the first bytes of the ground that have a number of points.
std::uint64_t ground_bytes(std::uint64_t points) {
  return rounded_up(points, 8) + rounded_up(points, kGroundPoints) * sizeof(std::uint32_t);
}

void write(std::ostream& out, std::string_view bytes) {
  out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  if (!out) throw IoError("cannot be written: is the disk full?");
}

void write_ground_bits(std::ostream& out, const std::vector<std::uint64_t>& words, std::size_t points) {
  const std::string_view bytes = bytes_of(words);
  require_good(bytes.size() >= (points + 7) / 8, "its ground is incomplete");
  for (std::size_t first = 0; first < points; first += kGroundPoints) {
    const std::string_view block = bytes.substr(first / 8, (std::min(kGroundPoints, points - first) + 7) / 8);
    const std::uint32_t sum = check_sum({block});
    write(out, block);
    write(out, {reinterpret_cast<const char*>(&sum), sizeof sum});
  }
}

template <typename Stream>
void close(Stream& out) {
  out.close();
  require_good(!out.fail(), "cannot be written: is the disk full?");
}

}  // namespace

std::uint64_t first_record_of_object_file() {
  return sizeof(ObjectFilePreamble);
}

void write_object_file(const std::filesystem::path& path, FileLife life,
                       const std::function<void(const std::filesystem::path& file)>& make) {
  require_good(!std::filesystem::exists(path) || std::filesystem::is_regular_file(path),
               "is not a regular file");
  const auto make_new = [&](const std::filesystem::path& file) {
    if (std::filesystem::exists(file)) {
      std::filesystem::resize_file(file, 0);
    } else {
      require_good(std::ofstream(file, std::ios::binary).is_open(), "cannot be opened for writing");
    }
    make(file);
  };
  if (life == FileLife::temporary) return make_new(path);
  create_folder_of(path);
  replace_file_atomically(path, make_new);
}

std::uint64_t complete_object_file(const std::filesystem::path& file, std::uint64_t begin,
                                   const ObjectFileHeader& header, const ClusterShare& share,
                                   const std::function<std::string(std::uint32_t component)>& text,
                                   const std::vector<std::uint64_t>& ground) {
  std::fstream out(file, std::ios::binary | std::ios::in | std::ios::out);
  require_good(out.is_open(), "cannot be opened for writing");
  const std::uint64_t records = points_in(share.runs()) * share_record_bytes(share.scalar());
  out.seekp(static_cast<std::streamoff>(begin + sizeof(ObjectFilePreamble) + records));
  std::vector<ObjectText> texts(1);
  for (std::uint32_t c = 0; c < share.components().size(); ++c) {
    const std::string each = text(c);
    write(out, each);
    texts.back().check_sum = check_sum({each});
    texts.push_back({texts.back().begin + each.size(), 0});
  }
  const std::size_t with_ground = ground_bit_count(header);
  write_ground_bits(out, ground, with_ground);
  const std::string own = object_header_text(header, share.scalar()),
                    cloud = partial_file_content(header.cloud);
  ObjectFilePreamble preamble{{},
                              records,
                              texts.back().begin + ground_bytes(with_ground),
                              own.size(),
                              cloud.size(),
                              share.runs().size(),
                              share.components().size()};
  std::memcpy(preamble.format, kObjectFormat, sizeof kObjectFormat);
  const std::string_view runs = bytes_of(share.runs()), components = bytes_of(share.components());
  const std::uint32_t sum = check_sum({bytes_of(preamble), own, cloud, runs, components, bytes_of(texts)});
  for (const std::string_view part :
       {std::string_view(own), std::string_view(cloud), runs, components, bytes_of(texts)})
    write(out, part);
  write(out, {reinterpret_cast<const char*>(&sum), sizeof sum});
  const auto end = static_cast<std::uint64_t>(out.tellp());
  out.seekp(static_cast<std::streamoff>(begin));
  write(out, bytes_of(preamble));
  close(out);
  return end;
}

ObjectFile::ObjectFile(std::shared_ptr<const InputFile> file, std::uint64_t begin)
    : file_(std::move(file)), begin_(begin) {
  require_good(file_->size() - begin >= sizeof preamble_, "is truncated");
  file_->read(begin, &preamble_, sizeof preamble_);
  require_good(std::memcmp(preamble_.format, "pcl_bv ground ", 14) != 0,
               "has the ground of a share: name it by --ground-parts");
  require_good(std::memcmp(preamble_.format, kObjectFormat, 15) == 0,
               "is no file of objects, as --partial --cluster writes them");
  require_good(std::memcmp(preamble_.format, kObjectFormat, sizeof kObjectFormat) == 0,
               "was written by another version of pcl_bv: this one reads version 1");
  require_good(preamble_.header_bytes <= kMaxObjectHeader && preamble_.cloud_bytes <= kMaxObjectHeader &&
                   preamble_.runs <= kMaxItems && preamble_.components <= kMaxItems,
               "is damaged: its index is too large");
  const std::uint64_t left = file_->size() - begin - sizeof preamble_;
  require_good(preamble_.record_bytes <= left && preamble_.text_bytes <= left - preamble_.record_bytes,
               "is truncated");
  read_index();
  require_right_index();
}

void ObjectFile::read_index() {
  std::uint64_t at = begin_ + sizeof preamble_ + preamble_.record_bytes + preamble_.text_bytes;
  const std::uint64_t bytes = preamble_.header_bytes + preamble_.cloud_bytes +
                              preamble_.runs * sizeof(ShareRun) +
                              preamble_.components * sizeof(ShareComponent) +
                              (preamble_.components + 1) * sizeof(ObjectText) + sizeof(std::uint32_t);
  require_good(bytes <= file_->size() - at, "is truncated");
  end_ = at + bytes;
  std::string header(preamble_.header_bytes + preamble_.cloud_bytes, '\0');
  try {
    runs_.resize(preamble_.runs);
    components_.resize(preamble_.components);
    texts_.resize(preamble_.components + 1);
  } catch (const std::bad_alloc&) {
    throw IoError("its index does not fit in memory");
  }
  const auto read_next = [&](void* to, std::size_t count) {
    file_->read(at, to, count);
    at += count;
  };
  std::uint32_t sum;
  read_next(header.data(), header.size());
  read_next(runs_.data(), bytes_of(runs_).size());
  read_next(components_.data(), bytes_of(components_).size());
  read_next(texts_.data(), bytes_of(texts_).size());
  read_next(&sum, sizeof sum);
  require_good(sum == check_sum({bytes_of(preamble_), header, bytes_of(runs_), bytes_of(components_),
                                 bytes_of(texts_)}),
               "is damaged: the checksum does not match");
  header_ = parse_object_header(std::string_view(header).substr(0, preamble_.header_bytes), scalar_);
  header_.cloud = parse_partial_file(std::string_view(header).substr(preamble_.header_bytes), false);
}

void ObjectFile::require_right_index() const {
  const std::uint64_t step = share_record_bytes(scalar_);
  std::uint64_t left = preamble_.record_bytes;
  bool right = true;
  for (const ShareRun& run : runs_) {
    right = right && run.points > 0 && run.points <= left / step &&
            (run.component == ShareRun::kNoise || run.component < components_.size());
    left -= right ? run.points * step : 0;
  }
  const std::uint64_t bits = ground_bit_count(header_);
  right = right && (bits == 0 || points_in(runs_) <= bits);
  const bool sorted = std::is_sorted(texts_.begin(), texts_.end(),
                                     [](const auto& a, const auto& b) { return a.begin < b.begin; });
  require_good(right && left == 0 && sorted && texts_.front().begin == 0 &&
                   texts_.back().begin <= preamble_.text_bytes &&
                   preamble_.text_bytes - texts_.back().begin == ground_bytes(bits),
               "its index is wrong");
}

void ObjectFile::read(std::uint64_t first_byte, std::byte* to, std::size_t count) const {
  file_->read(begin_ + sizeof preamble_ + first_byte, to, count);
}

void ObjectFile::read_bytes(std::uint64_t first_byte, std::byte* to, std::size_t count) const {
  file_->read(begin_ + first_byte, to, count);
}

std::optional<std::string> ObjectFile::text(std::uint32_t component) const {
  if (!has_text(component)) return std::nullopt;
  std::string text(texts_[component + 1].begin - texts_[component].begin, '\0');
  const std::uint64_t first_text = begin_ + sizeof preamble_ + preamble_.record_bytes;
  file_->read(first_text + texts_[component].begin, text.data(), text.size());
  require_good(check_sum({text}) == texts_[component].check_sum, "is damaged: a volume has changed");
  return text;
}

void ObjectFile::mark_ground(std::size_t first, std::vector<std::uint8_t>& ground) const {
  const std::size_t points = ground_bit_count(header_);
  if (points == 0) return;
  const std::size_t own = header_.cloud.shares.front().first;
  const std::uint64_t section = begin_ + sizeof preamble_ + preamble_.record_bytes + texts_.back().begin;
  const std::size_t begin = std::max(first, own), end = std::min(first + ground.size(), own + points);
  std::vector<char> block;
  for (std::size_t number = begin; number < end;) {
    const std::size_t block_first = (number - own) / kGroundPoints * kGroundPoints;
    const std::size_t count = std::min(kGroundPoints, points - block_first), bytes = (count + 7) / 8;
    block.resize(bytes + sizeof(std::uint32_t));
    file_->read(section + ground_bytes(block_first), block.data(), block.size());
    std::uint32_t sum;
    std::memcpy(&sum, &block[bytes], sizeof sum);
    require_good(sum == check_sum({{block.data(), bytes}}), "is damaged: its ground has changed");
    for (; number < end && number - own < block_first + count; ++number) {
      const std::size_t bit = number - own - block_first;
      if ((static_cast<unsigned char>(block[bit / 8]) >> bit % 8 & 1U) != 0) ground[number - first] = 1;
    }
  }
}

void join_object_files(const std::filesystem::path& path,
                       const std::vector<std::unique_ptr<ObjectFile>>& shares) {
  create_folder_of(path);
  write_file_atomically(path, [&](const FileSink& sink) {
    std::vector<std::byte> block;
    for (const auto& share : shares) {
      const std::uint64_t bytes = share->end() - share->begin();
      for (std::uint64_t done = 0; done < bytes; done += block.size()) {
        block.resize(std::min<std::uint64_t>(kBlock, bytes - done));
        share->read_bytes(done, block.data(), block.size());
        sink(bytes_of(block));
      }
    }
  });
}

std::vector<std::unique_ptr<ObjectFile>> open_object_file(const std::filesystem::path& path) {
  const auto file = std::make_shared<const InputFile>(path);
  std::vector<std::unique_ptr<ObjectFile>> shares;
  for (std::uint64_t begin = 0; begin < file->size(); begin = shares.back()->end())
    shares.push_back(std::make_unique<ObjectFile>(file, begin));
  return shares;
}

}  // namespace pcl_bv::detail
