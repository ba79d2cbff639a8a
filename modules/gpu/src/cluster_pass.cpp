// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "cluster_pass.h"

#include <sys/mman.h>

#include <algorithm>
#include <cstring>
#include <deque>
#include <new>
#include <optional>

#include "pcl_bv/parallel/for_each_chunk.h"

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

// Clusters whose results one task copies.
constexpr std::size_t kCopiedClusters = 2048;

// What all slices have in common.
struct SlabSearch {
  const DevicePoints& cloud;
  const DeviceClusters& clusters;
  const ComputePipeline& pipeline;
  std::size_t words;  // of the results of a cluster
  std::size_t most_clusters, most_indices;
};

// The buffers of one slice at a time. Two of them alternate, so that the device computes one slice while the
// processor copies the results of the one before it.
class SlabPass {
 public:
  explicit SlabPass(const SlabSearch& search)
      : search_(search),
        offsets_(context(), 4 * (search.most_clusters + 1), BufferUse::device),
        indices_(context(), 4 * search.most_indices, BufferUse::device),
        results_(context(), 4 * search.words * search.most_clusters, BufferUse::device),
        input_(context(), 4 * (search.most_clusters + 1 + search.most_indices), BufferUse::upload),
        answer_(context(), 4 * search.words * search.most_clusters, BufferUse::download) {}

  void start(const ClusterSlice& slice) {
    slice_ = slice;
    const std::uint32_t* const offsets = &search_.clusters.offsets[slice.first];
    const std::size_t offset_bytes = 4 * (slice.count + 1), points = offsets[slice.count] - offsets[0];
    std::memcpy(input_.mapped(), offsets, offset_bytes);
    submission_.emplace(search_.cloud.context());
    submission_->copy(input_, 0, offsets_, 0, offset_bytes);
    if (search_.clusters.indices != nullptr && points > 0) {
      std::memcpy(input_.mapped() + offset_bytes, search_.clusters.indices + offsets[0], 4 * points);
      submission_->copy(input_, offset_bytes, indices_, 0, 4 * points);
    }
    const std::vector<PointPart>& parts = search_.cloud.parts();
    const PointPart &first = parts[slice.part], &second = parts[std::min(slice.part + 1, parts.size() - 1)];
    const SlicePush push{first.first_word, second.first_word, static_cast<std::uint32_t>(first.first),
                         static_cast<std::uint32_t>(first.count), offsets[0]};
    submission_->dispatch(
        search_.pipeline,
        {first.binding, second.binding, {offsets_.get()}, {indices_.get()}, {results_.get()}}, push,
        static_cast<std::uint32_t>(slice.count));
    submission_->copy(results_, 0, answer_, 0, 4 * search_.words * slice.count);
    submission_->start();
  }

  void finish(ClusterSlabs& out, const Execution& execution) {
    submission_->wait();
    submission_.reset();
    for_each_range(execution.parallel, slice_.count, kCopiedClusters,
                   [&](std::size_t begin, std::size_t end) {
                     for (std::size_t c = begin; c < end; ++c)
                       take(slice_.first + c, answer_.mapped() + 4 * search_.words * c, out);
                   });
  }

 private:
  GpuContext& context() const { return *search_.cloud.context(); }

  static void take(std::size_t cluster, const std::byte* words, ClusterSlabs& out) {
    std::uint32_t head[2];
    std::memcpy(head, words, sizeof head);
    out.valid[cluster] = head[0];
    out.found[cluster] = head[1] != 0;
    if (head[1] == 0) return;
    std::memcpy(&out.slabs[2 * cluster * out.directions], words + sizeof head, 16 * out.directions);
  }

  const SlabSearch& search_;
  ClusterSlice slice_{};
  ScratchBuffer offsets_, indices_, results_, input_, answer_;
  std::optional<Submission> submission_;  // destroyed, and waited for, before the buffers
};

// Adds two passes, or one if there is one slice or the device has too little memory for two.
void add_passes(const SlabSearch& search, std::size_t slices, std::deque<SlabPass>& passes) {
  passes.emplace_back(search);
  try {
    if (slices > 1) passes.emplace_back(search);
  } catch (const GpuError& error) {
    if (error.failure() != GpuFailure::out_of_memory) throw;
  }
}

}  // namespace

bool can_find_slabs(const DevicePoints& cloud, bool lists) {
  if (cloud.size() == 0 || cloud.rounded()) return false;
  if (cloud.parts().size() == 1) return !lists || cloud.numbered_from_zero();
  // A shader sees two parts, which must have the whole cluster.
  return !lists && cloud.parts().front().count >= kLargestCluster;
}

std::shared_ptr<double[]> make_slabs(std::size_t directions, std::size_t clusters) {
  constexpr std::align_val_t huge_page{std::size_t{2} << 20};
  const std::size_t bytes = 2 * sizeof(double) * directions * clusters;
  if (bytes < 2 * static_cast<std::size_t>(huge_page))
    return std::shared_ptr<double[]>(new double[2 * directions * clusters]);
  void* const memory = ::operator new(bytes, huge_page);
  ::madvise(memory, bytes, MADV_HUGEPAGE);
  return {static_cast<double*>(memory), [](double* slabs) { ::operator delete(slabs, huge_page); }};
}

ClusterSlabs find_slabs(const DevicePoints& cloud, const DeviceClusters& clusters, DirectionSet set,
                        const Execution& execution) {
  ClusterSlabs out;
  out.directions = direction_count(set);
  out.slabs = make_slabs(out.directions, clusters.size());
  out.valid.resize(clusters.size());
  out.found.resize(clusters.size());
  const std::vector<ClusterSlice> slices = slices_of(cloud, clusters);
  if (slices.empty()) return out;
  SlabSearch search{
      cloud,
      clusters,
      cloud.context()->pipeline(Shader::clusters, {static_cast<std::uint32_t>(set), cloud.stride_words(),
                                                   clusters.indices != nullptr ? 1U : 0U}),
      2 + 4 * out.directions,
      0,
      0};
  for (const ClusterSlice& slice : slices) {
    search.most_clusters = std::max(search.most_clusters, slice.count);
    if (clusters.indices != nullptr)
      search.most_indices = std::max<std::size_t>(
          search.most_indices, clusters.offsets[slice.first + slice.count] - clusters.offsets[slice.first]);
  }
  std::deque<SlabPass> passes;
  add_passes(search, slices.size(), passes);
  std::size_t started = 0;
  for (SlabPass& pass : passes)
    pass.start(slices[started++]);
  for (std::size_t i = 0; i < slices.size(); ++i) {
    SlabPass& pass = i % 2 == 0 ? passes.front() : passes.back();  // the same one if memory is short
    pass.finish(out, execution);
    if (started < slices.size()) pass.start(slices[started++]);
  }
  return out;
}

}  // namespace pcl_bv::detail
