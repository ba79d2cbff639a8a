// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include <algorithm>
#include <utility>

#include "pcl_bv/io/untrusted_text.h"
#include "pcl_bv/recording/recording.h"

namespace pcl_bv {
namespace {

// Maximum number of listed warnings, so that damaged input cannot fill the memory or a log.
constexpr std::size_t kMaxListed = 10;

}  // namespace

void WarningList::add(std::string line) {
  if (lines_.size() < kMaxListed) {
    lines_.push_back(detail::message_line(line));
  } else {
    add_unlisted(1);
  }
}

void WarningList::append_new(const WarningList& other, std::uint64_t& added, const std::string& prefix) {
  const std::uint64_t listed = std::min<std::uint64_t>(kMaxListed, other.lines_.size());
  for (; added < listed; ++added)
    add(prefix + other.lines_[added]);
  const std::uint64_t all = listed + other.unlisted_;
  if (all > added) add_unlisted(all - added);
  added = std::max(added, all);
}

void WarningList::add_unlisted(std::uint64_t number) {
  if (unlisted_ == 0) lines_.emplace_back();
  unlisted_ += number;
  lines_.back() = "further warnings are not listed: " + std::to_string(unlisted_) + " so far";
}

}  // namespace pcl_bv
