// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "watch.h"

#include <poll.h>
#include <sys/inotify.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstring>
#include <string>
#include <utility>
#include <vector>

#include "commands/shared/interruption.h"
#include "commands/shared/messages.h"
#include "gpu_supports.h"
#include "inputs.h"
#include "ordered_results.h"
#include "pcl_bv/io/posix_file.h"
#include "pcl_bv/io/read_cloud.h"
#include "pcl_bv/io/text_cloud.h"

namespace pcl_bv::detail {
namespace {

namespace fs = std::filesystem;

// The names of complete files, from inotify.
class ArrivedFiles {
 public:
  explicit ArrivedFiles(const fs::path& folder) : descriptor_(::inotify_init1(IN_CLOEXEC | IN_NONBLOCK)) {
    constexpr std::uint32_t events =
        IN_CLOSE_WRITE | IN_MOVED_TO | IN_DELETE_SELF | IN_MOVE_SELF | IN_ONLYDIR;
    if (descriptor_ < 0 || ::inotify_add_watch(descriptor_, folder.c_str(), events) < 0) {
      const int error = errno;
      if (descriptor_ >= 0) ::close(descriptor_);
      throw IoError(folder.string() + ": cannot be watched: " + system_reason(error));
    }
  }
  ~ArrivedFiles() { ::close(descriptor_); }
  ArrivedFiles(const ArrivedFiles&) = delete;
  ArrivedFiles& operator=(const ArrivedFiles&) = delete;

  /// Waits at most 200 ms. Returns the names in the order of arrival.
  std::vector<std::string> next() {
    std::vector<std::string> names;
    pollfd ready{descriptor_, POLLIN, 0};
    if (::poll(&ready, 1, 200) <= 0) return names;
    alignas(inotify_event) char buffer[65536];
    const ssize_t size = ::read(descriptor_, buffer, sizeof buffer);
    for (ssize_t at = 0; at < size;) {
      inotify_event event;
      std::memcpy(&event, buffer + at, sizeof event);
      const char* const name = buffer + at + sizeof event;
      at += static_cast<ssize_t>(sizeof event + event.len);
      if ((event.mask & IN_Q_OVERFLOW) != 0) overflowed = true;
      if ((event.mask & (IN_DELETE_SELF | IN_MOVE_SELF | IN_IGNORED | IN_UNMOUNT)) != 0) gone = true;
      if ((event.mask & (IN_CLOSE_WRITE | IN_MOVED_TO)) != 0 && (event.mask & IN_ISDIR) == 0 && event.len > 0)
        names.emplace_back(name);
    }
    return names;
  }

  bool overflowed = false;  ///< Whether names were lost.
  bool gone = false;        ///< Whether the folder was removed, moved or unmounted.

 private:
  int descriptor_;
};

class Watch {
 public:
  explicit Watch(const Options& options)
      : options_(options),
        folder_(options.inputs.front()),
        pipeline_(options.pipeline),
        writer_(options.format, {}) {
    if (!options.gpu.empty()) pipeline_.set_support_finder(open_gpu(options.gpu)());
  }

  // Processes a file. Returns false if nobody reads the reports and no other files are written.
  bool process_file(const std::string& name) {
    Job job;
    job.input = (folder_ / name).string();
    job.bin_fields = options_.bin_fields;
    job.columns = options_.columns;
    job = plan_jobs(options_, {job}).front();
    job.frame = files_++;
    Result result = do_job(job, options_, pipeline_);
    // Some programs change the mode of a file after they have closed it, such as Python's shutil.copy().
    for (int tries = 0; tries < 3 && changed_meanwhile(result); ++tries)
      result = do_job(job, options_, pipeline_);
    for (const std::string& message : result.messages)
      print_message(message);
    status = worse(status, result.status);
    failed_ += result.status == Status::failed ? 1 : 0;
    has_reader_ = has_reader_ && writer_.add(std::move(result.text), false);
    return has_reader_ || writes_files(options_) || options_.check;
  }

  void finish() {
    if (has_reader_) writer_.finish();
    print_message(std::to_string(files_) + " files: " + std::to_string(files_ - failed_) + " done, " +
                  std::to_string(failed_) + " failed");
  }

  Status status = Status::done;

 private:
  static bool changed_meanwhile(const Result& result) {
    const auto says_so = [](const std::string& message) {
      return message.find(kChangedWhileRead) != std::string::npos;
    };
    return result.status == Status::failed && !result.partly_written &&
           std::any_of(result.messages.begin(), result.messages.end(), says_so);
  }

  const Options& options_;
  const fs::path folder_;
  FramePipeline pipeline_;
  ReportWriter writer_;
  std::size_t files_ = 0, failed_ = 0;
  bool has_reader_ = true;
};

}  // namespace

bool is_watched_name(const fs::path& name, const Options& options) {
  const std::string extension = lower_case_extension(name);
  if (name.string().starts_with('.')) return false;
  if (is_cloud_name(name) || extension == ".npy" || extension == ".npz") return true;
  return !options.columns.empty() && is_text_name(name);
}

Status watch_folder(const Options& options) {
  std::atomic<bool> stop = false;
  const Interruption interruption(stop);
  ArrivedFiles arrived(options.inputs.front());
  Watch watch(options);
  print_message("watching " + options.inputs.front());
  bool useful = true;
  while (!stop && useful && !arrived.gone) {
    for (const std::string& name : arrived.next()) {
      if (!stop && useful && is_watched_name(name, options)) useful = watch.process_file(name);
    }
    if (std::exchange(arrived.overflowed, false)) {
      print_message(options.inputs.front() + ": too many files at a time: some were missed");
      watch.status = worse(watch.status, Status::failed);
    }
  }
  if (arrived.gone) {
    print_message(options.inputs.front() + ": the folder is gone");
    watch.status = worse(watch.status, Status::failed);
  }
  watch.finish();
  return watch.status;
}

}  // namespace pcl_bv::detail
