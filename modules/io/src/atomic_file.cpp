// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// A temporary file beside the target, on the same file system, makes the final rename one step.
#include "pcl_bv/io/atomic_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <random>
#include <string>

#include "posix_file.h"

namespace pcl_bv {
namespace {

namespace fs = std::filesystem;
using Pieces = std::initializer_list<std::string_view>;

const char cannot_write[] = "cannot write: ";

// Throws the reason that errno holds unless a call succeeded.
void require(bool success) {
  if (!success) throw IoError(cannot_write + system_reason(errno));
}

void write_and_close(FileDescriptor& file, Pieces pieces) {
  for (std::string_view rest : pieces) {
    while (!rest.empty()) {
      const ssize_t written = ::write(file.get(), rest.data(), rest.size());
      if (written < 0 && errno == EINTR) continue;
      require(written >= 0);
      rest.remove_prefix(static_cast<std::size_t>(written));
    }
  }
  require(file.close());
}

// 64 random bits, and O_EXCL when it is opened: no two writers, on whatever machines, share a temporary file.
fs::path temporary_name() {
  std::random_device random;
  return ".pcl_bv-" + std::to_string(random()) + "-" + std::to_string(random()) + ".tmp";
}

// Removes the file unless it has been renamed.
class TemporaryFile {
 public:
  explicit TemporaryFile(const fs::path& folder)
      : path_(folder / temporary_name()), file_(path_, O_WRONLY | O_CREAT | O_EXCL, 0644, cannot_write) {}
  ~TemporaryFile() {
    if (!renamed_) ::unlink(path_.c_str());
  }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;

  FileDescriptor& file() { return file_; }

  void rename_to(const fs::path& target) {
    require(::rename(path_.c_str(), target.c_str()) == 0);
    renamed_ = true;
  }

 private:
  fs::path path_;
  FileDescriptor file_;
  bool renamed_ = false;
};

}  // namespace

void write_file_atomically(const fs::path& path, std::string_view content) {
  write_file_atomically(path, {content});
}

void write_file_atomically(const fs::path& link_or_file, Pieces pieces) {
  // A link stays a link; what it leads to is replaced. /dev/stdout leads to something that rename must not
  // touch.
  struct stat old;
  const bool exists = ::stat(link_or_file.c_str(), &old) == 0;
  const bool special =
      link_or_file.native().starts_with("/dev/") || link_or_file.native().starts_with("/proc/");
  if (special || (exists && !S_ISREG(old.st_mode))) {
    FileDescriptor direct(link_or_file, O_WRONLY | O_CREAT | O_TRUNC | O_NOCTTY, 0644, cannot_write);
    return write_and_close(direct, pieces);
  }
  std::error_code unresolved;
  const fs::path resolved = fs::weakly_canonical(link_or_file, unresolved);
  const fs::path path = exists && !unresolved ? resolved : link_or_file;
  if (exists) require(::faccessat(AT_FDCWD, path.c_str(), W_OK, AT_EACCESS) == 0);
  TemporaryFile temporary(path.parent_path());
  if (exists) require(::fchmod(temporary.file().get(), old.st_mode & 0777) == 0);
  write_and_close(temporary.file(), pieces);
  temporary.rename_to(path);
}

}  // namespace pcl_bv
