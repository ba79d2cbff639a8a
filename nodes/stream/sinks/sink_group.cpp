// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Calls several sinks and isolates their failures.

#include <algorithm>
#include <chrono>
#include <mutex>
#include <stdexcept>

#include "pcl_bv/io/untrusted_text.h"
#include "pcl_bv/nodes/frame_sink.h"

namespace pcl_bv {

namespace {

namespace fs = std::filesystem;

// Returns the outermost part of `path` that does not exist: a folder, or `path` itself. If all parts exist,
// returns an empty path.
fs::path first_missing(const fs::path& path) {
  std::error_code unknown;
  fs::path missing;
  for (fs::path at = fs::absolute(path, unknown); !at.empty() && !fs::exists(fs::symlink_status(at, unknown));
       at = at.parent_path())
    missing = at;
  return missing;
}

// Removes empty folders from `path` outwards to `outermost`. Does not remove files: each sink removes the
// files that it created, because several sinks may write into one folder.
void remove_empty_folders(const fs::path& path, const fs::path& outermost) {
  std::error_code unknown;
  for (fs::path at = path;; at = at.parent_path()) {
    if (fs::is_directory(fs::symlink_status(at, unknown))) fs::remove(at, unknown);
    if (at == outermost || at == at.parent_path()) return;
  }
}

}  // namespace

struct SinkGroup::Member {
  std::string name;
  std::unique_ptr<FrameSink> sink;   // null after an IoError or a closed pipe
  std::uint64_t missing_frames = 0;  // number of frames that were not written
  std::string last_problem;
  mutable std::mutex mutex;
  LatencyHistogram ms;
};

SinkGroup::SinkGroup(std::function<void(const std::string&)> report) : report_(std::move(report)) {
  if (!report_) throw std::invalid_argument("SinkGroup: the function `report` is empty");
}

// If nothing was written, for example because a sink could not be opened, no created file or folder remains.
SinkGroup::~SinkGroup() {
  members_.clear();
  if (used_) return;
  for (const auto& [path, outermost] : created_)
    remove_empty_folders(path, outermost);
}

void SinkGroup::add(std::string name, std::unique_ptr<FrameSink> sink) {
  Member& member = *members_.emplace_back(std::make_unique<Member>());
  member.name = std::move(name);
  member.sink = std::move(sink);
  alive_ = true;
}

void SinkGroup::add(const SinkOptions& description) {
  const bool standard = description.target == "-";
  const std::string name =
      standard ? "standard output" : std::string(description.kind->name) + ':' + description.target.string();
  std::error_code unknown;
  if (!standard && !description.kind->live)
    if (const fs::path missing = first_missing(description.target); !missing.empty())
      created_.emplace_back(fs::absolute(description.target, unknown), missing);
  try {
    add(name, make_sink(description));
    for (const std::string& warning : members_.back()->sink->take_warnings())
      report_(std::string(name).append(": ").append(warning));
  } catch (const IoError& error) {
    throw IoError(name + ": " + error.what());
  }
}

void SinkGroup::report_failure(Member& member, const std::string& problem) {
  failed_ = true;
  ++member.missing_frames;
  if (problem != std::exchange(member.last_problem, problem)) report_(member.name + ": " + problem);
}

// Runs `what` and returns true. If the sink can write nothing more, returns false. A closed pipe is no
// failure and is not reported.
template <typename Do>
bool SinkGroup::attempt(Member& member, const Do& what) {
  try {
    what(member);
  } catch (const ClosedPipe&) {
    return false;
  } catch (const IoError& error) {
    report_failure(member, error.what());
    return false;
  } catch (const std::exception& error) {
    report_failure(member, detail::reason_of(error));
  } catch (...) {
    report_failure(member, "an exception that is no std::exception");
  }
  return true;
}

template <typename Do>
void SinkGroup::each(const Do& what) {
  for (const std::unique_ptr<Member>& member : members_) {
    if (member->sink == nullptr) {
      member->missing_frames += member->missing_frames > 0;
    } else if (!attempt(*member, what)) {
      const std::uint64_t missing_frames = member->missing_frames;
      attempt(*member, [](Member& m) { m.sink->close(); });  // completes the output so far
      member->missing_frames = missing_frames;
      member->sink = nullptr;
    }
  }
  alive_ = std::any_of(members_.begin(), members_.end(), [](const auto& m) { return m->sink != nullptr; });
}

void SinkGroup::offer_settings(const std::shared_ptr<detail::RemoteParameters>& settings) {
  each([&](Member& member) { member.sink->offer_settings(settings); });
}

void SinkGroup::write(const Frame& frame, const FrameResult& result) {
  used_ = true;
  each([&](Member& member) {
    const auto begin = std::chrono::steady_clock::now();
    member.sink->write(frame, result);
    for (const std::string& warning : member.sink->take_warnings())
      report_(member.name + ": " + warning);
    const std::chrono::duration<double, std::milli> took = std::chrono::steady_clock::now() - begin;
    const std::lock_guard lock(member.mutex);
    member.ms.add(took.count());
  });
}

void SinkGroup::write_lost(const Frame& frame, const std::string& reason) {
  used_ = true;
  each([&](Member& member) { member.sink->write_lost(frame, reason); });
}

void SinkGroup::close() {
  used_ = true;
  for (const std::unique_ptr<Member>& member : members_) {
    if (member->missing_frames > 1)
      report_(member->name + ": " + std::to_string(member->missing_frames) + " frames were not written");
    if (member->sink != nullptr) attempt(*member, [](Member& m) { m.sink->close(); });
    member->sink = nullptr;
  }
}

std::vector<std::pair<std::string, LatencyHistogram>> SinkGroup::times() const {
  std::vector<std::pair<std::string, LatencyHistogram>> all;
  for (const std::unique_ptr<Member>& member : members_) {
    const std::lock_guard lock(member->mutex);
    all.emplace_back(member->name, member->ms);
  }
  return all;
}

}  // namespace pcl_bv
