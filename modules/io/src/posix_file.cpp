// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "pcl_bv/io/posix_file.h"

#include <fcntl.h>

#include <cctype>
#include <cerrno>
#include <system_error>

namespace pcl_bv::detail {
namespace {

constexpr char kCut[] = "truncated: the file became shorter while it was read";

struct stat status_of(const FileDescriptor& file) {
  struct stat status;
  if (::fstat(file.get(), &status) != 0) throw IoError(system_reason(errno));
  return status;
}

bool same(const timespec& a, const timespec& b) {
  return a.tv_sec == b.tv_sec && a.tv_nsec == b.tv_nsec;
}

}  // namespace

std::string system_reason(int error) {
  std::string reason = std::generic_category().message(error);
  if (!reason.empty()) reason[0] = static_cast<char>(std::tolower(static_cast<unsigned char>(reason[0])));
  return reason;
}

FileDescriptor::FileDescriptor(const std::filesystem::path& path, int flags, unsigned mode,
                               const std::string& context)
    : fd_(::open(path.c_str(), flags | O_CLOEXEC, mode)) {
  if (fd_ < 0) throw IoError(context + system_reason(errno));
}

// Without O_NONBLOCK, open() would wait for a writer of a pipe, but pipes must be refused at once. O_NONBLOCK
// has no effect on regular files.
InputFile::InputFile(const std::filesystem::path& path) : file_(path, O_RDONLY | O_NONBLOCK, 0, "") {
  opened_ = status_of(file_);
  if (S_ISDIR(opened_.st_mode)) throw IoError(system_reason(EISDIR));
  if (!S_ISREG(opened_.st_mode)) throw IoError("not a regular file");
  if (opened_.st_size == 0) throw IoError("empty file");
  size_ = static_cast<std::size_t>(opened_.st_size);
}

void InputFile::read(std::size_t offset, void* to, std::size_t bytes) const {
  char* at = static_cast<char*>(to);
  while (bytes > 0) {
    const ssize_t got = ::pread(file_.get(), at, bytes, static_cast<off_t>(offset));
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) throw IoError(system_reason(errno));
    if (got == 0) throw IoError(kCut);
    at += got;
    offset += static_cast<std::size_t>(got);
    bytes -= static_cast<std::size_t>(got);
  }
  require_unchanged();
}

// fstat() describes the open file, whatever its name now refers to. If another file takes the name, the
// number of links and st_ctim change, but not the content of the open file. `relinked` is true in this case,
// and st_ctim is not compared. If the number of links is unchanged, st_ctim detects writers that restore
// st_mtim. Three kinds of changes stay undetected: writes within a tick of the system's clock (4 ms) after
// the opening, writes through an earlier mapping, and writes after which the number of links differs and
// st_mtim is restored. CloudFile detects most of these changes by checksums.
void InputFile::require_unchanged() const {
  const struct stat now = status_of(file_);
  if (now.st_size < opened_.st_size) throw IoError(kCut);
  const bool relinked = now.st_nlink != opened_.st_nlink;
  if (now.st_size == opened_.st_size && same(now.st_mtim, opened_.st_mtim) &&
      (relinked || same(now.st_ctim, opened_.st_ctim)))
    return;
  throw IoError(kChangedWhileRead);
}

FileIdentity InputFile::identity() const {
  const auto number = [](auto value) { return static_cast<std::int64_t>(value); };
  const struct stat& s = opened_;
  return {number(s.st_dev),         number(s.st_ino),          number(s.st_size),
          number(s.st_mtim.tv_sec), number(s.st_mtim.tv_nsec), number(s.st_ctim.tv_sec),
          number(s.st_ctim.tv_nsec)};
}

void InputFile::prefetch(std::size_t offset, std::size_t bytes) const {
  ::posix_fadvise(file_.get(), static_cast<off_t>(offset), static_cast<off_t>(bytes), POSIX_FADV_WILLNEED);
}

}  // namespace pcl_bv::detail
