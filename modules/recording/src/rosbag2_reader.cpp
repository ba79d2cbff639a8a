// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Reads rosbag2's folders (metadata.yaml and one or more files), and files that are compressed as a whole.

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <fstream>
#include <map>
#include <set>
#include <stdexcept>

#include "chunked_reader.h"
#include "formats.h"
#include "pcl_bv/io/list_clouds.h"
#include "pcl_bv/io/posix_file.h"
#include "pcl_bv/io/untrusted_text.h"
#include "pcl_bv/io/yaml_error.h"

namespace pcl_bv::detail {
namespace {

namespace fs = std::filesystem;

bool is_recording_file(const fs::path& file) {
  const fs::path name = file.extension() == ".zstd" ? file.stem() : file.filename();
  return name.extension() == ".db3" || name.extension() == ".mcap";
}

// Throws IoError unless the path can be a file of a recording. Folders are refused, because metadata.yaml
// could name the folder itself, and reading would recurse without end.
void require_recording_file(const fs::path& file) {
  std::error_code unknown;
  if (!is_recording_file(file) || (fs::exists(file, unknown) && !fs::is_regular_file(file, unknown)))
    throw IoError("no .db3 or .mcap file");
}

// Reads several files one after another as one recording. The messages then come in the order of time,
// because a recorder begins a file when it has ended the previous file.
class JoinedReader final : public RecordingReader {
 public:
  /// `folder_warnings` are the warnings about the folder.
  JoinedReader(std::vector<fs::path> files, const std::vector<std::string>& folder_warnings) {
    for (const std::string& line : folder_warnings)
      add_warning(line);
    std::string problem;
    for (fs::path& file : files) {
      try {
        Member member;
        require_recording_file(file);
        member.reader = open_recording(file);
        for (const RecordedTopic& topic : member.reader->topics())
          member.topics.push_back(topics_.add(topic));
        members_.push_back(std::move(member));
        files_.push_back(std::move(file));
      } catch (const IoError& error) {
        problem = file.filename().string() + ": " + error.what();
        add_warning("skipped " + problem);
      }
    }
    if (members_.empty()) throw IoError(message_line(problem));
  }

  const std::vector<RecordedTopic>& topics() const override { return topics_.all(); }

  void select(const std::vector<std::size_t>& topics) override {
    std::vector<bool> wanted(topics_.all().size(), false);
    for (const std::size_t topic : topics)
      wanted.at(topic) = true;
    for (Member& member : members_) {
      std::vector<std::size_t> own;
      for (std::size_t i = 0; i < member.topics.size(); ++i) {
        if (wanted[member.topics[i]]) own.push_back(i);
      }
      member.reader->select(own);
    }
    at_ = 0;
  }

  bool next(RecordedMessage& message) override {
    for (; at_ < members_.size(); ++at_) {
      const bool more = members_[at_].reader->next(message);
      add_warnings(members_[at_].reader->warnings(), members_[at_].warnings,
                   files_[at_].filename().string() + ": ");
      if (!more) continue;
      message.topic = members_[at_].topics[message.topic];
      return true;
    }
    return false;
  }

 private:
  struct Member {
    std::unique_ptr<RecordingReader> reader;
    std::vector<std::size_t> topics;  // index in topics_ of each topic of the reader
    std::uint64_t warnings = 0;       // number of the reader's warnings that were passed on
  };

  std::vector<fs::path> files_;
  std::vector<Member> members_;
  TopicList topics_;
  std::size_t at_ = 0;
};

// Returns the files that metadata.yaml names.
std::vector<fs::path> files_of(const fs::path& folder) {
  const fs::path metadata = folder / "metadata.yaml";
  std::vector<fs::path> files;
  try {
    const std::string text = read_untrusted_text(metadata, kMaxMetadataBytes);
    require_few_yaml_nodes(text);
    const YAML::Node root = YAML::Load(text);
    for (const YAML::Node& file : root["rosbag2_bagfile_information"]["relative_file_paths"])
      files.push_back(folder /
                      fs::path(file.as<std::string>()).filename());  // old versions write the folder, too
  } catch (const YAML::Exception& error) {
    throw IoError("metadata.yaml: " + yaml_error_message(error));
  } catch (const IoError& error) {
    throw IoError(std::string("metadata.yaml: ") + error.what());
  }
  if (files.empty()) throw IoError("metadata.yaml names no files");
  return files;
}

// Removes repeated files, with a warning, because a small metadata.yaml could name one file a million times.
std::vector<fs::path> without_repetitions(const std::vector<fs::path>& files,
                                          std::vector<std::string>& warnings) {
  std::vector<fs::path> once;
  std::map<fs::path, std::size_t> times;
  for (const fs::path& file : files) {
    if (++times[file] == 1) once.push_back(file);
  }
  for (const fs::path& file : once) {
    if (times[file] > 1)
      warnings.push_back("metadata.yaml names " + file.filename().string() + " " +
                         std::to_string(times[file]) + " times: it is read once");
  }
  return once;
}

// Returns whether the folder has a metadata.yaml of rosbag2. Other programs also write files of this name.
bool has_metadata(const fs::path& folder) {
  std::ifstream stream(folder / "metadata.yaml", std::ios::binary);
  std::string start(1000, ' ');
  stream.read(start.data(), static_cast<std::streamsize>(start.size()));
  return start.find("rosbag2_bagfile_information") != std::string::npos;
}

// Returns the .db3 and .mcap files in a folder (NAME_0.db3, NAME_1.db3, ...), in natural order.
std::vector<fs::path> recording_files_in(const fs::path& folder) {
  std::vector<fs::path> files;
  std::error_code unknown;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, unknown)) {
    if (is_recording_file(entry.path())) files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end(), [](const fs::path& a, const fs::path& b) {
    return natural_less(a.filename().native(), b.filename().native());
  });
  return files;
}

// Returns the files of a recording without metadata.yaml, as after a crash. Returns none if the folder also
// has clouds, because it is then a folder of clouds.
std::vector<fs::path> files_without_metadata(const fs::path& folder) {
  std::vector<fs::path> files = recording_files_in(folder);
  if (files.empty()) return files;
  try {
    if (!list_clouds(folder).empty()) files.clear();
  } catch (const IoError&) {
    files.clear();
  }
  return files;
}

fs::path temporary_folder() {
  std::error_code failure;
  fs::path folder = fs::temp_directory_path(failure);
  if (failure) throw IoError("no folder for temporary files (TMPDIR): " + system_reason(failure.value()));
  return folder;
}

// A temporary file that only this user can read. It is removed at destruction.
class TemporaryFile {
 public:
  explicit TemporaryFile(const std::vector<std::byte>& bytes)
      : path_((temporary_folder() / "pcl_bv_XXXXXX").string()) {
    const int descriptor = ::mkstemp(path_.data());
    if (descriptor < 0) throw IoError(path_ + ": " + system_reason(errno));
    for (std::size_t done = 0; done < bytes.size();) {
      const ssize_t wrote = ::write(descriptor, bytes.data() + done, bytes.size() - done);
      if (wrote < 0) {
        const int error = errno;
        ::close(descriptor);
        ::unlink(path_.c_str());
        throw IoError(path_ + ": " + system_reason(error));
      }
      done += static_cast<std::size_t>(wrote);
    }
    ::close(descriptor);
  }
  ~TemporaryFile() { ::unlink(path_.c_str()); }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;

  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

}  // namespace

bool is_rosbag2_folder(const fs::path& folder) {
  std::error_code unknown;
  return fs::is_directory(folder, unknown) &&
         (has_metadata(folder) || !files_without_metadata(folder).empty());
}

// A recorder writes metadata.yaml last. Therefore metadata.yaml may be older than the files or incomplete. If
// metadata.yaml cannot be read, all files of the folder are used.
std::unique_ptr<RecordingReader> open_rosbag2_folder(const fs::path& folder) {
  std::vector<std::string> warnings;
  if (!has_metadata(folder)) {
    std::error_code unknown;
    if (fs::exists(folder / "metadata.yaml", unknown))
      warnings.push_back(
          "metadata.yaml is not that of a recording: all .db3 and .mcap files of the folder are read");
    return std::make_unique<JoinedReader>(files_without_metadata(folder), std::move(warnings));
  }
  std::vector<fs::path> files;
  const std::vector<fs::path> there = recording_files_in(folder);
  try {
    files = without_repetitions(files_of(folder), warnings);
  } catch (const IoError& error) {
    if (there.empty()) throw;
    warnings.push_back(std::string(error.what()) + ": all files of the folder are read");
    files = there;
  }
  const std::set<fs::path> named(files.begin(), files.end());
  for (const fs::path& file : there) {
    if (!named.contains(file))
      warnings.push_back(file.filename().string() + " is not in metadata.yaml and is not read");
  }
  return std::make_unique<JoinedReader>(std::move(files), warnings);
}

// Unpacks the file into a temporary file, because SQLite needs a file. The temporary file can be unlinked as
// soon as the reader has opened it.
std::unique_ptr<RecordingReader> open_zstd_file(const fs::path& file) {
  std::vector<std::byte> unpacked;
  {
    const InputFile input(file);
    std::vector<std::byte> packed(input.size());
    input.read(0, packed.data(), packed.size());
    Decompressor().decompress_zstd(packed.data(), packed.size(), unpacked);
  }
  const TemporaryFile temporary(unpacked);
  return open_recording(temporary.path());
}

}  // namespace pcl_bv::detail
