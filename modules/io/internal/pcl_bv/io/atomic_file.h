// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Output files that are either whole or not there.
#pragma once

#include <filesystem>
#include <initializer_list>
#include <string_view>
#include <vector>

namespace [[gnu::visibility("default")]] pcl_bv {

/// Makes `content` the content of the file: written to a new file in the same folder, which then takes the
/// name. At every moment, and after an error, the name stands for the old content (or nothing) or for all of
/// the new one.
///
/// A new file has mode 0644 less the umask; one that was there keeps its mode, and if it may not be written
/// by this process it is left alone. A symbolic link stays, and the file it leads to is replaced; one
/// that leads to nothing is replaced itself. What is not
/// a regular file (a device, a pipe) or lies in /dev or /proc (/dev/stdout, whatever it leads to) is opened
/// and written directly, without that promise.
///
/// Returns when file and name are on the disk (fsync of both, some milliseconds). Throws IoError with the
/// reason, also for what the disk says so late; then, if it is the folder that could not be synchronised, the
/// new content is in place, but may not outlast a loss of power.
void write_file_atomically(const std::filesystem::path& path, std::string_view content);

/// The same for a content in pieces, such as a header and a body, without joining them in memory.
void write_file_atomically(const std::filesystem::path& path, std::initializer_list<std::string_view> pieces);
void write_file_atomically(const std::filesystem::path& path, const std::vector<std::string_view>& pieces);

/// Makes the folders that lead to a file, where they are missing. Throws IoError with the reason.
void make_folder_of(const std::filesystem::path& file);

/// For a process that is about to end while other threads may be in write_file_atomically(): removes their
/// unfinished files. From now on all such calls throw IoError and leave what is there.
void remove_temporary_files() noexcept;

}  // namespace pcl_bv
