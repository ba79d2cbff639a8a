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

[[noreturn]] void fail(const char* what, const std::string& name, int error) {
  throw std::runtime_error(std::string("cannot ") + what + ' ' + name + ": " +
                           std::generic_category().message(error));
}

std::filesystem::path temporary_folder() {
  std::error_code failure;
  std::filesystem::path folder = std::filesystem::temp_directory_path(failure);
  if (!failure) return folder;
  const char* const given = std::getenv("TMPDIR");
  fail("use", given == nullptr ? "a folder for temporary files" : std::string("TMPDIR, ") + given,
       failure.value());
}

}  // namespace

SpillFile::SpillFile(const std::filesystem::path& given) {
  const std::filesystem::path folder = given.empty() ? temporary_folder() : given;
  name_ = "a temporary file in " + folder.string();
  std::string path = (folder / "pcl_bv_XXXXXX").string();
  fd_ = ::mkostemp(path.data(), O_CLOEXEC);
  if (fd_ < 0) fail("make", name_, errno);
  ::unlink(path.c_str());
}

SpillFile::SpillFile(const std::filesystem::path& file, std::uint64_t begin)
    : name_("its points"), fd_(::open(file.c_str(), O_RDWR | O_CLOEXEC)), begin_(begin) {
  if (fd_ < 0) fail("open", name_, errno);
}

SpillFile::~SpillFile() {
  ::close(fd_);
}

Extent SpillFile::append(const void* bytes, std::size_t count) {
  const Extent extent{end_.fetch_add(count), count};
  write(extent.offset, bytes, count);
  return extent;
}

void SpillFile::reserve(std::uint64_t bytes) {
  if (::ftruncate(fd_, static_cast<off_t>(begin_ + (end_ += bytes))) != 0) fail("write", name_, errno);
}

void SpillFile::write(std::uint64_t offset, const void* bytes, std::size_t count) {
  const char* from = static_cast<const char*>(bytes);
  while (count > 0) {
    const ssize_t written = ::pwrite(fd_, from, count, static_cast<off_t>(begin_ + offset));
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) fail("write", name_, written < 0 ? errno : ENOSPC);
    from += written;
    count -= static_cast<std::size_t>(written);
    offset += static_cast<std::uint64_t>(written);
  }
}

void SpillFile::read(std::uint64_t offset, void* to, std::size_t count) const {
  char* at = static_cast<char*>(to);
  while (count > 0) {
    const ssize_t got = ::pread(fd_, at, count, static_cast<off_t>(begin_ + offset));
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) fail("read", name_, got < 0 ? errno : EIO);
    at += got;
    count -= static_cast<std::size_t>(got);
    offset += static_cast<std::uint64_t>(got);
  }
}

void SpillFile::discard(const Extent& extent) {
#ifdef FALLOC_FL_PUNCH_HOLE
  if (extent.bytes > 0)
    static_cast<void>(::fallocate(fd_, FALLOC_FL_PUNCH_HOLE | FALLOC_FL_KEEP_SIZE,
                                  static_cast<off_t>(begin_ + extent.offset),
                                  static_cast<off_t>(extent.bytes)));
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
