// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Merges files of objects.

#include <algorithm>
#include <map>
#include <mutex>
#include <new>
#include <set>
#include <utility>

#include "class_points.h"
#include "commands/shared/messages.h"
#include "object_fitter.h"
#include "object_list.h"
#include "object_shares.h"
#include "object_texts.h"
#include "pcl_bv/io/raw_cloud.h"
#include "pcl_bv/io/untrusted_text.h"
#include "share_inputs.h"
#include "stopwatch.h"

namespace pcl_bv::detail {
namespace {

bool have_same_ground(const ObjectFileHeader& a, const ObjectFileHeader& b) {
  return a.ground ? b.ground && a.ground->check_sum == b.ground->check_sum : !b.ground;
}

// Opens the files. Reports each that cannot be opened or does not belong to the others; then returns false.
bool open_files(const std::vector<std::string>& files, const Options& options, OpenShares& open) {
  bool good = true;
  const std::string clusters = clusters_text(options.pipeline);
  for (const std::string& name : files) {
    try {
      for (auto& share : open_object_file(name)) {
        if (share->header().clusters != clusters)
          throw IoError("was made with " + share->header().clusters + ": give the same options");
        if (!open.shares.empty() && open.shares.front()->scalar() != share->scalar())
          throw IoError("has points of another type (float32, float64) than the files before");
        if (!open.shares.empty() && !have_same_ground(open.shares.front()->header(), share->header()))
          throw IoError("was made with other --ground-parts than the files before");
        open.clouds.add(share->header().cloud);
        open.shares.push_back(std::move(share));
        open.names.push_back(name);
      }
    } catch (const std::bad_alloc&) {
      throw;
    } catch (const std::exception& error) {
      report_problem(name + ": " + reason_of(error));
      good = false;
    }
  }
  return good;
}

void describe(const OpenShares& open, Report& report) {
  report.parts = 0;
  open.clouds.require_whole();
  for (const PartialFile& cloud : open.clouds.clouds()) {
    *report.parts += cloud.inputs;
    report.points += cloud.cloud_points;
    report.counts.range += cloud.counts.range;
    report.counts.inside += cloud.counts.inside;
    report.origin = cloud.origin;
  }
  for (const auto& share : open.shares) {
    report.counts.nonfinite += share->header().nonfinite;
    if (share->header().ground) report.counts.ground += share->header().ground->points;
    report.counts.dropped_class += share->header().dropped_class;
  }
}

// Merges the shares of one class, or all shares without classes.
class ClassMerger {
 public:
  ClassMerger(const Options& options, const ClassTable& table, FileLife life,
              std::optional<std::int64_t> value, std::size_t points)
      : options_(options),
        table_(table),
        points_(points),
        value_(value),
        volumes_(volumes_text(options.pipeline, table, value)),
        life_(life) {}

  void add(const ObjectFile& share, const std::string& name) {
    shares_.push_back(&share);
    names_.push_back(&name);
  }

  // Adds the objects to the list, and the time for their volumes to `fit_seconds`. Returns Status::failed if
  // a share is damaged, after that is reported.
  Status merge(ObjectList& list, double& fit_seconds) {
    try {
      while (!attempt(list, fit_seconds)) {
      }
      report_problems();
      return problems_.empty() ? Status::done : Status::failed;
    } catch (const ShareError& error) {
      report_problems();
      throw IoError(*names_[error.share()] + ": " + error.what());
    }
  }

 private:
  // Returns false if texts are damaged. They are not used in the next attempt.
  bool attempt(ObjectList& list, double& fit_seconds) {
    StoredClusterOptions store = store_options(options_, shares_.front()->scalar());
    store.points_of_shares = points_;
    store.is_known = [&](const ComponentOfShare& component) {
      return !options_.objects && has_volumes(component);
    };
    if (life_ == FileLife::lasting)
      store.on_lost = [&](const ShareError& error, std::uint64_t points) {
        add_problem(error.share(), std::string(error.what()) + ": " + std::to_string(points) +
                                       " points are left out, so objects near them may be incomplete (JSON: "
                                       "\"incomplete\")");
      };
    auto clusters = std::make_unique<StoredClusters>(
        std::vector<const ClusterShare*>(shares_.begin(), shares_.end()), options_of_class(table_, value_),
        store, options_.pipeline.execution());
    const Stopwatch watch;
    std::vector<Object> objects = find_objects(*clusters);
    fit_seconds += watch.seconds();
    if (!new_bad_texts_.empty()) {
      bad_texts_.merge(std::exchange(new_bad_texts_, {}));
      return false;
    }
    list.add(std::move(clusters), std::move(objects));
    return true;
  }

  void report_problems() const {
    for (const auto& [share, problem] : problems_)
      report_problem(*names_[share] + ": " + problem);
  }

  // Several threads may call it at the same time.
  void add_problem(std::size_t share, const std::string& problem) {
    const std::lock_guard lock(mutex_);
    problems_.emplace(share, problem);
  }

  bool has_volumes(const ComponentOfShare& component) const {
    const ObjectFile& share = *shares_[component.share];
    return !options_.check && share.header().volumes == volumes_ && share.has_text(component.number) &&
           !bad_texts_.contains({component.share, component.number});
  }

  std::vector<Object> find_objects(const StoredClusters& clusters) {
    const ObjectFitter fitter(options_, table_, value_);
    std::vector<Object> objects(clusters.size());
    for_each_cluster(clusters, options_.pipeline.execution(), [&](std::size_t i, const Execution& execution) {
      const auto component = clusters.component(i);
      objects[i] = component && has_volumes(*component) ? read_object(*component)
                                                        : fitter.fit(clusters.points(i).view(), execution);
      objects[i].entry.incomplete = clusters.is_incomplete(i);
    });
    return objects;
  }

  // Several threads may call it at the same time.
  Object read_object(const ComponentOfShare& component) {
    try {
      return object_of(shares_[component.share]->text(component.number).value());
    } catch (const IoError& error) {
      add_problem(component.share, std::string(error.what()) + ": such volumes are fitted again");
      const std::lock_guard lock(mutex_);
      new_bad_texts_.emplace(component.share, component.number);
      return {};
    }
  }

  const Options& options_;
  const ClassTable& table_;
  std::size_t points_;  // of all shares and classes
  std::optional<std::int64_t> value_;
  std::string volumes_;
  std::vector<const ObjectFile*> shares_;
  std::vector<const std::string*> names_;
  FileLife life_;
  std::mutex mutex_;
  std::set<std::pair<std::size_t, std::string>> problems_;  // of shares, each once
  // Shares and numbers of components. Threads read those of earlier attempts, and add new ones.
  std::set<std::pair<std::size_t, std::uint32_t>> bad_texts_, new_bad_texts_;
};

}  // namespace

bool join_object_files(const std::vector<std::string>& files, const Options& options) {
  OpenShares open;
  if (!open_files(files, options, open)) return false;
  join_object_files(*options.partial, open.shares);
  return true;
}

Status merge_object_files(const Job& job, const std::vector<std::string>& files, FileLife life,
                          const Options& options, Report& report) {
  const Stopwatch watch;
  OpenShares open;
  if (!open_files(files, options, open)) {
    report.error = "some partial results cannot be merged";
    return Status::failed;
  }
  describe(open, report);
  const std::vector<LabelledInput> labelled =
      options.labels ? inputs_to_label(open, options) : std::vector<LabelledInput>();
  const ClassTable table(options.pipeline);
  std::map<std::optional<std::int64_t>, ClassMerger> classes;
  for (std::size_t i = 0; i < open.shares.size(); ++i) {
    ObjectFile& share = *open.shares[i];
    share.first_number = open.clouds.points_before(share.header().cloud);
    const auto value = share.header().class_value;
    classes.try_emplace(value, options, table, life, value, report.points)
        .first->second.add(share, open.names[i]);
  }
  ObjectList list(options, report);
  double fit_seconds = 0;
  Status status = Status::done;
  for (auto& [value, merger] : classes)
    status = worse(status, merger.merge(list, fit_seconds));
  list.write_report();
  if (options.timings) report.seconds = {0, watch.seconds() - fit_seconds, fit_seconds};
  if (job.objects) status = worse(status, list.write_points(*job.objects));
  if (options.labels) {
    const ScalarType scalar = open.shares.front()->scalar();
    status = worse(status, write_input_labels(labelled, open, report.origin, scalar, list));
  }
  return status;
}

}  // namespace pcl_bv::detail
