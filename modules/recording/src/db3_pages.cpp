// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "db3_pages.h"

#include <algorithm>
#include <string>

#include "formats.h"
#include "pcl_bv/io/raw_cloud.h"

namespace pcl_bv::detail {
namespace {

constexpr std::uint64_t kFileHeader = 100;  // bytes at the beginning of the first page
constexpr int kTableLeaf = 0x0D;
constexpr std::size_t kMaxColumns = 16;  // all tables have fewer; limits the work for a damaged row

std::uint64_t big(const std::byte* at, std::size_t bytes) {
  std::uint64_t value = 0;
  for (std::size_t i = 0; i < bytes; ++i)
    value = value << 8U | std::to_integer<std::uint64_t>(at[i]);
  return value;
}

// Reads a part of a page in sequence. Throws IoError if the rest of the part is too short.
class PageBytes {
 public:
  PageBytes(const std::vector<std::byte>& page, std::uint64_t from, std::uint64_t to)
      : page_(page), at_(from), end_(std::min<std::uint64_t>(to, page.size())) {}

  std::uint64_t at() const { return at_; }
  const std::byte* take(std::uint64_t bytes) {
    if (at_ > end_ || bytes > end_ - at_) throw IoError("a row ends within a value");
    at_ += bytes;
    return page_.data() + (at_ - bytes);
  }
  std::uint64_t varint() {
    std::uint64_t value = 0;
    for (int i = 0; i < 8; ++i) {
      const auto byte = std::to_integer<std::uint64_t>(*take(1));
      value = value << 7U | (byte & 0x7FU);
      if (byte < 0x80) return value;
    }
    return value << 8U | std::to_integer<std::uint64_t>(*take(1));
  }
  bool ends_before(std::uint64_t position) const { return at_ < position; }

 private:
  const std::vector<std::byte>& page_;
  std::uint64_t at_, end_;
};

// Returns whether a serial type of SQLite is an integer.
bool is_integer(std::uint64_t type) {
  return (type >= 1 && type <= 6) || type == 8 || type == 9;
}
bool is_blob(std::uint64_t type) {
  return type >= 12 && type % 2 == 0;
}
bool is_text(std::uint64_t type) {
  return type >= 13 && type % 2 == 1;
}

std::int64_t take_integer(PageBytes& bytes, std::uint64_t type) {
  if (type >= 8) return static_cast<std::int64_t>(type - 8);
  const std::size_t size = type <= 4 ? type : type == 5 ? 6 : 8;
  const auto value = big(bytes.take(size), size) << (64 - 8 * size);
  return static_cast<std::int64_t>(value) >> (64 - 8 * size);  // extends the sign of the first byte
}

std::string take_text(PageBytes& bytes, std::uint64_t type) {
  const std::uint64_t size = (type - 13) / 2;
  return {reinterpret_cast<const char*>(bytes.take(size)), size};
}

}  // namespace

Db3Pages::Db3Pages(const std::filesystem::path& file) : file_(file) {
  bytes_.resize(std::min<std::uint64_t>(kFileHeader, file_.size()));
  file_.read(0, bytes_.data(), bytes_.size());
  // If the header is damaged, the page size is 4096, which rosbag2 uses by default.
  if (bytes_.size() == kFileHeader) {
    const std::uint64_t size = big(bytes_.data() + 16, 2) == 1 ? 65'536 : big(bytes_.data() + 16, 2);
    const auto reserved = std::to_integer<std::uint64_t>(bytes_[20]);
    const bool power = size >= 512 && (size & (size - 1)) == 0;
    if (power && reserved <= size - 480) {
      page_size_ = size;
      usable_ = size - reserved;
    }
  }
  bytes_.resize(page_size_);
  for (std::uint64_t page = 0; (page + 1) * page_size_ <= file_.size(); ++page)
    read_leaf(page);
  std::stable_sort(messages_.begin(), messages_.end(),
                   [](const Message& a, const Message& b) { return a.id < b.id; });
  const auto same = [](const Message& a, const Message& b) {
    return a.id == b.id;
  };  // the same row can also be on a page that is no longer used
  messages_.erase(std::unique(messages_.begin(), messages_.end(), same), messages_.end());
}

void Db3Pages::read_leaf(std::uint64_t page) {
  const std::uint64_t header = page == 0 ? kFileHeader : 0;
  std::byte start[8];
  file_.read(page * page_size_ + header, start, sizeof start);
  if (std::to_integer<int>(start[0]) != kTableLeaf) return;
  const std::uint64_t cells = big(start + 3, 2);
  if (header + 8 + 2 * cells > page_size_) return;
  file_.read(page * page_size_, bytes_.data(), bytes_.size());
  std::vector<bool> read(page_size_);  // a damaged page may refer to a cell many times
  for (std::uint64_t i = 0; i < cells; ++i) {
    const std::uint64_t cell = big(bytes_.data() + header + 8 + 2 * i, 2);
    if (cell >= page_size_ || read[cell]) continue;
    read[cell] = true;
    try {
      read_row(page, cell);
    } catch (const IoError&) {  // skip the damaged row; the next one may be intact
    }
  }
}

// Recognises the rows of the tables of messages and topics by their column types, which no other table has.
// The first column is the row's id, which SQLite stores as NULL. The other columns of a message are two
// integers and a blob. The next three columns of a topic are texts.
void Db3Pages::read_row(std::uint64_t page, std::uint64_t cell) {
  PageBytes bytes(bytes_, cell, usable_);
  const std::uint64_t payload = bytes.varint();
  const auto id = static_cast<std::int64_t>(bytes.varint());
  const std::uint64_t max_local = usable_ - 35, min_local = (usable_ - 12) * 32 / 255 - 23;
  const std::uint64_t wanted =
      payload <= max_local ? payload : min_local + (payload - min_local) % (usable_ - 4);
  const std::uint64_t local = wanted <= max_local ? wanted : min_local;
  const std::uint64_t begin = bytes.at();
  PageBytes values(bytes_, begin, begin + local);
  const std::uint64_t types_end = begin + values.varint();
  std::vector<std::uint64_t> types;
  while (values.ends_before(types_end)) {
    if (types.size() == kMaxColumns) return;
    types.push_back(values.varint());
  }
  if (types.size() == 4 && types[0] == 0 && is_integer(types[1]) && is_integer(types[2]) &&
      is_blob(types[3])) {
    Message message;
    message.id = id;
    message.topic = take_integer(values, types[1]);
    message.time = take_integer(values, types[2]);
    message.size = (types[3] - 12) / 2;
    if (values.at() - begin + message.size != payload) return;
    message.data = page * page_size_ + values.at();
    message.local = begin + local - values.at();
    if (local < payload)
      message.next_page =
          static_cast<std::uint32_t>(big(PageBytes(bytes_, begin + local, usable_).take(4), 4));
    messages_.push_back(message);
  } else if (types.size() >= 4 && types[0] == 0 && is_text(types[1]) && is_text(types[2]) &&
             is_text(types[3]) && !topics_.contains(id)) {
    RecordedTopic topic;
    topic.name = take_text(values, types[1]);
    topic.type = ros2_type(take_text(values, types[2]));
    topic.encoding = take_text(values, types[3]);
    if (topic.name.starts_with('/')) topics_.emplace(id, std::move(topic));
  }
}

void Db3Pages::load(const Message& message, std::vector<std::byte>& to) const {
  if (message.size > file_.size()) throw IoError("a message is longer than the file");
  to.resize(message.size);
  const std::uint64_t here = std::min(message.local, message.size);
  file_.read(message.data, to.data(), here);
  std::uint64_t page = message.next_page;
  for (std::uint64_t done = here; done < message.size;) {
    if (page == 0 || page * page_size_ > file_.size()) throw IoError("its pages do not follow one another");
    std::byte next[4];
    file_.read((page - 1) * page_size_, next, sizeof next);
    const std::uint64_t part = std::min(usable_ - 4, message.size - done);
    file_.read((page - 1) * page_size_ + 4, to.data() + done, part);
    done += part;
    page = big(next, 4);
  }
}

}  // namespace pcl_bv::detail
