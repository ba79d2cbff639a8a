// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "object_shares.h"

#include <utility>

#include "class_points.h"
#include "object_fitter.h"
#include "object_texts.h"
#include "pipeline/ground_view.h"
#include "share_inputs.h"
#include "share_points.h"

namespace pcl_bv::detail {
namespace {

// Returns the texts of the components of a share. Components without an allowed size have none.
std::vector<std::string> fit_share(const MadeClusterShare& share, const ClusterOptions& clusters,
                                   const Options& options, ObjectFitter& fitter) {
  StoredClusterOptions store = store_options(options, share.scalar());
  store.has_labels = false;
  store.is_known = [&](const ComponentOfShare& component) {
    return share.visit(component.number).has_value();
  };
  const StoredClusters objects({&share}, clusters, store, options.pipeline.execution());
  std::vector<std::string> texts(share.components().size());
  for_each_cluster(objects, options.pipeline.execution(), [&](std::size_t i, const Execution& execution) {
    const std::uint32_t component = objects.component(i).value().number;
    const auto visit = share.visit(component);
    texts[component] = text_of(visit ? fitter.take(*visit) : fitter.fit(objects.points(i).view(), execution));
  });
  return texts;
}

// Writes a share of a cloud to a file: one for points without classes, or one for each class.
class ShareWriter {
 public:
  ShareWriter(const Tiles& tiles, const ShareOption& share, const Options& options,
              const std::optional<CloudGround>& ground, const std::filesystem::path& file,
              const GatherCells& gather)
      : tiles_(tiles),
        options_(options),
        file_(file),
        gather_(gather),
        range_(tiles.share(share.number, share.count)),
        filtered_(tiles, range_, options.origin.at, options),
        points_(filtered_.view()),
        ground_(range_.first, ground ? range_.second - range_.first : 0),
        table_(options.pipeline) {
    if (ground) {
      above_ = remove_slope_ground(points_, ground->surface, ground_);
      points_ = above_.points;
      header_.ground = {0, ground->check_sum};
    }
    header_.cloud = describe_cloud(tiles, options.origin.at, options);
    header_.clusters = clusters_text(options.pipeline);
    header_.inputs = inputs_of_share(tiles, range_, options);
    if (range_.first < range_.second) header_.cloud.shares = {range_};
  }

  void write() {
    const auto& field = options_.pipeline.cluster.class_field;
    field ? write_classes(field->name) : add(points_, std::nullopt);
    tiles_.require_unchanged();
  }

 private:
  void write_classes(const std::string& field) {
    const ClassifiedPoints cloud{points_, tiles_, field};
    const Classes classes = find_classes(cloud, table_, options_.pipeline.execution().parallel);
    set_counts(cloud.points.count - classes.valid);
    header_.dropped_class = classes.dropped;
    for (const auto& [value, clusters] : classes.kept)
      add(ClassPoints(cloud, value).view(), value);
    if (!classes.kept.empty()) return;
    PointView none;
    none.scalar = cloud.points.scalar;
    add(none, std::nullopt);
  }

  void set_counts(std::size_t invalid) {
    const Counts& counts = filtered_.counts();
    header_.cloud.counts.range = counts.range;
    header_.cloud.counts.inside = counts.inside;
    if (header_.ground) header_.ground->points = ground_.count();
    header_.nonfinite = invalid - counts.range - counts.inside - ground_.count();
  }

  void add(const PointView& points, std::optional<std::int64_t> value) {
    ObjectFitter fitter(options_, table_, value);
    StoredClusterOptions store = store_options(options_, points.scalar);
    store.visit = [&](std::size_t brick, const std::vector<PointView>& found, const Execution& execution) {
      fitter.visit(brick, found, execution);
    };
    const ClusterOptions clusters = options_of_class(table_, value);
    const MadeClusterShare share(points, clusters, store, options_.pipeline.execution(),
                                 {file_, begin_ + first_record_of_object_file(), gather_});
    const std::vector<std::string> texts = fit_share(share, clusters, options_, fitter);
    if (!options_.pipeline.cluster.class_field) set_counts(share.invalid_points());
    header_.class_value = value;
    header_.volumes = volumes_text(options_.pipeline, table_, value);
    begin_ = complete_object_file(
        file_, begin_, header_, share, [&](std::uint32_t component) { return texts[component]; },
        ground_.words());
    header_.without_points();
  }

  const Tiles& tiles_;
  const Options& options_;
  const std::filesystem::path& file_;
  const GatherCells& gather_;
  PointRange range_;
  SharePoints filtered_;
  PointView points_;  // those that are clustered
  GroundBits ground_;
  GroundView above_;
  ClassTable table_;
  ObjectFileHeader header_;
  std::uint64_t begin_ = 0;  // of the next share in the file
};

void write_share(const Tiles& tiles, const ShareOption& share, const Options& options,
                 const std::optional<CloudGround>& ground, const std::filesystem::path& path, FileLife life,
                 const GatherCells& gather) {
  write_object_file(path, life, [&](const std::filesystem::path& file) {
    ShareWriter(tiles, share, options, ground, file, gather).write();
  });
}

}  // namespace

bool needs_all_records(const Options& options) {
  return options.check || options.objects || options.labels || options.pipeline.cluster.class_field;
}

void write_object_share(const Tiles& tiles, const ShareOption& share, const Options& options,
                        const std::optional<CloudGround>& ground, const std::filesystem::path& path) {
  write_share(tiles, share, options, ground, path, FileLife::lasting, {});
}

void write_temporary_object_share(const Tiles& tiles, const ShareOption& share, const Options& options,
                                  const std::optional<CloudGround>& ground, const std::filesystem::path& path,
                                  const GatherCells& gather) {
  write_share(tiles, share, options, ground, path, FileLife::temporary,
              needs_all_records(options) ? GatherCells() : gather);
}

}  // namespace pcl_bv::detail
