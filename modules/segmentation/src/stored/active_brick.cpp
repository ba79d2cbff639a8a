// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "active_brick.h"

#include <algorithm>
#include <cstring>

#include "record.h"

namespace pcl_bv::detail {
namespace {

constexpr std::uint32_t kUnset = kMaxSets;  // as the component of a piece

std::uint32_t component_of_record(const std::byte* record, ScalarType scalar) {
  std::uint32_t component;
  std::memcpy(&component, record + record_bytes(scalar), sizeof component);
  return component;
}

std::vector<std::byte> sorted_by_number(const std::vector<std::byte>& records, ScalarType scalar) {
  const std::size_t step = active_record_bytes(scalar);
  std::vector<std::pair<std::uint64_t, std::uint32_t>> order(records.size() / step);
  for (std::size_t i = 0; i < order.size(); ++i)
    order[i] = {number_of_record(&records[i * step], scalar) & kNumberMask, static_cast<std::uint32_t>(i)};
  std::sort(order.begin(), order.end());
  std::vector<std::byte> sorted(records.size());
  for (std::size_t i = 0; i < order.size(); ++i)
    std::memcpy(&sorted[i * step], &records[order[i].second * step], step);
  return sorted;
}

}  // namespace

void ActiveWorker::operator()(std::uint32_t number, const std::vector<std::byte>& unsorted) {
  const ScalarType scalar = components_.scalar();
  const std::size_t step = active_record_bytes(scalar);
  const std::vector<std::byte> records = sorted_by_number(unsorted, scalar);
  components_.find(number, records, step);
  ActiveBrick& brick = results_[number];
  brick.result = clusters_.write(number, records, step);
  add_links(records, step, brick);
}

// A core point of a share is a core point of the cloud. So its component in the share and its piece in the
// brick belong to one cluster.
void ActiveWorker::add_links(const std::vector<std::byte>& records, std::size_t step, ActiveBrick& brick) {
  brick.component.assign(components_.piece_count(), kUnset);
  brick.is_near_lost.assign(components_.piece_count(), 0);
  for (std::size_t i = 0; i * step < records.size(); ++i) {
    const std::uint32_t c = components_.component_of(i);
    if (c == BrickComponents::kNoise) continue;
    const std::uint32_t piece = components_.components()[c].piece;
    if (piece == BrickComponents::kNoPiece) continue;
    const std::byte* const record = &records[i * step];
    const std::uint64_t number = number_of_record(record, components_.scalar());
    const std::uint32_t marked = component_of_record(record, components_.scalar());
    const std::uint32_t component = marked & ~kNearLost;
    brick.is_near_lost[piece] |= marked != component;
    if ((number & kOfOtherBrick) == 0) {
      std::uint32_t& all = brick.component[piece];
      all = all == kUnset || all == component ? component : kNoComponent;
    }
    const std::pair<std::uint32_t, std::uint32_t> link{component, piece};
    const bool linked = component != kNoComponent && (number & kCore) != 0 && components_.is_core(i);
    if (linked && (brick.links.empty() || brick.links.back() != link)) brick.links.push_back(link);
  }
  std::sort(brick.links.begin(), brick.links.end());
  brick.links.erase(std::unique(brick.links.begin(), brick.links.end()), brick.links.end());
}

}  // namespace pcl_bv::detail
