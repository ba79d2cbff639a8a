// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "object_shares.h"

#include <algorithm>
#include <chrono>
#include <new>
#include <utility>

#include "commands/shared/interruption.h"
#include "commands/shared/messages.h"
#include "object_fitter.h"
#include "pcl_bv/io/atomic_file.h"
#include "pcl_bv/report/cluster_json.h"
#include "pcl_bv/report/object_file.h"
#include "pipeline/config/settings.h"
#include "process.h"
#include "shares.h"

namespace pcl_bv::detail {
namespace {

// Texts of components whose objects are dropped because of their extent.
constexpr const char* kSmall = "small";
constexpr const char* kLarge = "large";

std::string clusters_text(const PipelineConfig& config) {
  return "--cluster " + to_text(config.cluster.tolerance) + " --min-points " +
         to_text(config.cluster.min_points);
}

// Returns a text of all that volumes depend on.
std::string volumes_text(const PipelineConfig& config) {
  const MethodOptions options = config.method_options();
  std::string text;
  for (const Method* method : config.methods())
    text.append(method->name).append(" ");
  return text + to_text(options.growth) + ' ' + to_text(options.up) + ' ' + to_text(options.concave_length) +
         ' ' + to_text(config.cluster.min_extent) + ' ' + to_text(config.cluster.max_extent);
}

std::string text_of(const Object& object) {
  if (object.verdict == ExtentVerdict::small) return kSmall;
  if (object.verdict == ExtentVerdict::large) return kLarge;
  return cluster_json(object.entry);
}

Object object_of(const std::string& text) {
  Object object;
  if (text == kSmall) {
    object.verdict = ExtentVerdict::small;
  } else if (text == kLarge) {
    object.verdict = ExtentVerdict::large;
  } else {
    object.entry = read_cluster_json(text);
  }
  return object;
}

// Returns the texts of the components of a share. Components without an allowed size have none.
std::vector<std::string> fit_share(const MadeClusterShare& share, const ClusterOptions& clusters,
                                   const Options& options, ObjectFitter& fitter) {
  StoredClusterOptions store = store_options(options, share.scalar());
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

using Shares = std::vector<std::unique_ptr<ObjectFile>>;

// Clouds of files that were made independently. They are parts of one cloud in the order of the files.
class MergedClouds {
 public:
  /// Throws std::invalid_argument if the share does not belong to the others.
  void add(const ObjectFileHeader& header) {
    const PartialFile& cloud = header.cloud;
    if (!clouds_.empty() && cloud.origin != clouds_.front().origin)
      throw std::invalid_argument("is a share with another --origin");
    if (!clouds_.empty() && cloud.filter != clouds_.front().filter)
      throw std::invalid_argument("is a share with another --range or other regions");
    const auto same = std::find_if(clouds_.begin(), clouds_.end(), [&](const PartialFile& other) {
      return other.inputs_hash == cloud.inputs_hash && other.cloud_points == cloud.cloud_points;
    });
    if (same == clouds_.end())
      clouds_.push_back(cloud);
    else
      same->merge(cloud);
  }

  /// Returns the number of points of all clouds before that of a share.
  std::size_t points_before(const ObjectFileHeader& header) const {
    std::size_t points = 0;
    for (const PartialFile& cloud : clouds_) {
      if (cloud.inputs_hash == header.cloud.inputs_hash && cloud.cloud_points == header.cloud.cloud_points)
        return points;
      points += cloud.cloud_points;
    }
    return points;
  }

  const std::vector<PartialFile>& clouds() const { return clouds_; }

 private:
  std::vector<PartialFile> clouds_;
};

// Opens the files. Reports each that cannot be opened or does not belong to the others; then returns false.
bool open_files(const std::vector<std::string>& files, const Options& options, Shares& shares,
                std::vector<std::string>& names, MergedClouds& clouds) {
  bool good = true;
  for (const std::string& name : files) {
    try {
      for (auto& share : open_object_file(name)) {
        const ObjectFileHeader& header = share->header();
        if (header.clusters != clusters_text(options.pipeline))
          throw IoError("was made with " + header.clusters + ": give the same options");
        if (!shares.empty() && shares.front()->scalar() != share->scalar())
          throw IoError("has points of another type (float32, float64) than the files before");
        clouds.add(header);
        shares.push_back(std::move(share));
        names.push_back(name);
      }
    } catch (const std::bad_alloc&) {
      throw;
    } catch (const std::exception& error) {
      report_problem(name + ": " + error.what());
      good = false;
    }
  }
  return good;
}

void describe(const MergedClouds& clouds, const Shares& shares, Report& report) {
  report.parts = 0;
  for (const PartialFile& cloud : clouds.clouds()) {
    if (!cloud.is_whole()) throw IoError("shares are missing: " + cloud.missing());
    *report.parts += cloud.inputs;
    report.points += cloud.cloud_points;
    report.counts.range += cloud.counts.range;
    report.counts.inside += cloud.counts.inside;
    report.origin = cloud.origin;
  }
  for (const auto& share : shares)
    report.counts.nonfinite += share->header().nonfinite;
}

// Returns whether the volumes of a component are in its file. `volumes` is the volumes_text() of the options.
bool is_known(const Shares& shares, const Options& options, const std::string& volumes,
              const ComponentOfShare& component) {
  const ObjectFile& share = *shares[component.share];
  return !options.check && share.header().volumes == volumes && share.has_text(component.number);
}

Object read_object(const Shares& shares, const ComponentOfShare& component) {
  try {
    return object_of(shares[component.share]->text(component.number).value());
  } catch (const IoError& error) {
    throw ShareError(component.share, error.what());
  }
}

void add_objects(const StoredClusters& clusters, const Shares& shares, const Options& options,
                 Report& report) {
  const ClassTable table(options.pipeline);
  const ObjectFitter fitter(options, table, std::nullopt);
  const std::string volumes = volumes_text(options.pipeline);
  std::vector<Object> objects(clusters.size());
  for_each_cluster(clusters, options.pipeline.execution(), [&](std::size_t i, const Execution& execution) {
    const auto component = clusters.component(i);
    objects[i] = component && is_known(shares, options, volumes, *component)
                     ? read_object(shares, *component)
                     : fitter.fit(clusters.points(i).view(), execution);
  });
  for (std::size_t i = 0; i < objects.size(); ++i) {
    if (objects[i].verdict == ExtentVerdict::small) report.counts.small += clusters.point_count(i);
    if (objects[i].verdict == ExtentVerdict::large) report.counts.large += clusters.point_count(i);
    if (objects[i].verdict != ExtentVerdict::keep) continue;
    objects[i].entry.id = report.clusters.size();
    report.clusters.push_back(std::move(objects[i].entry));
  }
}

void write_share(const Tiles& tiles, const ShareOption& number, const Options& options,
                 const std::filesystem::path& path, FileLife life, const GatherCells& gather) {
  const PipelineConfig& config = options.pipeline;
  const PointRange range = tiles.share(number.number, number.count);
  const SharePoints points(tiles, range, options.origin.at, options);
  const ClassTable table(config);
  ObjectFitter fitter(options, table, std::nullopt);
  StoredClusterOptions store = store_options(options, points.view().scalar);
  store.visit = [&](std::size_t brick, const std::vector<PointView>& found, const Execution& execution) {
    fitter.visit(brick, found, execution);
  };
  write_object_file(path, life, [&](const std::filesystem::path& file) {
    const MadeClusterShare share(points.view(), table.default_options(), store, config.execution(),
                                 {file, first_record_of_object_file(), gather});
    const std::vector<std::string> texts = fit_share(share, table.default_options(), options, fitter);
    tiles.require_unchanged();
    ObjectFileHeader header{describe_cloud(tiles, options.origin.at, options), clusters_text(config),
                            volumes_text(config), share.invalid_points()};
    if (range.first < range.second) header.cloud.shares = {range};
    header.cloud.counts.range = points.counts().range;
    header.cloud.counts.inside = points.counts().inside;
    header.nonfinite -= points.counts().range + points.counts().inside;
    complete_object_file(file, header, share, [&](std::uint32_t component) { return texts[component]; });
  });
}

}  // namespace

void write_object_share(const Tiles& tiles, const ShareOption& share, const Options& options,
                        const std::filesystem::path& path) {
  write_share(tiles, share, options, path, FileLife::lasting, {});
}

void write_temporary_object_share(const Tiles& tiles, const ShareOption& share, const Options& options,
                                  const std::filesystem::path& path, const GatherCells& gather) {
  // With --check, merging reads all points.
  write_share(tiles, share, options, path, FileLife::temporary, options.check ? GatherCells() : gather);
}

Status make_object_file(const Job& job, const Options& options) {
  const Interruption interruption([] {});
  try {
    if (!job.partials.empty()) {
      Shares shares;
      std::vector<std::string> names;
      MergedClouds clouds;
      if (!open_files(job.partials, options, shares, names, clouds)) return Status::failed;
      join_object_files(*options.partial, shares);
      return Status::done;
    }
    if (report_excluded_inputs(*job.tiles) != Status::done) return Status::failed;
    write_object_share(*job.tiles, options.share, options, *options.partial);
    report_notes(*job.tiles);
    return Status::done;
  } catch (const TileError& error) {
    report_problem(job.tiles->jobs()[error.tile()].input + ": " + error.what());
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    report_problem(options.partial->string() + ": " + error.what());
  }
  return Status::failed;
}

Status merge_object_files(const std::vector<std::string>& files, const Options& options, Report& report) {
  const auto begin = std::chrono::steady_clock::now();
  Shares shares;
  std::vector<std::string> names;
  MergedClouds clouds;
  if (!open_files(files, options, shares, names, clouds)) {
    report.error = "some partial results cannot be merged";
    return Status::failed;
  }
  describe(clouds, shares, report);
  std::vector<const ClusterShare*> pointers;
  for (const auto& share : shares) {
    share->first_number = clouds.points_before(share->header());
    pointers.push_back(share.get());
  }
  StoredClusterOptions store = store_options(options, shares.front()->scalar());
  const std::string volumes = volumes_text(options.pipeline);
  store.is_known = [&](const ComponentOfShare& component) {
    return is_known(shares, options, volumes, component);
  };
  try {
    const StoredClusters clusters(pointers, ClassTable(options.pipeline).default_options(), store,
                                  options.pipeline.execution());
    report.counts.small = clusters.counts().small;
    report.counts.large = clusters.counts().large;
    report.counts.noise = clusters.counts().noise;
    const std::chrono::duration<double> segment = std::chrono::steady_clock::now() - begin;
    add_objects(clusters, shares, options, report);
    const std::chrono::duration<double> all = std::chrono::steady_clock::now() - begin;
    if (options.timings) report.seconds = {0, segment.count(), (all - segment).count()};
  } catch (const ShareError& error) {
    throw IoError(names[error.share()] + ": " + error.what());
  }
  return report_failures(report);
}

}  // namespace pcl_bv::detail
