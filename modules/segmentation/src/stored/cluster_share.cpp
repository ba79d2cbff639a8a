// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "pcl_bv/segmentation/cluster_share.h"

#include <algorithm>
#include <cstring>
#include <limits>

#include "active_cells.h"
#include "brick_workers.h"
#include "joined_pieces.h"
#include "pcl_bv/numeric/float_environment.h"
#include "run_writer.h"

namespace pcl_bv::detail {
namespace {

// The result of a brick of a share.
struct ShareBrick {
  BrickRuns runs;
  SharedPoints shared;
  std::vector<std::uint32_t> visited;  // pieces, in the order of the visit
};

// Finds and writes the components of bricks. Cannot be copied or moved.
class ShareWorker {
 public:
  ShareWorker(const DistributedPoints& all, ScalarType scalar, const ClusterOptions& options,
              const StoredClusterOptions& store, const Execution& execution, SpillFile& file,
              const std::optional<NearCells>& near, SpillFile& records, std::vector<ShareBrick>& bricks)
      : all_(all.bricks),
        components_(all.bricks, scalar, options, PieceRule::all, execution, file),
        writer_(components_, grid_of_runs(options, scalar), near),
        records_(records),
        options_(options),
        store_(store),
        execution_(execution),
        bricks_(bricks) {}
  ShareWorker(const ShareWorker&) = delete;
  ShareWorker& operator=(const ShareWorker&) = delete;

  void operator()(std::uint32_t number, const std::vector<std::byte>& records) {
    components_.find(number, records, record_bytes(components_.scalar()));
    ShareBrick& brick = bricks_[number];
    brick.runs = writer_.make(records);
    brick.shared = components_.shared_points();
    write(number);
    if (!store_.visit) return;
    const std::vector<PointView> views =
        writer_.complete_pieces(brick.runs, records, options_, brick.visited);
    if (!views.empty()) store_.visit(number, views, execution_);
  }

 private:
  // Writes the records behind those of earlier bricks.
  void write(std::uint32_t brick) {
    const std::size_t step = record_bytes(components_.scalar());
    const std::uint64_t first = all_.points_before(brick), end = all_.points_before(brick + 1);
    std::uint64_t points = 0;
    for (const ShareRun& run : bricks_[brick].runs.runs)
      points += run.points;
    if (points != end - first) throw std::runtime_error(kPointsChanged);
    for (const WrittenRecords& part : writer_.written())
      records_.write((first + part.first_in_brick) * step, &writer_.buffer()[part.first * step],
                     part.count * step);
  }

  const Bricks& all_;
  BrickComponents components_;
  RunWriter writer_;
  SpillFile& records_;
  ClusterOptions options_;
  const StoredClusterOptions& store_;
  Execution execution_;
  std::vector<ShareBrick>& bricks_;
};

NearCells near_cells(const Bricks& bricks, const GatherCells& gather) {
  static_assert(kHalosPerCell == 4 * kHalosPerRunCell);
  std::vector<std::uint64_t> cells = bricks.cells();
  for (std::uint64_t& cell : cells)
    cell = BrickGrid::first_quarter(cell);
  return {bricks.grid(), cells_near_others(cells, 4, gather)};
}

}  // namespace

std::uint32_t run_check_sum(const std::byte* bytes, std::size_t count, std::uint32_t before) {
  std::uint32_t sum = before;
  for (std::size_t i = 0; i + sizeof sum <= count; i += sizeof sum) {
    std::uint32_t word;
    std::memcpy(&word, bytes + i, sizeof word);
    sum = (sum ^ word) * 0x01000193;  // FNV-1a, by words
    sum ^= sum >> 15;
  }
  return sum;
}

std::size_t share_record_bytes(ScalarType scalar) {
  return record_bytes(scalar);
}

struct MadeClusterShare::State {
  State(const std::filesystem::path& folder, const ShareRecords& written)
      : file(folder),
        records(written.file.empty() ? SpillFile(folder) : SpillFile(written.file, written.first_byte)) {}

  void add(const std::vector<ShareBrick>& bricks);
  void join(const std::vector<ShareBrick>& bricks);

  SpillFile file, records;
  ScalarType scalar = ScalarType::float32;
  std::size_t invalid = 0;
  std::vector<ShareRun> runs;
  std::vector<ShareComponent> components;
  std::vector<std::optional<StoredVisit>> visits;  // of the components
  std::vector<std::uint32_t> component_of;         // of the pieces of all bricks
};

// Gives numbers to the components. A component is a set of pieces; its number is that of its first piece.
void MadeClusterShare::State::join(const std::vector<ShareBrick>& bricks) {
  std::vector<std::uint32_t> first_set;
  std::vector<SharedPoints> shared;
  std::size_t pieces = 0;
  for (const ShareBrick& brick : bricks) {
    first_set.push_back(static_cast<std::uint32_t>(pieces));
    shared.push_back(brick.shared);
    pieces += brick.runs.pieces.size();
    if (pieces >= ShareRun::kNoise) throw std::length_error("too many clusters in a share: use more shares");
  }
  UnionFind sets;
  sets.reset(pieces);
  join_pieces(shared, first_set, file, sets);
  component_of = sets.roots();
  std::uint32_t components_found = 0;
  for (std::size_t p = 0; p < pieces; ++p)  // a root is the first of its set
    component_of[p] = component_of[p] == p ? components_found++ : component_of[component_of[p]];
  components.assign(components_found, {0, std::numeric_limits<std::uint64_t>::max()});
}

void MadeClusterShare::State::add(const std::vector<ShareBrick>& bricks) {
  join(bricks);
  visits.resize(components.size());
  std::size_t first_piece = 0;
  for (std::size_t b = 0; b < bricks.size(); ++b) {
    const BrickRuns& brick = bricks[b].runs;
    for (ShareRun run : brick.runs) {
      if (run.component != ShareRun::kNoise) run.component = component_of[first_piece + run.component];
      runs.push_back(run);
    }
    for (std::size_t p = 0; p < brick.pieces.size(); ++p) {
      ShareComponent& component = components[component_of[first_piece + p]];
      component.points += brick.pieces[p].points;
      component.first_number = std::min(component.first_number, brick.pieces[p].first_number);
    }
    for (std::size_t v = 0; v < bricks[b].visited.size(); ++v)
      visits[component_of[first_piece + bricks[b].visited[v]]] = StoredVisit{b, v};
    first_piece += brick.pieces.size();
  }
}

MadeClusterShare::MadeClusterShare(const PointView& points, const ClusterOptions& options,
                                   const StoredClusterOptions& store, const Execution& execution,
                                   const ShareRecords& written) {
  const FloatEnvironment environment;
  check_stored(options);
  state_ = std::make_unique<State>(store.folder, written);
  state_->scalar = points.scalar;
  const DistributedPoints all = distribute(points, options, store, execution, state_->file);
  state_->invalid = all.invalid;
  std::optional<NearCells> near;
  if (written.gather) near = near_cells(all.bricks, written.gather);
  std::vector<ShareBrick> bricks(all.lists.size());
  for_each_brick(all.lists, store, execution, state_->file, [&](const Execution& part) {
    return ShareWorker(all, points.scalar, options, store, part, state_->file, near, state_->records, bricks);
  });
  state_->add(bricks);
}

MadeClusterShare::~MadeClusterShare() = default;

ScalarType MadeClusterShare::scalar() const {
  return state_->scalar;
}
const std::vector<ShareRun>& MadeClusterShare::runs() const {
  return state_->runs;
}
const std::vector<ShareComponent>& MadeClusterShare::components() const {
  return state_->components;
}
std::optional<StoredVisit> MadeClusterShare::visit(std::uint32_t component) const {
  return state_->visits[component];
}
std::size_t MadeClusterShare::invalid_points() const {
  return state_->invalid;
}

void MadeClusterShare::read(std::uint64_t first_byte, std::byte* to, std::size_t count) const {
  state_->records.read(first_byte, to, count);
}

}  // namespace pcl_bv::detail
