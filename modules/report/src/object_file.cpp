// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "pcl_bv/report/object_file.h"

#include <algorithm>
#include <boost/crc.hpp>
#include <cstring>
#include <fstream>
#include <limits>

#include "pcl_bv/io/atomic_file.h"
#include "pcl_bv/io/raw_cloud.h"
#include "pcl_bv/io/read_json.h"

namespace pcl_bv::detail {
namespace {

// A file is a preamble, the header as JSON, the index (runs, components, ends of texts), a CRC-32 of all
// these, the records of the points, and the texts.
constexpr char kObjectFormat[24] = "pcl_bv objects 1\n";
struct Preamble {
  char format[sizeof kObjectFormat];
  std::uint64_t header_bytes, cloud_bytes, runs, components, text_bytes;
};
static_assert(sizeof(Preamble) == 64);
static_assert(sizeof(ShareRun) == 24 && sizeof(ShareComponent) == 16);

constexpr std::uint64_t kMaxHeader = 1U << 24U, kMaxItems = std::uint64_t{1} << 32U;
constexpr std::size_t kBlock = 1U << 22U;

template <typename T>
std::string_view bytes_of(const std::vector<T>& items) {
  return {reinterpret_cast<const char*>(items.data()), items.size() * sizeof(T)};
}

std::uint32_t check_sum(std::initializer_list<std::string_view> parts) {
  boost::crc_32_type sum;
  for (const std::string_view part : parts)
    sum.process_bytes(part.data(), part.size());
  return sum.checksum();
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

std::string header_text(const ObjectFileHeader& header, ScalarType scalar) {
  const nlohmann::ordered_json json{{"scalar", scalar == ScalarType::float32 ? "float32" : "float64"},
                                    {"nonfinite", header.nonfinite},
                                    {"clusters", header.clusters},
                                    {"volumes", header.volumes}};
  return json.dump(-1, ' ', true, UntrustedJson::error_handler_t::replace) + '\n';
}

void write(std::ofstream& out, std::string_view bytes) {
  out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  if (!out) throw IoError("cannot be written: is the disk full?");
}

template <typename Read>
void copy(const Read& read, std::uint64_t bytes, std::ofstream& out) {
  std::vector<std::byte> block;
  for (std::uint64_t done = 0; done < bytes; done += block.size()) {
    block.resize(std::min<std::uint64_t>(kBlock, bytes - done));
    read(done, block.data(), block.size());
    write(out, bytes_of(block));
  }
}

// Writes a file with a stream, and creates missing folders.
void write_stream(const std::filesystem::path& path, FileLife life,
                  const std::function<void(std::ofstream&)>& work) {
  const auto write_to = [&](const std::filesystem::path& file) {
    std::ofstream out(file, std::ios::binary | std::ios::trunc);
    if (!out) throw IoError("cannot be opened for writing");
    work(out);
    out.flush();
    if (!out) throw IoError("cannot be written: is the disk full?");
  };
  create_parent_folders(path);
  life == FileLife::temporary ? write_to(path) : replace_file_atomically(path, write_to);
}

}  // namespace

void write_object_file(const std::filesystem::path& path, const ObjectFileHeader& header,
                       const ClusterShare& share,
                       const std::function<std::string(std::uint32_t component)>& text, FileLife life) {
  std::vector<std::string> texts(share.components().size());
  std::vector<std::uint64_t> ends{0};
  for (std::uint32_t c = 0; c < texts.size(); ++c) {
    texts[c] = text(c);
    ends.push_back(ends.back() + texts[c].size());
  }
  const std::string cloud = partial_file_content(header.cloud), own = header_text(header, share.scalar());
  Preamble preamble{{}, own.size(), cloud.size(), share.runs().size(), texts.size(), ends.back()};
  std::memcpy(preamble.format, kObjectFormat, sizeof kObjectFormat);
  const std::string_view start(reinterpret_cast<const char*>(&preamble), sizeof preamble);
  const std::uint32_t sum =
      check_sum({start, own, cloud, bytes_of(share.runs()), bytes_of(share.components()), bytes_of(ends)});
  write_stream(path, life, [&](std::ofstream& out) {
    for (const std::string_view part : {start, std::string_view(own), std::string_view(cloud),
                                        bytes_of(share.runs()), bytes_of(share.components()), bytes_of(ends),
                                        std::string_view(reinterpret_cast<const char*>(&sum), sizeof sum)})
      write(out, part);
    copy([&](std::uint64_t at, std::byte* to, std::size_t count) { share.read(at, to, count); },
         points_in(share.runs()) * share_record_bytes(share.scalar()), out);
    for (const std::string& each : texts)
      write(out, each);
  });
}

ObjectFile::ObjectFile(std::shared_ptr<const InputFile> file, std::uint64_t begin)
    : file_(std::move(file)), begin_(begin) {
  Preamble preamble;
  require_good(file_->size() - begin >= sizeof preamble, "is truncated");
  file_->read(begin, &preamble, sizeof preamble);
  require_good(std::memcmp(preamble.format, kObjectFormat, 15) == 0,
               "is no file of objects, as --partial writes them");
  require_good(std::memcmp(preamble.format, kObjectFormat, sizeof kObjectFormat) == 0,
               "was written by another version of pcl_bv: this one reads version 1");
  require_good(preamble.header_bytes <= kMaxHeader && preamble.cloud_bytes <= kMaxHeader &&
                   preamble.runs <= kMaxItems && preamble.components <= kMaxItems,
               "is damaged: its index is too large");
  const std::uint64_t index = preamble.runs * sizeof(ShareRun) +
                              preamble.components * sizeof(ShareComponent) + (preamble.components + 1) * 8;
  const std::uint64_t at = begin + sizeof preamble, left = file_->size() - at;
  require_good(preamble.header_bytes + preamble.cloud_bytes + index + 4 <= left, "is truncated");
  std::string header(preamble.header_bytes + preamble.cloud_bytes, '\0');
  file_->read(at, header.data(), header.size());
  runs_.resize(preamble.runs);
  components_.resize(preamble.components);
  texts_.resize(preamble.components + 1);
  std::uint64_t offset = at + header.size();
  const auto read_list = [&](auto& list) {
    const std::size_t bytes = bytes_of(list).size();
    file_->read(offset, list.data(), bytes);
    offset += bytes;
  };
  read_list(runs_);
  read_list(components_);
  read_list(texts_);
  std::uint32_t sum;
  file_->read(offset, &sum, sizeof sum);
  const std::string_view start(reinterpret_cast<const char*>(&preamble), sizeof preamble);
  require_good(sum == check_sum({start, header, bytes_of(runs_), bytes_of(components_), bytes_of(texts_)}),
               "is damaged: the checksum does not match");
  records_ = offset + sizeof sum;
  read_header(std::string_view(header).substr(0, preamble.header_bytes));
  header_.cloud = parse_partial_file(std::string_view(header).substr(preamble.header_bytes), false);
  first_text_ = records_ + points_in(runs_) * share_record_bytes(scalar_);
  end_ = first_text_ + preamble.text_bytes;
  require_good(end_ <= file_->size(), "is truncated");
  for (const ShareRun& run : runs_)
    require_good(run.component == ShareRun::kNoise || run.component < components_.size(),
                 "its index is wrong");
  require_good(std::is_sorted(texts_.begin(), texts_.end()) && texts_.front() == 0 &&
                   texts_.back() == preamble.text_bytes,
               "its index is wrong");
}

void ObjectFile::read_header(std::string_view content) {
  try {
    const UntrustedJson json = read_json(content);
    scalar_ = json.at("scalar").get<std::string>() == "float64" ? ScalarType::float64 : ScalarType::float32;
    header_.nonfinite = json.at("nonfinite").get<std::size_t>();
    header_.clusters = json.at("clusters").get<std::string>();
    header_.volumes = json.at("volumes").get<std::string>();
  } catch (const UntrustedJson::exception&) {
    throw IoError("its header cannot be read");
  }
}

void ObjectFile::read(std::uint64_t first_byte, std::byte* to, std::size_t count) const {
  file_->read(records_ + first_byte, to, count);
}

void ObjectFile::read_bytes(std::uint64_t first_byte, std::byte* to, std::size_t count) const {
  file_->read(begin_ + first_byte, to, count);
}

std::optional<std::string> ObjectFile::text(std::uint32_t component) const {
  if (!has_text(component)) return std::nullopt;
  std::string text(texts_[component + 1] - texts_[component], '\0');
  file_->read(first_text_ + texts_[component], text.data(), text.size());
  return text;
}

void join_object_files(const std::filesystem::path& path,
                       const std::vector<std::unique_ptr<ObjectFile>>& shares) {
  write_stream(path, FileLife::lasting, [&](std::ofstream& out) {
    for (const auto& share : shares)
      copy([&](std::uint64_t at, std::byte* to, std::size_t count) { share->read_bytes(at, to, count); },
           share->end() - share->begin(), out);
  });
}

bool is_object_file(const std::filesystem::path& path) {
  const InputFile file(path);
  char start[15] = {};
  if (file.size() >= sizeof start) file.read(0, start, sizeof start);
  return std::memcmp(start, kObjectFormat, sizeof start) == 0;
}

std::vector<std::unique_ptr<ObjectFile>> open_object_file(const std::filesystem::path& path) {
  const auto file = std::make_shared<const InputFile>(path);
  std::vector<std::unique_ptr<ObjectFile>> shares;
  for (std::uint64_t begin = 0; begin < file->size(); begin = shares.back()->end())
    shares.push_back(std::make_unique<ObjectFile>(file, begin));
  return shares;
}

}  // namespace pcl_bv::detail
