// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "box_format.h"

#include <algorithm>

#include "commands/shared/kitti_boxes.h"
#include "commands/shared/messages.h"
#include "commands/shared/values.h"
#include "pipeline/config/names.h"

namespace pcl_bv::detail {
namespace {

constexpr Names<OutputFormat, 11> kFormats{{{"text", OutputFormat::text},
                                            {"json", OutputFormat::json},
                                            {"jsonl", OutputFormat::jsonl},
                                            {"csv", OutputFormat::csv},
                                            {"kitti", OutputFormat::kitti},
                                            {"kitti-tracking", OutputFormat::kitti_tracking},
                                            {"nuscenes", OutputFormat::nuscenes},
                                            {"openlabel", OutputFormat::openlabel},
                                            {"sustech", OutputFormat::sustech},
                                            {"3dtiles", OutputFormat::tiles},
                                            {"3dtiles-region", OutputFormat::tile_regions}}};

// Formats whose boxes have only a yaw, and types that end at a blank.
bool is_kitti(OutputFormat format) {
  return format == OutputFormat::kitti || format == OutputFormat::kitti_tracking;
}

}  // namespace

OutputFormat read_output_format(const std::string& name) {
  return read_name(kFormats, name);
}

std::optional<BoxLabelFormat> box_label_format(OutputFormat format) {
  switch (format) {
    case OutputFormat::kitti:
      return BoxLabelFormat::kitti;
    case OutputFormat::kitti_tracking:
      return BoxLabelFormat::kitti_tracking;
    case OutputFormat::nuscenes:
      return BoxLabelFormat::nuscenes;
    case OutputFormat::openlabel:
      return BoxLabelFormat::openlabel;
    case OutputFormat::sustech:
      return BoxLabelFormat::sustech;
    default:
      return std::nullopt;
  }
}

std::string checked_object_type(const std::string& type, OutputFormat format) {
  if (!box_label_format(format))
    throw UsageError("--object-type: only useful with a --format of boxes, such as kitti");
  const bool printable = std::none_of(type.begin(), type.end(), [](char c) { return c >= 0 && c < ' '; });
  if (!printable || (is_kitti(format) && type.find(' ') != std::string::npos))
    reject_value("--object-type", type, "is no word; blanks separate the columns of KITTI's labels");
  return type;
}

void check_box_format(const std::string& name, const Options& options) {
  const bool tiles = options.format == OutputFormat::tiles;
  const bool regions = options.format == OutputFormat::tile_regions;
  if (!tiles && !regions && !box_label_format(options.format)) return;
  const std::string format = "--format " + name;
  if (options.origin.requested) throw UsageError("--origin: cannot be combined with " + format);
  if (is_kitti(options.format)) return check_kitti_boxes(format, options.pipeline);
  const std::vector<const Method*> methods = options.pipeline.methods();
  const bool any = std::any_of(methods.begin(), methods.end(), [&](const Method* m) {
    return m->shape == "aabb" || (!regions && m->shape == "obb") || (tiles && m->shape == "sphere");
  });
  if (any) return;
  if (regions) throw UsageError(format + ": needs --volume aabb");
  throw UsageError(format + ": needs boxes: --volume obb-yaw, obb-lshape, obb" +
                   (tiles ? ", aabb or sphere" : " or aabb"));
}

}  // namespace pcl_bv::detail
