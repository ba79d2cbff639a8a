// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The clouds that the arguments name, and where the files made from each one go.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "options.h"
#include "pcl_bv/io/raw_cloud.h"
#include "pcl_bv/parallel/policy.h"
#include "stream/sources/recorded_clouds.h"

namespace pcl_bv {

class Tiles;

/// One cloud to be done.
struct Job {
  std::string input;                   ///< A file, synth:NAME[:POINTS[:SEED]], or RECORDING#NUMBER.
  std::optional<std::string> error{};  ///< Why there is nothing to load, for a folder without clouds.
  std::optional<std::filesystem::path> labels{}, mesh{}, image{}, view_html{};
  std::size_t bin_fields = 0;                   ///< As read_cloud() takes it.
  std::shared_ptr<RecordedClouds> recording{};  ///< Whose cloud `number` it is; `input` is FILE#number.
  std::size_t number = 0;
  std::shared_ptr<Tiles> tiles{};       ///< One cloud in many inputs (--together); `input` is its name.
  std::vector<std::string> partials{};  ///< Files of partial results (--merge); `input` is their name.
};

/// What one cloud in many inputs is called in results, however it came together.
inline constexpr char kTogether[] = "together";

/// Whether an input is a generated cloud, not a file.
bool is_synth(const std::string& input);

/// All inputs, folders expanded in natural order; nothing goes anywhere.
std::vector<Job> list_inputs(const Options& options);

/// The jobs and where their files go: one for each of the inputs, or one for all: of `tiles`, or, without
/// them, of tiles whose headers are read now. Throws UsageError if two results would go to the same file.
std::vector<Job> plan_jobs(const Options& options, std::vector<Job> inputs,
                           std::shared_ptr<Tiles> tiles = nullptr);
inline std::vector<Job> plan_jobs(const Options& options) {
  return plan_jobs(options, list_inputs(options));
}

/// The cloud of a job. Throws IoError, or std::invalid_argument for an unknown scene, with the reason.
RawCloud load_cloud(const Job& job, const ParallelPolicy& policy);

}  // namespace pcl_bv
