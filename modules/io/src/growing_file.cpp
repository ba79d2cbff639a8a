// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Uses POSIX calls without a buffer in this process, so that no written text is lost when the process is
// killed. Files have locks of fcntl, because `flock FILE COMMAND` of a shell holds the other kind. Folders
// can have only the other kind.

#include "pcl_bv/io/growing_file.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <map>
#include <mutex>
#include <utility>

#include "pcl_bv/io/atomic_file.h"

namespace pcl_bv::detail {
namespace {

// Removes the last `written` bytes before the position of a regular file, and writes `overwritten` in their
// place.
void take_back(int descriptor, std::size_t written, std::string_view overwritten) {
  struct stat status;
  const off_t end = ::lseek(descriptor, 0, SEEK_CUR);
  const off_t begin = end - static_cast<off_t>(written);
  const off_t former_end = begin + static_cast<off_t>(overwritten.size());
  if (begin < 0 || ::fstat(descriptor, &status) != 0 || !S_ISREG(status.st_mode)) return;
  if (status.st_size > std::max(end, former_end)) return;  // another program has appended to the file
  if (::pwrite(descriptor, overwritten.data(), overwritten.size(), begin) < 0) return;
  if (::ftruncate(descriptor, former_end) == 0) ::lseek(descriptor, former_end, SEEK_SET);
}

// Throws IoError if another descriptor has the lock, in this or another process.
void lock_file(const FileDescriptor& file) {
  struct flock whole {};
  whole.l_type = F_WRLCK;
  whole.l_whence = SEEK_SET;
  if (::fcntl(file.get(), F_OFD_SETLK, &whole) != 0 && (errno == EAGAIN || errno == EACCES))
    throw IoError("locked: another program or another output writes to this file");
}

}  // namespace

int write_whole(int descriptor, std::string_view bytes, std::string_view overwritten) {
  for (std::string_view rest = bytes; !rest.empty();) {
    const ssize_t written = ::write(descriptor, rest.data(), rest.size());
    if (written >= 0) {
      rest.remove_prefix(static_cast<std::size_t>(written));
    } else if (errno == EAGAIN || errno == EWOULDBLOCK) {
      pollfd writable{descriptor, POLLOUT, 0};
      ::poll(&writable, 1, -1);
    } else if (errno != EINTR) {
      const int error = errno;
      take_back(descriptor, bytes.size() - rest.size(), overwritten);
      return error;
    }
  }
  return 0;
}

GrowingFile::GrowingFile(const std::filesystem::path& file) : file_(open(follow_links(file))) {}

GrowingFile::~GrowingFile() {
  if (!created_.empty()) ::unlink(created_.c_str());
}

// Opens again if another writer has removed or replaced the file between the opening and the locking. Some
// file systems never give the same number for a file, so the number of tries is limited.
FileDescriptor GrowingFile::open(const std::filesystem::path& file) {
  constexpr int flags = O_WRONLY | O_CLOEXEC;
  for (int tries = 0;; ++tries) {
    int descriptor = ::open(file.c_str(), flags);
    const bool missing = descriptor < 0 && errno == ENOENT;
    if (missing) descriptor = ::open(file.c_str(), flags | O_CREAT | O_EXCL, 0644);
    if (missing && descriptor < 0 && errno == EEXIST) continue;
    if (descriptor < 0) throw IoError(system_reason(errno));
    FileDescriptor opened(descriptor);
    struct stat status, named;
    if (::fstat(opened.get(), &status) == 0 && S_ISREG(status.st_mode)) {
      lock_file(opened);
      const bool replaced =
          ::stat(file.c_str(), &named) != 0 || named.st_ino != status.st_ino || named.st_dev != status.st_dev;
      if (replaced && tries < 100) continue;
    }
    if (missing) created_ = file;
    return opened;
  }
}

// Empties a regular file. For other files, such as pipes, ftruncate() fails with EINVAL, which is ignored.
int GrowingFile::begin() {
  if (std::exchange(begun_, true)) return 0;
  return ::ftruncate(file_.get(), 0) == 0 || errno == EINVAL ? 0 : errno;
}

int GrowingFile::append(std::string_view bytes, std::size_t tail) {
  if (const int error = begin()) return error;
  if (!tail_.empty() && ::lseek(file_.get(), -static_cast<off_t>(tail_.size()), SEEK_CUR) < 0 &&
      errno != ESPIPE)
    return errno;
  if (const int error = write_whole(file_.get(), bytes, tail_)) return error;
  tail_ = bytes.substr(bytes.size() - tail);
  created_.clear();
  return 0;
}

int GrowingFile::close() {
  if (file_.get() < 0) return 0;
  if (const int error = begin()) return error;
  created_.clear();
  return file_.close() ? 0 : errno;
}

std::shared_ptr<const FileDescriptor> lock_folder(const std::filesystem::path& folder, bool exclusive) {
  static std::mutex mutex;
  static auto* const locked = new std::map<std::pair<dev_t, ino_t>, std::weak_ptr<const FileDescriptor>>;
  const int descriptor = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) return nullptr;
  // Closes under the mutex: an expired entry of `locked` is then also an unlocked folder.
  std::shared_ptr<const FileDescriptor> opened(new FileDescriptor(descriptor),
                                               [](const FileDescriptor* unlocked) {
                                                 const std::lock_guard lock(mutex);
                                                 delete unlocked;
                                               });
  struct stat status;
  if (::fstat(descriptor, &status) != 0) return nullptr;
  std::unique_lock lock(mutex);
  std::weak_ptr<const FileDescriptor>& known = (*locked)[{status.st_dev, status.st_ino}];
  if (auto ours = known.lock()) {
    lock.unlock();
    if (exclusive) throw IoError("locked: another output writes to this folder");
    return ours;
  }
  if (::flock(descriptor, LOCK_EX | LOCK_NB) != 0) {
    const bool is_locked = errno == EWOULDBLOCK;
    lock.unlock();
    if (is_locked) throw IoError("locked: another program writes to this folder");
    return nullptr;
  }
  known = opened;
  return opened;
}

}  // namespace pcl_bv::detail
