// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The inputs of clouds in shares, which are read again to write the labels of their points.
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "inputs.h"
#include "object_list.h"
#include "options.h"
#include "pcl_bv/report/object_file.h"
#include "status.h"
#include "tiles.h"

namespace pcl_bv::detail {

/// Returns the inputs that have points of a share. `range` holds their numbers.
ObjectInputs inputs_of_share(const Tiles& tiles, const PointRange& range, const Options& options);

/// Shares that were opened.
struct OpenShares {
  std::vector<std::unique_ptr<ObjectFile>> shares;
  std::vector<std::string> names;  ///< Of the files of the shares.
  MergedClouds clouds;
};

/// An input, and the file that it is written to.
struct LabelledInput {
  Job job;
  PointRange points;  ///< Numbers of its points among those of all clouds.
  std::filesystem::path file;
};

/// Returns the inputs of the clouds of the shares, in their order. Throws IoError if a share does not
/// name them, and UsageError if two of them would go to the same file or a file would be overwritten.
std::vector<LabelledInput> inputs_to_label(const OpenShares& open, const Options& options);

/// Writes each input with a field `label`. Reports those that are missing or have other points than the
/// shares, and files that cannot be written; the others are written.
Status write_input_labels(const std::vector<LabelledInput>& inputs, const OpenShares& open,
                          const std::optional<Eigen::Vector3d>& origin, ScalarType scalar,
                          const ObjectList& list);

}  // namespace pcl_bv::detail
