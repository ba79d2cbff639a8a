// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "spill_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <stdexcept>
#include <string>
#include <system_error>

namespace pcl_bv::detail {
namespace {

[[noreturn]] void fail(const char* what, const std::filesystem::path& folder, int error) {
  throw std::runtime_error(std::string("cannot ") + what + " a temporary file in " + folder.string() + ": " +
                           std::generic_category().message(error));
}

int open_unnamed(const std::filesystem::path& folder) {
  std::string name = (folder / "pcl_bv_XXXXXX").string();
  const int fd = ::mkostemp(name.data(), O_CLOEXEC);
  if (fd < 0) fail("make", folder, errno);
  ::unlink(name.c_str());
  return fd;
}

}  // namespace

SpillFile::SpillFile(const std::filesystem::path& folder)
    : folder_(folder.empty() ? std::filesystem::temp_directory_path() : folder), fd_(open_unnamed(folder_)) {}

SpillFile::~SpillFile() {
  ::close(fd_);
}

Extent SpillFile::append(const void* bytes, std::size_t count) {
  const Extent extent{end_.fetch_add(count), count};
  std::uint64_t at = extent.offset;
  const char* from = static_cast<const char*>(bytes);
  while (count > 0) {
    const ssize_t written = ::pwrite(fd_, from, count, static_cast<off_t>(at));
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) fail("write", folder_, written < 0 ? errno : ENOSPC);
    from += written;
    count -= static_cast<std::size_t>(written);
    at += static_cast<std::uint64_t>(written);
  }
  return extent;
}

void SpillFile::read(std::uint64_t offset, void* to, std::size_t count) const {
  char* at = static_cast<char*>(to);
  while (count > 0) {
    const ssize_t got = ::pread(fd_, at, count, static_cast<off_t>(offset));
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) fail("read", folder_, got < 0 ? errno : EIO);
    at += got;
    count -= static_cast<std::size_t>(got);
    offset += static_cast<std::uint64_t>(got);
  }
}

void SpillFile::discard(const Extent& extent) {
#ifdef FALLOC_FL_PUNCH_HOLE
  if (extent.bytes > 0)
    static_cast<void>(::fallocate(fd_, FALLOC_FL_PUNCH_HOLE | FALLOC_FL_KEEP_SIZE,
                                  static_cast<off_t>(extent.offset), static_cast<off_t>(extent.bytes)));
#endif
}

void SpillList::discard(SpillFile& file) const {
  for (const Extent& extent : extents_)
    file.discard(extent);
}

void SpillList::add(SpillFile& file, const void* bytes, std::size_t count, std::size_t block_bytes) {
  const auto* const from = static_cast<const std::byte*>(bytes);
  buffer_.insert(buffer_.end(), from, from + count);
  if (buffer_.size() < block_bytes) return;
  extents_.push_back(file.append(buffer_.data(), buffer_.size()));
  bytes_ += buffer_.size();
  buffer_.clear();
}

void SpillList::finish(SpillFile& file) {
  if (!buffer_.empty()) {
    extents_.push_back(file.append(buffer_.data(), buffer_.size()));
    bytes_ += buffer_.size();
  }
  buffer_ = {};
}

void SpillList::read(const SpillFile& file, std::vector<std::byte>& to) const {
  to.resize(bytes_);
  std::size_t at = 0;
  for (const Extent& extent : extents_) {
    file.read(extent.offset, to.data() + at, extent.bytes);
    at += extent.bytes;
  }
}

}  // namespace pcl_bv::detail
