// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The temporary file is in the target's folder, because rename() is atomic only within one file system.
#include "pcl_bv/io/atomic_file.h"

#include <fcntl.h>
#include <linux/magic.h>
#include <sys/stat.h>
#include <sys/vfs.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <mutex>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "pcl_bv/io/posix_file.h"

namespace pcl_bv::detail {
namespace {

namespace fs = std::filesystem;
using Pieces = std::vector<std::string_view>;

const char cannot_write[] = "cannot write: ";

// Throws IoError with the reason in errno if `success` is false.
void require(bool success) {
  if (!success) throw IoError(cannot_write + system_reason(errno));
}

void write_all(const FileDescriptor& file, std::string_view rest) {
  while (!rest.empty()) {
    const ssize_t written = ::write(file.get(), rest.data(), rest.size());
    if (written < 0 && errno == EINTR) continue;
    require(written >= 0);
    rest.remove_prefix(static_cast<std::size_t>(written));
  }
}

// Ignores EINVAL, because some file systems return it for the fsync of a folder.
void sync_to_disk(const FileDescriptor& file) {
  int failed = 0;
  do
    failed = ::fsync(file.get());
  while (failed != 0 && errno == EINTR);
  require(failed == 0 || errno == EINVAL);
}

// Returns a name with 64 random bits. Together with O_EXCL at opening, no two writers share a temporary file,
// even on different machines.
fs::path temporary_name() {
  std::random_device random;
  return ".pcl_bv-" + std::to_string(random()) + "-" + std::to_string(random()) + ".tmp";
}

// The existing temporary files. If `ended`, no further ones may be created. The object is never destroyed,
// because other threads may run until the process ends.
struct Temporaries {
  std::mutex mutex;
  std::vector<fs::path> paths;
  bool ended = false;

  // Requires that the caller holds the lock.
  void require_not_ended() const {
    if (ended) throw IoError(std::string(cannot_write) + "the program is terminating");
  }
};

Temporaries& temporaries() {
  static auto* const all = new Temporaries;
  return *all;
}

// Registers the name of a temporary file. The destructor removes the file and the registration.
class TemporaryName {
 public:
  explicit TemporaryName(fs::path path) : path_(std::move(path)) {
    const std::lock_guard lock(temporaries().mutex);
    temporaries().paths.push_back(path_);
  }
  ~TemporaryName() {
    const std::lock_guard lock(temporaries().mutex);
    ::unlink(path_.c_str());
    std::vector<fs::path>& paths = temporaries().paths;
    paths.erase(std::find(paths.begin(), paths.end(), path_));
  }
  TemporaryName(const TemporaryName&) = delete;
  TemporaryName& operator=(const TemporaryName&) = delete;

  const fs::path& path() const { return path_; }

  FileDescriptor create() const {
    const std::lock_guard lock(temporaries().mutex);
    temporaries().require_not_ended();
    return {path_, O_WRONLY | O_CREAT | O_EXCL, 0644, cannot_write};
  }

  void rename_to(const fs::path& target) const {
    const std::lock_guard lock(temporaries().mutex);
    temporaries().require_not_ended();
    require(::rename(path_.c_str(), target.c_str()) == 0);
  }

 private:
  fs::path path_;
};

fs::path folder_of(const fs::path& path) {
  return path.has_parent_path() ? path.parent_path() : ".";
}

bool is_in_proc(const fs::path& path) {
  struct statfs system;
  return ::statfs(folder_of(path).c_str(), &system) == 0 && system.f_type == PROC_SUPER_MAGIC;
}

// The target of /dev/stdout must not be replaced by rename(), although it may be a regular file.
bool is_written_directly(const fs::path& path) {
  struct stat old;
  return is_in_proc(path) || (::stat(path.c_str(), &old) == 0 && !S_ISREG(old.st_mode));
}

// Gives a new file the mode of the old one, and its owner and group if this process may set them.
void copy_permissions(const FileDescriptor& file, const struct stat& old) {
  constexpr auto same_owner = static_cast<uid_t>(-1);
  [[maybe_unused]] const bool copied =
      ::fchown(file.get(), old.st_uid, old.st_gid) == 0 || ::fchown(file.get(), same_owner, old.st_gid) == 0;
  require(::fchmod(file.get(), old.st_mode & 0777) == 0);
}

// Replaces or creates a regular file. `write` gets the temporary file, open, and its path.
template <class Write>
void replace(const fs::path& path, const Write& write) {
  struct stat old;
  const bool exists = ::stat(path.c_str(), &old) == 0;
  if (exists) require(::faccessat(AT_FDCWD, path.c_str(), W_OK, AT_EACCESS) == 0);
  // Open the folder first, because the old file must not be replaced if the folder cannot be opened for its
  // fsync.
  const FileDescriptor folder_descriptor(folder_of(path), O_RDONLY | O_DIRECTORY, 0, cannot_write);
  const TemporaryName name(path.parent_path() / temporary_name());
  FileDescriptor file = name.create();
  if (exists) copy_permissions(file, old);
  write(file, name.path());
  sync_to_disk(file);
  require(file.close());
  name.rename_to(path);
  sync_to_disk(folder_descriptor);
}

}  // namespace

void write_file_atomically(const fs::path& path, std::string_view content) {
  write_file_atomically(path, Pieces{content});
}

void write_file_atomically(const fs::path& path, std::initializer_list<std::string_view> pieces) {
  write_file_atomically(path, Pieces(pieces));
}

void write_file_atomically(const fs::path& path, const Pieces& pieces) {
  write_file_atomically(path, [&](const FileSink& sink) {
    for (const std::string_view piece : pieces)
      sink(piece);
  });
}

void write_file_atomically(const fs::path& link_or_file,
                           const std::function<void(const FileSink& sink)>& write) {
  const fs::path path = follow_links(link_or_file);
  const auto write_to = [&](const FileDescriptor& file) {
    write([&file](std::string_view piece) { write_all(file, piece); });
  };
  if (!is_written_directly(path))
    return replace(path, [&](const FileDescriptor& file, const fs::path&) { write_to(file); });
  FileDescriptor direct(path, O_WRONLY | O_CREAT | O_TRUNC | O_NOCTTY, 0644, cannot_write);
  write_to(direct);
  require(direct.close());
}

void replace_file_atomically(const fs::path& link_or_file,
                             const std::function<void(const fs::path&)>& write) {
  const fs::path path = follow_links(link_or_file);
  if (is_written_directly(path)) return write(path);
  replace(path, [&](const FileDescriptor&, const fs::path& temporary) { write(temporary); });
}

fs::path follow_links(fs::path path) {
  std::error_code unknown;
  for (int links = 0; fs::is_symlink(fs::symlink_status(path, unknown)) && !is_in_proc(path); ++links) {
    if (links == 40) throw IoError(cannot_write + system_reason(ELOOP));
    path = path.parent_path() / fs::read_symlink(path, unknown);
  }
  return path;
}

void create_folder(const fs::path& folder) {
  const fs::path without_slash = folder.has_filename() ? folder : folder.parent_path();
  std::error_code failure;
  fs::create_directory(without_slash, failure);
  std::error_code unknown;
  const bool exists = !failure || failure == std::errc::file_exists;
  if (exists && !fs::is_directory(folder, unknown))
    failure = std::make_error_code(std::errc::not_a_directory);
  if (failure) throw IoError("cannot create this folder: " + system_reason(failure.value()));
}

void create_folder_of(const fs::path& file) {
  std::error_code failure;
  if (file.has_parent_path()) fs::create_directory(file.parent_path(), failure);
  if (failure) throw IoError("cannot create its folder: " + system_reason(failure.value()));
}

void remove_temporary_files() noexcept {
  const std::lock_guard lock(temporaries().mutex);
  temporaries().ended = true;
  for (const fs::path& path : temporaries().paths)
    ::unlink(path.c_str());
}

}  // namespace pcl_bv::detail
