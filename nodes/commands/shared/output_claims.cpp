// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "output_claims.h"

#include <system_error>

#include "pcl_bv/io/raw_cloud.h"
#include "values.h"

namespace pcl_bv::detail {
namespace {

namespace fs = std::filesystem;

fs::path identity(const fs::path& path) {
  std::error_code unknown;
  fs::path whole = fs::absolute(path, unknown);  // the path of a missing file would stay relative
  // A link to a missing file would stay a link.
  for (int links = 0; links < 40 && fs::is_symlink(whole, unknown) && !fs::exists(whole, unknown); ++links)
    whole = whole.parent_path() / fs::read_symlink(whole, unknown);
  const fs::path canonical = fs::weakly_canonical(whole, unknown);
  return unknown ? whole.lexically_normal() : canonical;
}

[[noreturn]] void reject_overwriting(const fs::path& output) {
  throw UsageError(output.string() + ": is an input and would be overwritten");
}

}  // namespace

bool is_device(const fs::path& file) {
  std::error_code unknown;
  const fs::file_status status = fs::status(file, unknown);
  return fs::exists(status) && fs::is_other(status);
}

bool needs_no_suffix(const fs::path& file) {
  return is_device(file) || file.string().starts_with("/dev/");  // /dev/stdout may be a link to any file
}

void reject_dash(const fs::path& output) {
  if (output == "-")
    throw UsageError("-: is not a file; use /dev/stdout for standard output, ./- for a file of this name");
}

void require_folder_of(const fs::path& file) {
  const fs::path folder = file.parent_path();
  std::error_code unknown;
  if (!folder.empty() && fs::status(folder, unknown).type() == fs::file_type::not_found)
    throw IoError(file.string() + ": its folder does not exist");
}

void OutputClaims::add_input(const fs::path& file) {
  inputs_.insert(identity(file));
}

void OutputClaims::reject_input(const fs::path& output) const {
  if (inputs_.count(identity(output)) > 0) reject_overwriting(output);
}

void OutputClaims::claim(const fs::path& output) {
  reject_dash(output);
  reject_input(output);
  const fs::path file = identity(output);
  if (!taken_.insert(file).second && !is_device(file)) {
    throw UsageError(output.string() + ": more than one result would be written to this file");
  }
}

void OutputClaims::claim_in_place(const fs::path& output) {
  claim(output);
  std::error_code unknown;
  if (!fs::is_regular_file(output, unknown) || fs::hard_link_count(output, unknown) < 2) return;
  for (const fs::path& input : inputs_)
    if (fs::equivalent(input, output, unknown)) reject_overwriting(output);
}

void OutputClaims::claim_folder(const fs::path& folder) {
  claim(folder);
  const fs::path parent = identity(folder);
  for (const fs::path& input : inputs_) {
    if (input.parent_path() == parent)
      throw UsageError(folder.string() + ": has the input " + input.string() +
                       ", which could be overwritten");
  }
}

}  // namespace pcl_bv::detail
