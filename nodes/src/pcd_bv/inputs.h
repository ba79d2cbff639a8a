// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The clouds that the arguments name, and where the files made from each one go.
#pragma once

#include <filesystem>
#include <optional>
#include <memory>
#include <string>
#include <vector>

#include "options.h"
#include "pcl_bv/io/raw_cloud.h"
#include "pcl_bv/nodes/recorded_clouds.h"
#include "pcl_bv/parallel/policy.h"

namespace pcl_bv {

/// One cloud to be done.
struct Job {
  std::string input;                   ///< A file, synth:NAME[:POINTS[:SEED]], or RECORDING#NUMBER.
  std::optional<std::string> error{};  ///< Why there is nothing to load, for a folder without clouds.
  std::optional<std::filesystem::path> labels{}, mesh{}, image{}, view_html{};
  std::size_t bin_fields = 0;  ///< As read_cloud() takes it.
  std::shared_ptr<RecordedClouds> recording{};  ///< Whose cloud `number` it is; `input` is FILE#number.
  std::size_t number = 0;
};

/// Whether an input is a generated cloud, not a file.
bool is_synth(const std::string& input);

/// All clouds, folders expanded in natural order. Throws UsageError if two results would go to the same file.
std::vector<Job> plan_jobs(const Options& options);

/// The cloud of a job. Throws IoError, or std::invalid_argument for an unknown scene, with the reason.
RawCloud load_cloud(const Job& job, const ParallelPolicy& policy);

}  // namespace pcl_bv
