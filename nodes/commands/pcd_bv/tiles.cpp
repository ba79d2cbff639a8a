// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "tiles.h"

#include <sys/stat.h>

#include <algorithm>
#include <new>

#include "copy_points.h"
#include "pcl_bv/io/cloud_file.h"
#include "pcl_bv/io/posix_file.h"
#include "pcl_bv/io/raw_cloud_edit.h"
#include "pcl_bv/io/read_cloud.h"
#include "pcl_bv/io/untrusted_text.h"

namespace pcl_bv::detail {
namespace {

// Number of points between two calls of Tiles::on_loaded.
constexpr std::size_t kPointsPerReport = std::size_t{1} << 22;

bool is_file(const Job& job) {
  return !job.recording && !is_synth(job.input);
}

// Returns the result of work(). An exception of work() becomes a TileError, except std::bad_alloc.
template <typename Work>
auto of_tile(std::size_t tile, const Work& work) {
  try {
    return work();
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    throw TileError(tile, reason_of(error));
  }
}

}  // namespace

struct Tiles::OpenTile {
  std::unique_ptr<CloudFile> file;
  RawCloud cloud;  // used if `file` is null
  PointView xyz;
};

struct Tiles::Slot {
  explicit Slot(std::size_t number) : tile(number) {}
  const std::size_t tile;
  std::mutex mutex;
  std::shared_ptr<const OpenTile> opened;  // set by the first thread that needs it, while others wait
};

TileHeader describe_tile(const Job& job) {
  TileHeader header;
  try {
    if (is_file(job) && !job.error) {
      const CloudHeader found = read_cloud_header(job.input, {job.bin_fields, job.columns});
      header = {found.cloud.size(), found.scalar, found.random_access && found.cloud.size() > kChunkPoints};
      header.note = found.cloud.note;
    } else {
      const RawCloud cloud = load_cloud(job, {Serial{}, Isa::scalar});
      const PointView points = cloud.xyz();
      header = {points.count, points.scalar};
      header.note = cloud.note;
    }
  } catch (const std::exception& error) {
    header.error = reason_of(error);
  }
  return header;
}

Tiles::Tiles(std::vector<Job> jobs, std::vector<TileHeader> headers, std::size_t threads)
    : jobs_(std::move(jobs)),
      headers_(std::move(headers)),
      max_open_(threads + 1),
      identities_(jobs_.size()),
      notes_(jobs_.size()) {
  number_points();
}

void Tiles::number_points() {
  offsets_.assign(1, 0);
  scalar_ = ScalarType::float32;
  for (const TileHeader& header : headers_) {
    offsets_.push_back(offsets_.back() + header.points);
    if (header.points > 0 && header.scalar == ScalarType::float64) scalar_ = ScalarType::float64;
  }
}

std::size_t Tiles::included_count() const {
  return static_cast<std::size_t>(
      std::count_if(headers_.begin(), headers_.end(), [](const TileHeader& h) { return !h.error; }));
}

void Tiles::exclude(std::size_t tile, const std::string& reason) {
  headers_[tile] = {};
  headers_[tile].error = reason;
  number_points();
}

std::string Tiles::note(std::size_t tile) const {
  const std::lock_guard lock(mutex_);
  return notes_[tile].empty() ? headers_[tile].note : notes_[tile];
}

std::size_t Tiles::tile_of(std::size_t point) const {
  const auto after = std::upper_bound(offsets_.begin(), offsets_.end(), point);
  return static_cast<std::size_t>(after - offsets_.begin()) - 1;
}

std::size_t Tiles::share_begin(std::size_t number, std::size_t shares) const {
  const std::size_t all = offsets_.back();
  const std::size_t point = all / shares * number + all % shares * number / shares;
  if (number == 0 || point >= all) return number == 0 ? 0 : all;
  const std::size_t tile = tile_of(point), begin = offsets_[tile], end = offsets_[tile + 1];
  if (headers_[tile].random_access) return begin + (point - begin) / kChunkPoints * kChunkPoints;
  return point - begin < end - point ? begin : end;
}

PointRange Tiles::share(std::size_t number, std::size_t shares) const {
  const std::size_t end = number + 1 == shares ? offsets_.back() : share_begin(number + 1, shares);
  return {share_begin(number, shares), end};
}

Tiles::Identity Tiles::identity_of(std::size_t tile) const {
  struct stat status {};
  if (!is_file(jobs_[tile]) || stat(jobs_[tile].input.c_str(), &status) != 0) return {};
  const auto nanoseconds = [](const timespec& t) { return t.tv_sec * 1'000'000'000LL + t.tv_nsec; };
  return {status.st_size, nanoseconds(status.st_mtim), nanoseconds(status.st_ctim),
          static_cast<long long>(status.st_ino)};
}

Tiles::OpenTile Tiles::open_now(std::size_t tile) const {
  const Job& job = jobs_[tile];
  OpenTile opened;
  const Identity identity = identity_of(tile);
  if (headers_[tile].random_access) opened.file = CloudFile::open(job.input, job.bin_fields);
  if (!opened.file) opened.cloud = load_cloud(job, {Serial{}, Isa::scalar});
  opened.xyz = opened.file ? opened.file->xyz() : opened.cloud.xyz();
  const std::lock_guard lock(mutex_);
  Identity& known = identities_[tile];
  if (known == Identity{}) known = identity;
  const bool same = known == identity && opened.xyz.count == headers_[tile].points;
  if (!same) throw IoError(kChangedWhileRead);
  notes_[tile] = opened.cloud.note;
  return opened;
}

std::shared_ptr<const Tiles::OpenTile> Tiles::open(std::size_t tile) const {
  std::shared_ptr<Slot> slot;
  {
    const std::lock_guard lock(mutex_);
    const auto found =
        std::find_if(open_.begin(), open_.end(), [&](const auto& other) { return other->tile == tile; });
    if (found != open_.end()) {
      open_.splice(open_.begin(), open_, found);
    } else {
      open_.push_front(std::make_shared<Slot>(tile));
    }
    if (open_.size() > max_open_) open_.pop_back();
    slot = open_.front();
  }
  const std::lock_guard lock(slot->mutex);
  if (slot->opened == nullptr) slot->opened = std::make_shared<const OpenTile>(open_now(tile));
  return slot->opened;
}

// Calls copy(tile, first point in the tile, number of points, points in the tiles before) for each tile that
// has some of the points.
template <typename Copy>
void Tiles::for_each_tile(std::size_t first, std::size_t count, const Copy& copy) const {
  std::size_t done = 0;
  for (std::size_t tile = tile_of(first); done < count; ++tile) {
    const std::size_t from = first + done - offsets_[tile];
    const std::size_t n = std::min(count - done, headers_[tile].points - from);
    if (n == 0) continue;  // an empty or excluded tile
    of_tile(tile, [&] {
      copy(tile, from, n, done);
      return 0;
    });
    done += n;
  }
}

void Tiles::copy(std::size_t tile, std::size_t first, std::size_t count, std::byte* to) const {
  const std::shared_ptr<const OpenTile> opened = open(tile);
  const LoadedPoints part(opened->xyz, first, count);
  copy_points(part.view(), scalar_, to);
}

PointView Tiles::load(std::size_t first, std::size_t count, std::vector<std::byte>& buffer) const {
  if (count == 0) return packed_points(buffer.data(), scalar_, 0, first);
  count_loaded(count);
  const std::size_t tile = tile_of(first);
  const bool whole = first + count <= offsets_[tile + 1];
  if (whole && headers_[tile].random_access && headers_[tile].scalar == scalar_) {
    return of_tile(tile, [&] {
      PointView view = open(tile)->file->load(first - offsets_[tile], count, buffer);
      view.first = first;
      return view;
    });
  }
  const std::size_t step = 3 * size_of(scalar_);
  if (buffer.size() < count * step) buffer.resize(count * step);
  for_each_tile(first, count, [&](std::size_t part, std::size_t from, std::size_t n, std::size_t done) {
    copy(part, from, n, buffer.data() + done * step);
  });
  return packed_points(buffer.data(), scalar_, count, first);
}

void Tiles::load_integers(const std::string& field, std::size_t first, std::size_t count,
                          std::vector<std::int64_t>& values) const {
  values.resize(count);
  std::vector<std::byte> buffer;
  for_each_tile(first, count, [&](std::size_t tile, std::size_t from, std::size_t n, std::size_t done) {
    const std::shared_ptr<const OpenTile> opened = open(tile);
    const RawCloud& cloud = opened->file ? opened->file->header() : opened->cloud;
    const PointField& found = integer_field(cloud, field);
    if (opened->file) opened->file->load_records(from, n, buffer);
    const std::byte* const records =
        opened->file ? buffer.data() : cloud.data.data() + from * cloud.point_step;
    copy_integers(found, records, n, cloud.point_step, values.data() + done);
  });
}

void Tiles::count_loaded(std::size_t points) const {
  const std::size_t before = loaded_.fetch_add(points, std::memory_order_relaxed);
  if (on_loaded && before / kPointsPerReport != (before + points) / kPointsPerReport)
    on_loaded(before + points);
}

void Tiles::require_unchanged() const {
  for (std::size_t tile = 0; tile < identities_.size(); ++tile) {
    const bool opened = !headers_[tile].error && !(identities_[tile] == Identity{});
    if (opened && !(identity_of(tile) == identities_[tile])) throw TileError(tile, kChangedWhileRead);
  }
}

}  // namespace pcl_bv::detail
