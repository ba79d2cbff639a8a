// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "joined_pieces.h"

#include <algorithm>
#include <cstring>
#include <limits>
#include <numeric>
#include <queue>

#include "piece_reader.h"

namespace pcl_bv::detail {
namespace {

constexpr std::size_t kReadBytes = 64U << 10U;     // of a piece at a time
constexpr std::size_t kAllReadBytes = 64U << 20U;  // of all pieces of a cluster
constexpr std::size_t kWriteBytes = 1U << 20U;
// Maximum number of pieces that are merged at once. More pieces are first combined into sorted pieces of
// kSortedPoints points, unless that would leave more than half as many pieces.
constexpr std::size_t kMaxPieces = kAllReadBytes / kReadBytes;
constexpr std::size_t kSortedPoints = 1U << 20U;

std::vector<SharedPoint> read(const SpillFile& file, const Extent& extent) {
  std::vector<SharedPoint> points(extent.bytes / sizeof(SharedPoint));
  file.read(extent.offset, points.data(), extent.bytes);
  return points;
}

// Calls visit(piece, other piece) for points that are in both lists, which are sorted by number.
template <typename Visit>
void for_each_pair(const std::vector<SharedPoint>& own, std::vector<SharedPoint>::const_iterator begin,
                   std::vector<SharedPoint>::const_iterator end, const Visit& visit) {
  auto it = own.begin();
  for (; begin != end; ++begin) {
    while (it != own.end() && it->number < begin->number)
      ++it;
    if (it == own.end()) return;
    if (it->number == begin->number) visit(it->piece, begin->piece);
  }
}

}  // namespace

void join_pieces(const std::vector<SharedPoints>& bricks, const std::vector<std::uint32_t>& first_set,
                 const SpillFile& file, UnionFind& sets) {
  for (std::size_t brick = 0; brick < bricks.size(); ++brick) {
    const std::vector<SharedPoint> others = read(file, bricks[brick].others);
    for (auto begin = others.begin(); begin != others.end();) {
      const std::uint32_t owner = begin->owner;
      const auto end =
          std::find_if(begin, others.end(), [&](const SharedPoint& p) { return p.owner != owner; });
      for_each_pair(read(file, bricks[owner].own), begin, end, [&](std::uint32_t a, std::uint32_t b) {
        sets.unite(first_set[owner] + a, first_set[brick] + b);
      });
      begin = end;
    }
  }
}

std::vector<std::uint32_t> order_by_root(const std::vector<std::uint32_t>& roots) {
  std::vector<std::uint32_t> order(roots.size());
  std::iota(order.begin(), order.end(), 0U);
  std::stable_sort(order.begin(), order.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return roots[a] < roots[b]; });
  return order;
}

namespace {

std::uint64_t points_of(const std::vector<Piece>& pieces) {
  return std::accumulate(pieces.begin(), pieces.end(), std::uint64_t{0},
                         [](std::uint64_t sum, const Piece& piece) { return sum + piece.points; });
}

void discard(const std::vector<Piece>& pieces, ScalarType scalar, SpillFile& file) {
  for (const Piece& piece : pieces)
    if (piece.from.share == nullptr) file.discard({piece.offset, piece.points * record_bytes(scalar)});
}

// Writes records with the numbers of the merged cloud, in their order.
class PieceSorter {
 public:
  PieceSorter(ScalarType scalar, SpillFile& file) : scalar_(scalar), file_(file) {
    order_.reserve(kSortedPoints);
    records_.reserve(kSortedPoints * record_bytes(scalar));
  }

  void add(const Piece& piece) {
    const std::size_t step = record_bytes(scalar_);
    for (PieceReader reader(file_, piece, scalar_, kWriteBytes); !reader.done(); reader.next()) {
      order_.emplace_back(reader.number(), static_cast<std::uint32_t>(order_.size()));
      records_.insert(records_.end(), reader.record(), reader.record() + step);
      if (order_.size() == kSortedPoints) write();
    }
  }

  // Returns the sorted pieces.
  std::vector<Piece> finish() {
    if (!order_.empty()) write();
    return std::move(sorted_);
  }

 private:
  void write() {
    const std::size_t step = record_bytes(scalar_);
    std::sort(order_.begin(), order_.end());
    written_.resize(records_.size());
    for (std::size_t i = 0; i < order_.size(); ++i) {
      std::memcpy(&written_[i * step], &records_[order_[i].second * step], point_bytes(scalar_));
      std::memcpy(&written_[i * step + point_bytes(scalar_)], &order_[i].first, kNumberBytes);
    }
    sorted_.push_back({file_.append(written_.data(), written_.size()).offset, order_.size()});
    order_.clear();
    records_.clear();
  }

  ScalarType scalar_;
  SpillFile& file_;
  std::vector<std::pair<std::uint64_t, std::uint32_t>> order_;  // numbers, and positions in records_
  std::vector<std::byte> records_, written_;
  std::vector<Piece> sorted_;
};

}  // namespace

StoredCluster merge_pieces(const std::vector<Piece>& pieces, ScalarType scalar, SpillFile& file) {
  if (pieces.size() > kMaxPieces && pieces.size() * kSortedPoints > points_of(pieces) * 2) {
    PieceSorter sorter(scalar, file);
    for (const Piece& piece : pieces)
      sorter.add(piece);
    discard(pieces, scalar, file);
    return merge_pieces(sorter.finish(), scalar, file);
  }
  std::vector<PieceReader> readers;
  readers.reserve(pieces.size());
  for (const Piece& piece : pieces)
    readers.emplace_back(file, piece, scalar, std::min(kReadBytes, kAllReadBytes / pieces.size()));
  using Next = std::pair<std::uint64_t, std::size_t>;  // number of a point, and its reader
  std::priority_queue<Next, std::vector<Next>, std::greater<>> next;
  for (std::size_t r = 0; r < readers.size(); ++r)
    if (!readers[r].done()) next.emplace(readers[r].number(), r);
  StoredCluster cluster{std::numeric_limits<std::uint64_t>::max(), 0, next.top().first};
  std::vector<std::byte> points;
  const auto write = [&] {
    const Extent extent = file.append(points.data(), points.size());
    cluster.offset = std::min(cluster.offset, extent.offset);
    points.clear();
  };
  for (; !next.empty(); ++cluster.points) {
    PieceReader& reader = readers[next.top().second];
    const std::size_t number = next.top().second;
    next.pop();
    points.insert(points.end(), reader.record(), reader.record() + point_bytes(scalar));
    if (points.size() >= kWriteBytes) write();
    reader.next();
    if (!reader.done()) next.emplace(reader.number(), number);
  }
  if (!points.empty()) write();
  discard(pieces, scalar, file);
  return cluster;
}

}  // namespace pcl_bv::detail
