// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "kitti_score.h"

#include <algorithm>
#include <map>
#include <stdexcept>

#include "pipeline/track/assignment.h"

namespace pcl_bv::bench {
using namespace detail;
namespace {

constexpr int kMaxOccluded = 2, kMaxTruncated = 0;
constexpr double kMinImageHeight = 25;  // pixels

struct LabelFrame {
  std::vector<const KittiObject*> targets, others, dont_care;
};

bool in_dont_care(const ImageBox& box, const LabelFrame& labels) {
  return std::any_of(labels.dont_care.begin(), labels.dont_care.end(), [&](const KittiObject* region) {
    const ImageBox& r = region->image;
    const double width = std::min(box.right, r.right) - std::max(box.left, r.left),
                 height = std::min(box.bottom, r.bottom) - std::max(box.top, r.top);
    return width > 0 && height > 0 && width * height > 0.5 * box.area();
  });
}

// Returns whether a box that is assigned to no labelled object does not count.
bool is_ignored(const FoundBox& box, const LabelFrame& labels, const KittiCalibration& calibration,
                const KittiProtocol& protocol) {
  const std::optional<ImageBox> image = calibration.project(box);
  if (!image || image->bottom - image->top <= kMinImageHeight || in_dont_care(*image, labels)) return true;
  return !protocol.count_unlabelled &&
         std::none_of(labels.targets.begin(), labels.targets.end(),
                      [&](const KittiObject* target) { return ground_iou(target->base, box.base) > 0; });
}

// Returns the boxes that count: those without the ones that are assigned to objects that need not be found,
// and without the ignored ones.
std::vector<const FoundBox*> boxes_that_count(const std::vector<FoundBox>& boxes, const LabelFrame& labels,
                                              const KittiCalibration& calibration,
                                              const KittiProtocol& protocol) {
  std::vector<const KittiObject*> all = labels.targets;
  all.insert(all.end(), labels.others.begin(), labels.others.end());
  std::vector<AssignmentPair> pairs;
  for (std::size_t t = 0; t < all.size(); ++t) {
    for (std::size_t f = 0; f < boxes.size(); ++f) {
      const double iou = ground_iou(all[t]->base, boxes[f].base);
      if (iou >= protocol.min_iou) pairs.push_back({t, f, 1 - iou});
    }
  }
  SparseAssignment assignment;
  assignment.solve(all.size(), boxes.size(), pairs, 1);
  std::vector<const KittiObject*> partner(boxes.size(), nullptr);
  for (std::size_t t = 0; t < all.size(); ++t) {
    if (assignment.columns()[t] < boxes.size()) partner[assignment.columns()[t]] = all[t];
  }
  std::vector<const FoundBox*> counted;
  for (std::size_t f = 0; f < boxes.size(); ++f) {
    const bool target =
        std::find(labels.targets.begin(), labels.targets.end(), partner[f]) != labels.targets.end();
    if (partner[f] != nullptr ? target : !is_ignored(boxes[f], labels, calibration, protocol))
      counted.push_back(&boxes[f]);
  }
  return counted;
}

void add_frame(const LabelFrame& labels, const std::vector<const FoundBox*>& boxes, double min_iou,
               TrackScore& score) {
  std::vector<std::uint32_t> truths, tracks;
  std::vector<SimilarPair> pairs;
  for (const FoundBox* box : boxes)
    tracks.push_back(box->track);
  for (const KittiObject* target : labels.targets) {
    for (std::size_t f = 0; f < boxes.size(); ++f) {
      const double iou = ground_iou(target->base, boxes[f]->base);
      if (iou > 0) pairs.push_back({truths.size(), f, iou});
    }
    truths.push_back(target->id);
  }
  score.add(truths, tracks, std::move(pairs), min_iou);
}

std::map<std::size_t, LabelFrame> frames_of(const std::vector<KittiObject>& labels,
                                            const KittiProtocol& protocol) {
  std::map<std::size_t, LabelFrame> frames;
  for (const KittiObject& object : labels) {
    LabelFrame& frame = frames[object.frame];
    if (object.dont_care()) {
      frame.dont_care.push_back(&object);
    } else if (protocol.classes.count(object.type) != 0 && object.truncated <= kMaxTruncated &&
               object.occluded <= kMaxOccluded) {
      frame.targets.push_back(&object);
    } else {
      frame.others.push_back(&object);
    }
  }
  return frames;
}

const std::vector<FoundBox>& checked(const ResultFrame& frame) {
  std::set<std::uint32_t> tracks;
  for (const FoundBox& box : frame.boxes) {
    if (!tracks.insert(box.track).second)
      throw std::runtime_error("frame " + std::to_string(frame.number) + " has track " +
                               std::to_string(box.track) + " twice");
  }
  return frame.boxes;
}

}  // namespace

void add_kitti_sequence(const std::vector<KittiObject>& labels, const KittiCalibration& calibration,
                        const std::vector<ResultFrame>& results, const KittiProtocol& protocol,
                        TrackScore& score) {
  const std::map<std::size_t, LabelFrame> labelled = frames_of(labels, protocol);
  std::map<std::size_t, const ResultFrame*> found;
  for (const ResultFrame& frame : results) {
    if (!found.emplace(frame.number, &frame).second)
      throw std::runtime_error("frame " + std::to_string(frame.number) + " has two lines");
  }
  const std::size_t last =
      std::max(labelled.empty() ? 0 : labelled.rbegin()->first, found.empty() ? 0 : found.rbegin()->first);
  score.start_sequence();
  for (std::size_t number = 0; number <= last; ++number) {
    const auto truth = labelled.find(number);
    const auto result = found.find(number);
    const LabelFrame frame = truth == labelled.end() ? LabelFrame() : truth->second;
    const std::vector<FoundBox> boxes =
        result == found.end() ? std::vector<FoundBox>() : checked(*result->second);
    add_frame(frame, boxes_that_count(boxes, frame, calibration, protocol), protocol.min_iou, score);
  }
}

}  // namespace pcl_bv::bench
