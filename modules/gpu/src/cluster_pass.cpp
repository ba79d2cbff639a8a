// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "cluster_pass.h"

#include <algorithm>
#include <cstring>

namespace pcl_bv::detail {
namespace {

// Limits of one dispatch: Vulkan allows 65535 workgroups, and lists must fit in one binding.
constexpr std::size_t kMostClusters = 65535;

// What the shader declares.
struct SlicePush {
  std::uint32_t first_word, second_word, first_point, first_count, first_offset;
};

// Consecutive clusters that one dispatch processes.
struct ClusterSlice {
  std::size_t first, count;
  std::size_t part;  // in which all of them begin
};

std::size_t part_with(const DevicePoints& cloud, std::size_t point) {
  return std::min(point / cloud.parts().front().count, cloud.parts().size() - 1);
}

std::vector<ClusterSlice> slices_of(const DevicePoints& cloud, const DeviceClusters& clusters) {
  const std::size_t most_indices = cloud.context()->max_binding() / 4;
  const std::vector<std::uint32_t>& offsets = clusters.offsets;
  std::vector<ClusterSlice> slices;
  bool open = false;
  for (std::size_t c = 0; c < clusters.size(); ++c) {
    if (offsets[c + 1] - offsets[c] > kLargestCluster) {
      open = false;
      continue;
    }
    const std::size_t part = clusters.indices != nullptr ? 0 : part_with(cloud, offsets[c]);
    const bool fits = open && slices.back().part == part && slices.back().count < kMostClusters &&
                      offsets[c + 1] - offsets[slices.back().first] <= most_indices;
    if (!fits) slices.push_back({c, 0, part});
    ++slices.back().count;
    open = true;
  }
  return slices;
}

// Runs one dispatch after another with the same buffers.
class SlabPass {
 public:
  SlabPass(const DevicePoints& cloud, const DeviceClusters& clusters, DirectionSet set,
           std::size_t most_clusters, std::size_t most_indices, ClusterSlabs& out)
      : cloud_(cloud),
        clusters_(clusters),
        pipeline_(cloud.context()->pipeline(
            Shader::clusters,
            {static_cast<std::uint32_t>(set), cloud.stride_words(), clusters.indices != nullptr ? 1U : 0U})),
        words_(2 + 4 * direction_count(set)),
        out_(out),
        input_bytes_(4 * (most_clusters + 1 + most_indices)),
        offsets_(*cloud.context(), 4 * (most_clusters + 1), BufferUse::device),
        indices_(*cloud.context(), 4 * most_indices, BufferUse::device),
        results_(*cloud.context(), 4 * words_ * most_clusters, BufferUse::device),
        input_(*cloud.context(), input_bytes_, BufferUse::upload),
        answer_(*cloud.context(), 4 * words_ * most_clusters, BufferUse::download) {}

  void run(const ClusterSlice& slice) {
    const std::uint32_t* const offsets = &clusters_.offsets[slice.first];
    const std::size_t offset_bytes = 4 * (slice.count + 1), points = offsets[slice.count] - offsets[0];
    std::memcpy(input_.mapped(), offsets, offset_bytes);
    Submission submission(cloud_.context());
    submission.copy(input_, 0, offsets_, 0, offset_bytes);
    if (clusters_.indices != nullptr && points > 0) {
      std::memcpy(input_.mapped() + offset_bytes, clusters_.indices + offsets[0], 4 * points);
      submission.copy(input_, offset_bytes, indices_, 0, 4 * points);
    }
    const PointPart& first = cloud_.parts()[slice.part];
    const PointPart& second = cloud_.parts()[std::min(slice.part + 1, cloud_.parts().size() - 1)];
    const SlicePush push{first.first_word, second.first_word, static_cast<std::uint32_t>(first.first),
                         static_cast<std::uint32_t>(first.count), offsets[0]};
    submission.dispatch(pipeline_,
                        {first.binding, second.binding, {offsets_.get()}, {indices_.get()}, {results_.get()}},
                        push, static_cast<std::uint32_t>(slice.count));
    submission.copy(results_, 0, answer_, 0, 4 * words_ * slice.count);
    submission.run();
    for (std::size_t c = 0; c < slice.count; ++c)
      take(slice.first + c, answer_.mapped() + 4 * words_ * c);
  }

 private:
  void take(std::size_t cluster, const std::byte* words) {
    std::uint32_t head[2];
    std::memcpy(head, words, sizeof head);
    out_.valid[cluster] = head[0];
    out_.found[cluster] = head[1] != 0;
    if (head[1] == 0) return;
    std::memcpy(&out_.slabs[2 * cluster * out_.directions], words + sizeof head, 16 * out_.directions);
  }

  const DevicePoints& cloud_;
  const DeviceClusters& clusters_;
  const ComputePipeline& pipeline_;
  std::size_t words_;  // of the results of a cluster
  ClusterSlabs& out_;
  std::size_t input_bytes_;
  ScratchBuffer offsets_, indices_, results_, input_, answer_;
};

}  // namespace

bool can_find_slabs(const DevicePoints& cloud, bool lists) {
  if (cloud.size() == 0 || cloud.rounded()) return false;
  if (cloud.parts().size() == 1) return !lists || cloud.numbered_from_zero();
  // A shader sees two parts, which must have the whole cluster.
  return !lists && cloud.parts().front().count >= kLargestCluster;
}

ClusterSlabs find_slabs(const DevicePoints& cloud, const DeviceClusters& clusters, DirectionSet set) {
  ClusterSlabs out;
  out.directions = direction_count(set);
  out.slabs.resize(2 * out.directions * clusters.size());
  out.valid.resize(clusters.size());
  out.found.resize(clusters.size());
  const std::vector<ClusterSlice> slices = slices_of(cloud, clusters);
  std::size_t most_clusters = 0, most_indices = 0;
  for (const ClusterSlice& slice : slices) {
    most_clusters = std::max(most_clusters, slice.count);
    if (clusters.indices != nullptr)
      most_indices = std::max<std::size_t>(
          most_indices, clusters.offsets[slice.first + slice.count] - clusters.offsets[slice.first]);
  }
  if (slices.empty()) return out;
  SlabPass pass(cloud, clusters, set, most_clusters, most_indices, out);
  for (const ClusterSlice& slice : slices)
    pass.run(slice);
  return out;
}

}  // namespace pcl_bv::detail
