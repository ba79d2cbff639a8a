// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The file is not parsed and written again, which would lose its order of keys and its numbers' digits: only
// the numbers of the bounding volumes are replaced.

#include "pcl_bv/report/tileset.h"

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <functional>
#include <limits>
#include <map>
#include <optional>
#include <utility>

#include "json_text.h"
#include "pcl_bv/fitting/fit.h"
#include "pcl_bv/io/atomic_file.h"
#include "pcl_bv/io/posix_file.h"
#include "pcl_bv/io/untrusted_text.h"
#include "pcl_bv/parallel/for_each_chunk.h"
#include "tile_tree.h"
#include "tile_volumes.h"

namespace pcl_bv::detail {
namespace {

constexpr std::size_t kMaxContentBytes = std::size_t{1} << 30;
constexpr std::size_t kMaxPathBytes = 4096;  // Linux opens no longer ones
// Many tiles may show one content with different transforms. A small tileset must not read it without end.
constexpr std::uintmax_t kMaxRepeatedBytes = std::uintmax_t{4} << 30;

// Returns the path of a content: without a query, and with %20 as a blank.
std::filesystem::path path_of(const std::string& uri, const std::filesystem::path& folder) {
  if (uri.find("://") != std::string::npos || uri.starts_with("data:")) throw IoError("is no file");
  const std::string_view coded = std::string_view(uri).substr(0, uri.find_first_of("?#"));
  std::string path;
  for (std::size_t i = 0; i < coded.size(); ++i) {
    unsigned code = 0;
    const bool hex = coded[i] == '%' && i + 2 < coded.size() &&
                     std::from_chars(&coded[i + 1], &coded[i + 1] + 2, code, 16).ptr == &coded[i + 1] + 2;
    path += hex ? static_cast<char>(code) : coded[i];
    if (hex) i += 2;
  }
  if (path.size() > kMaxPathBytes) throw IoError(system_reason(ENAMETOOLONG));
  return (folder / path).lexically_normal();
}

bool is_external_tileset(const std::filesystem::path& path) {
  return path.extension() == ".json";
}

PointView view_of(const std::vector<double>& points) {
  return PointView::of(points.data(), 3 * sizeof(double), points.size() / 3);
}

void append(const std::vector<Eigen::Vector3d>& corners, const Eigen::Matrix4d& transform,
            std::vector<double>& points) {
  for (const Eigen::Vector3d& corner : corners) {
    const Eigen::Vector3d p = (transform * corner.homogeneous()).head<3>();
    points.insert(points.end(), p.data(), p.data() + 3);
  }
}

template <typename Numbers>
std::string as_list(const Numbers& numbers) {
  std::string text;
  JsonText(text).value(numbers);
  return text;
}

// Returns the corners of a box around a content's new volume. They are farther out by some units in the last
// place, because validators compute without error bounds whether a tile encloses the volumes of its contents.
std::vector<Eigen::Vector3d> outer_corners(const TileVolume& volume) {
  std::vector<Eigen::Vector3d> corners = bound_of(volume.kind, volume.text).corners;
  if (corners.empty()) return corners;
  const Eigen::Vector3d center = (corners.front() + corners.back()) / 2;
  const double size = center.norm() + (corners.back() - center).norm();
  for (Eigen::Vector3d& corner : corners)
    corner += 32 * std::numeric_limits<double>::epsilon() * size * (corner - center).normalized();
  return corners;
}

class Fitter {
 public:
  Fitter(TileTree& tree, const std::filesystem::path& folder, const std::vector<const Method*>& boxes)
      : tree_(tree), folder_(folder), boxes_(boxes) {}

  // Throws IoError if the tiles name the same contents too often. The files are not read yet.
  void require_few_repetitions() const {
    std::map<std::filesystem::path, std::uintmax_t> sizes;
    std::uintmax_t repeated = 0;
    for (const Tile& tile : tree_.tiles()) {
      std::vector<std::filesystem::path> paths;
      try {
        paths = paths_of(tile);
      } catch (const IoError&) {  // fit() reports it
      }
      for (std::filesystem::path& path : paths) {
        const auto [found, first] = sizes.try_emplace(std::move(path), 0);
        std::error_code unknown;
        if (first && std::filesystem::is_regular_file(found->first, unknown))
          found->second = std::filesystem::file_size(found->first, unknown);
        if (!first) repeated += found->second;
        if (repeated > kMaxRepeatedBytes)
          throw IoError("names the same contents too often: reading them again takes more than 4 GiB");
      }
    }
  }

  void fit(Tile& tile) const {
    if (!tile.problem.empty()) return;
    try {
      fit_volumes(tile);
    } catch (const std::exception& error) {
      keep_volumes(tile);
      tile.problem = reason_of(error);
    }
  }

 private:
  static void keep_volumes(Tile& tile) {
    for (TileContent& content : tile.contents)
      if (content.volume) content.volume->text.clear();
  }

  void fit_volumes(Tile& tile) const {
    TileBound bound;
    if (tree_.has_regions()) bound.region.emplace(std::vector<double>(), tile.to_root);
    std::vector<double> points;
    std::string problem;
    const bool known = add_contents(tile, points, bound, problem) && add_children(tile, points, bound);
    tile.problem = std::move(problem);
    if (!known || points.empty()) {
      const bool computed = std::ranges::any_of(
          tile.contents, [](const TileContent& c) { return c.volume && !c.volume->text.empty(); });
      if (computed) tile.problem = "volumes of contents stay, because the volume of a child is unknown";
      keep_volumes(tile);
      return;
    }
    set_volume(tile.volume, points, bound);
    tile.bound = std::move(bound);
  }

  // Appends the points of all contents, and the corners of their volumes. Returns false if one of them is an
  // external tileset.
  bool add_contents(Tile& tile, std::vector<double>& points, TileBound& bound, std::string& problem) const {
    const std::vector<std::filesystem::path> paths = paths_of(tile);
    const bool external = std::ranges::any_of(paths, is_external_tileset);
    std::map<std::pair<std::filesystem::path, BoundKind>, const TileVolume*> known;
    for (std::size_t i = 0; i < paths.size(); ++i) {
      TileContent& content = tile.contents[i];
      TileVolume* const volume = content.volume ? &*content.volume : nullptr;
      if (external && volume != nullptr && !is_external_tileset(paths[i]))
        throw IoError(content.uri +
                      ": its bounding volume stays, because of the external tileset next to it");
      if (external) continue;
      const BoundKind kind = volume == nullptr ? BoundKind::other : volume->kind;
      const auto [same, first] = known.try_emplace({paths[i], kind}, volume);
      if (!first && kind != BoundKind::other) volume->text = same->second->text;
      if (!first) continue;
      if (volume != nullptr && kind == BoundKind::other)
        problem = content.uri + ": its bounding volume stays, because it is not only a box, sphere or region";
      try {
        add_content(tile, paths[i], kind == BoundKind::other ? nullptr : volume, points, bound);
      } catch (const IoError& error) {
        throw IoError(content.uri + ": " + error.what());
      }
    }
    return !external;
  }

  std::vector<std::filesystem::path> paths_of(const Tile& tile) const {
    std::vector<std::filesystem::path> paths;
    for (const TileContent& content : tile.contents) {
      try {
        paths.push_back(path_of(content.uri, folder_));
      } catch (const IoError& error) {
        throw IoError(content.uri + ": " + error.what());
      }
    }
    return paths;
  }

  void add_content(const Tile& tile, const std::filesystem::path& path, TileVolume* volume,
                   std::vector<double>& points, TileBound& bound) const {
    const std::vector<double> own = tile_points(read_untrusted_text(path, kMaxContentBytes), tree_.up_axis());
    points.insert(points.end(), own.begin(), own.end());
    TileBound around;
    if (bound.region) around.region.emplace(own, tile.to_root);
    if (bound.region) bound.region->merge(*around.region);
    if (volume == nullptr || own.empty()) return;
    set_volume(*volume, own, around);
    // Without other contents and children, a volume of the same kind as the tile's has the same numbers.
    if (tile.contents.size() > 1 || !tile.children.empty() || tile.volume.kind != volume->kind)
      append(outer_corners(*volume), Eigen::Matrix4d::Identity(), points);
  }

  // Adds the bounds of the children, in the frame of the tile. Returns false if one of them is unknown.
  bool add_children(const Tile& tile, std::vector<double>& points, TileBound& bound) const {
    for (const std::size_t number : tile.children) {
      const Tile& child = tree_.tiles()[number];
      const bool region = tile.volume.kind == BoundKind::region;
      if (region ? !child.bound.region : child.bound.corners.empty()) return false;
      bound.boxed = bound.boxed && !child.bound.corners.empty();
      append(child.bound.corners, child.to_parent, points);
      if (bound.region && child.bound.region) {
        bound.region->merge(*child.bound.region);
      } else {
        bound.region.reset();
      }
    }
    return true;
  }

  Obb smallest_box(const PointView& view) const {
    Obb box;
    for (const Method* method : boxes_) {
      const AnyVolume fitted = *method->fit(view, {}, Execution{Serial{}});
      const Obb* const oriented = std::get_if<Obb>(&fitted);
      const Obb candidate = oriented != nullptr ? *oriented : Obb(std::get<Aabb>(fitted));
      if (box.empty() || candidate.volume() < box.volume()) box = candidate;
    }
    if (box.empty()) throw IoError("its contents have no valid point");
    return box;
  }

  // Sets the text of a volume around the points, and the corners of its bound.
  void set_volume(TileVolume& volume, const std::vector<double>& points, TileBound& bound) const {
    const Obb box = smallest_box(view_of(points));
    const Eigen::Matrix3d half_axes = box.axes() * box.half_extents().asDiagonal();
    if (bound.boxed) bound.corners = corners_of(box.center(), half_axes);
    if (volume.kind == BoundKind::box) {
      volume.text = as_list(tile_numbers(box));
    } else if (volume.kind == BoundKind::sphere) {
      volume.text = as_list(tile_numbers(*fit_smallest_sphere(view_of(points))));
    } else if (volume.kind == BoundKind::region && bound.region) {
      volume.text = as_list(bound.region->numbers());
    } else {
      throw IoError("its bounding volume is no box, sphere or region that can be computed");
    }
  }

  TileTree& tree_;
  const std::filesystem::path& folder_;
  const std::vector<const Method*>& boxes_;
};

// Children come before their parents, which need their bounds.
void fit_all(TileTree& tree, const Fitter& fitter, const Execution& execution) {
  std::map<std::size_t, std::vector<std::size_t>, std::greater<>> by_depth;
  for (std::size_t i = 0; i < tree.tiles().size(); ++i)
    by_depth[tree.tiles()[i].depth].push_back(i);
  for (const auto& level : by_depth)
    for_each_chunk(execution.parallel, level.second.size(),
                   [&](std::size_t i) { fitter.fit(tree.tiles()[level.second[i]]); });
}

}  // namespace

TilesetUpdate update_tileset(const std::filesystem::path& file, const std::vector<const Method*>& boxes,
                             const Execution& execution) {
  try {
    TileTree tree(file);
    const std::filesystem::path folder = file.parent_path();
    const Fitter fitter(tree, folder, boxes);
    fitter.require_few_repetitions();
    fit_all(tree, fitter, execution);
    TilesetUpdate update;
    update.tiles = tree.tiles().size();
    for (const Tile& tile : tree.tiles()) {
      update.updated += tile.volume.text.empty() ? 0 : 1;
      if (!tile.problem.empty()) update.problems.push_back(message_line(tile.problem));
    }
    if (update.updated > 0) write_file_atomically(file, tree.pieces());
    return update;
  } catch (const std::invalid_argument& error) {
    throw IoError(error.what());
  }
}

}  // namespace pcl_bv::detail
