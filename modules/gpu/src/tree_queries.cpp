// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "tree_queries.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <memory>

#include "pcl_bv/parallel/for_each_chunk.h"

namespace pcl_bv::detail {
namespace {

// Queries of one dispatch. Their results take 10 MiB.
constexpr std::size_t kMaxAtOnce = 131'072;
// Queries that a thread prepares or decides at a time.
constexpr std::size_t kBlock = 1024;

// Push constants of the shader.
struct TreePush {
  float center[3];
  std::uint32_t count, levels, first[TreePart::kMaxLevels];
};

// Runs one slice of the queries after another with the same buffers.
class QuerySlices {
 public:
  QuerySlices(const DeviceTree& tree, QueryKind kind, std::size_t max_count)
      : tree_(tree),
        context_(tree.cloud().on_device().context()),
        pipeline_(context_->pipeline(Shader::queries, {static_cast<std::uint32_t>(kind)})),
        input_(*context_, sizeof(DeviceQuery) * max_count, BufferUse::upload),
        queries_(*context_, sizeof(DeviceQuery) * max_count, BufferUse::device),
        results_(*context_, sizeof(DeviceResult) * max_count, BufferUse::device),
        output_(*context_, sizeof(DeviceResult) * max_count, BufferUse::download) {}

  void set(std::size_t i, const DeviceQuery& query) {
    std::memcpy(input_.mapped() + i * sizeof query, &query, sizeof query);
  }

  // Runs the queries that were set. The first part of the tree must come first, because the queries are
  // copied to the device then.
  void run(const TreePart& part, std::size_t count) {
    Submission submission(context_);
    if (part.first == 0) submission.copy(input_, 0, queries_, 0, sizeof(DeviceQuery) * count);
    TreePush push{{tree_.center()[0], tree_.center()[1], tree_.center()[2]},
                  static_cast<std::uint32_t>(count),
                  part.levels,
                  {}};
    std::copy_n(part.first_group.begin(), TreePart::kMaxLevels, push.first);
    submission.dispatch(
        pipeline_,
        {{part.packets.get()}, {part.numbers.get()}, {part.boxes.get()}, {queries_.get()}, {results_.get()}},
        push, static_cast<std::uint32_t>((count + kWorkgroup - 1) / kWorkgroup));
    submission.copy(results_, 0, output_, 0, sizeof(DeviceResult) * count);
    submission.run();
  }

  DeviceResult result(std::size_t i) const {
    DeviceResult result;
    std::memcpy(&result, output_.mapped() + i * sizeof result, sizeof result);
    return result;
  }

 private:
  const DeviceTree& tree_;
  std::shared_ptr<GpuContext> context_;
  const ComputePipeline& pipeline_;
  ScratchBuffer input_, queries_, results_, output_;
};

}  // namespace

std::optional<DeviceQuery> query_at(const DeviceTree& tree, const Coordinates& position, double radius) {
  const std::array<float, 3>& center = tree.center();
  const Coordinates relative{position.x - center[0], position.y - center[1], position.z - center[2]};
  const double largest = std::max({std::abs(relative.x), std::abs(relative.y), std::abs(relative.z)});
  const double own = largest + radius;
  if (!(tree.extent() + own <= kLargestOnDevice)) return std::nullopt;
  DeviceQuery query;
  for (std::size_t axis = 0; axis < 3; ++axis)
    query.position[axis] = static_cast<float>(relative[axis]);
  query.error = static_cast<float>(own * 0x1p-18 + 0x1p-58);
  query.radius = static_cast<float>(radius);
  return query;
}

void run_queries(const DeviceTree& tree, QueryKind kind, std::size_t count, const Execution& execution,
                 const std::function<DeviceQuery(std::size_t)>& make,
                 const std::function<void(std::size_t, const TreePart&, const DeviceResult&)>& take) {
  if (tree.parts().empty() || count == 0) return;
  const std::size_t in_binding = tree.cloud().on_device().context()->max_binding() / sizeof(DeviceResult);
  const std::size_t max_count = std::min({count, kMaxAtOnce, in_binding});
  QuerySlices slices(tree, kind, max_count);
  for (std::size_t first = 0; first < count; first += max_count) {
    const std::size_t taken = std::min(max_count, count - first);
    for_each_range(execution.parallel, taken, kBlock, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i)
        slices.set(i, make(first + i));
    });
    for (const TreePart& part : tree.parts()) {
      slices.run(part, taken);
      for_each_range(execution.parallel, taken, kBlock, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i)
          take(first + i, part, slices.result(i));
      });
    }
  }
}

}  // namespace pcl_bv::detail
