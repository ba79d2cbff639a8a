// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "merged_objects.h"

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <new>
#include <optional>
#include <vector>

#include "commands/pcd_bv/object_shares.h"
#include "commands/pcd_bv/process.h"
#include "commands/pcd_bv/shares.h"
#include "commands/pcd_bv/stopwatch.h"
#include "commands/shared/messages.h"
#include "costs.h"
#include "failures.h"
#include "pcl_bv/io/untrusted_text.h"

namespace pcl_bv {
using namespace detail;
namespace {

// A folder for the files of all ranks. The first rank makes and removes it.
class CommonFolder {
 public:
  CommonFolder(Ranks& ranks, InterruptAction& interrupted) : ranks_(ranks), interrupted_(interrupted) {
    std::string problem;
    if (ranks.first()) problem = make();
    problem = ranks.broadcast(problem);
    if (!problem.empty()) throw IoError("cannot make a folder for temporary files in $TMPDIR: " + problem);
    path_ = ranks.broadcast(path_.string());
    std::error_code unknown;
    const bool seen = std::filesystem::is_directory(path_, unknown);
    for (const std::string& each : ranks.all_gather(seen ? "yes" : "no"))
      if (each == "no") throw_for_folder();
  }
  ~CommonFolder() { remove(); }
  CommonFolder(const CommonFolder&) = delete;
  CommonFolder& operator=(const CommonFolder&) = delete;

  [[noreturn]] void throw_for_folder() {
    remove();
    throw IoError("$TMPDIR must be a folder that all ranks can access: " + path_.parent_path().string());
  }

  std::string file(std::size_t rank) const { return (path_ / std::to_string(rank)).string(); }
  std::string ground_file(std::size_t rank) const { return file(rank) + ".ground"; }

 private:
  // Makes the folder, which a signal removes, too. Returns the problem, or an empty text.
  std::string make() {
    std::error_code failure;
    const std::filesystem::path parent = std::filesystem::temp_directory_path(failure);
    if (failure) return system_reason(failure.value());
    std::string name = (parent / "pcl_bv_mpi_XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) return system_reason(errno);
    path_ = name;
    interrupted_.set([name] {
      std::error_code unknown;
      std::filesystem::remove_all(name, unknown);
    });
    return {};
  }

  void remove() {
    if (!ranks_.first()) return;
    std::error_code unknown;
    std::filesystem::remove_all(path_, unknown);
    interrupted_.set(nullptr);
  }

  Ranks& ranks_;
  InterruptAction& interrupted_;
  std::filesystem::path path_;
};

// Sends the cells of each rank to all others, while it writes its file.
class CellExchange {
 public:
  explicit CellExchange(Ranks& ranks) : ranks_(ranks) {}

  /// Thrown if another rank has failed.
  struct OtherRankFailed {};

  /// A collective call, as GatherCells.
  std::vector<std::uint64_t> gather(const std::vector<std::uint64_t>& own) {
    std::string text(own.size() * sizeof(std::uint64_t), '\0');
    std::memcpy(text.data(), own.data(), text.size());
    const std::vector<std::string> all = exchange(text);
    std::vector<std::uint64_t> others;
    for (std::size_t rank = 0; rank < all.size(); ++rank) {
      if (all[rank] == kFailed) throw OtherRankFailed();
      if (rank == ranks_.rank()) continue;
      const std::size_t before = others.size();
      others.resize(before + all[rank].size() / sizeof(std::uint64_t));
      std::memcpy(others.data() + before, all[rank].data(), all[rank].size());
    }
    return others;
  }

  /// What this rank has sent, and the CPU time of waiting for the cells of others.
  std::size_t messages() const { return messages_; }
  std::size_t bytes() const { return bytes_; }
  double waiting_seconds() const { return waiting_seconds_; }

  /// Tells the ranks that wait for cells of this rank that it has failed, if it did not make all calls.
  void end() {
    if (calls_ < kGatherCalls && !failed_) exchange(kFailed);
  }

 private:
  static constexpr const char* kFailed = "failed";  // the bytes of cells are a multiple of 8

  std::vector<std::string> exchange(const std::string& text) {
    const double begin = processor_seconds();
    std::vector<std::string> all = ranks_.all_gather(text);
    waiting_seconds_ += processor_seconds() - begin;
    messages_ += ranks_.size() - 1;
    bytes_ += (ranks_.size() - 1) * text.size();
    ++calls_;
    failed_ = std::find(all.begin(), all.end(), kFailed) != all.end();
    return all;
  }

  Ranks& ranks_;
  int calls_ = 0;
  std::size_t messages_ = 0, bytes_ = 0;
  double waiting_seconds_ = 0;
  bool failed_ = false;
};

// Runs work() of a rank, and then end(), even if it fails. Adds what both cost; end() returns the CPU time of
// waiting. Returns the input that fails on any rank. Throws IoError on all ranks if the work of a rank fails
// otherwise.
template <typename Work, typename End>
std::optional<TileFailure> run_on_all(Ranks& ranks, RankCosts& costs, const Work& work, const End& end) {
  const double begin = processor_seconds();
  std::string problem;
  const auto failure = run_and_catch([&] {
    try {
      work();
    } catch (const TileError&) {
      throw;
    } catch (const std::bad_alloc&) {
      throw;
    } catch (const std::exception& error) {
      problem = reason_of(error);
    }
  });
  const double waiting = end();
  costs.cpu_seconds += processor_seconds() - begin - waiting;
  for (const std::string& each : ranks.all_gather(problem))
    if (!each.empty()) throw IoError(each);
  return first_failure(ranks, failure);
}

// Writes the files of the ground, and reads those of all ranks. Returns the input that fails on any rank.
std::optional<TileFailure> find_ground(Ranks& ranks, const Tiles& tiles, const Options& options,
                                       const CommonFolder& folder, RankCosts& costs,
                                       std::optional<CloudGround>& ground) {
  if (!options.slope_ground()) return std::nullopt;
  const auto no_more = [] { return 0.0; };
  auto failure = run_on_all(
      ranks, costs,
      [&] {
        write_ground_part(tiles, {ranks.rank(), ranks.size()}, options, folder.ground_file(ranks.rank()),
                          FileLife::temporary);
      },
      no_more);
  if (failure) return failure;
  std::vector<std::string> files;
  for (std::size_t rank = 0; rank < ranks.size(); ++rank)
    files.push_back(folder.ground_file(rank));
  return run_on_all(
      ranks, costs,
      [&] {
        ground = read_ground_parts(tiles, {ranks.rank(), ranks.size()}, options, files);
      },
      no_more);
}

// Writes the file of a rank, and adds what it costs. Returns the input that fails on any rank. Throws IoError
// on all ranks if a rank cannot write.
std::optional<TileFailure> write_shares(Ranks& ranks, const Tiles& tiles, const Options& options,
                                        const CommonFolder& folder, RankCosts& costs) {
  std::optional<CloudGround> ground;
  if (auto failure = find_ground(ranks, tiles, options, folder, costs, ground)) return failure;
  CellExchange messages(ranks);
  return run_on_all(
      ranks, costs,
      [&] {
        try {
          write_temporary_object_share(tiles, {ranks.rank(), ranks.size()}, options, ground,
                                       folder.file(ranks.rank()),
                                       [&](const auto& cells) { return messages.gather(cells); });
        } catch (const CellExchange::OtherRankFailed&) {  // which reports the reason
        }
      },
      [&] {
        if (!needs_all_records(options)) messages.end();
        costs.messages += messages.messages();
        costs.bytes += messages.bytes();
        return messages.waiting_seconds();
      });
}

}  // namespace

Status detail::find_merged_objects(Ranks& ranks, const Job& job, const Options& options, Report& report,
                                   InterruptAction& interrupted) {
  const Stopwatch watch;
  RankCosts costs;
  Tiles& tiles = *job.tiles;
  Status status = ranks.first() ? report_excluded_inputs(tiles) : Status::done;
  const CommonFolder folder(ranks, interrupted);
  for (;;) {
    if (tiles.included_count() == 0) throw IoError("no input could be read");
    const auto failure = write_shares(ranks, tiles, options, folder, costs);
    if (!failure) break;
    if (ranks.first()) report_problem(tiles.jobs()[failure->tile].input + ": " + failure->reason);
    tiles.exclude(failure->tile, failure->reason);
    status = Status::failed;
  }
  std::string problem;
  ranks.work_on_first([&](std::size_t ranks_here) {
    const double begin = processor_seconds();
    try {
      report_notes(tiles);
      set_left_out(tiles, report);
      std::vector<std::string> files;
      for (std::size_t rank = 0; rank < ranks.size(); ++rank)
        files.push_back(folder.file(rank));
      Options merging = options;
      merging.pipeline.threads *= static_cast<decltype(merging.pipeline.threads)>(ranks_here);
      status = worse(status, merge_object_files(job, files, FileLife::temporary, merging, report));
      if (!report.error) report_ground_warning(report, options);
      status = worse(status, report_failures(report));
    } catch (const std::bad_alloc&) {
      throw;
    } catch (const std::exception& error) {
      problem = reason_of(error);
    }
    costs.cpu_seconds += processor_seconds() - begin;
  });
  problem = ranks.broadcast(problem);
  if (!problem.empty()) throw IoError(problem);
  costs.seconds = watch.seconds();
  if (options.timings) print_costs(ranks, costs);
  return status;
}

}  // namespace pcl_bv
