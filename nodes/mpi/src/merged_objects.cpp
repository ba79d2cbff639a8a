// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "merged_objects.h"

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <filesystem>
#include <new>
#include <vector>

#include "commands/pcd_bv/object_shares.h"
#include "commands/pcd_bv/process.h"
#include "commands/pcd_bv/shares.h"
#include "commands/shared/messages.h"
#include "failures.h"

namespace pcl_bv {
using namespace detail;
namespace {

// A folder for the files of all ranks. The first rank makes and removes it.
class CommonFolder {
 public:
  explicit CommonFolder(Ranks& ranks) : ranks_(ranks) {
    std::string name;
    if (ranks.first()) {
      name = (std::filesystem::temp_directory_path() / "pcl_bv_mpi_XXXXXX").string();
      if (mkdtemp(name.data()) == nullptr) name.clear();
    }
    path_ = ranks.broadcast(name);
    if (path_.empty()) throw IoError("cannot make a folder for temporary files in $TMPDIR");
  }
  ~CommonFolder() {
    std::error_code unknown;
    if (ranks_.first()) std::filesystem::remove_all(path_, unknown);
  }
  CommonFolder(const CommonFolder&) = delete;
  CommonFolder& operator=(const CommonFolder&) = delete;

  std::string file(std::size_t rank) const { return (path_ / std::to_string(rank)).string(); }

 private:
  Ranks& ranks_;
  std::filesystem::path path_;
};

// Writes the file of a rank. Returns the input that fails on any rank. Throws IoError on all ranks if a rank
// cannot write.
std::optional<TileFailure> write_shares(Ranks& ranks, const Tiles& tiles, const Options& options,
                                        const CommonFolder& folder) {
  std::string problem;
  const auto failure = run_and_catch([&] {
    try {
      write_object_share(tiles, {ranks.rank(), ranks.size()}, options, folder.file(ranks.rank()),
                         FileLife::temporary);
    } catch (const TileError&) {
      throw;
    } catch (const std::bad_alloc&) {
      throw;
    } catch (const std::exception& error) {
      problem = error.what();
    }
  });
  for (const std::string& each : ranks.all_gather(problem))
    if (!each.empty()) throw IoError(each);
  return first_failure(ranks, failure);
}

}  // namespace

Status detail::find_merged_objects(Ranks& ranks, Tiles& tiles, const Options& options, Report& report) {
  Status status = ranks.first() ? report_excluded_inputs(tiles) : Status::done;
  const CommonFolder folder(ranks);
  for (;;) {
    if (tiles.included_count() == 0) throw IoError("no input could be read");
    const auto failure = write_shares(ranks, tiles, options, folder);
    if (!failure) break;
    if (ranks.first()) report_problem(tiles.jobs()[failure->tile].input + ": " + failure->reason);
    tiles.exclude(failure->tile, failure->reason);
    status = Status::failed;
  }
  std::string problem;
  if (ranks.first()) {
    try {
      report_notes(tiles);
      std::vector<std::string> files;
      for (std::size_t rank = 0; rank < ranks.size(); ++rank)
        files.push_back(folder.file(rank));
      status = worse(status, merge_object_files(files, options, report));
    } catch (const std::bad_alloc&) {
      throw;
    } catch (const std::exception& error) {
      problem = error.what();
    }
  }
  problem = ranks.broadcast(problem);
  if (!problem.empty()) throw IoError(problem);
  return status;
}

}  // namespace pcl_bv
