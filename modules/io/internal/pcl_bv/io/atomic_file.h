// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Writes output files so that a reader never sees a partly written file.
#pragma once

#include <filesystem>
#include <functional>
#include <initializer_list>
#include <string_view>
#include <vector>

namespace pcl_bv {
namespace [[gnu::visibility("default")]] detail {

/// Replaces the content of the file by `content` atomically. Writes a new file in the same folder and renames
/// it to `path`. At every moment, also after an error, `path` is either unchanged (possibly missing) or has
/// the whole new content.
///
/// A new file gets mode 0644 without the bits of the umask. An existing file keeps its mode, and its owner
/// and group if this process may set them. If this process may not write the existing file, the file stays
/// unchanged and IoError is thrown. If `path` is a symbolic link, the link stays, and its target is replaced
/// or created in the target's folder. Anything other than a regular file, such as a device or a pipe, is
/// opened and written directly, not atomically. The same holds for every path that leads into /proc, such as
/// /dev/stdout, even if it leads to a regular file.
///
/// Returns when the file and its name are on the disk (fsync of the file and of the folder, some
/// milliseconds). Throws IoError with the reason, also for errors that the disk reports at fsync. If only the
/// fsync of the folder fails, `path` has the new content, but may lose it at a power failure.
void write_file_atomically(const std::filesystem::path& path, std::string_view content);

/// Writes the pieces (such as a header and a body) one after another without joining them in memory.
/// Otherwise like the overload for one text.
void write_file_atomically(const std::filesystem::path& path, std::initializer_list<std::string_view> pieces);
/// Like the overload for an initializer list.
void write_file_atomically(const std::filesystem::path& path, const std::vector<std::string_view>& pieces);

/// Takes the next piece of a file.
using FileSink = std::function<void(std::string_view piece)>;
/// Calls `write` with a sink, which gets the content piece by piece and writes each piece at once. Otherwise
/// like the overload for one text. An exception of `write` is rethrown after the temporary file is removed.
void write_file_atomically(const std::filesystem::path& path,
                           const std::function<void(const FileSink& sink)>& write);

/// Calls `write` with the path of an empty temporary file, to which it writes the new content. Otherwise like
/// write_file_atomically(). If `path` is written directly, `write` gets `path` itself. It opens the file that
/// exists and does not replace it. An exception of `write` is rethrown after the temporary file is removed.
void replace_file_atomically(const std::filesystem::path& path,
                             const std::function<void(const std::filesystem::path&)>& write);

/// Returns the path to which a path leads by symbolic links in its last component: no link, but possibly
/// missing. A link in /proc, such as the target of /dev/stdout, stays: it leads to an open file, whatever its
/// text. Throws IoError if more than 40 links follow each other.
std::filesystem::path follow_links(std::filesystem::path path);

/// Creates a folder. An existing folder stays. Throws IoError with the reason, without the path, also if its
/// parent folder is missing.
void create_folder(const std::filesystem::path& folder);

/// Creates the folder of a file, like create_folder().
void create_folder_of(const std::filesystem::path& file);

/// Removes the temporary files of all calls of write_file_atomically() and replace_file_atomically() that are
/// running in other threads. Call it in a process that is about to end. Afterwards each such call for a
/// regular file throws IoError and leaves the existing file unchanged.
void remove_temporary_files() noexcept;

}  // namespace detail
}  // namespace pcl_bv
